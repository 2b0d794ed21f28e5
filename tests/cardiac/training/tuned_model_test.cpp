#include "cardiac/training/tuned_model.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/protocol/build_anatomy.hpp>
#include <cardiac/run/errors.hpp>
#include <cardiac/run/simulate.hpp>
#include <cardiac/run/verification.hpp>
#include <cardiac/training/tuned_archive.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/solve/load_stepping.hpp>

#include "support/temporary_folder.hpp"

namespace cardiac {
namespace {

using polyaffine::Vector;

// A wall of Guccione's law that contracts under a held pressure, on a coarse ellipsoid.
constexpr auto kProtocol = R"(
[mesh]
shape = "land_ellipsoid"
[reduction]
preset = "tuned"
accuracy_percent = 5
budget_s = 40
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

class TunedModels : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::filesystem::remove_all(folder());
    setenv("XDG_CACHE_HOME", folder().c_str(), 1);
    protocol = parse_protocol(kProtocol, "test");
    auto mesh = structured_ellipsoid(land_ellipsoid(), {4, 10, 1});
    heart =
        std::make_shared<const Anatomy>(build_anatomy(std::move(mesh.mesh), protocol, {mesh.midpoints, {}}));
    protocol.heart = heart;
    RunControl control;
    control.on_round = [](const TuningRound& round) { rounds.push_back(round); };
    outcome = simulate(protocol, control);
    model = cached_model(*heart, protocol);
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder()); }
  static std::filesystem::path folder() {
    return std::filesystem::path(::testing::TempDir()) / "tuned_model_test";
  }

  static inline Protocol protocol;
  static inline std::shared_ptr<const Anatomy> heart;
  static inline Outcome outcome;
  static inline std::vector<TuningRound> rounds;
  static inline std::optional<TunedModel> model;
};

// A load of the wall between those that any plan holds.
TrainingLoad in_between(const Outcome& of, double pressure_mmHg) {
  TrainingLoad out;
  out.name = "in between";
  out.pressures_kPa = Vector::Constant(1, pressure_mmHg * kPa_per_mmHg);
  out.clock_ms = of.model.contraction->curve.contraction_end_ms() + of.model.contraction->delay_ms[0];
  out.level = 0.57;
  return out;
}

Vector solved(const Ventricle& v, const TrainingLoad& load) {
  const polyaffine::System system = loaded_ventricle(v, wall_load(v, load));
  Vector c = Vector::Zero(v.num_coefficients());
  EXPECT_TRUE(polyaffine::load_stepping(system, *system.make_linear(), c, {}).converged());
  return c;
}

TEST_F(TunedModels, ReachTheirAccuracyInLoadsHeldOut) {
  ASSERT_TRUE(outcome.path.completed) << outcome.path.stop_reason;
  ASSERT_FALSE(rounds.empty());
  EXPECT_LE(rounds.back().protocol.displacement_percent, protocol.reduction.accuracy_percent);
  EXPECT_LE(rounds.back().segments.displacement_percent,
            kSegmentsAllowance * protocol.reduction.accuracy_percent);
  EXPECT_GT(rounds.back().full_order_solves, 8);
  EXPECT_LE(rounds.back().unknowns, 100);
  EXPECT_LE(rounds.back().points, 1000);
}

TEST_F(TunedModels, AreNearFullOrderInANewLoad) {
  FullOrder full(heart, protocol);
  const TrainingLoad load = in_between(outcome, 33);
  const auto truth = full.solve(load, nullptr);
  ASSERT_TRUE(truth);
  const Vector c = solved(outcome.model, load);
  const auto& basis = dynamic_cast<const polyaffine::NestedBasis&>(*outcome.model.discretisation.basis);
  const HeartModes modes(*heart, protocol);
  EXPECT_GT(modes.size(truth->u), 0);
  // What the plan's own loads are held to.
  const double accuracy = protocol.reduction.accuracy_percent / 100;
  EXPECT_LT(modes.size(basis.nodal(c) - truth->u), accuracy * modes.size(truth->u));
  // The same difference at points within the elements, another way through the functions.
  const ModelErrors errors = Yardstick(full.ventricle(load), truth->u).errors(outcome.model, c);
  EXPECT_LT(errors.displacement_percent, 100 * accuracy);
  EXPECT_GT(errors.displacement_percent, 1e-3);
  EXPECT_LT(errors.max_segment_strain, 0.02);
  const double volume = full.ventricle(load).cavity_volume(truth->u);
  EXPECT_NEAR(outcome.model.cavity_volume(c), volume, 0.003 * volume);
}

// With all points and functions that hold a state, the state of the full-order model is the nested model's.
TEST_F(TunedModels, NestedModelsHoldTheirTrainingStates) {
  FullOrder full(heart, protocol);
  const auto truth = full.solve(in_between(outcome, 25), nullptr);
  ASSERT_TRUE(truth);
  const HeartModes modes(*heart, protocol);
  const NestedSpace space =
      modes.with_pressures(modes.with_modes(modes.affine(), {&*truth}, 1e-6, 10), {&*truth}, 1e-6, 10);
  EXPECT_EQ(space.num_modes, 1);
  const Ventricle nested = assemble_ventricle(
      heart, protocol, nested_discretisation(*heart, protocol, space, full.discretisation()));
  const Vector c = solved(nested, truth->load);
  const auto& basis = dynamic_cast<const polyaffine::NestedBasis&>(*nested.discretisation.basis);
  // Newton's tolerance, in the stiffness of the volume.
  EXPECT_LT(modes.size(basis.nodal(c) - truth->u), 1e-5 * modes.size(truth->u));
}

// What the model tells of itself against the truth, in loads of the plan's kind and far outside.
TEST_F(TunedModels, TellTheirErrorWithinAFactorOfTwo) {
  ASSERT_TRUE(model);
  ASSERT_EQ(outcome.result.estimated_errors.size(), 2u);
  const auto truth = verify_path(outcome.model, protocol, outcome.path);
  Protocol other = protocol;
  other.tuned = outcome.model.tuned;
  other.contraction->contractility_kPa *= 3.5;
  const Outcome strong = simulate(other);
  const auto strong_truth = verify_path(strong.model, other, strong.path);
  double last = 0;
  for (const auto& [told, instant] : {std::pair{outcome.result.estimated_errors[1], truth[1]},
                                      std::pair{strong.result.estimated_errors[1], strong_truth[1]}}) {
    EXPECT_GT(told.displacement_percent, 0.5 * instant.displacement_error_percent);
    EXPECT_LT(told.displacement_percent, 2 * instant.displacement_error_percent);
    EXPECT_GT(told.displacement_percent, last);
    last = told.displacement_percent;
  }
}

TEST_F(TunedModels, ModelFileRunsTheSame) {
  ASSERT_TRUE(model);
  const TemporaryFolder files;
  const auto file = files.path / "heart.model";
  write_heart_model(file, {kProtocol,
                           "test",
                           {},
                           structure_key(*heart, protocol),
                           heart,
                           std::make_shared<const TunedModel>(*model)});
  const HeartModel read = read_heart_model(file);
  Protocol again = parse_protocol(read.protocol, read.source, read.overrides);
  again.heart = read.heart;
  EXPECT_EQ(structure_key(*again.heart, again), read.structure);
  TunedModel tuned = *read.tuned;
  complete(*again.heart, again, tuned);
  again.tuned = std::make_shared<const TunedModel>(std::move(tuned));
  const Outcome second = simulate(again, {});
  ASSERT_EQ(second.path.steps.size(), outcome.path.steps.size());
  EXPECT_EQ(second.path.steps.back().c, outcome.path.steps.back().c);
  EXPECT_EQ(second.path.steps.back().volumes_mm3, outcome.path.steps.back().volumes_mm3);

  again.fibres->endo_angle_deg += 5;
  EXPECT_NE(structure_key(*again.heart, again), read.structure);
  again.fibres->endo_angle_deg -= 5;
  again.contraction->contractility_kPa *= 1.1;
  EXPECT_EQ(structure_key(*again.heart, again), read.structure);
  EXPECT_NE(tuned_key(*again.heart, again), tuned_key(*heart, protocol));
}

TEST_F(TunedModels, DamagedFilesAreRefused) {
  ASSERT_TRUE(model);
  const TemporaryFolder files;
  const auto file = files.path / "heart.model";
  write_heart_model(file, {kProtocol, "test", {}, "", heart, std::make_shared<const TunedModel>(*model)});
  const auto size = std::filesystem::file_size(file);
  std::filesystem::resize_file(file, size - 100);
  EXPECT_THROW(read_heart_model(file), polyaffine::InputError);
  TunedModel other = *model;
  other.wall.tet.front() = heart->mesh.num_tets();
  write_heart_model(file, {kProtocol, "test", {}, "", heart, std::make_shared<const TunedModel>(other)});
  EXPECT_THROW(read_heart_model(file), polyaffine::InputError);
}

}  // namespace
}  // namespace cardiac
