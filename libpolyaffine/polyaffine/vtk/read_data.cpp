#include "polyaffine/vtk/read_data.hpp"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkCharArray.h>
#include <vtkDataArray.h>
#include <vtkDataSetReader.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <array>
#include <new>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh_io/file_extension.hpp>
#include <polyaffine/mesh_io/file_scanner.hpp>
#include <polyaffine/vtk/child_process.hpp>
#include <polyaffine/vtk/message_trap.hpp>

namespace polyaffine {
namespace {

using std::filesystem::path;

[[noreturn]] void fail(const path& file, const std::string& what) {
  throw InputError(file.string() + ": " + what);
}

void open(vtkXMLReader& reader, const path& file) {
  reader.SetFileName(file.c_str());
}

/// The text with the names of types that VTK 9.1 does not know, but writers of the format 5.1 use (meshio's
/// int32 is "vtktypeint32"), replaced by those it knows; empty when there are none.
std::string with_known_types(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kTypes{
      {{"vtktypeint8", "char"},
       {"vtktypeuint8", "unsigned_char"},
       {"vtktypeint16", "short"},
       {"vtktypeuint16", "unsigned_short"},
       {"vtktypeint32", "int"},
       {"vtktypeuint32", "unsigned_int"},
       {"vtktypefloat32", "float"},
       {"vtktypefloat64", "double"}}};
  constexpr std::string_view kBegin = " vtktype";
  std::string out;
  std::size_t from = 0;
  for (std::size_t at = text.find(kBegin); at != std::string_view::npos; at = text.find(kBegin, at + 1)) {
    const std::size_t begin = at + 1, end = std::min(text.find_first_of(" \r\n", begin), text.size());
    const auto known = std::ranges::find(kTypes, text.substr(begin, end - begin),
                                         &std::pair<std::string_view, std::string_view>::first);
    if (known == kTypes.end()) continue;
    out.append(text.substr(from, begin - from)).append(known->second);
    from = end;
  }
  if (from > 0) out.append(text.substr(from));
  return out;
}

void open(vtkDataSetReader& reader, const path& file) {
  const FileScanner scan(file);
  const std::string text = with_known_types(scan.text());
  if (text.empty()) {
    reader.SetFileName(file.c_str());
    return;
  }
  const vtkNew<vtkCharArray> array;
  array->SetNumberOfValues(static_cast<vtkIdType>(text.size()));
  std::ranges::copy(text, array->GetPointer(0));
  reader.SetInputArray(array);
  reader.ReadFromInputStringOn();
}

template <class Reader>
vtkSmartPointer<vtkPointSet> load_as(const path& file, const char* format) {
  const MessageTrap trap;
  const auto reader = vtkSmartPointer<Reader>::New();
  open(*reader, file);
  const auto damaged = [&](const std::string& error) {
    fail(file, std::string("found a damaged file, expected a ") + format +
                   (error.empty() ? "" : " (" + error + ")"));
  };
  try {
    reader->Update();
  } catch (const std::bad_alloc&) {
    damaged("more data announced than memory holds");
  }
  const std::string error = trap.first_error();
  if (!error.empty() || reader->GetErrorCode() != 0) damaged(error);
  return vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
}

vtkSmartPointer<vtkPointSet> load(const path& file) {
  if (!std::filesystem::is_regular_file(file)) fail(file, "found no such file");
  const std::string extension = lower_extension(file);
  const auto data = extension == ".vtp" ? load_as<vtkXMLPolyDataReader>(file, "VTK XML file")
                                        : load_as<vtkDataSetReader>(file, "legacy VTK file");
  if (!data || data->GetNumberOfPoints() == 0 || data->GetNumberOfCells() == 0)
    fail(file, "found no points or no cells, expected a mesh (unstructured grid or polydata)");
  return data;
}

/// Numbers in the file of the cells of each kind.
struct CellNumbers {
  std::vector<vtkIdType> tets, triangles;
};

CellNumbers read_cells(vtkPointSet& grid, MeshData& data) {
  CellNumbers numbers;
  CellList tets{4}, triangles{3};
  std::size_t quadratic_tets = 0;
  vtkNew<vtkIdList> points;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    const int type = grid.GetCellType(c);
    const bool tet = type == VTK_TETRA || type == VTK_QUADRATIC_TETRA;
    const bool triangle = type == VTK_TRIANGLE || type == VTK_QUADRATIC_TRIANGLE;
    const bool line = type == VTK_VERTEX || type == VTK_POLY_VERTEX || type == VTK_LINE ||
                      type == VTK_POLY_LINE || type == VTK_QUADRATIC_EDGE;
    const auto cell = "cell " + std::to_string(c) + " (counted from 0): ";
    if (line) continue;
    if (!tet && !triangle)
      fail(data.source, cell + "found the type " + vtkCellTypes::GetClassNameFromTypeId(type) +
                            ", expected vtkTetra (tetrahedron) or vtkTriangle, linear or quadratic");
    grid.GetCellPoints(c, points);
    if (points->GetNumberOfIds() < (tet ? 4 : 3))
      fail(data.source, cell + "found " + std::to_string(points->GetNumberOfIds()) + " points, expected " +
                            (tet ? "4" : "3"));
    for (const vtkIdType p : *points)
      if (p < 0 || p >= data.points.cols())
        fail(data.source, cell + "found the point " + std::to_string(p) + ", expected 0 to " +
                              std::to_string(data.points.cols() - 1));
    (tet ? tets : triangles).add(*points);
    (tet ? numbers.tets : numbers.triangles).push_back(c);
    quadratic_tets += type == VTK_QUADRATIC_TETRA;
  }
  data.tets = tets.matrix();
  data.triangles = triangles.matrix();
  note_quadratic(data, quadratic_tets);
  return numbers;
}

/// Values of the chosen tuples of every numeric array.
std::map<std::string, Matrix> fields(vtkFieldData& arrays, const std::vector<vtkIdType>& chosen) {
  std::map<std::string, Matrix> out;
  for (int i = 0; i < arrays.GetNumberOfArrays(); ++i) {
    vtkDataArray* array = arrays.GetArray(i);
    if (array == nullptr || array->GetName() == nullptr) continue;
    Matrix& field = out[array->GetName()];
    field.resize(array->GetNumberOfComponents(), static_cast<Eigen::Index>(chosen.size()));
    for (Eigen::Index c = 0; c < field.cols(); ++c) array->GetTuple(chosen[c], field.col(c).data());
  }
  return out;
}

MeshData read(const path& file) {
  const auto grid = load(file);
  MeshData data;
  data.source = file;
  data.points.resize(3, grid->GetNumberOfPoints());
  std::vector<vtkIdType> points(grid->GetNumberOfPoints());
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p) {
    points[p] = p;
    grid->GetPoint(p, data.points.col(p).data());
  }
  const CellNumbers cells = read_cells(*grid, data);
  data.point_fields = fields(*grid->GetPointData(), points);
  data.tet_fields = fields(*grid->GetCellData(), cells.tets);
  data.triangle_fields = fields(*grid->GetCellData(), cells.triangles);
  return data;
}

}  // namespace

bool is_vtk_file(const path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".vtk" || extension == ".vtp";
}

MeshData read_vtk_data(const path& file) {
  return read_in_child(file, [&file] { return read(file); });
}

}  // namespace polyaffine
