#include "polyaffine/system/point_stress.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include <polyaffine/material/lagrangian_response.hpp>

#include "polyaffine/system/block_body.hpp"
#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

using testing::BlockBody;
using testing::random_vector;

// A tension τ along x as the state of the points: S = τ e₁⊗e₁.
class Tension : public Law {
 public:
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override {
    SymPack S;
    for (Pack& entry : S.v) entry = broadcast(0);
    S.v[0] = gather(at.state.data() + points.point, 1, points.lanes);
    add_constant_stress(at.F, broadcast(0), S, tangent, r);
  }
  bool feels_state() const override { return true; }
};

FieldEnergy block(const BlockBody& body, double kappa) {
  FieldTable table = deformation_table(body.basis, body.basis.wall_points(1));
  std::optional<PressureSpace> space;
  if (kappa > 0) space = block_pressure(table, kappa);
  return {std::move(table),
          BlockBody::Laws{std::make_shared<NeoHookean>(Lame{20, 10}), std::make_shared<Tension>(),
                          std::make_shared<KelvinVoigt>(30)},
          space};
}

// Σ_q w_q P_q : H_q is the power of the forces on a rate, whatever the stress comes from.
TEST(PointStress, ItsPartsMakeTheForces) {
  const BlockBody body;
  for (const double kappa : {0.0, 500.0}) {
    SCOPED_TRACE(kappa);
    const FieldEnergy energy = block(body, kappa);
    const FieldTable& table = energy.table();
    const Vector c = random_vector(table.num_unknowns(), 0.05, 1),
                 rate = random_vector(table.num_unknowns(), 0.01, 2);
    const Vector tension = random_vector(table.num_points(), 5, 3);
    const PointState state{tension.data(), static_cast<std::size_t>(tension.size())};
    const Matrix F = evaluate_field(table, c), H = field_rate(table, rate);
    const Matrix P = elastic_stress(energy, F, kappa > 0 ? energy.pressure(c) : Vector()) +
                     driven_stress(energy, F, state) + viscous_stress(energy, F, H);
    const double power = energy.evaluate({c, state, &rate}).gradient.dot(rate);
    EXPECT_NEAR(work(table.weights, P, H), power, 1e-12 * std::abs(power));
  }
}

TEST(PointStress, ElasticEnergyIsThatOfTheForces) {
  const BlockBody body;
  const FieldEnergy energy = block(body, 500);
  const Vector none = Vector::Zero(energy.table().num_points());
  const Vector c = random_vector(energy.table().num_unknowns(), 0.05, 1);
  const double value = energy.evaluate({c, {none.data(), static_cast<std::size_t>(none.size())}}).value;
  EXPECT_NEAR(elastic_energy(energy, c), value, 1e-12 * value);
  EXPECT_GT(value, 0.1);
}

// d(stored)/dt + dissipation is the power of a term's force.
TEST(Terms, StoreAndLoseWhatTheirForcesTake) {
  const BlockBody body;
  System system = body.system({solid(body.wall(30, 500)), body.support({3, 50}),
                               body.support({3, 50, body.end_normals(), SpringDirection::across_normal})});
  const Vector c = random_vector(system.size(), 0.05, 1), rate = random_vector(system.size(), 0.01, 2);
  const double h = 1e-4;
  for (const auto& term : system.terms) {
    Residual residual;
    residual.values = Vector::Zero(system.size());
    term->add_residual({0, c, &rate}, residual);
    const Vector before = c - h * rate, after = c + h * rate;
    const double stored = (term->stored_energy({0, after}) - term->stored_energy({0, before})) / (2 * h);
    const double lost = term->dissipation({0, c, &rate});
    const double power = residual.values.dot(rate);
    EXPECT_NEAR(stored + lost, power, 1e-7 * (std::abs(stored) + lost));
    EXPECT_GT(lost, 0);
    EXPECT_EQ(term->dissipation({0, c}), 0);
  }
  body.add_inertia(system);
  const Vector v = Vec3(0.3, 0.1, -0.2).replicate(body.basis.num_functions(), 1);
  EXPECT_NEAR(system.terms.back()->stored_energy({0, c, &v}), 0.5 * 2 * 1.06 * 0.14, 1e-12);
}

// P = F S with S = τ e₁⊗e₁ in an extension λ: the Cauchy stress is τ λ²/J along x.
TEST(PointStress, CauchyStressOfATensionInAnExtension) {
  const Mat3 F = Vec3(1.2, 0.9, 0.95).asDiagonal();
  const Mat3 S = 5 * Vec3::UnitX() * Vec3::UnitX().transpose();
  const Mat3 sigma = cauchy_stress(F * S, F);
  EXPECT_NEAR(sigma(0, 0), 5 * 1.2 * 1.2 / (1.2 * 0.9 * 0.95), 1e-12);
  EXPECT_NEAR(sigma.norm(), sigma(0, 0), 1e-12);
}

}  // namespace
}  // namespace polyaffine
