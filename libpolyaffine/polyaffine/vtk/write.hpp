#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

/// What to write beside the mesh.
struct WriteFields {
  std::map<std::string, Matrix> point_fields{};  ///< components × points
  std::map<std::string, Matrix>
      cell_fields{};  ///< components × tets; a boundary triangle shows its tet's value
  Points points{};    ///< deformed positions (mm) instead of the mesh's, if not empty
  std::map<std::string, std::vector<int>> integer_cell_fields{};  ///< a number a tet
  /// Names of the components of a field (those above), by the field's name.
  std::map<std::string, std::vector<std::string>> components{};
  std::set<std::string> single{};  ///< fields (those above) written with single precision, in half the space
  std::map<std::string, std::vector<std::string>> texts{};  ///< field data: lists of texts
  std::map<std::string, double> values{};                   ///< field data: single numbers
};

/// Writes a .vtu file: tets, then the labelled boundary triangles, with the integer cell arrays "surface"
/// (label of a triangle, 0 on tets) and "region" (where the mesh has regions).
///
/// Coordinates are mm, data is binary in zlib's format, compressed where that saves space. The file is
/// written under a temporary name and renamed when whole. Throws InputError when the name does not end in
/// .vtu, its folder does not exist, or a field does not fit the mesh or has another number of components than
/// names; ComputationError when writing fails.
void write_vtu(const std::filesystem::path& path, const TetMesh& mesh, const WriteFields& fields = {});

/// Writes the files of a series: what is the same in all of them (connectivity, labels, the fields given
/// here) is compressed once.
class VtuSeries {
 public:
  /// `constant` fields fit the mesh, which must outlive the series; its points are not used. Throws
  /// InputError, naming the field, as write_vtu.
  explicit VtuSeries(const TetMesh& mesh, const WriteFields& constant = {});
  VtuSeries(VtuSeries&&) noexcept;
  ~VtuSeries();
  /// Writes a file with further fields, none of which is among the constant ones. Throws as write_vtu.
  void write(const std::filesystem::path& path, const WriteFields& fields) const;

 private:
  struct Parts;
  const TetMesh& mesh_;
  std::unique_ptr<const Parts> parts_;
};

/// Writes a ParaView collection that gives each file of a series its time in ms (the unit is said in a
/// comment of the file). Files are named relative to the collection's folder; the same errors as write_vtu.
void write_pvd(const std::filesystem::path& path, const std::vector<double>& times_ms,
               const std::vector<std::filesystem::path>& files);

}  // namespace polyaffine
