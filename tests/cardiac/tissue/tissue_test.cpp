#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include <cardiac/tissue/active_stress.hpp>
#include <cardiac/tissue/guccione.hpp>
#include <cardiac/tissue/holzapfel_ogden.hpp>
#include <polyaffine/core/error.hpp>

#include "polyaffine/material/law_checks.hpp"

namespace cardiac {
namespace {

using namespace polyaffine;
using namespace polyaffine::checks;

constexpr int kPoints = 9;
const std::vector<double> kFactor = {1, 2, 0.5, 3, 1.5, 0.7, 4, 0.1, 1.1};
const std::vector<double> kTension = {60, 10, 0.5, 30, 100, 5, 80, 20, 45};
const GuccioneParameters kFull{2, 8, 2, 4, false}, kIsochoric{2, 8, 2, 4, true};

FibreAxes random_axes(int points) {
  std::mt19937 generator(23);
  FibreAxes axes(9, points);
  for (int i = 0; i < points; ++i) axes.col(i) = random_rotation(generator).reshaped();
  return axes;
}
FibreAxes identity_axes(int points = 1) {
  return Mat3::Identity().reshaped().replicate(1, points);
}

struct Case {
  std::string name;
  std::function<std::unique_ptr<Law>(FibreAxes)> make;
  bool stress_free = true, isochoric = false;
};

class Tissue : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    All, Tissue,
    testing::Values(
        Case{"GuccioneFull", [](FibreAxes a) { return std::make_unique<Guccione>(kFull, a, kFactor); }},
        Case{"GuccioneIsochoric",
             [](FibreAxes a) { return std::make_unique<Guccione>(kIsochoric, a, kFactor); }, true, true},
        Case{"HolzapfelOgden",
             [](FibreAxes a) {
               return std::make_unique<HolzapfelOgden>(HolzapfelOgdenParameters{}, a, kFactor);
             }},
        Case{"ActiveStress", [](FibreAxes a) { return std::make_unique<ActiveStress>(a, 0.3); }, false}),
    [](const auto& i) { return i.param.name; });

TEST_P(Tissue, StressAndTangentAreDerivatives) {
  expect_derivatives(*GetParam().make(random_axes(kPoints)), kPoints, kTension);
}

TEST_P(Tissue, BatchEqualsPoints) {
  expect_batches_equal_points(*GetParam().make(random_axes(kPoints)), kPoints, kTension);
}

TEST_P(Tissue, EnergyDoesNotSeeRotations) {
  expect_objective(*GetParam().make(random_axes(kPoints)), kTension);
}

TEST_P(Tissue, NoStressAtRest) {
  if (GetParam().stress_free) expect_stress_free(*GetParam().make(random_axes(kPoints)), 100);
}

TEST_P(Tissue, IsochoricPartDoesNotSeeVolume) {
  if (GetParam().isochoric) expect_isochoric(*GetParam().make(random_axes(kPoints)));
}

// Turning the fibres by R and the tissue back by R first changes nothing: W_R(F Rᵀ) = W_I(F).
TEST_P(Tissue, FollowsItsAxes) {
  std::mt19937 generator(29);
  const FibreAxes axes = random_axes(kPoints);
  const auto turned = GetParam().make(axes), straight = GetParam().make(identity_axes(kPoints));
  const Mat3 F = random_deformation(generator), R = axes.col(0).reshaped(3, 3);
  const Response a = respond(*turned, F * R.transpose(), 0, kTension), b = respond(*straight, F, 0, kTension);
  EXPECT_NEAR(a.W, b.W, 1e-12 * b.P.norm());
  EXPECT_LT((a.P - b.P * R.transpose()).norm(), 1e-12 * b.P.norm());
}

TEST_P(Tissue, AxesThatAreNotOrthonormalAreRefused) {
  FibreAxes axes = identity_axes(kPoints);
  axes(0, 4) = 1.01;
  EXPECT_THROW(GetParam().make(axes), InputError);
  axes(0, 4) = std::nan("");
  EXPECT_THROW(GetParam().make(axes), InputError);
}

// With equal exponents Q = b E:E, whatever the fibres.
TEST(Guccione, EqualExponentsAreIsotropic) {
  std::mt19937 generator(31);
  const Mat3 F = random_deformation(generator);
  const Mat3 E = 0.5 * (F.transpose() * F - Mat3::Identity());
  const double W = 0.5 * 10 * (std::exp(1.5 * E.squaredNorm()) - 1);
  for (int i = 0; i < 3; ++i) {
    const Response r = respond(Guccione({10, 1.5, 1.5, 1.5, false}, random_axes(3)), F, i);
    EXPECT_NEAR(r.W, W, 1e-12 * W);
    EXPECT_LT((r.P - F * (10 * 1.5 * std::exp(1.5 * E.squaredNorm()) * E)).norm(), 1e-12 * r.P.norm());
  }
}

TEST(Guccione, StretchAlongAndAcrossTheFibreAndShear) {
  const Guccione law(kFull, identity_axes());
  const double s = 1.15, E = 0.5 * (s * s - 1);
  EXPECT_NEAR(respond(law, Vec3(s, 1, 1).asDiagonal()).P(0, 0), s * 2 * 8 * E * std::exp(8 * E * E), 1e-13);
  EXPECT_NEAR(respond(law, Vec3(1, s, 1).asDiagonal()).P(1, 1), s * 2 * 2 * E * std::exp(2 * E * E), 1e-13);
  const double g = 0.2;  // E_fs = g/2, E_ss = g²/2
  const double Q = 2 * 4 * g * g / 4 + 2 * g * g * g * g / 4;
  EXPECT_NEAR(respond(law, simple_shear(g)).W, std::exp(Q) - 1, 1e-14);
}

// The energy written out with plain numbers, in the fibre axes.
TEST(Guccione, EnergyIsTheFormula) {
  std::mt19937 generator(43);
  const FibreAxes axes = random_axes(1);
  const Mat3 R = axes.col(0).reshaped(3, 3);
  for (int i = 0; i < 5; ++i) {
    const Mat3 F = random_deformation(generator), C = R.transpose() * F.transpose() * F * R;
    const auto energy = [](const Mat3& E) {
      const double Q = 8 * E(0, 0) * E(0, 0) +
                       2 * (E(1, 1) * E(1, 1) + E(2, 2) * E(2, 2) + E(1, 2) * E(1, 2) + E(2, 1) * E(2, 1)) +
                       4 * (E(0, 1) * E(0, 1) + E(1, 0) * E(1, 0) + E(0, 2) * E(0, 2) + E(2, 0) * E(2, 0));
      return 0.5 * 2 * (std::exp(Q) - 1);
    };
    const double full = energy(0.5 * (C - Mat3::Identity()));
    const double isochoric = energy(0.5 * (std::pow(F.determinant(), -2.0 / 3) * C - Mat3::Identity()));
    EXPECT_NEAR(respond(Guccione(kFull, axes), F).W, full, 1e-12 * (1 + full));
    EXPECT_NEAR(respond(Guccione(kIsochoric, axes), F).W, isochoric, 1e-12 * (1 + isochoric));
  }
}

// Isochoric stretch: both forms have the same energy, the isochoric one without mean stress.
TEST(Guccione, FormsAgreeAtConstantVolume) {
  const Guccione full(kFull, identity_axes()), isochoric(kIsochoric, identity_axes());
  const Mat3 a = cauchy(full, uniaxial(1.2)), b = cauchy(isochoric, uniaxial(1.2));
  EXPECT_NEAR(respond(full, uniaxial(1.2)).W, respond(isochoric, uniaxial(1.2)).W, 1e-13);
  EXPECT_NEAR(a(0, 0) - a(1, 1), b(0, 0) - b(1, 1), 1e-12);
  EXPECT_NEAR(b.trace(), 0, 1e-12);
}

TEST(Guccione, ImpossibleConstantsAreRefused) {
  EXPECT_THROW(Guccione({-2, 8, 2, 4}, identity_axes()), InputError);
  EXPECT_THROW(Guccione({2, -8, 2, 4}, identity_axes()), InputError);
  EXPECT_THROW(Guccione({2, 8, std::nan(""), 4}, identity_axes()), InputError);
  EXPECT_THROW(Guccione({2, 8, 2, 4}, identity_axes(3), {1, 2}), InputError);
  EXPECT_THROW(Guccione({2, 8, 2, 4}, identity_axes(), {-1}), InputError);
}

// The energy written out with plain numbers, in tension and in compression of fibre and sheet.
TEST(HolzapfelOgden, EnergyIsTheFormula) {
  std::mt19937 generator(37);
  const HolzapfelOgdenParameters p;
  const FibreAxes axes = random_axes(1);
  const Vec3 f = axes.col(0).head<3>(), s = axes.col(0).segment<3>(3);
  for (int i = 0; i < 10; ++i) {
    const Mat3 F = random_deformation(generator), C = F.transpose() * F;
    const double I1 = std::pow(F.determinant(), -2.0 / 3) * C.trace(), I8 = f.dot(C * s);
    const auto term = [&](double a, double b, double I4) {
      return a / (2 * b) * (std::exp(b * (I4 - 1) * (I4 - 1)) - 1) / (1 + std::exp(-100 * (I4 - 1)));
    };
    const double W = p.a_kPa / (2 * p.b) * (std::exp(p.b * (I1 - 3)) - 1) +
                     term(p.a_f_kPa, p.b_f, f.dot(C * f)) + term(p.a_s_kPa, p.b_s, s.dot(C * s)) +
                     p.a_fs_kPa / (2 * p.b_fs) * (std::exp(p.b_fs * I8 * I8) - 1);
    EXPECT_NEAR(respond(HolzapfelOgden(p, axes), F).W, W, 1e-12 * W);
  }
}

// Fibre I4 − 1 = 0.21: the switch is closed to e^−21, so S_ff of the fibre term is 2 a_f (I4−1) e^{b_f
// (I4−1)²}.
TEST(HolzapfelOgden, FibresResistTensionOnly) {
  HolzapfelOgdenParameters fibre_only;
  fibre_only.a_s_kPa = fibre_only.a_fs_kPa = 0;
  const HolzapfelOgden law(fibre_only, identity_axes());
  HolzapfelOgdenParameters none = fibre_only;
  none.a_f_kPa = 0;
  const HolzapfelOgden matrix(none, identity_axes());
  const Mat3 longer = uniaxial(1.1), shorter = uniaxial(0.8);
  const double x = 0.21, fibre = 1.1 * 2 * 18.472 * x * std::exp(16.026 * x * x);
  const double stretched = respond(law, longer).P(0, 0) - respond(matrix, longer).P(0, 0);
  EXPECT_NEAR(stretched, fibre, 1e-6 * fibre);
  // I4 − 1 = −0.36: the switch leaves e^−36 of an energy below 5 kPa and multiplies its slope by k = 100.
  EXPECT_LT(std::abs(respond(law, shorter).P(0, 0) - respond(matrix, shorter).P(0, 0)), 1e-11);
}

TEST(HolzapfelOgden, ImpossibleConstantsAreRefused) {
  const auto make = [](auto change) {
    HolzapfelOgdenParameters p;
    change(p);
    return HolzapfelOgden(p, identity_axes());
  };
  EXPECT_NO_THROW(make([](auto&) {}));
  EXPECT_THROW(make([](auto& p) { p.a_kPa = 0; }), InputError);
  EXPECT_THROW(make([](auto& p) { p.b = 0; }), InputError);
  EXPECT_THROW(make([](auto& p) { p.a_f_kPa = -1; }), InputError);
  EXPECT_THROW(make([](auto& p) { p.b_fs = -1; }), InputError);
  EXPECT_THROW(make([](auto& p) { p.switch_steepness = -1; }), InputError);
}

TEST(ActiveStress, PullsAlongTheFibre) {
  const FibreAxes axes = random_axes(1);
  const Vec3 f = axes.col(0).head<3>();
  const std::vector<double> tension = {60};
  std::mt19937 generator(41);
  const Mat3 F = random_deformation(generator);
  const Response r = respond(ActiveStress(axes), F, 0, tension);
  EXPECT_LT((r.P - 60 * F * f * f.transpose()).norm(), 1e-12);
  EXPECT_NEAR(r.W, 30 * ((F * f).squaredNorm() - 1), 1e-12);
}

TEST(ActiveStress, CrossFibreFractionOfOneIsAPressureLikeStress) {
  const std::vector<double> tension = {60};
  const Response r = respond(ActiveStress(random_axes(1), 1), Mat3::Identity(), 0, tension);
  EXPECT_LT((r.P - 60 * Mat3::Identity()).norm(), 1e-12);
  EXPECT_NEAR(r.W, 0, 1e-12);
}

TEST(ActiveStress, MissingTensionAndImpossibleFractionAreErrors) {
  const ActiveStress law(identity_axes(2));
  EXPECT_THROW(respond(law, Mat3::Identity(), 0), ComputationError);
  EXPECT_THROW(respond(law, Mat3::Identity(), 1, std::vector<double>{60}), ComputationError);
  EXPECT_THROW(ActiveStress(identity_axes(), -0.1), InputError);
  EXPECT_THROW(ActiveStress(identity_axes(), 1.1), InputError);
}

}  // namespace
}  // namespace cardiac
