#include "cardiac/reduction/axes_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cardiac/model/ventricle.hpp>
#include <cardiac/protocol/build_anatomy.hpp>
#include <cardiac/run/build_ventricle.hpp>

#include <polyaffine/solve/load_stepping.hpp>

#include "support/biventricle.hpp"
#include "support/heart_run.hpp"
#include "support/ridged_ellipsoid.hpp"

namespace cardiac {
namespace {

using polyaffine::Vector;
using protocol::Axes;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Protocol passive(std::vector<std::string> overrides = {}) {
  return testing::shipped_protocol("passive_inflation", testing::on_land_ellipsoid(std::move(overrides)));
}

std::shared_ptr<const Anatomy> with_ridge(double height) {
  return std::make_shared<const Anatomy>(build_anatomy(testing::ridged_ellipsoid(height), passive()));
}

TEST(AxesCheck, SmoothWallsKeepHeartAxes) {
  std::vector<std::string> warnings;
  for (const double height : {0.0, 0.2}) {
    EXPECT_LT(radial_misfit_deg(*with_ridge(height)), 2);
    EXPECT_EQ(axes_of(*with_ridge(height), passive(), warnings), Axes::heart);
  }
  const Protocol two = testing::shipped_protocol("healthy_biv", {"reduction.axes=auto"});
  const Anatomy both = build_anatomy(testing::Biventricle::get().mesh, two);
  EXPECT_LT(radial_misfit_deg(both), kTurningAxes_deg);
  EXPECT_EQ(axes_of(both, two, warnings), Axes::cartesian);  // nearer to full order with two ventricles
  EXPECT_THAT(warnings, IsEmpty());
}

TEST(AxesCheck, MuscleThatStandsIntoTheCavityTakesCartesianAxesUnlessAskedOtherwise) {
  const auto ridged = with_ridge(5);
  EXPECT_GT(radial_misfit_deg(*ridged), kTurningAxes_deg);
  std::vector<std::string> warnings;
  EXPECT_EQ(axes_of(*ridged, passive(), warnings), Axes::cartesian);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("Cartesian axes are taken")));
  warnings.clear();
  EXPECT_EQ(axes_of(*ridged, passive({"reduction.axes=heart"}), warnings), Axes::heart);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("kept as asked")));
  warnings.clear();
  EXPECT_EQ(axes_of(*ridged, passive({"reduction.axes=cartesian"}), warnings), Axes::cartesian);
  EXPECT_THAT(warnings, IsEmpty());
}

// Volume that a small pressure adds to the cavity, reduced over full order.
TEST(AxesCheck, TheRidgedWallIsAsCompliantAsFullOrder) {
  const auto ridged = with_ridge(5);
  const auto compliance = [&](const Protocol& protocol, protocol::Method method) {
    const Ventricle v = build_ventricle(ridged, protocol, method);
    Vector c = Vector::Zero(v.num_coefficients());
    const double before = v.cavity_volume(c);
    polyaffine::LoadOptions options;
    options.first_step = 1;
    const auto system = loaded_ventricle(v, {Vector{{0.02}}});
    EXPECT_TRUE(polyaffine::load_stepping(system, *system.make_linear(), c, options).converged());
    return v.cavity_volume(c) - before;
  };
  const double full = compliance(passive(), protocol::Method::fem);
  const auto off = [&](const char* axes) {
    const Protocol protocol = passive({std::string("reduction.axes=") + axes});
    return std::abs(compliance(protocol, protocol::Method::polyaffine) / full - 1);
  };
  EXPECT_LT(off("auto"), 0.1);
  EXPECT_LT(off("auto"), off("heart"));
}

TEST(MovingBaseWarning, IsGivenWhereTheBaseMoves) {
  Protocol protocol = passive();
  EXPECT_THAT(moving_base_warning(protocol), IsEmpty());
  for (const auto base : {protocol::Base::elastic, protocol::Base::sliding}) {
    protocol.boundary.base = base;
    EXPECT_THAT(moving_base_warning(protocol), HasSubstr("boundary.base"));
  }
}

}  // namespace
}  // namespace cardiac
