#include "polyaffine/mesh/tet_mesh.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <queue>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/tet_faces.hpp>

namespace polyaffine {
namespace {

std::string describe(const Points& points, const Tets& tets, int t) {
  std::ostringstream out;
  const Vec3 c =
      (points.col(tets(0, t)) + points.col(tets(1, t)) + points.col(tets(2, t)) + points.col(tets(3, t))) / 4;
  out << "tet " << t << " (counted from 0) near (" << c.x() << ", " << c.y() << ", " << c.z() << ") mm";
  return out.str();
}

void check_points(const Points& points) {
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (!points.col(i).allFinite())
      throw InputError("mesh point " + std::to_string(i) +
                       " (counted from 0): found a coordinate that is not a number, expected finite mm");
}

void orient(const Points& points, Tets& tets) {
  int negative = 0;
  std::vector<double> volume(tets.cols());
  for (Eigen::Index t = 0; t < tets.cols(); ++t) {
    for (int k = 0; k < 4; ++k)
      if (tets(k, t) < 0 || tets(k, t) >= points.cols())
        throw InputError("mesh tet " + std::to_string(t) + ": found vertex " + std::to_string(tets(k, t)) +
                         ", expected 0 to " + std::to_string(points.cols() - 1));
    volume[t] = signed_volume(points, tets.col(t));
    if (is_flat(points, tets.col(t)))
      throw InputError("mesh: " + describe(points, tets, static_cast<int>(t)) + " is flat: found volume " +
                       std::to_string(volume[t]) + " mm³, expected a positive volume");
    negative += volume[t] < 0;
  }
  if (negative == tets.cols()) {
    tets.row(2).swap(tets.row(3));
    return;
  }
  if (negative == 0) return;
  const bool minority_negative = 2 * negative <= tets.cols();
  const auto odd =
      std::find_if(volume.begin(), volume.end(), [&](double v) { return (v < 0) == minority_negative; });
  throw InputError("mesh: " + describe(points, tets, static_cast<int>(odd - volume.begin())) +
                   " is inverted; found " +
                   std::to_string(std::min<Eigen::Index>(negative, tets.cols() - negative)) + " of " +
                   std::to_string(tets.cols()) + " tets oriented against the others, expected none");
}

}  // namespace

double signed_volume(const Points& p, const Eigen::Vector4i& t) {
  Mat3 edges;
  edges << p.col(t[1]) - p.col(t[0]), p.col(t[2]) - p.col(t[0]), p.col(t[3]) - p.col(t[0]);
  return edges.determinant() / 6;
}

bool is_flat(const Points& points, const Eigen::Vector4i& tet) {
  double longest = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j)
      longest = std::max(longest, (points.col(tet[i]) - points.col(tet[j])).norm());
  return std::abs(signed_volume(points, tet)) <= 1e-8 * longest * longest * longest;
}

TetMesh::TetMesh(Points points, Tets tets, std::vector<int> region, const LabelledTriangles& surface)
    : points_(std::move(points)), tets_(std::move(tets)), regions_(std::move(region)) {
  if (tets_.cols() == 0) throw InputError("mesh: found no tetrahedra, expected at least one");
  if (regions_.empty()) regions_.assign(tets_.cols(), 0);
  if (regions_.size() != static_cast<std::size_t>(tets_.cols()))
    throw InputError("mesh: found " + std::to_string(regions_.size()) +
                     " region labels, expected one for each of " + std::to_string(tets_.cols()) + " tets");
  check_points(points_);
  orient(points_, tets_);

  neighbours_ = Eigen::Matrix4Xi::Constant(4, tets_.cols(), -1);
  const std::vector<TetFace> faces = sorted_faces(tets_);
  std::vector<TetFace> open;
  for (std::size_t f = 0; f < faces.size();) {
    std::size_t end = f + 1;
    while (end < faces.size() && faces[end].key == faces[f].key) ++end;
    if (end - f > 2)
      throw InputError("mesh: a face of " + describe(points_, tets_, faces[end - 1].tet) +
                       " is shared by more than two tets");
    if (end - f == 1) {
      open.push_back(faces[f]);
    } else {
      neighbours_(faces[f].local, faces[f].tet) = faces[f + 1].tet;
      neighbours_(faces[f + 1].local, faces[f + 1].tet) = faces[f].tet;
    }
    f = end;
  }
  std::vector<char> used(points_.cols(), 0);
  for (const int p : tets_.reshaped()) used[p] = 1;
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end())
    throw InputError("mesh point " + std::to_string(unused - used.begin()) +
                     " (counted from 0) belongs to no tet; expected every point to be used");

  std::vector<char> reached(tets_.cols(), 0);
  std::queue<int> front({0});
  reached[0] = 1;
  int count = 0;
  while (!front.empty()) {
    const int t = front.front();
    front.pop();
    ++count;
    for (int k = 0; k < 4; ++k) {
      const int n = neighbours_(k, t);
      if (n >= 0 && !reached[n]) {
        reached[n] = 1;
        front.push(n);
      }
    }
  }
  if (count != num_tets()) {
    const int lost = static_cast<int>(std::find(reached.begin(), reached.end(), 0) - reached.begin());
    throw InputError("mesh: " + describe(points_, tets_, lost) + " is isolated: found " +
                     std::to_string(num_tets() - count) + " tets that share no face with the " +
                     std::to_string(count) + " connected to the first, expected one connected wall");
  }

  boundary_.resize(3, static_cast<Eigen::Index>(open.size()));
  boundary_labels_.assign(open.size(), kUnlabelled);
  for (std::size_t f = 0; f < open.size(); ++f) {
    const auto& face = kTetFaces[open[f].local];
    for (int k = 0; k < 3; ++k) boundary_(k, static_cast<Eigen::Index>(f)) = tets_(face[k], open[f].tet);
    boundary_tets_.push_back(open[f].tet);
  }
  for (Eigen::Index i = 0; i < surface.triangles.cols(); ++i) {
    const FaceKey key = face_key(surface.triangles(0, i), surface.triangles(1, i), surface.triangles(2, i));
    const auto face = std::ranges::lower_bound(open, key, {}, &TetFace::key);
    if (face == open.end() || face->key != key)
      throw InputError("mesh: labelled triangle " + std::to_string(i) + " (label " +
                       std::to_string(surface.labels.at(i)) +
                       ") is not a face of the boundary of the tetrahedra");
    boundary_labels_[face - open.begin()] = surface.labels.at(i);
  }
}

TetMesh TetMesh::with_labels(std::vector<int> labels) const {
  if (labels.size() != boundary_labels_.size())
    throw std::invalid_argument("TetMesh::with_labels: expected a label for each boundary triangle");
  TetMesh out = *this;
  out.boundary_labels_ = std::move(labels);
  return out;
}

double TetMesh::tet_volume(int t) const {
  return signed_volume(points_, tets_.col(t));
}

Vec3 TetMesh::tet_centroid(int t) const {
  return (points_.col(tets_(0, t)) + points_.col(tets_(1, t)) + points_.col(tets_(2, t)) +
          points_.col(tets_(3, t))) /
         4;
}

double TetMesh::volume() const {
  double sum = 0;
  for (int t = 0; t < num_tets(); ++t) sum += tet_volume(t);
  return sum;
}

Triangles TetMesh::surface(const std::vector<int>& labels) const {
  std::vector<int> chosen;
  for (Eigen::Index f = 0; f < boundary_.cols(); ++f)
    if (std::find(labels.begin(), labels.end(), boundary_labels_[f]) != labels.end())
      chosen.push_back(static_cast<int>(f));
  Triangles out(3, static_cast<Eigen::Index>(chosen.size()));
  for (std::size_t i = 0; i < chosen.size(); ++i)
    out.col(static_cast<Eigen::Index>(i)) = boundary_.col(chosen[i]);
  return out;
}

std::vector<int> TetMesh::surface_points(const std::vector<int>& labels) const {
  const Triangles chosen = surface(labels);
  std::vector<int> points(chosen.data(), chosen.data() + chosen.size());
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

}  // namespace polyaffine
