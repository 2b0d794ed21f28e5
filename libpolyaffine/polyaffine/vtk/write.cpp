#include "polyaffine/vtk/write.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <sstream>

#include <polyaffine/core/atomic_file.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/vtk/xml_writer.hpp>

namespace polyaffine {
namespace {

using std::filesystem::path;
using vtk_xml::StoredArray;
using vtk_xml::StoredArrays;

void check_target(const path& file, const std::string& extension) {
  if (file.extension() != extension)
    throw InputError(file.string() + ": found the extension \"" + file.extension().string() +
                     "\", expected " + extension);
  const path folder = file.has_parent_path() ? file.parent_path() : path(".");
  if (!std::filesystem::is_directory(folder))
    throw InputError(file.string() + ": found no folder " + folder.string() + " to write into");
}

void check_width(const path& file, const std::string& name, const Matrix& field, int expected,
                 const std::string& of) {
  if (field.rows() == 0 || field.cols() != expected)
    throw InputError(file.string() + ": field \"" + name + "\": found " + std::to_string(field.rows()) +
                     " × " + std::to_string(field.cols()) + " values, expected components × " +
                     std::to_string(expected) + " " + of);
}

// Numbers of VTK's cell types.
constexpr std::uint8_t kTriangle = 5, kTet = 10;

std::vector<std::string> components_of(const path& file, const WriteFields& fields, const std::string& name,
                                       Eigen::Index components) {
  const auto found = fields.components.find(name);
  if (found == fields.components.end()) return {};
  if (std::ssize(found->second) != components)
    throw InputError(file.string() + ": field \"" + name + "\": found " +
                     std::to_string(found->second.size()) + " names of components, expected " +
                     std::to_string(components));
  return found->second;
}

// The columns of a field in some order, with the precision asked for.
template <class T, class Columns>
StoredArray array_of(const path& file, const WriteFields& fields, const std::string& name,
                     const Matrix& field, const Columns& columns) {
  const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> values =
      field(Eigen::all, columns).template cast<T>();
  return vtk_xml::number_array(name,
                               std::span<const T>(values.data(), static_cast<std::size_t>(values.size())),
                               field.rows(), components_of(file, fields, name, field.rows()));
}
template <class Columns>
StoredArray field_array(const path& file, const WriteFields& fields, const std::string& name,
                        const Matrix& field, const Columns& columns) {
  return fields.single.contains(name) ? array_of<float>(file, fields, name, field, columns)
                                      : array_of<double>(file, fields, name, field, columns);
}

StoredArray int_array(const path& file, const WriteFields& fields, const std::string& name,
                      const std::vector<int>& values) {
  return vtk_xml::number_array(name, std::span<const int>(values), 1, components_of(file, fields, name, 1));
}

// Of a cell field: its name is not one that the labels of the mesh have.
void check_free(const path& file, const std::string& name) {
  if (name == "surface" || name == "region")
    throw InputError(file.string() + ": cell field \"" + name +
                     "\": the name is reserved for the labels of the mesh");
}

/// Indices of the boundary triangles that carry a label.
std::vector<int> labelled_faces(const TetMesh& mesh) {
  std::vector<int> faces;
  for (int f = 0; f < static_cast<int>(mesh.boundary_labels().size()); ++f)
    if (mesh.boundary_labels()[f] != TetMesh::kUnlabelled) faces.push_back(f);
  return faces;
}

StoredArrays topology_of(const TetMesh& mesh, const std::vector<int>& faces) {
  std::vector<int> connectivity(mesh.tets().data(), mesh.tets().data() + mesh.tets().size()), offsets;
  std::vector<std::uint8_t> types(mesh.num_tets(), kTet);
  for (int t = 1; t <= mesh.num_tets(); ++t) offsets.push_back(4 * t);
  for (const int f : faces) {
    for (const int corner : mesh.boundary().col(f)) connectivity.push_back(corner);
    offsets.push_back(static_cast<int>(connectivity.size()));
    types.push_back(kTriangle);
  }
  return {vtk_xml::number_array("connectivity", std::span<const int>(connectivity), 1),
          vtk_xml::number_array("offsets", std::span<const int>(offsets), 1),
          vtk_xml::number_array("types", std::span<const std::uint8_t>(types), 1)};
}

StoredArrays labels_of(const TetMesh& mesh, const std::vector<int>& faces) {
  std::vector<int> surface(mesh.num_tets(), 0), region = mesh.regions();
  for (const int f : faces) {
    surface.push_back(mesh.boundary_labels()[f]);
    region.push_back(mesh.regions()[mesh.boundary_tets()[f]]);
  }
  StoredArrays out;
  if (!faces.empty()) out.push_back(vtk_xml::number_array("surface", std::span<const int>(surface), 1));
  if (std::ranges::any_of(region, [](int r) { return r != 0; }))
    out.push_back(vtk_xml::number_array("region", std::span<const int>(region), 1));
  return out;
}

struct FieldArrays {
  StoredArrays field_data, point_data, cell_data;
};

// `tets`: whose value each cell shows.
FieldArrays arrays_of(const path& file, const TetMesh& mesh, const std::vector<int>& tets,
                      const WriteFields& fields) {
  FieldArrays out;
  for (const auto& [name, texts] : fields.texts) out.field_data.push_back(vtk_xml::text_array(name, texts));
  for (const auto& [name, value] : fields.values) out.field_data.push_back(vtk_xml::field_value(name, value));
  for (const auto& [name, field] : fields.point_fields) {
    check_width(file, name, field, mesh.num_points(), "points");
    out.point_data.push_back(field_array(file, fields, name, field, Eigen::all));
  }
  for (const auto& [name, field] : fields.cell_fields) {
    check_width(file, name, field, mesh.num_tets(), "tets");
    check_free(file, name);
    out.cell_data.push_back(field_array(file, fields, name, field, tets));
  }
  for (const auto& [name, field] : fields.integer_cell_fields) {
    check_width(file, name, Matrix(1, field.size()), mesh.num_tets(), "tets");
    check_free(file, name);
    std::vector<int> all;
    for (const int t : tets) all.push_back(field[t]);
    out.cell_data.push_back(int_array(file, fields, name, all));
  }
  return out;
}

}  // namespace

struct VtuSeries::Parts {
  std::vector<int> tets;  // whose value each cell shows
  StoredArrays topology, labels;
  FieldArrays constant;
};

VtuSeries::VtuSeries(const TetMesh& mesh, const WriteFields& constant) : mesh_(mesh) {
  const std::vector<int> faces = labelled_faces(mesh);
  auto parts = std::make_unique<Parts>();
  for (int t = 0; t < mesh.num_tets(); ++t) parts->tets.push_back(t);
  for (const int f : faces) parts->tets.push_back(mesh.boundary_tets()[f]);
  parts->topology = topology_of(mesh, faces);
  parts->labels = labels_of(mesh, faces);
  parts->constant = arrays_of("series", mesh, parts->tets, constant);
  parts_ = std::move(parts);
}

VtuSeries::VtuSeries(VtuSeries&&) noexcept = default;
VtuSeries::~VtuSeries() = default;

void VtuSeries::write(const path& file, const WriteFields& fields) const {
  check_target(file, ".vtu");
  if (fields.points.cols() != 0) check_width(file, "points", fields.points, mesh_.num_points(), "points");
  const Points& points = fields.points.cols() != 0 ? fields.points : mesh_.points();
  const FieldArrays changing = arrays_of(file, mesh_, parts_->tets, fields);
  const StoredArrays vertices{vtk_xml::number_array(
      "Points", std::span<const double>(points.data(), static_cast<std::size_t>(points.size())), 3)};
  vtk_xml::GridParts grid{mesh_.num_points(), std::ssize(parts_->tets), {}, {}, {}, {&vertices}, {}};
  grid.topology = {&parts_->topology};
  grid.field_data = {&parts_->constant.field_data, &changing.field_data};
  grid.point_data = {&parts_->constant.point_data, &changing.point_data};
  grid.cell_data = {&parts_->labels, &parts_->constant.cell_data, &changing.cell_data};
  write_atomically(file, vtk_xml::file_text(grid));
}

void write_vtu(const path& file, const TetMesh& mesh, const WriteFields& fields) {
  check_target(file, ".vtu");
  VtuSeries(mesh).write(file, fields);
}

void write_pvd(const path& file, const std::vector<double>& times_ms, const std::vector<path>& files) {
  check_target(file, ".pvd");
  if (times_ms.size() != files.size())
    throw InputError(file.string() + ": found " + std::to_string(times_ms.size()) + " times for " +
                     std::to_string(files.size()) + " files, expected as many");
  const path folder = file.has_parent_path() ? file.parent_path() : path(".");
  std::ostringstream out;
  out.precision(15);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
         "  <!-- timestep: time in ms -->\n  <Collection>\n";
  for (std::size_t i = 0; i < files.size(); ++i)
    out << "    <DataSet timestep=\"" << times_ms[i] << "\" part=\"0\" file=\""
        << (files[i].is_relative() && !files[i].has_parent_path()
                ? files[i]
                : std::filesystem::proximate(files[i], folder))
               .generic_string()
        << "\"/>\n";
  out << "  </Collection>\n</VTKFile>\n";
  write_atomically(file, out.str());
}

}  // namespace polyaffine
