#include "polyaffine/mesh_io/assemble.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/point_grid.hpp>
#include <polyaffine/mesh/tet_faces.hpp>
#include <polyaffine/mesh/triangle_adjacency.hpp>

namespace polyaffine {
namespace {

constexpr double kSamePoint = 1e-7, kSurfacePoint = 1e-5;  // relative to the size of the mesh

std::string place(const Vec3& x, const char* unit) {
  std::ostringstream out;
  out << '(' << x.x() << ", " << x.y() << ", " << x.z() << ") " << unit;
  return out.str();
}

[[noreturn]] void fail(const MeshData& data, const std::string& what) {
  throw InputError(data.source.string() + ": " + what);
}

/// Diagonal of the bounding box.
double extent(const Points& points) {
  return points.cols() == 0 ? 0 : (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

/// Points that stay, and for each old point its new number, −1 where it goes.
struct Numbering {
  std::vector<int> kept, number;
  std::size_t dropped = 0, joined = 0;
};

/// Keeps one point a place of those that are used.
Numbering unique_points(const MeshData& data, const std::vector<char>& used) {
  Numbering out;
  out.number.assign(data.points.cols(), -1);
  std::vector<int> candidates;
  for (int i = 0; i < static_cast<int>(data.points.cols()); ++i) {
    if (!used[i]) continue;
    candidates.push_back(i);
    if (!data.points.col(i).allFinite() || data.points.col(i).norm() > 1e100)
      fail(data, "mesh point " + std::to_string(i) +
                     " (counted from 0): found a coordinate that is not a number, expected finite lengths");
  }
  out.dropped = used.size() - candidates.size();
  const Points points = data.points(Eigen::all, candidates);
  const double size = extent(points);
  if (!(size > 0)) fail(data, "found all points in one place, expected a mesh");
  const Vec3 centre = points.rowwise().mean();
  PointGrid grid(kSamePoint * size);
  for (Eigen::Index c = 0; c < points.cols(); ++c) {
    const Vec3 x = points.col(c) - centre;
    int& number = out.number[candidates[c]] = grid.find(x);
    if (number >= 0) continue;
    number = static_cast<int>(out.kept.size());
    out.kept.push_back(candidates[c]);
    grid.add(x, number);
  }
  out.joined = candidates.size() - out.kept.size();
  return out;
}

template <class Cells>
Cells renumbered(Cells cells, const std::vector<int>& number) {
  for (int& p : cells.reshaped()) p = number[p];
  return cells;
}

void note_points(const Numbering& points, bool say_dropped, std::vector<std::string>& notes) {
  if (say_dropped && points.dropped > 0)
    notes.push_back(std::to_string(points.dropped) + " points without a tet dropped");
  if (points.joined > 0)
    notes.push_back(std::to_string(points.joined) + " points in the place of another joined with it");
}

/// Turns the negative tets. A tet is inverted, not just numbered the other way round, when it and its
/// neighbour still lie on the same side of their common face; no turning helps that.
void orient(const MeshData& data, const Points& points, Tets& tets, const std::vector<TetFace>& faces,
            std::vector<std::string>& notes) {
  std::vector<char> turned(tets.cols(), 0);
  const auto near = [&](Eigen::Index t) {
    return "mesh: tet " + std::to_string(t) + " (counted from 0) near " +
           place(points(Eigen::all, tets.col(t)).rowwise().mean(), "mm");
  };
  for (Eigen::Index t = 0; t < tets.cols(); ++t) {
    if (is_flat(points, tets.col(t)))
      fail(data, near(t) + " is flat: found volume " + std::to_string(signed_volume(points, tets.col(t))) +
                     " mm³, expected a positive volume");
    turned[t] = signed_volume(points, tets.col(t)) < 0;
  }
  const auto even = [&](const TetFace& face) {
    const auto& k = kTetFaces[face.local];
    const std::array<int, 3> v{tets(k[0], face.tet), tets(k[1], face.tet), tets(k[2], face.tet)};
    const bool ascending = (v[0] < v[1]) + (v[1] < v[2]) + (v[2] < v[0]) == 2;
    return ascending != (turned[face.tet] != 0);
  };
  for (std::size_t f = 0; f + 1 < faces.size(); ++f) {
    const TetFace &a = faces[f], &b = faces[f + 1];
    if (a.key != b.key || even(a) != even(b)) continue;
    const int t = turned[a.tet] ? a.tet : b.tet;
    fail(data,
         "mesh: tet " + std::to_string(t) + " (counted from 0) near " +
             place(points(Eigen::all, tets.col(t)).rowwise().mean(), "mm") +
             " is inverted: found it on the same side of a face as its neighbour, expected tets that do "
             "not overlap");
  }
  const auto count = std::ranges::count(turned, 1);
  for (Eigen::Index t = 0; t < tets.cols(); ++t)
    if (turned[t]) std::swap(tets(2, t), tets(3, t));
  if (count == tets.cols())
    notes.emplace_back("all tets turned to positive orientation");
  else if (count > 0)
    notes.push_back(std::to_string(count) + " tets turned to the orientation of the others");
}

[[noreturn]] void fail_off_face(const SurfaceData& surface, int triangle) {
  fail(surface.data, "labelled triangle " + std::to_string(triangle) + " (label " +
                         std::to_string(surface.labels[triangle]) +
                         ") is not a face of the boundary of the tetrahedra");
}

[[noreturn]] void fail_off_point(const MeshData& data, int triangle, int point, double tolerance) {
  std::ostringstream within;
  within << tolerance;
  fail(data, "triangle " + std::to_string(triangle) + ": found its point " +
                 place(data.points.col(point), "(in the file's unit)") +
                 " away from every tet vertex, expected one within " + within.str());
}

/// The chosen triangles on the points of the mesh (in the unit of the file); points without a number are
/// found by position. A point of an optional triangle that is nowhere is −1; fails when all are.
Triangles joined(const SurfaceData& surface, const std::vector<int>& chosen, const Points& points,
                 std::vector<int> number) {
  const MeshData& data = surface.data;
  const double tolerance = kSurfacePoint * extent(points);
  PointGrid grid(tolerance);
  const Vec3 centre = points.rowwise().mean();
  for (int i = 0; i < static_cast<int>(points.cols()); ++i) grid.add(points.col(i) - centre, i);
  Triangles out(3, static_cast<Eigen::Index>(chosen.size()));
  std::size_t found = 0;
  for (Eigen::Index i = 0; i < out.cols(); ++i) {
    int lost = -1;
    for (int k = 0; k < 3; ++k) {
      const int p = data.triangles(k, chosen[i]);
      const Vec3 x = data.points.col(p);
      if (number[p] < 0 && (x - centre).norm() <= 2 * extent(points)) number[p] = grid.find(x - centre);
      if (number[p] < 0) lost = p;
      out(k, i) = number[p];
    }
    found += lost < 0;
    const bool last = i + 1 == out.cols();
    if (lost >= 0 && (!surface.optional.contains(surface.labels[chosen[i]]) || (last && found == 0)))
      fail_off_point(data, chosen[i], lost, tolerance);
  }
  return out;
}

/// The labelled triangles on the boundary; those between two tets are left out.
LabelledTriangles labelled(const SurfaceData& surface, const std::vector<TetFace>& faces,
                           const Points& points, const std::vector<int>& number,
                           std::vector<std::string>& notes) {
  std::vector<int> chosen, outer;
  for (int i = 0; i < static_cast<int>(surface.labels.size()); ++i)
    if (surface.labels[i] != TetMesh::kUnlabelled) chosen.push_back(i);
  if (chosen.empty()) return {};
  const Triangles triangles = joined(surface, chosen, points, number);
  LabelledTriangles out;
  std::map<int, int> off;             // triangles of optional labels that are no faces
  std::map<FaceKey, std::size_t> at;  // place in the answer
  std::size_t inside = 0, repeated = 0, doubtful = 0;
  for (int i = 0; i < static_cast<int>(triangles.cols()); ++i) {
    const int label = surface.labels[chosen[i]];
    const bool optional = surface.optional.contains(label);
    if ((triangles.col(i).array() < 0).any()) {
      ++off[label];
      continue;
    }
    const FaceKey key = face_key(triangles(0, i), triangles(1, i), triangles(2, i));
    const auto first = std::ranges::lower_bound(faces, key, {}, &TetFace::key);
    const auto shared_by = std::ranges::upper_bound(first, faces.end(), key, {}, &TetFace::key) - first;
    if (shared_by == 0 && !optional) fail_off_face(surface, chosen[i]);
    off[label] += shared_by == 0;
    inside += shared_by > 1;
    if (shared_by != 1) continue;
    const auto [entry, first_time] = at.emplace(key, outer.size());
    if (first_time) {
      outer.push_back(i);
      out.labels.push_back(label);
      continue;
    }
    ++repeated;
    int& earlier = out.labels[entry->second];
    const bool replaced = surface.optional.contains(earlier) && !optional;
    doubtful += earlier != label && surface.optional.contains(earlier) == optional;
    if (replaced) earlier = label;
  }
  out.triangles = triangles(Eigen::all, outer);
  if (outer.empty() && inside == 0) fail_off_face(surface, chosen.front());
  if (inside > 0) notes.push_back(std::to_string(inside) + " labelled triangles inside the wall left out");
  if (repeated > 0) notes.push_back(std::to_string(repeated) + " repeated triangles left out");
  if (doubtful > 0)
    notes.push_back(std::to_string(doubtful) + " triangles are listed with two labels: the first one counts");
  for (const auto& [label, count] : off)
    if (count > 0)
      notes.push_back(std::to_string(count) + " triangles with label " + std::to_string(label) +
                      " left out: no faces of the boundary");
  return out;
}

void check_manifold(const MeshData& data, const TetMesh& mesh) {
  const TriangleAdjacency adjacency = triangle_adjacency(mesh.boundary());
  if (!adjacency.crowded.empty()) {
    const auto [a, b] = adjacency.crowded.front();
    fail(data, "mesh: the boundary is not manifold: found an edge of more than two boundary triangles near " +
                   place((mesh.points().col(a) + mesh.points().col(b)) / 2, "mm") +
                   ", expected parts of the wall to share faces, not only edges");
  }
  if (const int v = pinched_vertex(mesh.boundary(), adjacency.across); v >= 0)
    fail(data, "mesh: the boundary is not manifold: found parts that touch in the point " +
                   place(mesh.points().col(v), "mm") + " only, expected them to share faces");
}

/// Fields beside the labels; columns as `chosen` says.
template <class Chosen>
std::map<std::string, Matrix> kept_fields(const MeshData& data, const std::map<std::string, Matrix>& fields,
                                          const Chosen& chosen) {
  std::map<std::string, Matrix> out;
  for (const auto& [name, field] : fields) {
    if (name == "surface" || name == "region") continue;
    out[name] = field(Eigen::all, chosen);
    if (!out[name].allFinite())
      fail(data, "array \"" + name + "\": found a value that is not a finite number");
  }
  return out;
}

}  // namespace

void join_points(MeshData& data) {
  const Numbering points = unique_points(data, std::vector<char>(data.points.cols(), 1));
  note_points(points, false, data.notes);
  data.points = Points(data.points(Eigen::all, points.kept));
  for (auto& [name, field] : data.point_fields) field = Matrix(field(Eigen::all, points.kept));
  data.tets = renumbered(data.tets, points.number);
  data.triangles = renumbered(data.triangles, points.number);
}

MeshFile assemble(const MeshData& volume, const SurfaceData& surface, double mm_per_unit) {
  if (!(mm_per_unit > 0) || !std::isfinite(mm_per_unit))
    fail(volume, "found a length unit of " + std::to_string(mm_per_unit) + " mm, expected a positive length");
  if (volume.tets.cols() == 0)
    fail(volume, volume.triangles.cols() > 0
                     ? "found no tetrahedra (only surface triangles), expected tetrahedra"
                     : "found no tetrahedra, expected at least one");
  MeshFile out;
  out.notes = volume.notes;
  if (&surface.data != &volume)
    out.notes.insert(out.notes.end(), surface.data.notes.begin(), surface.data.notes.end());
  out.notes.insert(out.notes.end(), surface.notes.begin(), surface.notes.end());
  std::vector<char> used(volume.points.cols(), 0);
  for (const int p : volume.tets.reshaped()) used[p] = 1;
  const Numbering kept = unique_points(volume, used);
  note_points(kept, volume.triangles.cols() == 0, out.notes);
  const Points in_file_unit = volume.points(Eigen::all, kept.kept);
  Points points = mm_per_unit * in_file_unit;
  Tets tets = renumbered(volume.tets, kept.number);
  const std::vector<TetFace> faces = sorted_faces(tets);
  orient(volume, points, tets, faces, out.notes);

  const bool own = &surface.data == &volume;
  const LabelledTriangles labels =
      labelled(surface, faces, in_file_unit,
               own ? kept.number : std::vector<int>(surface.data.points.cols(), -1), out.notes);
  std::vector<int> regions;
  if (volume.tet_fields.contains("region")) regions = integer_field(volume, volume.tet_fields, "region");
  try {
    out.mesh = TetMesh(std::move(points), std::move(tets), std::move(regions), labels);
  } catch (const InputError& error) {
    fail(volume, error.what());
  }
  check_manifold(volume, out.mesh);
  out.point_fields = kept_fields(volume, volume.point_fields, kept.kept);
  out.cell_fields = kept_fields(volume, volume.tet_fields, Eigen::all);
  return out;
}

}  // namespace polyaffine
