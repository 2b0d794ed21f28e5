#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/geodesic_regions.hpp>
#include <polyaffine/kinematics/region_frames.hpp>
#include <polyaffine/material/neo_hookean.hpp>
#include <polyaffine/system/field_energy.hpp>
#include "polyaffine/geometry/box_mesh.hpp"
#include "rotating_basis.hpp"

namespace polyaffine {
namespace {

using testing::random_vector;

// A bar of 6 × 2 × 1 mm in four regions; the edges inside the faces x = const of its mesh are bent.
struct Bar {
  TetMesh mesh = box_mesh(Vec3::Zero(), Vec3(6, 2, 1), {12, 4, 3}, 0.2);
  std::shared_ptr<const LagrangeBasis> geometry;
  std::shared_ptr<const RegionWeights> weights;
  std::vector<ControlNode> nodes;

  Bar() {
    EdgeMidpoints bent;
    unsigned seed = 0;
    for (int t = 0; t < mesh.num_tets(); ++t)
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j) {
          const auto [a, b] = std::minmax(mesh.tets()(i, t), mesh.tets()(j, t));
          if (mesh.points()(0, a) == 0 && mesh.points()(0, b) == 0) continue;  // the clamped face stays flat
          if (!bent.contains({a, b}))
            bent[{a, b}] = (mesh.points().col(a) + mesh.points().col(b)) / 2 + random_vector(3, 0.02, ++seed);
        }
    geometry = std::make_shared<LagrangeBasis>(mesh, 2, bent);
    const EikonalSolver solver(mesh);
    std::vector<MeshPoint> seeds;
    for (const Vec3& x : {Vec3(1, 1, 0.5), Vec3(3, 0.5, 0.5), Vec3(3, 1.5, 0.5), Vec3(5, 1, 0.5)}) {
      seeds.push_back(locate(mesh, x));
      nodes.push_back(
          {x,
           Eigen::Quaterniond(Vec4(random_vector(4, 1, 20 + nodes.size()))).normalized().toRotationMatrix()});
    }
    weights = std::make_shared<RegionWeights>(
        mesh, normalised_border_distances(solver, voronoi_labels(solver, seeds), 4));
  }

  std::shared_ptr<const RegionFrames> frames(const Vector& clamp = {}) const {
    return std::make_shared<RegionFrames>(geometry, weights, nodes, 2.0, clamp);
  }
};

FrameBasis affine_basis(std::shared_ptr<const FrameField> field) {
  const int n = field->num_frames();
  return {std::move(field), std::vector<FrameFunctions>(n, {affine_monomials(), false})};
}

// Coefficients of the displacement B X + b: its value at each node and, times the length, its slope along the
// node's axes.
Vector affine_coefficients(const FrameBasis& basis, const RegionFrames& frames, const Mat3& B,
                           const Vec3& b) {
  Vector c(3 * basis.num_functions());
  for (int i = 0; i < frames.num_frames(); ++i) {
    const ControlNode& node = frames.nodes()[i];
    c.segment<3>(3 * basis.function(i, {0, 0, 0})) = B * node.position + b;
    for (int k = 0; k < 3; ++k) {
      Monomial m{0, 0, 0};
      m[k] = 1;
      c.segment<3>(3 * basis.function(i, m)) = frames.length() * B * node.axes.col(k);
    }
  }
  return c;
}

TEST(RegionFrames, ReproduceEveryAffineMap) {
  const Bar bar;
  const auto frames = bar.frames();
  const FrameBasis basis = affine_basis(frames);
  Mat3 B;
  B << 0.3, -0.2, 0.1, 0.4, -0.1, 0.25, -0.3, 0.15, 0.2;
  const Vec3 b(0.5, -1, 2);
  const Vector c = affine_coefficients(basis, *frames, B, b);
  const WallPoints points = bar.geometry->wall_points(2);
  const Matrix F = evaluate_field(deformation_table(basis, points), c);
  const Points u = DisplacementMap(basis, points.tet, points.barycentric).apply(c);
  for (Eigen::Index q = 0; q < u.cols(); ++q) {
    const BasisSample s = bar.geometry->sample(points.tet[q], points.barycentric.col(q));
    const Vec3 X = bar.geometry->nodes()(Eigen::all, s.functions) * s.N;
    // Round-off: sums of terms of order ten.
    EXPECT_LT((u.col(q) - B * X - b).norm(), 1e-13);
    EXPECT_LT((F.col(q).reshaped(3, 3) - Mat3::Identity() - B).norm(), 1e-12);
  }
}

TEST(RegionFrames, RigidMotionHasNoStress) {
  const Bar bar;
  const auto frames = bar.frames();
  const FrameBasis basis = affine_basis(frames);
  const FieldEnergy wall(deformation_table(basis, bar.geometry->wall_points(2)),
                         {std::make_shared<IsochoricNeoHookean>(3.0)});
  const Mat3 R = Eigen::AngleAxisd(1.2, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  const Vec3 t(3, 1, -2);
  const EnergyValue rigid = wall.evaluate({affine_coefficients(basis, *frames, R - Mat3::Identity(), t)});
  const Mat3 stretch = Vec3(0.1, -0.05, 0).asDiagonal();
  const EnergyValue stretched = wall.evaluate({affine_coefficients(basis, *frames, stretch, t)});
  EXPECT_LT(rigid.gradient.norm(), 1e-11 * stretched.gradient.norm());
  EXPECT_LT(std::abs(rigid.value), 1e-11 * stretched.value);
  EXPECT_NEAR(rigid.min_det, 1, 1e-12);
  EXPECT_GT(stretched.value, 0.1);
}

// All weights and coordinates against differences along the coordinates of the bent elements.
void expect_exact_gradients(const Bar& bar, const RegionFrames& frames) {
  constexpr double kStep = 1e-5;
  const Vec4 at(0.2, 0.35, 0.15, 0.3);
  for (int t = 0; t < bar.mesh.num_tets(); t += 41) {
    const FramesAtPoint here = frames.sample(t, at);
    const Mat3 J = bar.geometry->jacobian(t, at);
    for (int k = 0; k < 3; ++k) {
      const Vec4 h = kStep * (Vec4::Unit(k + 1) - Vec4::Unit(0));
      const FramesAtPoint after = frames.sample(t, at + h), before = frames.sample(t, at - h);
      for (std::size_t i = 0; i < here.frames.size(); ++i) {
        const double slope = (after.frames[i].weight - before.frames[i].weight) / (2 * kStep);
        // Central difference: step² times third derivatives of order ten.
        EXPECT_NEAR(here.frames[i].weight_gradient.dot(J.col(k)), slope, 1e-8);
        const Vec3 xi_slope = (after.frames[i].xi - before.frames[i].xi) / (2 * kStep);
        EXPECT_LT((here.frames[i].xi_gradient * J.col(k) - xi_slope).norm(), 1e-8);
      }
    }
  }
}

TEST(RegionFrames, HaveExactGradientsInCurvedElements) {
  const Bar bar;
  EXPECT_GT((bar.geometry->jacobian(0, Vec4(0.7, 0.1, 0.1, 0.1)) -
             bar.geometry->jacobian(0, Vec4(0.1, 0.1, 0.1, 0.7)))
                .norm(),
            1e-3);  // the elements are bent
  expect_exact_gradients(bar, *bar.frames());
  expect_exact_gradients(bar, *bar.frames(bar.geometry->nodes().row(0).array().square() / 36));
}

TEST(RegionFrames, ClampHoldsAFaceButNotItsSlope) {
  const Bar bar;
  const Vector x = bar.geometry->nodes().row(0) / 6;
  const Vector clamp = x.array() * (2 - x.array());
  const auto frames = bar.frames(clamp);
  const FrameBasis basis = affine_basis(frames);
  const Vector c = random_vector(3 * basis.num_functions(), 1, 9);
  double largest_slope = 0;
  for (Eigen::Index f = 0; f < bar.mesh.boundary().cols(); ++f) {
    const int t = bar.mesh.boundary_tets()[f];
    Vec4 on_face = Vec4::Zero();
    for (int k = 0; k < 4; ++k) on_face[k] = bar.mesh.points()(0, bar.mesh.tets()(k, t)) == 0 ? 1.0 / 3 : 0;
    if (on_face.sum() < 0.9) continue;
    const BasisSample s = basis.sample(t, on_face);
    Mat3 H = Mat3::Zero();
    for (std::size_t a = 0; a < s.functions.size(); ++a)
      H += c.segment<3>(3 * s.functions[a]) * s.gradient.col(static_cast<Eigen::Index>(a)).transpose();
    EXPECT_EQ(s.N.cwiseAbs().maxCoeff(), 0);
    largest_slope = std::max(largest_slope, H.norm());
  }
  EXPECT_GT(largest_slope, 0.1);

  const RegionFrames free = frames->without_clamp();
  const Vec4 at(0.1, 0.2, 0.3, 0.4);
  for (int t = 0; t < bar.mesh.num_tets(); t += 13) {
    double sum = 0, free_sum = 0;
    for (const auto& frame : frames->sample(t, at).frames) sum += frame.weight;
    for (const auto& frame : free.sample(t, at).frames) free_sum += frame.weight;
    EXPECT_NEAR(sum, bar.geometry->interpolate(clamp, t, at), 1e-14);
    EXPECT_NEAR(free_sum, 1, 1e-14);
  }
}

TEST(RegionFrames, RejectBadInput) {
  const Bar bar;
  auto nodes = bar.nodes;
  nodes.pop_back();
  EXPECT_THROW(RegionFrames(bar.geometry, bar.weights, nodes, 1), InputError);
  EXPECT_THROW(RegionFrames(bar.geometry, bar.weights, bar.nodes, 0), InputError);
  EXPECT_THROW(RegionFrames(bar.geometry, bar.weights, bar.nodes, 1, Vector::Ones(5)), InputError);
  nodes = bar.nodes;
  nodes[0].axes *= 2;
  EXPECT_THROW(RegionFrames(bar.geometry, bar.weights, nodes, 1), InputError);
}

}  // namespace
}  // namespace polyaffine
