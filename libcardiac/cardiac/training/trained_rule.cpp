#include "cardiac/training/trained_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <cardiac/core/units.hpp>
#include <polyaffine/quadrature/cubature.hpp>
#include <polyaffine/solve/load_stepping.hpp>

namespace cardiac {

using polyaffine::CubatureTraining;
using polyaffine::Matrix;
using polyaffine::Vector;

namespace {

constexpr int kStiffnesses = 6, kLoads = 7;           // samples of the one, and for each of them of the other
constexpr double kTension_kPa = 120;                  // largest level of the active tension
constexpr double kPressure_kPa = 160 * kPa_per_mmHg;  // largest pressure with a circulation
constexpr double kWallAccuracy = 2e-2, kCavityAccuracy = 5e-3;  // in the energy norm
constexpr double kViscousTime_ms = 40;                          // from half to the whole of a load

class Samples {
 public:
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  // One override for each segment, every third segment in the low or high range of a sick one.
  std::vector<scene::RegionOverride> overrides(double scene::RegionOverride::*factor, double low,
                                               double high) {
    std::vector<scene::RegionOverride> out;
    for (int s = 1; s <= kAhaSegments; ++s) {
      scene::RegionOverride region;
      region.segments = {s};
      region.*factor = uniform(0, 3) < 1 ? uniform(low, high) : uniform(0.8, 1.2);
      out.push_back(region);
    }
    return out;
  }

 private:
  std::mt19937_64 random_{1};
};

struct State {
  Vector c;
  double share = 0;  // of the load
};

Matrix solve(const polyaffine::LinearSystem& system, const Matrix& rhs, const std::vector<char>& fixed) {
  Matrix free = rhs;
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (fixed[i]) free.row(static_cast<Eigen::Index>(i)).setZero();
  return system.solve(free);
}

Matrix joined(const Matrix& A, const Vector& t) {
  Matrix out(A.rows(), A.cols() + 1);
  out << A, t;
  return out;
}

// The integrals that a rule has to keep, and what a point contributes to each. With K the tangent in a state
// and ‖r‖ = (rᵀK⁻¹r)^½, the energy norm, a sum of forces f = Σ f_q is kept to a share of ‖f‖.
class Trainer {
 public:
  explicit Trainer(const Ventricle& ventricle)
      : wall_(ventricle.wall->table().num_points()),
        cavity_(ventricle.cavities.empty() ? 0 : cavity(ventricle).table().num_points()) {
    const Vector& w = ventricle.wall->table().weights;
    keep_sum(w.transpose(), wall_);
  }

  // What the points contribute in a state under a load. A state that is not stable says nothing.
  void add(const Ventricle& v, const Vector& c, const Vector& rate, const WallLoad& load) {
    const polyaffine::System system = loaded_ventricle(v, load);
    const auto linear = system.make_linear();
    polyaffine::Linearised tangent(system, *linear);
    if (!tangent.factorise({1, c}, 0) || !tangent.positive_definite()) return;
    const auto dual = [&](const Matrix& forces) {
      return solve(*linear, joined(forces, forces.rowwise().sum()), v.discretisation.fixed);
    };

    const polyaffine::PointState state = load.state();
    const bool mixed = v.wall->pressure_space().has_value();
    const Vector pressure = mixed ? v.wall->pressure(c) : Vector();
    const auto terms = v.wall->point_terms({c, state, &rate, mixed ? &pressure : nullptr});
    const double energy = keep_forces(terms.gradient, dual(terms.gradient), wall_);
    if (mixed) keep_volumes(*v.wall, terms.pressure_gradient, energy);
    if (v.cavities.empty()) return;
    const auto surface = cavity(v).point_terms({c});
    keep_forces(surface.gradient, dual(surface.gradient), cavity_);
    keep_sum(surface.value.transpose(), cavity_);
  }

  TrainedRule rule() const {
    TrainedRule out{wall_.select(kWallAccuracy), {}};
    if (!cavity_.empty()) out.cavity = cavity_.select(kCavityAccuracy);
    return out;
  }

 private:
  static const polyaffine::FieldEnergy& cavity(const Ventricle& v) { return *v.cavities.front().volume; }

  // One number, the sum of a row, relative to itself.
  static void keep_sum(const Matrix& row, CubatureTraining& training) {
    const Matrix share = row / row.sum();
    training.add(share, Vector::Ones(1), joined(share, Vector::Ones(1)));
  }

  // The sum f of forces, a column a point, with K⁻¹ of them and of f. Returns ‖f‖².
  static double keep_forces(const Matrix& forces, const Matrix& dual, CubatureTraining& training) {
    const Vector f = forces.rowwise().sum();
    const double energy = f.dot(dual.rightCols<1>());
    training.add(forces, f, dual / energy);
    return energy;
  }

  // The changes of volume g that the pressures see, in the energy of the forces: ‖g‖² = κ gᵀM⁻¹g.
  void keep_volumes(const polyaffine::FieldEnergy& wall, const Matrix& changes, double energy) {
    const Vector g = changes.rowwise().sum();
    Matrix dual = joined(changes, g);
    for (auto column : dual.colwise()) column = wall.penalty_pressure(column);
    wall_.add(changes, g, dual / energy);
  }

  CubatureTraining wall_, cavity_;
};

// Pressure and tension of sample j of the loads.
WallLoad sample_load(Samples& samples, int j, const Anatomy& anatomy, Scene scene,
                     const polyaffine::WallPoints& points) {
  WallLoad load;
  const double level = (j + samples.uniform(0, 1)) / kLoads;
  double highest = scene.cavities && !scene.cavities->curves ? scene.cavities->pressure_kPa : kPressure_kPa;
  if (scene.contraction) {
    highest *= std::min(1.0, 0.2 + 1.5 * level);
    scene.regions.clear();
    if (j > 0) scene.regions = samples.overrides(&scene::RegionOverride::tension_factor, 0, 0.5);
    load.tension = Vector::Constant(static_cast<Eigen::Index>(points.tet.size()), level * kTension_kPa);
    const auto factors = region_factors(anatomy, scene, points).tension;
    if (!factors.empty())
      load.tension.array() *= Eigen::Map<const Eigen::ArrayXd>(factors.data(), std::ssize(factors));
  }
  if (scene.cavities || scene.circulation)
    load.pressures_kPa = Vector::Constant(1, samples.uniform(0.1, 1) * highest);
  return load;
}

// States on the way to a load: half of the steps, and the last one (which may not be the whole load).
std::vector<State> loaded_states(const Ventricle& ventricle, const WallLoad& load) {
  std::vector<State> path;
  polyaffine::LoadOptions options;
  options.first_step = 0.25;
  options.path_slack = 100;
  options.newton.tolerance = options.newton.defect_tolerance = 1e-5;
  options.on_step = [&](double reached, const Vector& at) { path.push_back({at, reached}); };
  Vector c = Vector::Zero(ventricle.num_coefficients());
  const polyaffine::System system = loaded_ventricle(ventricle, load);
  polyaffine::load_stepping(system, *system.make_linear(), c, options);
  if (path.size() > 2) path = {path[path.size() / 2 - 1], path.back()};
  return path;
}

}  // namespace

TrainedRule train_rule(const std::shared_ptr<const Anatomy>& anatomy, const Scene& scene) {
  const Discretisation all = discretise(anatomy, scene, scene::Method::polyaffine);
  Samples samples;
  std::optional<Trainer> trainer;
  Scene sampled = scene;
  for (int i = 0; i < kStiffnesses; ++i) {
    sampled.regions.clear();
    if (i > 0) sampled.regions = samples.overrides(&scene::RegionOverride::stiffness_factor, 1, 4);
    const Ventricle ventricle = assemble_ventricle(anatomy, sampled, all);
    if (!trainer) trainer.emplace(ventricle);
    for (int j = 0; j < kLoads; ++j) {
      const WallLoad load = sample_load(samples, j, *anatomy, sampled, all.points);
      const std::vector<State> states = loaded_states(ventricle, load);
      for (const State& state : states)
        trainer->add(ventricle, state.c, (states.back().c - states.front().c) / kViscousTime_ms,
                     {state.share * load.pressures_kPa, state.share * load.tension});
    }
  }
  return trainer->rule();
}

double rule_error(const Ventricle& ventricle, const HeartState& state, double clock_ms) {
  const Ventricle& all = *ventricle.all_points;
  const Vector& c = state.c;
  const auto system_of = [&](const Ventricle& v) {
    return loaded_ventricle(
        v, {state.pressures_kPa, v.contraction ? v.contraction->tension(clock_ms) : Vector()});
  };
  const polyaffine::System of_all = system_of(all), of_rule = system_of(ventricle);
  const polyaffine::At at{1, c};
  const auto linear = of_all.make_linear();
  if (!polyaffine::Linearised(of_all, *linear).factorise(at, 0))
    return std::numeric_limits<double>::infinity();
  const Vector lack = of_all.residual(at).values - of_rule.residual(at).values;
  const Vector step = solve(*linear, lack, all.discretisation.fixed);
  const auto& points = all.discretisation.points;
  const polyaffine::DisplacementMap displacement(*all.discretisation.basis, points.tet, points.barycentric);
  const auto square = [&](const Vector& x) {
    const Vector at_points = displacement.apply(x).colwise().squaredNorm();
    return points.weights.dot(at_points);
  };
  return std::sqrt(square(step) / square(c));
}

}  // namespace cardiac
