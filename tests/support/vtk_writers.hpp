#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <polyaffine/mesh_io/mesh_data.hpp>

/// Writers of VTK's formats as other tools use them, for tests only: all fields of one component each.
namespace testing_io {

using polyaffine::Matrix;
using polyaffine::MeshData;

/// The names of all cell fields.
inline std::set<std::string> cell_fields(const MeshData& mesh) {
  std::set<std::string> names;
  for (const auto* fields : {&mesh.tet_fields, &mesh.triangle_fields})
    for (const auto& [name, field] : *fields) names.insert(name);
  return names;
}

/// The values of a cell field, tets first; NaN where a kind of cell lacks it.
inline std::vector<double> cell_values(const MeshData& mesh, const std::string& name) {
  std::vector<double> out;
  const auto add = [&](const std::map<std::string, Matrix>& fields, Eigen::Index count) {
    const auto field = fields.find(name);
    for (Eigen::Index c = 0; c < count; ++c)
      out.push_back(field == fields.end() ? std::numeric_limits<double>::quiet_NaN() : field->second(0, c));
  };
  add(mesh.tet_fields, mesh.tets.cols());
  add(mesh.triangle_fields, mesh.triangles.cols());
  return out;
}

/// XML, unstructured grid or (polydata) triangles only; numbers as raw bytes, so that they may be NaN.
inline void write_vtk_xml(const std::filesystem::path& file, const MeshData& mesh, bool polydata) {
  std::string data;
  const auto array = [&](const std::string& name, int components, const std::vector<double>& values) {
    const std::size_t offset = data.size();
    const auto bytes = static_cast<std::uint32_t>(8 * values.size());
    data.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    data.append(reinterpret_cast<const char*>(values.data()), bytes);
    return "<DataArray type=\"Float64\" Name=\"" + name + "\" NumberOfComponents=\"" +
           std::to_string(components) + "\" format=\"appended\" offset=\"" + std::to_string(offset) +
           "\"/>\n";
  };
  const auto list = [](const char* type, const char* name, const std::string& text) {
    return std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" format=\"ascii\">" + text +
           "</DataArray>\n";
  };
  const Eigen::Index tets = polydata ? 0 : mesh.tets.cols(), cells = tets + mesh.triangles.cols();
  std::string connectivity, offsets, types;
  std::size_t offset = 0;
  const auto add = [&](const auto& cell, const char* type) {
    for (const int p : cell) connectivity += std::to_string(p) + ' ';
    offsets += std::to_string(offset += static_cast<std::size_t>(cell.size())) + ' ';
    types += type;
  };
  for (Eigen::Index t = 0; t < tets; ++t) add(mesh.tets.col(t), "10 ");
  for (const auto& t : mesh.triangles.colwise()) add(t, "5 ");
  std::ofstream out(file, std::ios::binary);
  const std::string type = polydata ? "PolyData" : "UnstructuredGrid";
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type
      << "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n<" << type
      << ">\n<Piece NumberOfPoints=\"" << mesh.points.cols()
      << (polydata ? "\" NumberOfPolys=\"" : "\" NumberOfCells=\"") << cells << "\">\n<PointData>\n";
  for (const auto& [name, field] : mesh.point_fields)
    out << array(name, 1, {field.reshaped().begin(), field.reshaped().end()});
  out << "</PointData>\n<CellData>\n";
  for (const std::string& name : cell_fields(mesh)) out << array(name, 1, cell_values(mesh, name));
  out << "</CellData>\n<Points>\n"
      << array("Points", 3, {mesh.points.reshaped().begin(), mesh.points.reshaped().end()}) << "</Points>\n"
      << (polydata ? "<Polys>\n" : "<Cells>\n") << list("Int64", "connectivity", connectivity)
      << list("Int64", "offsets", offsets) << (polydata ? "" : list("UInt8", "types", types))
      << (polydata ? "</Polys>\n" : "</Cells>\n") << "</Piece>\n</" << type
      << ">\n<AppendedData encoding=\"raw\">_" << data << "</AppendedData>\n</VTKFile>\n";
}

/// The legacy format's binary numbers are big-endian.
template <class T>
void put_big_endian(std::ofstream& out, T value) {
  static_assert(std::endian::native == std::endian::little);
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  std::reverse(bytes, bytes + sizeof value);
  out.write(bytes, sizeof value);
}

/// Legacy, binary, version 3.0: tets and triangles with the triangle field "physical" as cell array "label".
inline void write_legacy_vtk_binary(const std::filesystem::path& file, const MeshData& mesh) {
  std::ofstream out(file, std::ios::binary);
  const Eigen::Index tets = mesh.tets.cols(), cells = tets + mesh.triangles.cols();
  out << "# vtk DataFile Version 3.0\nheart\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS " << mesh.points.cols()
      << " double\n";
  for (const double x : mesh.points.reshaped()) put_big_endian(out, x);
  out << "\nCELLS " << cells << ' ' << 5 * tets + 4 * mesh.triangles.cols() << '\n';
  const auto put = [&](const auto& cell) {
    put_big_endian(out, static_cast<std::int32_t>(cell.size()));
    for (const int p : cell) put_big_endian(out, p);
  };
  for (const auto& t : mesh.tets.colwise()) put(t);
  for (const auto& t : mesh.triangles.colwise()) put(t);
  out << "\nCELL_TYPES " << cells << '\n';
  for (Eigen::Index c = 0; c < cells; ++c) put_big_endian(out, c < tets ? 10 : 5);
  out << "\nCELL_DATA " << cells << "\nSCALARS label int 1\nLOOKUP_TABLE default\n";
  for (Eigen::Index c = 0; c < cells; ++c)
    put_big_endian(out, c < tets ? 0 : static_cast<int>(mesh.triangle_fields.at("physical")(0, c - tets)));
  out << '\n';
}

/// Legacy, binary, version 5.1, as meshio 5 writes integers of 32 bits: the triangle field "physical" as cell
/// array "label".
inline void write_meshio_vtk(const std::filesystem::path& file, const MeshData& mesh) {
  std::ofstream out(file, std::ios::binary);
  const Eigen::Index tets = mesh.tets.cols(), cells = tets + mesh.triangles.cols();
  out << "# vtk DataFile Version 5.1\nwritten by meshio v5.0.0\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS "
      << mesh.points.cols() << " double\n";
  for (const double x : mesh.points.reshaped()) put_big_endian(out, x);
  out << "\nCELLS " << cells + 1 << ' ' << 4 * tets + 3 * mesh.triangles.cols() << "\nOFFSETS vtktypeint64\n";
  for (Eigen::Index c = 0; c <= cells; ++c)
    put_big_endian(
        out, static_cast<std::int64_t>(4 * std::min(c, tets) + 3 * std::max<Eigen::Index>(0, c - tets)));
  out << "\nCONNECTIVITY vtktypeint64\n";
  for (const int p : mesh.tets.reshaped()) put_big_endian(out, static_cast<std::int64_t>(p));
  for (const int p : mesh.triangles.reshaped()) put_big_endian(out, static_cast<std::int64_t>(p));
  out << "\nCELL_TYPES " << cells << '\n';
  for (Eigen::Index c = 0; c < cells; ++c) put_big_endian(out, c < tets ? 10 : 5);
  out << "\n\nCELL_DATA " << cells << "\nFIELD FieldData 1\nlabel 1 " << cells << " vtktypeint32\n";
  for (Eigen::Index c = 0; c < cells; ++c)
    put_big_endian(out, c < tets ? 0 : static_cast<int>(mesh.triangle_fields.at("physical")(0, c - tets)));
  out << '\n';
}

/// Legacy, text, polydata without labels.
inline void write_vtk_polydata(const std::filesystem::path& file, const MeshData& mesh) {
  std::ofstream out(file);
  out.precision(17);
  out << "# vtk DataFile Version 3.0\nwall\nASCII\nDATASET POLYDATA\nPOINTS " << mesh.points.cols()
      << " double\n"
      << mesh.points.transpose() << "\nPOLYGONS " << mesh.triangles.cols() << ' ' << 4 * mesh.triangles.cols()
      << '\n';
  for (const auto& t : mesh.triangles.colwise()) out << "3 " << t.transpose() << '\n';
}

}  // namespace testing_io
