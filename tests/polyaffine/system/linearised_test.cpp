#include "polyaffine/system/linearised.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "polyaffine/system/block_body.hpp"
#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

using testing::BlockBody;
using testing::random_vector;

// A number s that pushes the end of a body with s · 1 kPa and is itself driven by its motion,
// R_c = −s g, R_s = ṡ + s³ − gᵀc, the last part met exactly or not.
class Pusher : public Term {
 public:
  Pusher(Vector g, Unknowns s) : g_(std::move(g)), s_(s) {}
  void add_residual(const At& at, Residual& out) const override {
    out.values.head(g_.size()) -= at.y[s_.first] * g_;
    out.values[s_.first] -= g_.dot(at.y.head(g_.size()));
  }
  void add_tangent(const At&, double, Tangent& out) const override {
    out.columns.push_back({out.few_index(s_.first), -g_});
    out.rows.push_back({out.few_index(s_.first), -g_});
  }

 private:
  Vector g_;
  Unknowns s_;
};
class Cubic : public Term {
 public:
  Cubic(Unknowns s, bool exactly) : s_(s), exactly_(exactly) {}
  bool is_met_exactly() const override { return exactly_; }
  void add_residual(const At& at, Residual& out) const override {
    out.values[s_.first] += at.rate_of(s_)[0] + std::pow(at.y[s_.first], 3);
  }
  void add_tangent(const At& at, double alpha, Tangent& out) const override {
    const int k = out.few_index(s_.first);
    out.corner(k, k) += alpha + 3 * std::pow(at.y[s_.first], 2);
  }

 private:
  Unknowns s_;
  bool exactly_;
};

struct Case {
  const char* name;
  bool inertia, mixed, few, exactly;
};

System system_of(const BlockBody& body, const Case& of) {
  // Without viscosity the tangent is exact.
  System out = body.system({solid(body.wall(0, of.mixed ? 200 : 0)),
                            body.support({.stiffness_kPa_per_mm = 3, .damping_kPa_ms_per_mm = 50})});
  if (of.inertia) body.add_inertia(out);
  if (of.few) {
    const Unknowns s = out.layout.add({.name = "push", .unit = "kPa"}, 1);
    Vector g = random_vector(out.layout.field().size, 1, 9);
    out.restrict(g);
    out.terms.push_back(std::make_shared<Pusher>(g, s));
    out.terms.push_back(std::make_shared<Cubic>(s, of.exactly));
  }
  return of.mixed ? mixed_form(out) : out;
}

class EveryTangent : public ::testing::TestWithParam<Case> {};

// J⁻¹(J d) = d with J d by central differences, for every way in which unknowns are solved.
TEST_P(EveryTangent, CorrectionsInvertTheDerivativeOfTheResidual) {
  const BlockBody body;
  const System system = system_of(body, GetParam());
  Vector y = random_vector(system.size(), 0.05, 3), rate = random_vector(system.size(), 0.01, 4);
  Vector d = random_vector(system.size(), 1, 5);
  for (std::size_t i = 0; i < system.fixed.size(); ++i)
    if (system.fixed[i]) y[static_cast<Eigen::Index>(i)] = d[static_cast<Eigen::Index>(i)] = 0;
  const double alpha = 0.7, h = 1e-5;
  const auto residual = [&](double step) {
    const Vector moved = y + step * d, moving = rate + alpha * step * d;
    return system.residual({0, moved, &moving}).values;
  };
  const Vector image = (residual(h) - residual(-h)) / (2 * h);
  const auto linear = system.make_linear();
  Linearised tangent(system, *linear);
  const At at{0, y, &rate};
  ASSERT_TRUE(tangent.factorise(at, alpha));
  Vector step;
  const double small = 1e-6;  // so that what is met exactly is linear
  ASSERT_TRUE(tangent.solve(at, small * image, step));
  EXPECT_LT((step / small - d).norm(), 1e-5 * d.norm());
  EXPECT_GT(image.norm(), 1);
  EXPECT_EQ(tangent.cost().factorisations, 1);
  EXPECT_EQ(tangent.cost().linear_solves, 1);
}

INSTANTIATE_TEST_SUITE_P(
    Linearised, EveryTangent,
    ::testing::Values(Case{"field", false, false, false, false}, Case{"inertia", true, false, false, false},
                      Case{"mixed", false, true, false, false}, Case{"few", false, false, true, false},
                      Case{"few_exactly", false, false, true, true}, Case{"all", true, true, true, true}),
    [](const auto& of) { return std::string(of.param.name); });

// From s = 2 to s³ = 0.001: Newton's tangent at 2 would leave 2/3 of the way.
TEST(Linearised, MeetsWhatBendsAsItIs) {
  System system;
  const Unknowns s = system.layout.add({.name = "s", .unit = "1"}, 1);
  system.terms.push_back(std::make_shared<Cubic>(s, true));
  const auto linear = system.make_linear();
  Linearised tangent(system, *linear);
  const Vector y = Vector::Constant(1, 2), rate = Vector::Zero(1);
  const At at{0, y, &rate};
  ASSERT_TRUE(tangent.factorise(at, 0));
  Vector step;
  ASSERT_TRUE(tangent.solve(at, Vector::Constant(1, 0.001 - 8), step));
  EXPECT_NEAR(2 + step[0], 0.1, 1e-7);
}

TEST(System, FixedUnknownsFollowTheirPrescribedValues) {
  const BlockBody body;
  System system = body.system({solid(body.wall(0, 0))});
  system.prescribed = random_vector(system.size(), 0.1, 6);
  Vector y = Vector::Zero(system.size());
  system.prescribe(0.5, y);
  for (Eigen::Index i = 0; i < y.size(); ++i)
    EXPECT_EQ(y[i], system.fixed[static_cast<std::size_t>(i)] ? 0.5 * system.prescribed[i] : 0);
  const Vector r = system.residual({0.5, y}).values;
  Vector free = r;
  system.restrict(free);
  EXPECT_EQ(r, free);  // nothing is left where the constraints hold
  EXPECT_GT(r.norm(), 0);
}

}  // namespace
}  // namespace polyaffine
