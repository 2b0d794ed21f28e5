#include "cardiac/fibres/direction_field.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

#include <polyaffine/core/error.hpp>

namespace cardiac {

using polyaffine::Mat3;
using polyaffine::TetMesh;
using polyaffine::Vec3;
using polyaffine::Vec4;

namespace {

// A rate that the places of the neighbours hardly tell is held back by this share of their spread.
constexpr double kRidge = 1e-3;
constexpr double kFortyDegrees = 0.766;  // its cosine
constexpr double kLeastSum = 1e-3;       // of vectors that do not cancel

std::vector<int> next_and_next_but_one(const TetMesh& mesh, int tet) {
  std::vector<int> out;
  for (const int n : mesh.neighbours().col(tet)) {
    if (n < 0) continue;
    out.push_back(n);
    for (const int m : mesh.neighbours().col(n))
      if (m >= 0 && m != tet) out.push_back(m);
  }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

// The way from one unit vector to another or its opposite, whichever is nearer, on the sphere: across `from`,
// its length the angle.
Vec3 turn(const Vec3& from, const Vec3& to) {
  const double cosine = from.dot(to);
  const Vec3 across = (cosine < 0 ? -1 : 1) * (to - cosine * from);
  const double sine = across.norm();
  return sine > 0 ? Vec3(std::atan2(sine, std::abs(cosine)) / sine * across) : Vec3::Zero();
}

}  // namespace

DirectionField::DirectionField(const TetMesh& mesh, const polyaffine::Matrix& vectors, bool of_tets)
    : points_(mesh.points()), tets_(mesh.tets()) {
  const Eigen::Index expected = of_tets ? mesh.num_tets() : mesh.num_points();
  if (vectors.rows() != 3 || vectors.cols() != expected)
    throw polyaffine::InputError("direction field: found " + std::to_string(vectors.cols()) + " vectors of " +
                                 std::to_string(vectors.rows()) + " components, expected " +
                                 std::to_string(expected) + " of 3");
  given_ = vectors.colwise().normalized();
  if (of_tets) find_turning(mesh);
}

void DirectionField::find_turning(const TetMesh& mesh) {
  for (int t = 0; t < mesh.num_tets(); ++t) {
    const Vec3 here = mesh.tet_centroid(t);
    Mat3 spread = Mat3::Zero(), change = Mat3::Zero();
    for (const int n : next_and_next_but_one(mesh, t)) {
      const Vec3 way = mesh.tet_centroid(n) - here;
      spread += mesh.tet_volume(n) * way * way.transpose();
      change += mesh.tet_volume(n) * turn(given_.col(t), given_.col(n)) * way.transpose();
    }
    spread.diagonal().array() += kRidge * spread.trace();
    turning_.push_back(spread.trace() > 0 ? Mat3(spread.ldlt().solve(change.transpose()).transpose())
                                          : Mat3::Zero());
  }
}

bool DirectionField::is_whole() const {
  if (tets_.size() > 0 && (tets_.minCoeff() < 0 || tets_.maxCoeff() >= points_.cols())) return false;
  if (turning_.empty()) return given_.cols() == points_.cols();
  return given_.cols() == tets_.cols() && std::ssize(turning_) == tets_.cols();
}

bool DirectionField::ambiguous(int tet) const {
  const auto& corners = tets_.col(tet);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j)
      if (std::abs(given_.col(corners[i]).dot(given_.col(corners[j]))) < kFortyDegrees) return true;
  return false;
}

Vec3 DirectionField::at(int tet, const Vec4& barycentric, const Vec3& usual) const {
  const auto& corners = tets_.col(tet);
  if (turning_.empty()) {
    Vec3 sum = Vec3::Zero();
    Mat3 tensor = Mat3::Zero();
    for (int k = 0; k < 4; ++k) {
      const Vec3 v = given_.col(corners[k]);
      sum += (v.dot(usual) < 0 ? -barycentric[k] : barycentric[k]) * v;
      tensor += barycentric[k] * v * v.transpose();
    }
    if (sum.norm() > kLeastSum && ambiguous(tet)) return sum.normalized();
    return Eigen::SelfAdjointEigenSolver<Mat3>(tensor).eigenvectors().col(2);
  }
  const Vec3 way = points_(Eigen::all, corners) * (barycentric - Vec4::Constant(0.25));
  const Vec3 turned = turning_[tet] * way;
  const double angle = turned.norm();
  if (angle == 0) return given_.col(tet);
  return (std::cos(angle) * given_.col(tet) + std::sin(angle) / angle * turned).normalized();
}

double DirectionField::ambiguous_share() const {
  if (!turning_.empty()) return 0;
  int count = 0;
  for (int t = 0; t < static_cast<int>(tets_.cols()); ++t) count += ambiguous(t);
  return static_cast<double>(count) / static_cast<double>(tets_.cols());
}

}  // namespace cardiac
