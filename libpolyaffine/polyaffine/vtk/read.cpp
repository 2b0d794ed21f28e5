#include "polyaffine/vtk/read.hpp"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStaticPointLocator.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>
#include <cmath>
#include <limits>
#include <polyaffine/core/error.hpp>
#include <polyaffine/vtk/message_trap.hpp>

namespace polyaffine {
namespace {

using std::filesystem::path;

[[noreturn]] void fail(const path& file, const std::string& what) {
  throw InputError(file.string() + ": " + what);
}

template <class Reader>
vtkSmartPointer<vtkPointSet> load_as(const path& file) {
  const MessageTrap trap;
  const auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(file.c_str());
  reader->Update();
  const vtkSmartPointer<vtkPointSet> data = reader->GetOutput();
  const std::string error = trap.first_error();
  if (!error.empty() || reader->GetErrorCode() != 0)
    fail(file, "found a damaged file, expected a VTK XML file" + (error.empty() ? "" : " (" + error + ")"));
  return data;
}

vtkSmartPointer<vtkPointSet> load(const path& file, bool polydata_too) {
  const std::string extension = file.extension().string();
  const bool polydata = polydata_too && extension == ".vtp";
  if (extension != ".vtu" && !polydata)
    fail(file, "found the extension \"" + extension + "\", expected .vtu" + (polydata_too ? " or .vtp" : ""));
  if (!std::filesystem::is_regular_file(file)) fail(file, "found no such file");
  const auto data =
      polydata ? load_as<vtkXMLPolyDataReader>(file) : load_as<vtkXMLUnstructuredGridReader>(file);
  if (!data || data->GetNumberOfPoints() == 0 || data->GetNumberOfCells() == 0)
    fail(file, "found no points or no cells, expected a mesh");
  return data;
}

/// Cells of one type: their numbers in the file and their points.
struct Cells {
  std::vector<vtkIdType> ids;
  std::vector<vtkIdType> points;
};

Cells cells_of_type(vtkPointSet& data, int type) {
  Cells out;
  vtkNew<vtkIdList> points;
  for (vtkIdType c = 0; c < data.GetNumberOfCells(); ++c) {
    if (data.GetCellType(c) != type) continue;
    data.GetCellPoints(c, points);
    out.ids.push_back(c);
    out.points.insert(out.points.end(), points->begin(), points->end());
  }
  return out;
}

void check_cell_types(vtkPointSet& data, const path& file, bool tets_allowed) {
  for (vtkIdType c = 0; c < data.GetNumberOfCells(); ++c) {
    const int type = data.GetCellType(c);
    if (type == VTK_TRIANGLE || (type == VTK_TETRA && tets_allowed)) continue;
    fail(file, "cell " + std::to_string(c) + " (counted from 0): found the type " +
                   vtkCellTypes::GetClassNameFromTypeId(type) + ", expected " +
                   (tets_allowed ? "vtkTetra (linear tetrahedron) or " : "") + "vtkTriangle");
  }
}

vtkDataArray* numeric_cell_array(vtkPointSet& data, const std::string& name) {
  return data.GetCellData()->GetArray(name.c_str());
}

std::string names_of(vtkFieldData& fields) {
  std::string names;
  for (int i = 0; i < fields.GetNumberOfArrays(); ++i)
    names += (i ? ", \"" : "\"") + std::string(fields.GetArrayName(i) ? fields.GetArrayName(i) : "") + "\"";
  return names.empty() ? "none" : names;
}

std::vector<int> integers(vtkDataArray& array, const std::vector<vtkIdType>& cells, const path& file) {
  if (array.GetNumberOfComponents() != 1)
    fail(file, std::string("cell array \"") + array.GetName() + "\": found " +
                   std::to_string(array.GetNumberOfComponents()) +
                   " components, expected one integer a cell");
  std::vector<int> out;
  out.reserve(cells.size());
  for (const vtkIdType c : cells) {
    const double value = array.GetTuple1(c);
    if (!(std::abs(value) <= std::numeric_limits<int>::max()) || value != std::round(value))
      fail(file, std::string("cell array \"") + array.GetName() + "\", cell " + std::to_string(c) +
                     ": found " + std::to_string(value) + ", expected an integer");
    out.push_back(static_cast<int>(value));
  }
  return out;
}

vtkDataArray& label_array(vtkPointSet& data, const std::string& wanted, const path& file) {
  const std::array<std::string, 3> candidates{"surface", "label", "tag"};
  if (!wanted.empty()) {
    if (auto* found = numeric_cell_array(data, wanted)) return *found;
  } else {
    for (const auto& name : candidates)
      if (auto* found = numeric_cell_array(data, name)) return *found;
  }
  fail(file, "found no label array for the surface triangles (cell arrays: " + names_of(*data.GetCellData()) +
                 "), expected an integer cell array named " +
                 (wanted.empty() ? "\"surface\", \"label\" or \"tag\"" : "\"" + wanted + "\""));
}

/// Values of chosen tuples, components × chosen.
Matrix chosen_tuples(vtkDataArray& array, const std::vector<vtkIdType>& chosen, const path& file) {
  Matrix out(array.GetNumberOfComponents(), static_cast<Eigen::Index>(chosen.size()));
  for (Eigen::Index i = 0; i < out.cols(); ++i) array.GetTuple(chosen[i], out.col(i).data());
  if (!out.allFinite())
    fail(file, std::string("array \"") + array.GetName() + "\": found a value that is not a finite number");
  return out;
}

std::map<std::string, Matrix> fields_of(vtkFieldData& data, const std::vector<vtkIdType>& chosen,
                                        const path& file) {
  std::map<std::string, Matrix> out;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data.GetArray(i);
    if (!array || !array->GetName()) continue;
    const std::string name = array->GetName();
    if (name != "surface" && name != "region") out[name] = chosen_tuples(*array, chosen, file);
  }
  return out;
}

/// Points of the file that some tet uses, renumbered.
struct UsedPoints {
  std::vector<vtkIdType> ids;  ///< number in the file of each used point
  std::vector<int> number;     ///< new number of each point of the file, −1 where unused
};

UsedPoints used_points(const Cells& tets, vtkIdType num_points) {
  UsedPoints used;
  used.number.assign(num_points, -1);
  for (const vtkIdType p : tets.points) used.number[p] = 0;
  for (vtkIdType p = 0; p < num_points; ++p)
    if (used.number[p] == 0) {
      used.number[p] = static_cast<int>(used.ids.size());
      used.ids.push_back(p);
    }
  return used;
}

Points used_coordinates(vtkPointSet& data, const std::vector<vtkIdType>& ids, double mm_per_unit) {
  Points points(3, static_cast<Eigen::Index>(ids.size()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) data.GetPoint(ids[i], points.col(i).data());
  return mm_per_unit * points;
}

/// Triangles of `surface` on the used points of `mesh`; own points are found by their coordinates.
Triangles join_triangles(const Cells& cells, vtkPointSet& surface, vtkPointSet& mesh, const UsedPoints& used,
                         const path& file) {
  vtkNew<vtkPoints> candidates;
  for (const vtkIdType id : used.ids) candidates->InsertNextPoint(mesh.GetPoint(id));
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(candidates);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  const double tolerance = 1e-5 * cloud->GetLength();

  Triangles out(3, static_cast<Eigen::Index>(cells.ids.size()));
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const vtkIdType p = cells.points[i];
    if (&surface == &mesh && used.number[p] >= 0) {
      out.data()[i] = used.number[p];
      continue;
    }
    Vec3 x;
    surface.GetPoint(p, x.data());
    double distance2 = 0;
    const vtkIdType near =
        x.allFinite() ? locator->FindClosestPointWithinRadius(tolerance, x.data(), distance2) : -1;
    if (near < 0)
      fail(file, "triangle " + std::to_string(cells.ids[i / 3]) + ": found its point (" +
                     std::to_string(x[0]) + ", " + std::to_string(x[1]) + ", " + std::to_string(x[2]) +
                     ") away from every tet vertex, expected one within " + std::to_string(tolerance) +
                     " (in the file's unit)");
    out.data()[i] = static_cast<int>(near);
  }
  return out;
}

}  // namespace

MeshFile read_mesh_file(const path& file, double mm_per_unit, const ReadOptions& options) {
  if (!(mm_per_unit > 0) || !std::isfinite(mm_per_unit))
    fail(file, "found a length unit of " + std::to_string(mm_per_unit) + " mm, expected a positive length");
  const auto data = load(file, false);
  check_cell_types(*data, file, true);
  const Cells tet_cells = cells_of_type(*data, VTK_TETRA);
  if (tet_cells.ids.empty())
    fail(file, "found no tetrahedra (only surface triangles), expected linear tetrahedra");

  const UsedPoints used = used_points(tet_cells, data->GetNumberOfPoints());
  Tets tets(4, static_cast<Eigen::Index>(tet_cells.ids.size()));
  for (Eigen::Index i = 0; i < tets.size(); ++i) tets.data()[i] = used.number[tet_cells.points[i]];

  const bool own_surface = options.surface_file.empty();
  const path& surface_path = own_surface ? file : options.surface_file;
  const auto surface_data = own_surface ? data : load(surface_path, true);
  if (!own_surface) check_cell_types(*surface_data, surface_path, false);
  const Cells triangle_cells = cells_of_type(*surface_data, VTK_TRIANGLE);
  if (triangle_cells.ids.empty() && !(own_surface && options.label_array.empty()))
    fail(surface_path, "found no triangles, expected labelled surface triangles");
  LabelledTriangles surface;
  if (!triangle_cells.ids.empty()) {
    surface.labels = integers(label_array(*surface_data, options.label_array, surface_path),
                              triangle_cells.ids, surface_path);
    surface.triangles = join_triangles(triangle_cells, *surface_data, *data, used, surface_path);
  }

  std::vector<int> regions;
  if (auto* region = numeric_cell_array(*data, "region")) regions = integers(*region, tet_cells.ids, file);

  MeshFile out;
  try {
    out.mesh = TetMesh(used_coordinates(*data, used.ids, mm_per_unit), tets, regions, surface);
  } catch (const InputError& error) {
    fail(file, error.what());
  }
  if (options.fields) {
    out.point_fields = fields_of(*data->GetPointData(), used.ids, file);
    out.cell_fields = fields_of(*data->GetCellData(), tet_cells.ids, file);
  }
  return out;
}

TetMesh read_vtu(const path& file, double mm_per_unit, const ReadOptions& options) {
  return read_mesh_file(file, mm_per_unit, options).mesh;
}

}  // namespace polyaffine
