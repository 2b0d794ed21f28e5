#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <polyaffine/mesh/tet_mesh.hpp>
#include <polyaffine/mesh_io/mesh_data.hpp>

/// Writers of the formats that the readers know, for tests only. Labels of triangles are in the triangle
/// field "physical", those of tets in the tet field "region", fibres in the tet field "fibre" (absent: none).
namespace testing_io {

using polyaffine::MeshData;

inline MeshData data_of(const polyaffine::TetMesh& mesh) {
  MeshData out;
  out.points = mesh.points();
  out.tets = mesh.tets();
  out.triangles = mesh.boundary();
  out.triangle_fields["physical"] =
      Eigen::Map<const Eigen::RowVectorXi>(mesh.boundary_labels().data(), mesh.boundary().cols())
          .cast<double>();
  return out;
}

inline int value(const std::map<std::string, polyaffine::Matrix>& fields, const char* name, Eigen::Index i) {
  const auto field = fields.find(name);
  return field == fields.end() ? 0 : static_cast<int>(field->second(0, i));
}

/// Numbers as text or as raw bytes.
class NumberWriter {
 public:
  NumberWriter(const std::filesystem::path& file, bool binary)
      : out(file, std::ios::binary), binary_(binary) {
    out.precision(17);
  }
  NumberWriter& integer(long long i) { return put(static_cast<std::int32_t>(i)); }
  NumberWriter& size(long long i) { return put(static_cast<std::uint64_t>(i)); }
  NumberWriter& real(double x) { return put(x); }
  NumberWriter& line() {
    if (!binary_) out << '\n';
    return *this;
  }

  std::ofstream out;

 private:
  template <class T>
  NumberWriter& put(T number) {
    if (binary_)
      out.write(reinterpret_cast<const char*>(&number), sizeof number);
    else
      out << number << ' ';
    return *this;
  }
  bool binary_;
};

inline void write_gmsh_head(NumberWriter& to, const MeshData& mesh, const char* version, bool binary) {
  to.out << "$MeshFormat\n" << version << (binary ? " 1 8\n" : " 0 8\n");
  if (binary) to.integer(1).out << '\n';
  to.out << "$EndMeshFormat\n";
  if (mesh.surface_names.empty() && mesh.region_names.empty()) return;
  to.out << "$PhysicalNames\n" << mesh.surface_names.size() + mesh.region_names.size() << '\n';
  for (const auto& [number, name] : mesh.surface_names) to.out << "2 " << number << " \"" << name << "\"\n";
  for (const auto& [number, name] : mesh.region_names) to.out << "3 " << number << " \"" << name << "\"\n";
  to.out << "$EndPhysicalNames\n";
}

/// The fibres as $ElementData; tets are numbered from 1, triangles after them.
inline void write_gmsh_fibres(NumberWriter& to, const MeshData& mesh) {
  const auto fibre = mesh.tet_fields.find("fibre");
  if (fibre == mesh.tet_fields.end()) return;
  to.out << "$ElementData\n1\n\"fibre\"\n1\n0.0\n3\n0\n3\n" << mesh.tets.cols() << '\n';
  for (Eigen::Index t = 0; t < mesh.tets.cols(); ++t) {
    to.integer(t + 1);
    for (const double x : fibre->second.col(t)) to.real(x);
    to.line();
  }
  to.out << "\n$EndElementData\n";
}

inline void write_gmsh_2(const std::filesystem::path& file, const MeshData& mesh, bool binary) {
  NumberWriter to(file, binary);
  write_gmsh_head(to, mesh, "2.2", binary);
  to.out << "$Nodes\n" << mesh.points.cols() << '\n';
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    to.integer(i + 1);
    for (const double x : mesh.points.col(i)) to.real(x);
    to.line();
  }
  to.out << "$EndNodes\n$Elements\n" << mesh.tets.cols() + mesh.triangles.cols() << '\n';
  const auto write = [&](int type, Eigen::Index first, const auto& cells, const auto& tag) {
    if (cells.cols() == 0) return;
    if (binary) to.integer(type).integer(cells.cols()).integer(2);
    for (Eigen::Index c = 0; c < cells.cols(); ++c) {
      to.integer(first + c);
      if (!binary) to.integer(type).integer(2);
      to.integer(tag(c)).integer(7);
      for (const int p : cells.col(c)) to.integer(p + 1);
      to.line();
    }
  };
  write(4, 1, mesh.tets, [&](Eigen::Index t) { return value(mesh.tet_fields, "region", t); });
  write(2, 1 + mesh.tets.cols(), mesh.triangles,
        [&](Eigen::Index t) { return value(mesh.triangle_fields, "physical", t); });
  to.out << "\n$EndElements\n";
  write_gmsh_fibres(to, mesh);
}

/// Surfaces are the entities 10 + label, the volumes 1 + region.
inline void write_gmsh_4(const std::filesystem::path& file, const MeshData& mesh, bool binary) {
  NumberWriter to(file, binary);
  write_gmsh_head(to, mesh, "4.1", binary);
  std::map<int, std::vector<Eigen::Index>> surfaces, volumes;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    surfaces[value(mesh.triangle_fields, "physical", t)].push_back(t);
  for (Eigen::Index t = 0; t < mesh.tets.cols(); ++t)
    volumes[value(mesh.tet_fields, "region", t)].push_back(t);
  const auto entity = [&](int tag, int group) {
    to.integer(tag);
    for (int k = 0; k < 6; ++k) to.real(0);
    to.size(group == 0 ? 0 : 1);
    if (group != 0) to.integer(group);
    to.size(1).integer(3).line();  // one bounding entity
  };
  to.out << "$Entities\n";
  to.size(1)
      .size(0)
      .size(static_cast<long long>(surfaces.size()))
      .size(static_cast<long long>(volumes.size()))
      .line();
  to.integer(1).real(0).real(0).real(0).size(0).line();
  for (const auto& [label, cells] : surfaces) entity(10 + label, label);
  for (const auto& [region, cells] : volumes) entity(1 + region, region);
  const Eigen::Index n = mesh.points.cols(), half = n / 2;
  to.out << "\n$EndEntities\n$Nodes\n";
  to.size(2).size(n).size(1).size(n).line();
  for (const auto& [first, last] : {std::pair{Eigen::Index(0), half}, {half, n}}) {
    to.integer(3).integer(1).integer(0).size(last - first).line();
    for (Eigen::Index i = first; i < last; ++i) to.size(i + 1).line();
    for (Eigen::Index i = first; i < last; ++i) {
      for (const double x : mesh.points.col(i)) to.real(x);
      to.line();
    }
  }
  to.out << "\n$EndNodes\n$Elements\n";
  to.size(static_cast<long long>(surfaces.size() + volumes.size()))
      .size(mesh.tets.cols() + mesh.triangles.cols());
  to.size(1).size(mesh.tets.cols() + mesh.triangles.cols()).line();
  const auto write = [&](int dimension, int tag, int type, const auto& chosen, Eigen::Index first,
                         const auto& cells) {
    to.integer(dimension).integer(tag).integer(type).size(static_cast<long long>(chosen.size())).line();
    for (const Eigen::Index c : chosen) {
      to.size(first + c);
      for (const int p : cells.col(c)) to.size(p + 1);
      to.line();
    }
  };
  for (const auto& [label, chosen] : surfaces)
    write(2, 10 + label, 2, chosen, 1 + mesh.tets.cols(), mesh.triangles);
  for (const auto& [region, chosen] : volumes) write(3, 1 + region, 4, chosen, 1, mesh.tets);
  to.out << "\n$EndElements\n";
  write_gmsh_fibres(to, mesh);
}

/// NAME.pts, NAME.elem and, with fibres, NAME.lon; triangles come after the tets.
inline void write_opencarp(const std::filesystem::path& file, const MeshData& mesh) {
  const auto open = [&](const char* extension) {
    std::ofstream out(std::filesystem::path(file).replace_extension(extension));
    out.precision(17);
    return out;
  };
  std::ofstream points = open(".pts"), cells = open(".elem");
  points << mesh.points.cols() << '\n';
  for (const auto& x : mesh.points.colwise()) points << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
  cells << mesh.tets.cols() + mesh.triangles.cols() << '\n';
  for (Eigen::Index t = 0; t < mesh.tets.cols(); ++t)
    cells << "Tt " << mesh.tets.col(t).transpose() << ' ' << value(mesh.tet_fields, "region", t) << '\n';
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    cells << "Tr " << mesh.triangles.col(t).transpose() << ' ' << value(mesh.triangle_fields, "physical", t)
          << '\n';
  const auto fibre = mesh.tet_fields.find("fibre");
  if (fibre == mesh.tet_fields.end()) return;
  std::ofstream vectors = open(".lon");
  vectors << "1\n";
  for (const auto& f : fibre->second.colwise()) vectors << f.transpose() << '\n';
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) vectors << "1 0 0\n";
}

/// Legacy VTK, text.
inline void write_legacy_vtk(const std::filesystem::path& file, const MeshData& mesh) {
  std::ofstream out(file);
  out.precision(17);
  const auto cells = mesh.tets.cols() + mesh.triangles.cols();
  out << "# vtk DataFile Version 3.0\nheart\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " << mesh.points.cols()
      << " double\n"
      << mesh.points.transpose() << "\nCELLS " << cells << ' '
      << 5 * mesh.tets.cols() + 4 * mesh.triangles.cols() << '\n';
  for (const auto& t : mesh.tets.colwise()) out << "4 " << t.transpose() << '\n';
  for (const auto& t : mesh.triangles.colwise()) out << "3 " << t.transpose() << '\n';
  out << "CELL_TYPES " << cells << '\n';
  for (Eigen::Index c = 0; c < cells; ++c) out << (c < mesh.tets.cols() ? 10 : 5) << '\n';
  out << "CELL_DATA " << cells << "\nSCALARS label int 1\nLOOKUP_TABLE default\n";
  for (Eigen::Index t = 0; t < mesh.tets.cols(); ++t) out << "0\n";
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    out << value(mesh.triangle_fields, "physical", t) << '\n';
}

inline void write_stl(const std::filesystem::path& file, const MeshData& mesh, bool binary) {
  std::ofstream out(file, std::ios::binary);
  out.precision(9);
  const auto number = static_cast<std::uint32_t>(mesh.triangles.cols());
  if (binary) {
    out << std::string(80, 'x');
    out.write(reinterpret_cast<const char*>(&number), sizeof number);
  } else {
    out << "solid heart\n";
  }
  for (const auto& t : mesh.triangles.colwise()) {
    if (!binary) out << "facet normal 0 0 0\nouter loop\n";
    Eigen::Matrix<float, 3, 4> rows = Eigen::Matrix<float, 3, 4>::Zero();
    rows.rightCols(3) = mesh.points(Eigen::all, t).cast<float>();
    if (binary) {
      out.write(reinterpret_cast<const char*>(rows.data()), 48);
      out.write("\0\0", 2);
      continue;
    }
    for (int k = 1; k < 4; ++k) out << "vertex " << rows.col(k).transpose() << '\n';
    out << "endloop\nendfacet\n";
  }
  if (!binary) out << "endsolid heart\n";
}

inline void write_off(const std::filesystem::path& file, const MeshData& mesh) {
  std::ofstream out(file);
  out.precision(17);
  out << "OFF\n# a comment\n" << mesh.points.cols() << ' ' << mesh.triangles.cols() << " 0\n";
  out << mesh.points.transpose() << '\n';
  for (const auto& t : mesh.triangles.colwise()) out << "3 " << t.transpose() << " 0.5 0.5 0.5\n";
}

inline void write_obj(const std::filesystem::path& file, const MeshData& mesh) {
  std::ofstream out(file);
  out.precision(17);
  out << "# a comment\n";
  for (const auto& x : mesh.points.colwise()) out << "v " << x.transpose() << '\n';
  for (const auto& t : mesh.triangles.colwise())
    out << "f " << t[0] + 1 << "/1/2 " << t[1] + 1 << "//3 " << t[2] - mesh.points.cols() << '\n';
}

inline void write_ply(const std::filesystem::path& file, const MeshData& mesh, bool binary) {
  NumberWriter to(file, binary);
  to.out << "ply\nformat " << (binary ? "binary_little_endian" : "ascii")
         << " 1.0\ncomment a heart\nelement vertex " << mesh.points.cols()
         << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
         << mesh.triangles.cols()
         << "\nproperty list int int vertex_indices\nproperty int label\nend_header\n";
  for (const auto& x : mesh.points.colwise()) {
    for (const double c : x) to.real(c);
    to.line();
  }
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    to.integer(3);
    for (const int p : mesh.triangles.col(t)) to.integer(p);
    to.integer(value(mesh.triangle_fields, "physical", t)).line();
  }
}

}  // namespace testing_io
