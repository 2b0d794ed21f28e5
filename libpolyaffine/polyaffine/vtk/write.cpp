#include "polyaffine/vtk/write.hpp"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cerrno>
#include <polyaffine/core/atomic_file.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/vtk/message_trap.hpp>
#include <sstream>
#include <system_error>

namespace polyaffine {
namespace {

using std::filesystem::path;

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

vtkSmartPointer<vtkDoubleArray> double_array(const std::string& name, const Matrix& field) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(field.rows()));
  array->SetNumberOfTuples(field.cols());
  std::copy(field.data(), field.data() + field.size(), array->GetPointer(0));
  return array;
}

vtkSmartPointer<vtkDataArray> field_array(const WriteFields& fields, const std::string& name,
                                          const Matrix& field) {
  if (!fields.single.contains(name)) return double_array(name, field);
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(field.rows()));
  array->SetNumberOfTuples(field.cols());
  std::transform(field.data(), field.data() + field.size(), array->GetPointer(0),
                 [](double value) { return static_cast<float>(value); });
  return array;
}

vtkSmartPointer<vtkIntArray> int_array(const std::string& name, const std::vector<int>& values) {
  auto array = vtkSmartPointer<vtkIntArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

void name_components(const path& file, const WriteFields& fields, vtkDataSetAttributes& data) {
  for (const auto& [name, components] : fields.components) {
    vtkDataArray* array = data.GetArray(name.c_str());
    if (array == nullptr) continue;
    if (array->GetNumberOfComponents() != static_cast<int>(components.size()))
      throw InputError(file.string() + ": field \"" + name + "\": found " +
                       std::to_string(components.size()) + " names of components, expected " +
                       std::to_string(array->GetNumberOfComponents()));
    for (int k = 0; k < array->GetNumberOfComponents(); ++k)
      array->SetComponentName(k, components[k].c_str());
  }
}

void add_field_data(const WriteFields& fields, vtkFieldData& data) {
  for (const auto& [name, texts] : fields.texts) {
    vtkNew<vtkStringArray> array;
    array->SetName(name.c_str());
    for (const std::string& text : texts) array->InsertNextValue(text);
    data.AddArray(array);
  }
  for (const auto& [name, value] : fields.values)
    data.AddArray(double_array(name, Matrix::Constant(1, 1, value)));
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

vtkSmartPointer<vtkUnstructuredGrid> grid_of(const TetMesh& mesh, const Points& points,
                                             const std::vector<int>& faces) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> vertices;
  vertices->SetDataTypeToDouble();
  vertices->SetNumberOfPoints(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) vertices->SetPoint(i, points.col(i).data());
  grid->SetPoints(vertices);
  grid->Allocate(mesh.num_tets() + static_cast<vtkIdType>(faces.size()));
  for (int t = 0; t < mesh.num_tets(); ++t) {
    const Eigen::Matrix<vtkIdType, 4, 1> tet = mesh.tets().col(t).cast<vtkIdType>();
    grid->InsertNextCell(VTK_TETRA, 4, tet.data());
  }
  for (const int f : faces) {
    const Eigen::Matrix<vtkIdType, 3, 1> triangle = mesh.boundary().col(f).cast<vtkIdType>();
    grid->InsertNextCell(VTK_TRIANGLE, 3, triangle.data());
  }
  return grid;
}

}  // namespace

void write_vtu(const path& file, const TetMesh& mesh, const WriteFields& fields) {
  check_target(file, ".vtu");
  if (fields.points.cols() != 0) check_width(file, "points", fields.points, mesh.num_points(), "points");
  const std::vector<int> faces = labelled_faces(mesh);
  const auto num_cells = mesh.num_tets() + static_cast<Eigen::Index>(faces.size());
  const auto grid = grid_of(mesh, fields.points.cols() ? fields.points : mesh.points(), faces);

  std::vector<int> surface(num_cells, 0), region = mesh.regions();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    surface[mesh.num_tets() + i] = mesh.boundary_labels()[faces[i]];
    region.push_back(mesh.regions()[mesh.boundary_tets()[faces[i]]]);
  }
  if (!faces.empty()) grid->GetCellData()->AddArray(int_array("surface", surface));
  if (std::any_of(region.begin(), region.end(), [](int r) { return r != 0; }))
    grid->GetCellData()->AddArray(int_array("region", region));

  for (const auto& [name, field] : fields.point_fields) {
    check_width(file, name, field, mesh.num_points(), "points");
    grid->GetPointData()->AddArray(field_array(fields, name, field));
  }
  for (const auto& [name, field] : fields.cell_fields) {
    check_width(file, name, field, mesh.num_tets(), "tets");
    check_free(file, name);
    Matrix all(field.rows(), num_cells);
    all.leftCols(mesh.num_tets()) = field;
    for (std::size_t i = 0; i < faces.size(); ++i)
      all.col(mesh.num_tets() + static_cast<Eigen::Index>(i)) = field.col(mesh.boundary_tets()[faces[i]]);
    grid->GetCellData()->AddArray(field_array(fields, name, all));
  }
  for (const auto& [name, field] : fields.integer_cell_fields) {
    check_width(file, name, Matrix(1, field.size()), mesh.num_tets(), "tets");
    check_free(file, name);
    std::vector<int> all = field;
    for (const int f : faces) all.push_back(field[mesh.boundary_tets()[f]]);
    grid->GetCellData()->AddArray(int_array(name, all));
  }
  name_components(file, fields, *grid->GetPointData());
  name_components(file, fields, *grid->GetCellData());
  add_field_data(fields, *grid->GetFieldData());

  const MessageTrap trap;
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetInputData(grid);
  write_atomically(file, [&](const path& temporary) {
    errno = 0;
    writer->SetFileName(temporary.c_str());
    if (writer->Write() != 1 || !trap.first_error().empty())
      throw ComputationError("cannot write " + file.string() + " to its end" +
                             (errno == 0 ? "" : ": " + std::generic_category().message(errno)));
  });
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
