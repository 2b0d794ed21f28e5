#include "cardiac/model/supports.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cardiac/run/build_ventricle.hpp>
#include <polyaffine/check/derivative_check.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/solve/load_stepping.hpp>

#include "support/heart_run.hpp"
#include "support/random_vector.hpp"

namespace cardiac {
namespace {

using polyaffine::Mat3;
using polyaffine::Points;
using polyaffine::Vec3;
using polyaffine::Vector;
using ::testing::HasSubstr;

using Settings = std::vector<std::string>;

// A passive ellipsoid whose base lies at z = 5 mm, on a mesh and by functions that the settings choose.
struct Held {
  Protocol protocol;
  Ventricle ventricle;

  explicit Held(Settings settings)
      : protocol(
            testing::shipped_protocol("passive_inflation", testing::on_land_ellipsoid(std::move(settings)))) {
    static const auto anatomy = testing::read_anatomy(protocol);
    ventricle = build_ventricle(anatomy, protocol, protocol.reduction.method);
  }

  // The coefficients of u = A (X − C) + t, C the centre of the base.
  Vector affine(const Mat3& A, const Vec3& t) const {
    const Discretisation& d = ventricle.discretisation;
    Vector c = Vector::Zero(ventricle.num_coefficients());
    const Vec3 C = ventricle.anatomy->coordinates->base_centre();
    if (const auto* elements = dynamic_cast<const polyaffine::LagrangeBasis*>(d.basis.get())) {
      c.reshaped(3, elements->num_functions()) = ((A * (elements->nodes().colwise() - C)).colwise() + t);
      return c;
    }
    const int frames = static_cast<int>(d.frame_basis->frames().size()), global = frames - 1;
    const auto set = [&](int frame, const polyaffine::Monomial& m, const Vec3& value) {
      c.segment<3>(3 * d.frame_basis->function(frame, m)) = value;
    };
    set(global, {1, 0, 0}, d.layout.length * A.col(0));
    set(global, {0, 1, 0}, d.layout.length * A.col(1));
    set(global, {0, 0, 1}, d.layout.length * A.col(2));
    if (d.frame_basis->function(global, {0, 0, 0}) >= 0)
      set(global, {0, 0, 0}, t);
    else
      for (int i = 0; i < global; ++i) set(i, {0, 0, 0}, t);
    return c;
  }

  double wall_energy(const Vector& c) const { return ventricle.wall->evaluate({c}).value; }

  Vector inflated(double pressure_kPa) const {
    const polyaffine::System system = loaded_ventricle(ventricle, {Vector::Constant(1, pressure_kPa), {}});
    Vector c = Vector::Zero(ventricle.num_coefficients());
    EXPECT_TRUE(polyaffine::load_stepping(system, *system.make_linear(), c).converged());
    return c;
  }
  // Displacement at points of the base, 3 × points.
  Points of_base(const Vector& c) const {
    const Anatomy& a = *ventricle.anatomy;
    const auto points = a.coordinates->space().surface_points(a.mesh, {a.labels.base}, 2);
    return polyaffine::DisplacementMap(*ventricle.discretisation.basis, points.tet, points.barycentric)
        .apply(c);
  }
};

const Settings kElastic{"boundary.base=elastic"}, kSliding{"boundary.base=sliding"};

Settings with(Settings settings, const Settings& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

const std::vector<Settings>& models() {
  static const std::vector<Settings> list{{"reduction.method=fem", "reduction.element_order=1"},
                                          {"reduction.method=fem"},
                                          {"reduction.axes=cartesian"},
                                          {"reduction.axes=heart"},
                                          {"reduction.axes=cartesian", "reduction.preset=accurate"}};
  return list;
}

class MovingBase : public ::testing::TestWithParam<int> {
 protected:
  const Settings& model() const { return models()[static_cast<std::size_t>(GetParam())]; }
};

// Small and large rotations about an oblique axis.
TEST_P(MovingBase, RigidMotionsCostNothingAndKeepTheVolume) {
  const Held held(with(model(), kElastic));
  const double rest = held.ventricle.cavity_volume(held.affine(Mat3::Zero(), Vec3::Zero()));
  const double scale = held.wall_energy(held.affine(Vec3(0.1, 0, 0).asDiagonal(), Vec3::Zero()));
  for (const double angle : {0.0, 1e-3, 0.3, 2.0}) {
    const Mat3 R = Eigen::AngleAxisd(angle, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
    const Vector c = held.affine(R - Mat3::Identity(), Vec3(3, -7, 11));
    EXPECT_LT(std::abs(held.wall_energy(c)), 1e-12 * scale) << angle;
    EXPECT_NEAR(held.ventricle.cavity_volume(c), rest, 1e-12 * rest) << angle;
    const auto u = held.of_base(c);
    const auto& a = *held.ventricle.anatomy;
    const auto points = a.coordinates->space().surface_points(a.mesh, {a.labels.base}, 2);
    if (model().size() > 1 && model()[1] == "reduction.element_order=1") continue;  // straight elements
    const Points expected =
        ((R - Mat3::Identity()) * (points.X.colwise() - a.coordinates->base_centre())).colwise() +
        Vec3(3, -7, 11);
    EXPECT_LT((u - expected).cwiseAbs().maxCoeff(), 1e-12 * 40) << angle;
  }
}

// By the divergence theorem a closed surface under an affine map encloses det A times as much.
TEST_P(MovingBase, VolumeFollowsAffineMaps) {
  const Held held(with(model(), kElastic));
  const double rest = held.ventricle.cavity_volume(Vector::Zero(held.ventricle.num_coefficients()));
  const Mat3 A{{1.2, 0.1, -0.3}, {0.05, 0.9, 0.2}, {-0.1, 0.15, 1.1}};
  const Vector c = held.affine(A - Mat3::Identity(), Vec3(1, 2, 3));
  EXPECT_NEAR(held.ventricle.cavity_volume(c), A.determinant() * rest, 1e-11 * rest);
}

TEST_P(MovingBase, VolumeAtRestIsThatOfAClampedBase) {
  const Held moving(with(model(), kElastic)), clamped(model());
  const auto volume = [](const Held& held) {
    return held.ventricle.cavity_volume(Vector::Zero(held.ventricle.num_coefficients()));
  };
  EXPECT_NEAR(volume(moving), volume(clamped), 1e-12 * volume(clamped));
}

TEST_P(MovingBase, VolumeHasItsDerivatives) {
  const Held held(with(model(), kElastic));
  const polyaffine::FieldEnergy& volume = *held.ventricle.cavities[0].volume;
  const int n = held.ventricle.num_coefficients();
  const Vector c = 0.1 * polyaffine::testing::random_vector(n, 1, 3),
               v = polyaffine::testing::random_vector(n, 1, 5);
  const auto at = [&](double s) { return volume.evaluate({c + s * v}); };
  const double h = 1e-5;
  const double slope = (at(h).value - at(-h).value) / (2 * h);
  EXPECT_NEAR(at(0).gradient.dot(v), slope, 1e-6 * std::abs(slope));
  EXPECT_GT(std::abs(slope), 1);
}

// Pressure in a closed cavity has neither a resultant nor a moment, so that it moves no heart as a whole.
TEST_P(MovingBase, PressureOfAClosedCavityIsBalanced) {
  const Held held(with(model(), kElastic));
  const Vector c = 0.05 * polyaffine::testing::random_vector(held.ventricle.num_coefficients(), 1, 4);
  const Vector force = held.ventricle.cavities[0].volume->evaluate({c}).gradient;
  for (int k = 0; k < 3; ++k) {
    const Vector t = held.affine(Mat3::Zero(), Vec3::Unit(k));
    EXPECT_LT(std::abs(force.dot(t)), 1e-11 * force.norm() * t.norm()) << k;
  }
}

TEST_P(MovingBase, SlidesInItsPlaneAlone) {
  const Held held(with(model(), kSliding));
  const Vector c = held.inflated(0.1);
  const Points u = held.of_base(c);
  EXPECT_LT(u.row(2).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(u.topRows<2>().cwiseAbs().maxCoeff(), 0.02);
  // The ring as a whole stays.
  const auto& ring = *held.ventricle.discretisation.ring;
  const Points rim = polyaffine::DisplacementMap(*held.ventricle.discretisation.basis, ring.rim.centre.tet,
                                                 ring.rim.centre.barycentric)
                         .apply(c);
  EXPECT_LT((rim * ring.rim.centre.weights).norm(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Models, MovingBase, ::testing::Range(0, static_cast<int>(models().size())));

TEST(Supports, ElasticBaseHoldsNormalAndInPlaneApart) {
  const Held held({"reduction.method=fem", "boundary.base=elastic",
                   "boundary.base_normal_stiffness_kPa_per_mm=3",
                   "boundary.base_inplane_stiffness_kPa_per_mm=0.5"});
  const auto& points = held.ventricle.discretisation.base_points;
  double area = 0;
  for (Eigen::Index q = 0; q < points.X.cols(); ++q)
    area += points.weights[q] * Vec3(points.X_xi.col(q)).cross(Vec3(points.X_eta.col(q))).norm();
  const Vec3 t(0.2, -0.1, 0.4);
  const Vector c = held.affine(Mat3::Zero(), t);
  polyaffine::Residual found;
  found.values = Vector::Zero(c.size());
  for (const auto& term : held.ventricle.supports) term->add_residual({0, c}, found);
  EXPECT_NEAR(found.potential, 0.5 * area * (3 * t.z() * t.z() + 0.5 * t.head<2>().squaredNorm()),
              1e-9 * area);
}

TEST(Supports, WeightsFollowHeightAndLaw) {
  scene::Boundary b;
  EXPECT_EQ(height_weight(b, 0.3), 1);
  b.epicardial_base_weight = 0.2;
  EXPECT_NEAR(height_weight(b, 0.25), 1 - 0.8 * 0.25, 1e-15);
  EXPECT_EQ(height_weight(b, -1), 1);
  EXPECT_NEAR(height_weight(b, 2), 0.2, 1e-15);
  b.epicardial_weight_law = scene::HeightLaw::smooth;
  EXPECT_NEAR(height_weight(b, 0.25), 1 - 0.8 * (3 * 0.0625 - 2 * 0.015625), 1e-15);
}

// An array of the mesh multiplies the springs: of a uniform displacement along z the energy is that of Σ w.
TEST(Supports, ArrayOfTheMeshWeighsTheSprings) {
  const Held plain({"boundary.epicardial_stiffness_kPa_per_mm=2", "boundary.epicardial_directions=all"});
  Anatomy anatomy = *plain.ventricle.anatomy;
  anatomy.epicardial_weight = Vector::Constant(anatomy.mesh.num_points(), 0.25);
  const auto energy = [&](const Anatomy& of) {
    const Discretisation& d = plain.ventricle.discretisation;
    const Vector c = polyaffine::testing::random_vector(plain.ventricle.num_coefficients(), 1, 2);
    polyaffine::Residual found;
    found.values = Vector::Zero(c.size());
    for (const auto& term : supports(of, plain.protocol, d)) term->add_residual({0, c}, found);
    return found.potential;
  };
  EXPECT_NEAR(energy(anatomy), 0.25 * energy(*plain.ventricle.anatomy),
              1e-12 * energy(*plain.ventricle.anatomy));
  EXPECT_GT(energy(anatomy), 0);
}

std::string refusal(const Settings& settings) {
  try {
    const Held held(settings);
  } catch (const polyaffine::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Supports, HeartThatNothingHoldsIsRefused) {
  EXPECT_THAT(refusal({"boundary.base=elastic", "boundary.base_normal_stiffness_kPa_per_mm=0",
                       "boundary.base_inplane_stiffness_kPa_per_mm=0"}),
              HasSubstr("boundary.base_normal_stiffness_kPa_per_mm: nothing holds the heart"));
  // A flat base held along its normal alone may slide and turn in its plane.
  EXPECT_THAT(refusal({"boundary.base=elastic", "boundary.base_inplane_stiffness_kPa_per_mm=0"}),
              HasSubstr("boundary.base: found elastic, but no spring resists"));
  // The epicardium of an ellipsoid does not feel a rotation about its axis.
  const Settings pericardium{"boundary.base=elastic", "boundary.base_normal_stiffness_kPa_per_mm=0",
                             "boundary.base_inplane_stiffness_kPa_per_mm=0",
                             "boundary.epicardial_stiffness_kPa_per_mm=1"};
  EXPECT_THAT(refusal(pericardium), HasSubstr("a rotation about"));
  EXPECT_EQ(refusal(with(pericardium, {"boundary.epicardial_directions=all"})), "");
  EXPECT_EQ(refusal(kSliding), "");
}

TEST(Supports, StiffSpringsAreAClampedBase) {
  const double pressure = 0.1;
  const Held clamped({"reduction.method=fem"});
  const Held stiff({"reduction.method=fem", "boundary.base=elastic",
                    "boundary.base_normal_stiffness_kPa_per_mm=1e5",
                    "boundary.base_inplane_stiffness_kPa_per_mm=1e5"});
  const double expected = clamped.ventricle.cavity_volume(clamped.inflated(pressure));
  EXPECT_NEAR(stiff.ventricle.cavity_volume(stiff.inflated(pressure)), expected, 1e-4 * expected);
}

// The reduced model of a moving base against full order on the same mesh, under the pressure of the example.
TEST(Supports, ReducedModelFollowsFullOrder) {
  for (const Settings& base : {kElastic, kSliding}) {
    const Held full(with(base, {"reduction.method=fem"})), reduced(with(base, {"reduction.axes=cartesian"}));
    const double rest = full.ventricle.cavity_volume(Vector::Zero(full.ventricle.num_coefficients()));
    const double expected = full.ventricle.cavity_volume(full.inflated(0.3)) - rest;
    EXPECT_NEAR(reduced.ventricle.cavity_volume(reduced.inflated(0.3)) - rest, expected, 0.15 * expected)
        << base[0];
    EXPECT_GT(expected, 0.05 * rest);
  }
}

}  // namespace
}  // namespace cardiac
