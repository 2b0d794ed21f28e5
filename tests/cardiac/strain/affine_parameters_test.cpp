#include "cardiac/strain/affine_parameters.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include <cardiac/anatomy/segments.hpp>

#include "support/heart_run.hpp"
#include "support/random_vector.hpp"

namespace cardiac {
namespace {

using polyaffine::FrameBasis;
using polyaffine::Mat3;
using polyaffine::Monomial;
using polyaffine::Points;
using polyaffine::Vec3;
using polyaffine::Vec4;
using polyaffine::Vector;
using polyaffine::testing::random_vector;

/// A reduced passive inflation on the coarse Land ellipsoid: its model and a state of it.
struct Model {
  Protocol protocol;
  std::shared_ptr<const Anatomy> anatomy;
  Ventricle ventricle;
  std::vector<ControlNode> nodes;

  explicit Model(const std::vector<std::string>& overrides)
      : protocol(testing::shipped_protocol("passive_inflation", testing::on_land_ellipsoid(overrides))),
        anatomy(testing::read_anatomy(protocol)),
        ventricle(build_ventricle(anatomy, protocol, protocol.reduction.method)),
        nodes(testing::control_nodes_of(*anatomy)) {}

  const FrameBasis& basis() const { return *ventricle.discretisation.frame_basis; }

  /// Displacement of all vertices of the mesh.
  Points displacement(const Vector& c) const {
    const auto& mesh = anatomy->mesh;
    std::vector<int> tet(mesh.num_points());
    Eigen::Matrix4Xd corner(4, mesh.num_points());
    for (int t = 0; t < mesh.num_tets(); ++t)
      for (int k = 0; k < 4; ++k) {
        tet[mesh.tets()(k, t)] = t;
        corner.col(mesh.tets()(k, t)) = Vec4::Unit(k);
      }
    return polyaffine::DisplacementMap(basis(), tet, corner).apply(c);
  }

  /// Is the function affine and of a segment's frame?
  std::vector<char> affine_functions() const {
    std::vector<char> out(basis().num_functions(), 0);
    for (int i = 0; i < kAhaSegments; ++i)
      for (const Monomial& m : polyaffine::affine_monomials())
        if (const int f = basis().function(i, m); f >= 0) out[f] = 1;
    return out;
  }

  Vector state() const {
    const HeartPath path = run_prescribed(ventricle, protocol);
    EXPECT_TRUE(path.completed) << path.stop_reason;
    return path.steps.back().c;
  }

  /// Size of the difference between the field of c and that of its own affine parameters, over its size.
  double round_trip_error(const Vector& c, const Vector& rest) const {
    const auto frames = affine_parameters(basis(), nodes, c);
    const Points u = displacement(c);
    EXPECT_GT(u.norm(), 0);
    return (displacement(affine_coefficients(basis(), nodes, frames, rest)) - u).norm() / u.norm();
  }
};

// Sums of a hundred products: 1e-9 is far above rounding and far below any mistake.
constexpr double kRounding = 1e-9;

TEST(AffineParameters, AreAllThatAModelOfFramesAloneHas) {
  for (const char* axes : {"heart", "cartesian"}) {
    SCOPED_TRACE(axes);
    const Model model({"reduction.enrichment=[]", std::string("reduction.axes=") + axes});
    const std::vector<char> affine = model.affine_functions();
    ASSERT_LT(std::count(affine.begin(), affine.end(), 1), model.basis().num_functions());  // base functions
    for (unsigned seed = 1; seed < 4; ++seed) {
      Vector c = random_vector(3 * model.basis().num_functions(), 1, seed);
      for (int f = 0; f < model.basis().num_functions(); ++f)
        if (!affine[f]) c.segment<3>(3 * f).setZero();
      EXPECT_LT(model.round_trip_error(c, Vector::Zero(c.size())), kRounding);
    }
  }
}

TEST(AffineParameters, WithTheRestReproduceTheFieldOfThePreset) {
  const Model model({"time.load_steps=2"});
  const Vector c = model.state();
  EXPECT_LT(model.round_trip_error(c, c), kRounding);
  for (unsigned seed = 1; seed < 4; ++seed) {
    const Vector random = random_vector(c.size(), 1, seed);
    EXPECT_LT(model.round_trip_error(random, random), kRounding);
  }
  // The parameters do carry the field: without them it is another one.
  const Vector none =
      affine_coefficients(model.basis(), model.nodes, std::vector<SegmentFrame>(kAhaSegments), c);
  const Points u = model.displacement(c);
  EXPECT_GT((model.displacement(none) - u).norm(), 0.3 * u.norm());
}

/// Displacement by the frame's own functions 1, l, c, t, without its weight.
Vec3 own_map(const Model& model, const Vector& c, int frame, const Vec4& barycentric) {
  const FrameBasis& basis = model.basis();
  const auto at = basis.field().sample(model.nodes[frame].tet, barycentric);
  const auto own =
      std::find_if(at.frames.begin(), at.frames.end(), [&](const auto& f) { return f.frame == frame; });
  EXPECT_NE(own, at.frames.end());
  const auto coefficient = [&](int i, const Monomial& m) {
    const int f = basis.function(i, m);
    return f < 0 ? Vec3(Vec3::Zero()) : Vec3(c.segment<3>(3 * f));
  };
  Vec3 slope_c = coefficient(frame, {0, 1, 0});
  const int ring = aha_ring(frame + 1);
  if (ring > 0)  // of the circumferential coefficients of a ring only differences move the wall
    for (int k = 0; k < aha_ring_size(ring); ++k)
      slope_c -= coefficient(aha_ring_first(ring) - 1 + k, {0, 1, 0}) / aha_ring_size(ring);
  const Vec3 sum = coefficient(frame, {0, 0, 0}) + coefficient(frame, {1, 0, 0}) * own->xi[0] +
                   slope_c * own->xi[1] + coefficient(frame, {0, 0, 1}) * own->xi[2];
  return basis.in_local_axes(basis.function(frame, {0, 0, 0})) ? Vec3(at.Q * sum) : sum;
}

TEST(AffineParameters, AreValueAndGradientOfTheFramesOwnMapAtItsNode) {
  const Model model({});
  const Vector c = random_vector(3 * model.basis().num_functions(), 1, 5);
  const auto frames = affine_parameters(model.basis(), model.nodes, c);
  ASSERT_EQ(frames.size(), kAhaSegments);
  constexpr double h = 1e-4;  // of a tet; differences of second order leave about h²
  for (int i = 0; i < kAhaSegments; ++i) {
    SCOPED_TRACE(aha_name(i + 1));
    const ControlNode& node = model.nodes[i];
    Mat3 du, dX;
    for (int k = 0; k < 3; ++k) {
      const Vec4 step = h * (Vec4::Unit(k) - Vec4::Unit(3));
      du.col(k) =
          own_map(model, c, i, node.barycentric + step) - own_map(model, c, i, node.barycentric - step);
      dX.col(k) = model.anatomy->coordinates->position(node.tet, node.barycentric + step) -
                  model.anatomy->coordinates->position(node.tet, node.barycentric - step);
    }
    const Mat3 expected = Mat3::Identity() + node.axes.transpose() * (du * dX.inverse()) * node.axes;
    EXPECT_LT((frames[i].A - expected).norm(), 1e-5 * expected.norm());
    EXPECT_GT((frames[i].A - Mat3::Identity()).norm(), 0.01);
    EXPECT_LT((frames[i].t - node.axes.transpose() * own_map(model, c, i, node.barycentric)).norm(), 1e-9);
  }
}

TEST(AffineParameters, OfTheReferenceAreTheIdentity) {
  const Model model({});
  for (const SegmentFrame& f :
       affine_parameters(model.basis(), model.nodes, Vector::Zero(3 * model.basis().num_functions()))) {
    EXPECT_EQ(f.A, Mat3::Identity());
    EXPECT_EQ(f.t, Vec3::Zero());
  }
}

TEST(FitAffine, RecoversAGlobalAffineMap) {
  const Model model({});
  const auto& mesh = model.anatomy->mesh;
  Points X(3, mesh.num_tets());
  for (int t = 0; t < mesh.num_tets(); ++t)
    X.col(t) = mesh.points()(Eigen::all, mesh.tets().col(t)).rowwise().mean();
  const Mat3 G = Mat3::Identity() + random_vector(9, 0.4, 2).reshaped(3, 3);
  const Vec3 b = random_vector(3, 10, 3);
  const Points x = (G * X).colwise() + b;
  const Vector weights = random_vector(X.cols(), 0.5, 4).array() + 1;
  const auto frames = fit_affine(model.nodes, model.anatomy->segment, X, x, weights);
  ASSERT_EQ(frames.size(), kAhaSegments);
  for (int i = 0; i < kAhaSegments; ++i) {
    SCOPED_TRACE(aha_name(i + 1));
    const ControlNode& node = model.nodes[i];
    // In the axes R of the node: A = Rᵀ G R, t = Rᵀ (G q + b − q).
    EXPECT_LT((frames[i].A - node.axes.transpose() * G * node.axes).norm(), 1e-9);
    EXPECT_LT((frames[i].t - node.axes.transpose() * (G * node.position + b - node.position)).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace cardiac
