#include "cardiac/model/supports.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>

#include <polyaffine/core/error.hpp>
#include <polyaffine/material/springs.hpp>
#include <polyaffine/system/field_term.hpp>
#include <polyaffine/system/support.hpp>

namespace cardiac {

using polyaffine::Mat3;
using polyaffine::Points;
using polyaffine::SpringDirection;
using polyaffine::SurfacePoints;
using polyaffine::Vec3;
using polyaffine::Vector;

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

// A surface resists a rigid motion when its springs feel this part of the mean square of its displacement:
// far above what the facets of a surface of revolution feel of a rotation about its axis.
constexpr double kResisted = 1e-3;

Points unit_normals(const SurfacePoints& points) {
  Points out(3, points.X.cols());
  for (Eigen::Index q = 0; q < points.X.cols(); ++q)
    out.col(q) = Vec3(points.X_xi.col(q)).cross(Vec3(points.X_eta.col(q))).normalized();
  return out;
}

Vector areas(const SurfacePoints& points) {
  Vector out = points.weights;
  for (Eigen::Index q = 0; q < out.size(); ++q)
    out[q] *= Vec3(points.X_xi.col(q)).cross(Vec3(points.X_eta.col(q))).norm();
  return out;
}

void add(const polyaffine::FieldTable& surface, polyaffine::SupportParameters parameters,
         polyaffine::Terms& out) {
  if (parameters.stiffness_kPa_per_mm > 0 || parameters.damping_kPa_ms_per_mm > 0)
    out.push_back(std::make_shared<polyaffine::Support>(surface, std::move(parameters)));
}

// Springs that resist some of the displacements of a surface: the direction alone, what is across it, or all.
struct Springs {
  enum Kind { along, across, all } kind;
  Mat3 felt(const Vec3& n) const {
    if (kind == all) return Mat3::Identity();
    return kind == along ? Mat3(n * n.transpose()) : Mat3(Mat3::Identity() - n * n.transpose());
  }
};

// The rigid motions of a heart about its centre, u = t + (ω ℓ) × (X − C)/ℓ with unknowns t and ω ℓ.
struct RigidMotions {
  Vec3 centre;
  double length;

  Matrix36 at(const Vec3& X) const {
    const Vec3 r = (X - centre) / length;
    Matrix36 out;
    out << Mat3::Identity(), Mat3{{0, r.z(), -r.y()}, {-r.z(), 0, r.x()}, {r.y(), -r.x(), 0}};
    return out;
  }

  // Projection on the motions that springs on a surface resist.
  Matrix6 resisted(const Points& X, const Points& normals, const Vector& weights, Springs springs) const {
    Matrix6 G = Matrix6::Zero();
    for (Eigen::Index q = 0; q < X.cols(); ++q) {
      const Matrix36 J = at(X.col(q));
      G += weights[q] * J.transpose() * springs.felt(normals.col(q)) * J;
    }
    const Eigen::SelfAdjointEigenSolver<Matrix6> solver(G / std::max(weights.sum(), 1e-300));
    Matrix6 out = Matrix6::Zero();
    for (int k = 0; k < 6; ++k)
      if (solver.eigenvalues()[k] > kResisted)
        out += solver.eigenvectors().col(k) * solver.eigenvectors().col(k).transpose();
    return out;
  }
};

std::string text(const Vec3& v) {
  std::ostringstream out;
  out.precision(2);
  const auto rounded = [](double x) { return std::round(100 * x) / 100 + 0.0; };  // no −0
  out << '(' << rounded(v.x()) << ", " << rounded(v.y()) << ", " << rounded(v.z()) << ')';
  return out.str();
}

std::string in_words(const Eigen::Matrix<double, 6, 1>& motion) {
  const Vec3 moved = motion.head<3>(), turned = motion.tail<3>();
  return turned.norm() > moved.norm() ? "a rotation about " + text(turned.normalized())
                                      : "a translation along " + text(moved.normalized());
}

}  // namespace

double height_weight(const scene::Boundary& b, double height) {
  const double h = std::clamp(height, 0.0, 1.0);
  const double s = b.epicardial_weight_law == scene::HeightLaw::smooth ? h * h * (3 - 2 * h) : h;
  return b.epicardial_apex_weight + (b.epicardial_base_weight - b.epicardial_apex_weight) * s;
}

Vector epicardial_weights(const Anatomy& anatomy, const scene::Boundary& boundary,
                          const SurfacePoints& points) {
  Vector out(points.X.cols());
  for (Eigen::Index q = 0; q < out.size(); ++q) {
    out[q] = height_weight(boundary, anatomy.coordinates->long_axis_height(points.X.col(q)));
    if (anatomy.epicardial_weight.size() == 0) continue;
    const auto corners = anatomy.mesh.tets().col(points.tet[static_cast<std::size_t>(q)]);
    out[q] *= points.barycentric.col(q).dot(anatomy.epicardial_weight(corners));
  }
  return out;
}

polyaffine::Terms supports(const Anatomy& anatomy, const Scene& scene, const Discretisation& d) {
  polyaffine::Terms out;
  const scene::Boundary& b = scene.boundary;
  if (!d.epicardium_points.tet.empty()) {
    polyaffine::FieldTable table = polyaffine::displacement_table(*d.basis, d.epicardium_points);
    const Vector weights = epicardial_weights(anatomy, b, d.epicardium_points);
    if ((weights.array() != 1).any()) table.weights.array() *= weights.array();
    polyaffine::SupportParameters parameters{b.epicardial_stiffness_kPa_per_mm,
                                             b.epicardial_damping_kPa_ms_per_mm};
    if (b.epicardial_directions == scene::SupportDirections::normal)
      parameters.normals = unit_normals(d.epicardium_points);
    add(table, std::move(parameters), out);
  }
  if (!d.base_points.tet.empty()) {
    const polyaffine::FieldTable table = polyaffine::displacement_table(*d.basis, d.base_points);
    const Points normals = unit_normals(d.base_points);
    if (b.base_normal_stiffness_kPa_per_mm == b.base_inplane_stiffness_kPa_per_mm &&
        b.base_normal_damping_kPa_ms_per_mm == b.base_inplane_damping_kPa_ms_per_mm) {
      add(table, {b.base_normal_stiffness_kPa_per_mm, b.base_normal_damping_kPa_ms_per_mm}, out);
    } else {
      add(table, {b.base_normal_stiffness_kPa_per_mm, b.base_normal_damping_kPa_ms_per_mm, normals}, out);
      add(table,
          {b.base_inplane_stiffness_kPa_per_mm, b.base_inplane_damping_kPa_ms_per_mm, normals,
           SpringDirection::across_normal},
          out);
    }
  }
  if (d.ring) {
    const auto law = std::make_shared<polyaffine::MeanMotionSpring>(kRingStiffness_mN_per_mm, d.ring->normal);
    out.push_back(polyaffine::load(std::make_shared<polyaffine::FieldEnergy>(
        polyaffine::mean_motion_table(*d.basis, d.ring->rim.centre, d.ring->normal),
        std::vector<std::shared_ptr<const polyaffine::Law>>{law})));
  }
  return out;
}

void check_held(const Anatomy& anatomy, const Scene& scene, const Discretisation& d) {
  const scene::Boundary& b = scene.boundary;
  if (!b.base_moves()) return;
  const auto& coordinates = *anatomy.coordinates;
  const RigidMotions motions{
      coordinates.base_centre() - 0.5 * coordinates.cavity_length() * coordinates.axis(),
      0.5 * coordinates.cavity_length()};
  Matrix6 held = Matrix6::Zero();
  const auto count = [&](const SurfacePoints& points, const Vector& weights, double stiffness,
                         Springs springs) {
    if (stiffness > 0 && !points.tet.empty())
      held += motions.resisted(points.X, unit_normals(points), weights, springs);
  };
  if (!d.epicardium_points.tet.empty())
    count(d.epicardium_points,
          areas(d.epicardium_points).cwiseProduct(epicardial_weights(anatomy, b, d.epicardium_points)),
          b.epicardial_stiffness_kPa_per_mm,
          {b.epicardial_directions == scene::SupportDirections::all ? Springs::all : Springs::along});
  if (!d.base_points.tet.empty()) {
    const Vector area = areas(d.base_points);
    count(d.base_points, area, b.base_normal_stiffness_kPa_per_mm, {Springs::along});
    count(d.base_points, area, b.base_inplane_stiffness_kPa_per_mm, {Springs::across});
  }
  if (d.ring) {  // the whole of it: the base along its normal, the ring in its plane
    const Points& X = d.ring->rim.edges.X;
    held +=
        motions.resisted(X, d.ring->normal.replicate(1, X.cols()), Vector::Ones(X.cols()), {Springs::all});
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(held);
  if (solver.eigenvalues()[0] > kResisted) return;
  throw polyaffine::InputError("boundary.base: found elastic, but no spring resists " +
                               in_words(solver.eigenvectors().col(0)) +
                               " of the whole heart; expected boundary.base_normal_stiffness_kPa_per_mm and "
                               "boundary.base_inplane_stiffness_kPa_per_mm above 0 kPa/mm, or a "
                               "boundary.epicardial_stiffness_kPa_per_mm "
                               "that holds it");
}

}  // namespace cardiac
