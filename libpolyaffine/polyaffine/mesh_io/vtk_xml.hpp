#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <polyaffine/mesh_io/file_scanner.hpp>

/// VTK's XML format, as far as a mesh needs it; for the sources of this folder only.
namespace polyaffine::vtk_xml {

using Attributes = std::map<std::string, std::string>;

/// An element <DataArray>.
struct DataArray {
  std::string section;  ///< name of the element around it: Points, Cells, PointData, CellData, …
  int piece;            ///< number of the <Piece> it stands in, from 0
  Attributes attributes;
  std::string_view text;  ///< what stands between its tags
  std::size_t position;   ///< of the text in the file

  /// An attribute; `otherwise` where there is none.
  std::string attribute(const std::string& name, const std::string& otherwise = "") const;
};

/// A file taken apart; nothing is decoded. Throws InputError, naming file and line, for another kind of file.
class Document {
 public:
  explicit Document(const std::filesystem::path& file);
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  FileScanner scan;
  std::vector<DataArray> arrays;
  Attributes file;                 ///< attributes of <VTKFile>
  std::vector<Attributes> pieces;  ///< attributes of each <Piece>
  bool big_endian = false;         ///< byte order of the numbers
  std::string_view appended;       ///< all behind the _ of <AppendedData>
  bool appended_base64 = false;

  /// The array of a section of a piece, by its name (empty: the first one). Throws InputError when it is
  /// missing.
  const DataArray& array(int piece, const std::string& section, const std::string& name) const;

  /// Fails at a place of the file.
  [[noreturn]] void fail(std::size_t position, const std::string& what);

 private:
  void check_root(const std::string& name, const Attributes& attributes);
};

/// Is the type of the array one of VTK's numbers?
bool has_numbers(const DataArray& array);

/// The `count` numbers of an array: text, or raw or base64-coded bytes, with or without zlib. Throws
/// InputError, naming file and line, when there are more or fewer, they cannot be decoded, or would take more
/// than 256 MB and a hundred times the size of the file.
std::vector<double> values(Document& document, const DataArray& array, std::size_t count);

}  // namespace polyaffine::vtk_xml
