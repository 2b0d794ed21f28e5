#include "cardiac/model/muscle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <cardiac/contraction/bestel_full_2001.hpp>
#include <cardiac/contraction/land_2017.hpp>
#include <cardiac/contraction/twitch.hpp>
#include <cardiac/tissue/active_stress.hpp>
#include <polyaffine/core/monotone_cubic.hpp>
#include <polyaffine/linear/linear_system.hpp>
#include <polyaffine/solve/dae.hpp>
#include <polyaffine/system/linearised.hpp>

#include "polyaffine/system/block_body.hpp"

namespace cardiac {
namespace {

using polyaffine::Matrix;
using polyaffine::Vector;

// A block of 2 × 1 × 1 mm with fibres along x, held at x = 0.
struct Strip : polyaffine::testing::BlockBody {
  explicit Strip(std::shared_ptr<const SarcomereModel> sarcomere, double cross = 0)
      : table(polyaffine::deformation_table(basis, basis.wall_points(1))) {
    FibreAxes axes(9, table.num_points());
    axes.colwise() = polyaffine::Mat3::Identity().reshaped();
    muscle = std::make_shared<Muscle>(Muscle{
        std::move(sarcomere),
        std::make_shared<polyaffine::FieldEnergy>(table, Laws{std::make_shared<ActiveStress>(axes, cross)}),
        axes.topRows<3>(), Vector::LinSpaced(table.num_points(), 0, 20),
        Vector::LinSpaced(table.num_points(), 1, 0.5)});
  }
  polyaffine::System in_time(double viscosity = 10) const {
    polyaffine::System out = polyaffine::field_system(
        3 * basis.num_functions(), {polyaffine::solid(wall(viscosity, 0))}, system({}).fixed, 1e-5);
    out.terms.push_back(std::make_shared<MuscleTerm>(muscle, out.layout));
    return out;
  }

  polyaffine::FieldTable table;
  std::shared_ptr<Muscle> muscle;
};

std::shared_ptr<const SarcomereModel> land() {
  return std::make_shared<Land2017>(LandParameters());
}

std::shared_ptr<const SarcomereModel> bestel() {
  BestelParameters p;
  p.systole_ms = 0;
  p.diastole_ms = 324;
  return std::make_shared<BestelFull2001>(p, BridgeParameters(), 800);
}

// A step with the tangent, states eliminated, obeys the whole tangent found by differences of the residual.
// Nothing moves at the state, where the part that the tangent leaves out vanishes.
TEST(MuscleTerm, ItsEliminationIsThatOfTheWholeTangent) {
  for (const auto& model : {land(), bestel()}) {
    const Strip strip(model);
    polyaffine::System system = strip.in_time();
    const int n = system.size();
    std::mt19937 random(3);
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    Vector y(n), rate = Vector::Zero(n), rhs(n);
    for (int i = 0; i < n; ++i) {
      const bool field = i < system.layout.field().end();
      y[i] = field ? uniform(-0.02, 0.02) : uniform(0.1, 0.3);
      rhs[i] = uniform(-1, 1);
    }
    system.prescribe(0, y);
    for (std::size_t i = 0; i < system.fixed.size(); ++i)
      if (system.fixed[i]) rhs[static_cast<Eigen::Index>(i)] = 0;
    const double t = 60, alpha = 0.3, step = 1e-6;
    Matrix tangent(n, n);
    for (int j = 0; j < n; ++j) {
      Vector high = y, low = y, high_rate = rate, low_rate = rate;
      high[j] += step;
      low[j] -= step;
      high_rate[j] += alpha * step;
      low_rate[j] -= alpha * step;
      tangent.col(j) =
          (system.residual({t, high, &high_rate}).values - system.residual({t, low, &low_rate}).values) /
          (2 * step);
    }
    const auto linear = system.make_linear();
    polyaffine::Linearised linearised(system, *linear);
    ASSERT_TRUE(linearised.factorise({t, y, &rate}, alpha));
    Vector found;
    ASSERT_TRUE(linearised.solve({t, y, &rate}, rhs, found));
    Vector back = tangent * found;
    for (std::size_t i = 0; i < system.fixed.size(); ++i)
      if (system.fixed[i]) back[static_cast<Eigen::Index>(i)] = 0;
    // Differences are good to 1e-9 of entries up to 1e3.
    EXPECT_LT((back - rhs).cwiseAbs().maxCoeff(), 2e-4);
    EXPECT_GT(found.tail(n - system.layout.field().size).norm(), 1e-3);
  }
}

// The block against the twitch of one fibre on a spring: with the same motion the states are the same.
TEST(MuscleTerm, StatesFollowTheEquationsOfOneFibre) {
  LandParameters parameters;
  parameters.calcium.diastolic_uM = 0;  // no tension at first: the wall begins at rest
  Strip strip(std::make_shared<Land2017>(parameters));
  strip.muscle->delay_ms.setZero();
  strip.muscle->scale.setOnes();
  const polyaffine::System system = strip.in_time(20);
  Vector y = Vector::Zero(system.size());
  const auto& term = dynamic_cast<const MuscleTerm&>(*system.terms.back());
  term.rest(0, y);
  polyaffine::DaeIntegrator ida(system, {.relative_tolerance = 1e-6, .max_step = 1}, 0, y,
                                Vector::Zero(system.size()));
  std::vector<double> times{0}, stretch{1};
  const auto point_stretch = [&](const Vector& at) {
    return fibre_stretch(*strip.muscle, system.layout.field().of(at)).stretch[0];
  };
  double shortest = 1;
  while (ida.time() < 300) {
    ASSERT_EQ(ida.step(300), polyaffine::DaeStatus::reached) << ida.failure();
    times.push_back(ida.time());
    stretch.push_back(point_stretch(ida.y()));
    shortest = std::min(shortest, stretch.back());
  }
  EXPECT_LT(shortest, 0.85);
  const polyaffine::MonotoneCubic curve(times, stretch);
  const SarcomereModel& model = *strip.muscle->sarcomere;
  const Twitch twitch = moved_twitch(model,
                                     [&](double t) {
                                       const auto [value, slope] = curve(t);
                                       return Stretch{value, slope};
                                     },
                                     model.at_rest(model.drive(0), 1), {0, 300});
  const polyaffine::Unknowns z = system.layout.find("contraction");
  for (int i = 0; i < model.num_states(); ++i)
    EXPECT_NEAR(ida.y()[z.first + i], twitch.states.back()[static_cast<std::size_t>(i)], 2e-3) << i;
}

}  // namespace
}  // namespace cardiac
