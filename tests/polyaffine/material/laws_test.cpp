#include <functional>
#include <memory>
#include <string>

#include <polyaffine/core/error.hpp>
#include <polyaffine/material/linear_elastic.hpp>
#include <polyaffine/material/mooney_rivlin.hpp>
#include <polyaffine/material/neo_hookean.hpp>
#include <polyaffine/material/saint_venant_kirchhoff.hpp>
#include <polyaffine/material/signed_volume.hpp>
#include <polyaffine/material/volumetric.hpp>

#include "polyaffine/material/law_checks.hpp"

namespace polyaffine {
namespace {

using namespace checks;

constexpr int kPoints = 9;  // with packs of 4: two full ones and a tail of 1
const std::vector<double> kFactor = {1, 2, 0.5, 3, 1.5, 0.7, 4, 0.1, 1.1};
const Elasticity kElasticity{12, 0.3};
const Lame kLame = lame(kElasticity);
const double kBulk = kLame.lambda + 2 * kLame.mu / 3;

struct Case {
  std::string name;
  std::function<std::unique_ptr<Law>(std::vector<double> factor)> make;
  bool objective = true, stress_free = true, isochoric = false, takes_factor = true;
};

template <class T, class Parameter>
Case make_case(std::string name, Parameter parameter) {
  return {name, [parameter](std::vector<double> factor) { return std::make_unique<T>(parameter, factor); }};
}

std::vector<Case> cases() {
  std::vector<Case> all = {make_case<LinearElastic>("LinearElastic", kElasticity),
                           make_case<SaintVenantKirchhoff>("SaintVenantKirchhoff", kElasticity),
                           make_case<NeoHookean>("NeoHookean", kLame),
                           make_case<IsochoricNeoHookean>("IsochoricNeoHookean", kLame.mu),
                           make_case<MooneyRivlin>("MooneyRivlin", MooneyRivlinParameters{2, 1.3}),
                           make_case<QuadraticVolumetric>("QuadraticVolumetric", kBulk),
                           make_case<LogarithmicVolumetric>("LogarithmicVolumetric", kBulk)};
  all[0].objective = false;
  all[3].isochoric = all[4].isochoric = true;
  all.push_back(
      {"SignedVolume", [](std::vector<double>) { return std::make_unique<SignedVolume>(1.0 / 3); }});
  all.back().stress_free = all.back().takes_factor = false;
  return all;
}

class Laws : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(All, Laws, testing::ValuesIn(cases()), [](const auto& i) { return i.param.name; });

TEST_P(Laws, StressAndTangentAreDerivatives) {
  expect_derivatives(*GetParam().make(kFactor), kPoints);
}

TEST_P(Laws, BatchEqualsPoints) {
  expect_batches_equal_points(*GetParam().make(kFactor), kPoints);
}

TEST_P(Laws, EnergyDoesNotSeeRotations) {
  if (GetParam().objective) expect_objective(*GetParam().make({}));
}

TEST_P(Laws, NoStressAtRest) {
  const auto law = GetParam().make({});
  if (GetParam().stress_free && GetParam().objective) expect_stress_free(*law, 100);
  EXPECT_EQ(respond(*law, Mat3::Identity()).P.isZero(1e-13), GetParam().stress_free);
}

TEST_P(Laws, IsochoricPartDoesNotSeeVolume) {
  if (GetParam().isochoric) expect_isochoric(*GetParam().make({}));
}

TEST_P(Laws, FactorMultipliesEverything) {
  if (!GetParam().takes_factor) return;
  std::mt19937 generator(5);
  const Mat3 F = random_deformation(generator);
  const Response one = respond(*GetParam().make({}), F, 3), three = respond(*GetParam().make(kFactor), F, 3);
  EXPECT_DOUBLE_EQ(three.W, 3 * one.W);
  EXPECT_LT((three.P - 3 * one.P).norm(), 1e-14 * three.P.norm());
  EXPECT_LT((three.A - 3 * one.A).norm(), 1e-14 * three.A.norm());
}

TEST_P(Laws, NegativeFactorIsRefused) {
  if (!GetParam().takes_factor) return;
  EXPECT_THROW(GetParam().make({1, -1}), InputError);
}

// At F = I every law has the tangent of linear elasticity with its small-strain moduli, to rounding.
TEST(SmallStrain, TangentIsLinearElasticity) {
  const auto tangent = [](const Law& law) { return respond(law, Mat3::Identity()).A; };
  const Mat9 linear = tangent(LinearElastic(kElasticity));
  EXPECT_LT((tangent(SaintVenantKirchhoff(kElasticity)) - linear).norm(), 1e-13 * linear.norm());
  EXPECT_LT((tangent(NeoHookean(kLame)) - linear).norm(), 1e-13 * linear.norm());
  const Mat9 isochoric = tangent(IsochoricNeoHookean(kLame.mu));
  EXPECT_LT((isochoric + tangent(QuadraticVolumetric(kBulk)) - linear).norm(), 1e-13 * linear.norm());
  EXPECT_LT((isochoric + tangent(LogarithmicVolumetric(kBulk)) - linear).norm(), 1e-13 * linear.norm());
  const Mat9 mooney = tangent(MooneyRivlin({0.2 * kLame.mu, 0.3 * kLame.mu}));
  EXPECT_LT((mooney - isochoric).norm(), 1e-13 * linear.norm());
}

TEST(LinearElastic, UniaxialStressGivesYoungsModulus) {
  const double strain = 0.01;
  const Mat3 F = Vec3(1 + strain, 1 - 0.3 * strain, 1 - 0.3 * strain).asDiagonal();
  const Mat3 P = respond(LinearElastic(kElasticity), F).P;
  EXPECT_NEAR(P(0, 0), 12 * strain, 1e-13);
  EXPECT_NEAR(P(1, 1), 0, 1e-13);
  EXPECT_NEAR(respond(LinearElastic(kElasticity), F).W, 0.5 * 12 * strain * strain, 1e-14);
}

TEST(SaintVenantKirchhoff, UniaxialStretchWithFixedSides) {
  const double s = 1.4, E = 0.5 * (s * s - 1);
  const Mat3 P = respond(SaintVenantKirchhoff(kElasticity), Vec3(s, 1, 1).asDiagonal()).P;
  EXPECT_NEAR(P(0, 0), s * (kLame.lambda + 2 * kLame.mu) * E, 1e-12);
  EXPECT_NEAR(P(1, 1), kLame.lambda * E, 1e-12);
}

TEST(NeoHookean, SimpleShear) {
  const double shear = 0.6;
  const Mat3 sigma = cauchy(NeoHookean(kLame), simple_shear(shear));  // μ (b − I) at J = 1
  EXPECT_NEAR(sigma(0, 1), kLame.mu * shear, 1e-13);
  EXPECT_NEAR(sigma(0, 0), kLame.mu * shear * shear, 1e-13);
  EXPECT_NEAR(sigma(1, 1), 0, 1e-13);
}

TEST(NeoHookean, UniformDilatation) {
  const double s = 1.2, J = s * s * s;  // σ = (μ (s² − 1) + λ ln J)/J I
  const Mat3 sigma = cauchy(NeoHookean(kLame), s * Mat3::Identity());
  EXPECT_LT((sigma - (kLame.mu * (s * s - 1) + kLame.lambda * std::log(J)) / J * Mat3::Identity()).norm(),
            1e-13);
}

TEST(IsochoricNeoHookean, UniaxialAndShear) {
  const double s = 1.5;
  const Mat3 stretched = cauchy(IsochoricNeoHookean(3), uniaxial(s));  // μ dev b
  EXPECT_NEAR(stretched(0, 0) - stretched(1, 1), 3 * (s * s - 1 / s), 1e-13);
  EXPECT_NEAR(stretched.trace(), 0, 1e-13);
  EXPECT_NEAR(cauchy(IsochoricNeoHookean(3), simple_shear(0.4))(0, 1), 3 * 0.4, 1e-13);
}

TEST(MooneyRivlin, UniaxialAndShear) {
  const double c1 = 2, c2 = 1.3, s = 1.5, g = 0.4;
  const MooneyRivlin law({c1, c2});
  const Mat3 stretched = cauchy(law, uniaxial(s));
  EXPECT_NEAR(stretched(0, 0) - stretched(1, 1), 2 * (s * s - 1 / s) * (c1 + c2 / s), 1e-12);
  const Mat3 sheared = cauchy(law, simple_shear(g));
  EXPECT_NEAR(sheared(0, 1), 2 * (c1 + c2) * g, 1e-13);
  EXPECT_NEAR(sheared(0, 0) - sheared(1, 1), 2 * (c1 + c2) * g * g, 1e-13);  // Poynting effect
  EXPECT_NEAR(sheared(1, 1) - sheared(2, 2), -2 * c2 * g * g, 1e-13);
}

TEST(Volumetric, PressureOfAUniformDilatation) {
  const double s = 1.1, J = s * s * s, kappa = 50;
  const Mat3 F = s * Mat3::Identity();
  EXPECT_LT((cauchy(QuadraticVolumetric(kappa), F) - kappa * (J - 1) * Mat3::Identity()).norm(), 1e-12);
  EXPECT_LT((cauchy(LogarithmicVolumetric(kappa), F) - kappa / 2 * (J - 1 / J) * Mat3::Identity()).norm(),
            1e-12);
  EXPECT_NEAR(respond(LogarithmicVolumetric(kappa), F).W, kappa / 4 * (J * J - 1 - 2 * std::log(J)), 1e-13);
}

// Twelve triangles around the unit cube, moved away from the origin: ∫ over each parameter triangle (area
// 1/2) of det[x, x_ξ, x_η]/3, which is linear in x, so the centroid suffices.
TEST(SignedVolume, ClosedSurfaceOfACube) {
  const int faces[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                            {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  const Vec3 shift(3, -2, 5);
  const auto corner = [&](int v) { return Vec3(shift + Vec3(v % 4 == 1 || v % 4 == 2, v % 4 >= 2, v >= 4)); };
  double volume = 0;
  for (const auto& face : faces) {
    const Vec3 a = corner(face[0]), b = corner(face[1]), c = corner(face[2]);
    Mat3 M;
    M << (a + b + c) / 3, b - a, c - a;
    volume += 0.5 * respond(SignedVolume(1.0 / 3), M).W;
  }
  EXPECT_NEAR(volume, 1, 1e-13);
}

TEST(Parameters, ImpossibleValuesAreRefused) {
  EXPECT_THROW(lame({-1, 0.3}), InputError);
  EXPECT_THROW(lame({0, 0.3}), InputError);
  EXPECT_THROW(lame({10, 0.5}), InputError);
  EXPECT_THROW(lame({10, -1}), InputError);
  EXPECT_THROW(lame({10, std::nan("")}), InputError);
  EXPECT_THROW(LinearElastic({10, 0.5}), InputError);
  EXPECT_THROW(SaintVenantKirchhoff({-3, 0.2}), InputError);
  EXPECT_THROW(NeoHookean({1, -1}), InputError);
  EXPECT_THROW(NeoHookean({-1, 1}), InputError);
  EXPECT_THROW(IsochoricNeoHookean(0), InputError);
  EXPECT_THROW(MooneyRivlin({-1, 2}), InputError);
  EXPECT_THROW(MooneyRivlin({0, 0}), InputError);
  EXPECT_THROW(QuadraticVolumetric(-5), InputError);
  EXPECT_THROW(LogarithmicVolumetric(1 / 0.0), InputError);
}

TEST(Parameters, TheMessageSaysWhatWasFoundAndExpected) {
  try {
    lame({10, 0.7});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "Poisson's ratio: found 0.7, expected a dimensionless number between -1 and 0.5, both excluded");
  }
}

}  // namespace
}  // namespace polyaffine
