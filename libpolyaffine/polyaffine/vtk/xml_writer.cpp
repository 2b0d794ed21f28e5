#include "polyaffine/vtk/xml_writer.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <new>
#include <type_traits>

namespace polyaffine::vtk_xml {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

constexpr std::size_t kBlock = std::size_t{1} << 18U;
// What a block is tried with, and the share of its bytes that must be saved to compress all of it.
constexpr std::size_t kSample = 1024;
constexpr double kLeastSaving = 0.2;

std::string deflated(std::string_view bytes, int level) {
  std::string out(compressBound(bytes.size()), '\0');
  uLongf size = out.size();
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), level) != Z_OK)
    throw std::bad_alloc();  // the only failure with room enough for the result
  out.resize(size);
  return out;
}

bool is_worth_it(std::string_view block) {
  const std::string_view sample = block.substr(block.size() / 2, kSample);
  return static_cast<double>(deflated(sample, 1).size()) <=
         (1 - kLeastSaving) * static_cast<double>(sample.size());
}

std::string bytes_of(const std::vector<std::uint64_t>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(std::uint64_t)};
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

template <class T>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, float>) return "Float32";
  if constexpr (std::is_same_v<T, int>) return "Int32";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

std::string opening(const std::string& kind, const std::string& type, const std::string& name) {
  return "<" + kind + " type=\"" + type + "\" Name=\"" + escaped(name) + '"';
}

// Adds the elements of a part with the places of their data, and the data.
void add_part(const char* part, const std::vector<const StoredArrays*>& arrays, std::string& xml,
              std::string& data) {
  xml += std::string("<") + part + ">\n";
  for (const StoredArrays* some : arrays)
    for (const StoredArray& array : *some) {
      xml += array.element + " format=\"appended\" offset=\"" + std::to_string(data.size()) + "\"/>\n";
      data += array.data;
    }
  xml += std::string("</") + part + ">\n";
}

}  // namespace

std::string compressed(std::string_view bytes) {
  const std::size_t blocks = (bytes.size() + kBlock - 1) / kBlock;
  std::vector<std::uint64_t> head{blocks, kBlock, bytes.size() % kBlock};
  std::string data;
  for (std::size_t k = 0; k < blocks; ++k) {
    const std::string_view block = bytes.substr(k * kBlock, kBlock);
    const std::string stored = deflated(block, is_worth_it(block) ? 1 : 0);
    head.push_back(stored.size());
    data += stored;
  }
  return bytes_of(head) + data;
}

template <class T>
StoredArray number_array(const std::string& name, std::span<const T> values, std::int64_t components,
                         const std::vector<std::string>& component_names) {
  std::string element = opening("DataArray", type_name<T>(), name);
  element += " NumberOfComponents=\"" + std::to_string(components) + '"';
  for (std::size_t k = 0; k < component_names.size(); ++k)
    element += " ComponentName" + std::to_string(k) + "=\"" + escaped(component_names[k]) + '"';
  return {element, compressed({reinterpret_cast<const char*>(values.data()), values.size_bytes()})};
}
template StoredArray number_array(const std::string&, std::span<const double>, std::int64_t,
                                  const std::vector<std::string>&);
template StoredArray number_array(const std::string&, std::span<const float>, std::int64_t,
                                  const std::vector<std::string>&);
template StoredArray number_array(const std::string&, std::span<const int>, std::int64_t,
                                  const std::vector<std::string>&);
template StoredArray number_array(const std::string&, std::span<const std::uint8_t>, std::int64_t,
                                  const std::vector<std::string>&);

StoredArray field_value(const std::string& name, double value) {
  StoredArray out = number_array(name, std::span<const double>(&value, 1), 1);
  out.element += " NumberOfTuples=\"1\"";
  return out;
}

StoredArray text_array(const std::string& name, const std::vector<std::string>& texts) {
  std::string bytes;
  for (const std::string& text : texts) (bytes += text) += '\0';
  return {opening("Array", "String", name) + " NumberOfTuples=\"" + std::to_string(texts.size()) + '"',
          compressed(bytes)};
}

std::string file_text(const GridParts& parts) {
  std::string xml =
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n";
  std::string data;
  add_part("FieldData", parts.field_data, xml, data);
  xml += "<Piece NumberOfPoints=\"" + std::to_string(parts.points) + "\" NumberOfCells=\"" +
         std::to_string(parts.cells) + "\">\n";
  add_part("PointData", parts.point_data, xml, data);
  add_part("CellData", parts.cell_data, xml, data);
  add_part("Points", parts.vertices, xml, data);
  add_part("Cells", parts.topology, xml, data);
  return xml + "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_" + data +
         "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace polyaffine::vtk_xml
