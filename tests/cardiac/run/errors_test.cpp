#include <gtest/gtest.h>

#include <cmath>

#include <cardiac/bench/model.hpp>
#include <cardiac/run/errors.hpp>
#include "support/random_vector.hpp"

namespace cardiac {
namespace {

const BenchScene& scene() {
  return bench_scenes().front();
}

const CurvedMesh& fine() {
  static const CurvedMesh mesh = structured_ellipsoid(scene().shape, {6, 12, 2});
  return mesh;
}

const CurvedMesh& coarse() {
  static const CurvedMesh mesh = structured_ellipsoid(scene().shape, {4, 8, 1});
  return mesh;
}

std::vector<std::string> full_order(int order) {
  return {"reduction.method=fem", "reduction.element_order=" + std::to_string(order)};
}

// Coefficients of u = (λ − 1) (X − X0), X0 the middle of the base.
polyaffine::Vector stretched(const BenchModel& model, double lambda) {
  const Points from_base = material_elements(model.ventricle()).nodes().colwise() -
                           Vec3(model.anatomy().coordinates->base_centre());
  return (lambda - 1) * from_base.reshaped();
}

TEST(Yardstick, IsZeroForTheReferenceItself) {
  const BenchModel reference(scene(), fine(), full_order(2));
  const auto c = stretched(reference, 1.2);
  const ModelErrors e = Yardstick(reference.ventricle(), c).errors(reference.ventricle(), c);
  EXPECT_LT(e.displacement_percent, 1e-9);
  EXPECT_LT(std::abs(e.volume_percent), 1e-9);
  EXPECT_LT(e.max_segment_strain, 1e-12);
  EXPECT_LT(e.apex_strain, 1e-12);
  EXPECT_NEAR(e.compliance_ratio, 1, 1e-12);
}

// A uniform stretch is in every finite element space, whatever its mesh, if points are looked up where they
// are; then all errors are known.
TEST(Yardstick, MeasuresAKnownDifferenceBetweenMeshes) {
  constexpr double kReference = 1.2, kOther = 1.25;
  const BenchModel reference(scene(), fine(), full_order(2));
  const Yardstick yardstick(reference.ventricle(), stretched(reference, kReference));
  for (const int order : {1, 2}) {
    const BenchModel other(scene(), coarse(), full_order(order));
    const ModelErrors e = yardstick.errors(other.ventricle(), stretched(other, kOther));
    EXPECT_NEAR(e.displacement_percent, 100 * (kOther - kReference) / (kReference - 1), 0.01);
    const double strain = (kOther * kOther - kReference * kReference) / 2;
    EXPECT_NEAR(e.max_segment_strain, strain, 1e-10);
    EXPECT_NEAR(e.apex_strain, strain, 1e-10);
    const double shape = other.cavity_at_rest() / reference.cavity_at_rest();
    EXPECT_NEAR(e.volume_percent, 100 * (shape * std::pow(kOther / kReference, 3) - 1), 1e-9);
    EXPECT_NEAR(e.compliance_ratio, shape * (std::pow(kOther, 3) - 1) / (std::pow(kReference, 3) - 1), 1e-10);
  }
}

TEST(WallState, OfAReducedModelIsThatOfItsTables) {
  const BenchModel model(scene(), fine(), {"reduction.preset=accurate"});
  const auto& d = model.ventricle().discretisation;
  const polyaffine::Vector c =
      polyaffine::testing::random_vector(model.ventricle().num_coefficients(), 0.1, 3);
  std::vector<polyaffine::MeshPoint> at;
  for (std::size_t q = 0; q < d.points.tet.size(); ++q)
    at.push_back({d.points.tet[q], d.points.barycentric.col(static_cast<Eigen::Index>(q))});
  const WallState state = wall_state(*d.basis, c, at);
  const auto F = polyaffine::evaluate_field(model.ventricle().wall->table(), c);
  const Points u = polyaffine::DisplacementMap(*d.basis, d.points.tet, d.points.barycentric).apply(c);
  EXPECT_GT(u.norm(), 0.1);
  EXPECT_LT((state.F - F).cwiseAbs().maxCoeff(), 1e-10 * F.cwiseAbs().maxCoeff());
  EXPECT_LT((state.u - u).cwiseAbs().maxCoeff(), 1e-10 * u.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace cardiac
