#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace polyaffine::vtk_xml {

/// An array of a .vtu file: its XML element up to the place of its data, and the data as they are appended.
struct StoredArray {
  std::string element;
  std::string data;
};
using StoredArrays = std::vector<StoredArray>;

/// Bytes as vtkZLibDataCompressor stores them: numbers and sizes of blocks (UInt64), then the blocks, each a
/// stream of zlib. Blocks whose beginning does not shrink (the digits of measured numbers) are streams
/// without compression: nothing is gained there, and compressing would be most of the time of writing.
std::string compressed(std::string_view bytes);

/// An array of numbers with some components, whose names (none or one each) are given. T is double, float,
/// int or std::uint8_t.
template <class T>
StoredArray number_array(const std::string& name, std::span<const T> values, std::int64_t components,
                         const std::vector<std::string>& component_names = {});
/// The same as field data, which tell the number of tuples.
StoredArray field_value(const std::string& name, double value);
StoredArray text_array(const std::string& name, const std::vector<std::string>& texts);

/// The parts of an unstructured grid; of a series those that change stand beside those that do not.
struct GridParts {
  std::int64_t points = 0, cells = 0;
  std::vector<const StoredArrays*> field_data, point_data, cell_data, vertices, topology;
};

/// The text of the file, with raw appended data.
std::string file_text(const GridParts& parts);

}  // namespace polyaffine::vtk_xml
