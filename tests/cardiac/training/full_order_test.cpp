#include "cardiac/training/full_order.hpp"

#include <gtest/gtest.h>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/protocol/build_anatomy.hpp>
#include <cardiac/protocol/protocol.hpp>

namespace cardiac {
namespace {

using polyaffine::Vector;

constexpr auto kProtocol = R"(
[mesh]
shape = "land_ellipsoid"
[tissue]
law = "guccione"
bulk_modulus_kPa = 1000.0
[fibres]
endo_angle_deg = 60.0
epi_angle_deg = -60.0
[contraction]
contractility_kPa = 100.0
[activation]
mode = "uniform"
[cavities]
pressure_mmHg = 40.0
[time]
duration_ms = 600
)";

// A coarse ellipsoid that contracts against a pressure.
struct Contracting {
  Protocol protocol = parse_protocol(kProtocol, "test");
  std::shared_ptr<const Anatomy> heart = [this] {
    auto mesh = structured_ellipsoid(land_ellipsoid(), {4, 10, 1});
    return std::make_shared<const Anatomy>(
        build_anatomy(std::move(mesh.mesh), protocol, {mesh.midpoints, {}}));
  }();
  FullOrder full{heart, protocol};

  FullState state() {
    TrainingLoad load;
    load.name = "contracted";
    load.pressures_kPa = Vector::Constant(1, 30 * kPa_per_mmHg);
    const Ventricle v = full.ventricle({});
    load.clock_ms = v.contraction->curve.contraction_end_ms() + v.contraction->delay_ms[0];
    load.level = 0.6;
    auto out = full.solve(load, nullptr);
    EXPECT_TRUE(out);
    return *out;
  }
};

scene::RegionOverride weak(int segment, double tension) {
  scene::RegionOverride out;
  out.segments = {segment};
  out.tension_factor = tension;
  return out;
}

// The part of the forces that nothing holds, over all of them.
double unbalanced(const FullOrder& full, const FullState& state) {
  const Ventricle v = full.ventricle(state.load);
  const polyaffine::System system = polyaffine::mixed_form(loaded_ventricle(v, wall_load(v, state.load)));
  Vector y(state.u.size() + state.pressure.size());
  y << state.u, state.pressure;
  const auto at = polyaffine::rest_state(system, 1, y);
  return at.relative;
}

TEST(FullOrder, AnswersInFullAreEquilibriaBeyondTheLinearOnes) {
  Contracting scene;
  const FullState state = scene.state();
  const std::vector<scene::RegionOverride> changes{weak(7, 0.2), weak(15, 0.2)};
  const auto linear = scene.full.linear_answers(state, changes), all = scene.full.answers(state, changes);
  ASSERT_EQ(all.size(), changes.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_EQ(all[k].load.regions.back().tension_factor, linear[k].load.regions.back().tension_factor);
    const double far = (all[k].u - state.u).norm();
    EXPECT_GT(far, 0.02 * state.u.norm());
    // An eighth is what a linear answer leaves out at the least here; it would be none without Newton's
    // steps.
    EXPECT_GT((all[k].u - linear[k].u).norm(), far / 8);
    // Newton's own tolerance.
    EXPECT_LT(unbalanced(scene.full, all[k]), 1e-7);
    EXPECT_GT(unbalanced(scene.full, linear[k]), 1e-4);
  }
}

// To first order they are the same: what they differ by falls with the square of the change.
TEST(FullOrder, AnswersToSmallChangesAreLinear) {
  Contracting scene;
  const FullState state = scene.state();
  const auto misfit = [&](double change) {
    const std::vector<scene::RegionOverride> changes{weak(7, 1 - change)};
    return (scene.full.linear_answers(state, changes)[0].u - scene.full.answers(state, changes)[0].u).norm();
  };
  const double order = std::log2(misfit(0.04) / misfit(0.02));
  EXPECT_NEAR(order, 2, 0.2);
}

}  // namespace
}  // namespace cardiac
