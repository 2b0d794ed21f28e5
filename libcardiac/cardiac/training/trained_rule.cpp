#include "cardiac/training/trained_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <cardiac/core/units.hpp>
#include <polyaffine/quadrature/cubature.hpp>

namespace cardiac {

using polyaffine::CubatureTraining;
using polyaffine::Matrix;
using polyaffine::Vector;

namespace {

constexpr int kStiffnesses = 6, kLoads = 7;  // samples of the one, and for each of them of the other
constexpr double kTension_kPa = 120;         // largest level of the active tension
constexpr double kPressure_mmHg = 160;       // largest pressure with a circulation
constexpr double kWallAccuracy = 2e-2, kCavityAccuracy = 5e-3;  // in the energy norm
constexpr double kViscousTime_ms = 40;                          // from half to the whole of a load

class Samples {
 public:
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  // One override for each segment, every third segment in the low or high range of a sick one.
  std::vector<protocol::RegionOverride> overrides(double protocol::RegionOverride::*factor, double low,
                                                  double high) {
    std::vector<protocol::RegionOverride> out;
    for (int s = 1; s <= kAhaSegments; ++s) {
      protocol::RegionOverride region;
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

class Trainer {
 public:
  Trainer(const Ventricle& ventricle)
      : wall_(ventricle.wall->table().num_points()),
        cavity_(ventricle.cavity ? ventricle.cavity->table().num_points() : 0) {
    const Vector& w = ventricle.wall->table().weights;
    const Matrix volume = w.transpose() / w.sum();
    wall_.add(volume, Vector::Ones(1), joined(volume, Vector::Ones(1)));
  }

  // What the points contribute in a state under a load.
  void add(const Ventricle& v, const Vector& c, const Vector& rate, const WallLoad& load) {
    const polyaffine::PointState state(load.tension.data(), static_cast<std::size_t>(load.tension.size()));
    const auto system = v.make_system();
    system->set_zero();
    v.wall->add_tangent({c, state}, *system);
    if (v.cavity) v.cavity->add_tangent({c}, *system, -load.pressure_kPa);
    for (const auto& spring : v.springs) spring->add_tangent({c}, *system);
    if (!system->factorise() || !system->positive_definite()) return;
    const auto& fixed = v.discretisation.fixed;

    const bool mixed = v.wall->pressure_space().has_value();
    const Vector pressure = mixed ? v.wall->pressure(c) : Vector();
    const auto terms = v.wall->point_terms({c, state, &rate, mixed ? &pressure : nullptr});
    const Vector force = terms.gradient.rowwise().sum();
    const Matrix dual = solve(*system, joined(terms.gradient, force), fixed);
    const double energy = force.dot(dual.rightCols<1>());
    wall_.add(terms.gradient, force, dual / energy);
    if (mixed) {
      const Vector lack = terms.pressure_gradient.rowwise().sum();
      Matrix dual_pressure = joined(terms.pressure_gradient, lack);
      for (auto column : dual_pressure.colwise()) column = v.wall->penalty_pressure(column);
      wall_.add(terms.pressure_gradient, lack, dual_pressure / energy);
    }
    if (!v.cavity) return;
    const auto surface = v.cavity->point_terms({c});
    const Vector gradient = surface.gradient.rowwise().sum();
    const Matrix dual_surface = solve(*system, joined(surface.gradient, gradient), fixed);
    cavity_.add(surface.gradient, gradient, dual_surface / gradient.dot(dual_surface.rightCols<1>()));
    const Matrix volume = surface.value.transpose() / surface.value.sum();
    cavity_.add(volume, Vector::Ones(1), joined(volume, Vector::Ones(1)));
  }

  TrainedRule rule() const {
    TrainedRule out{wall_.select(kWallAccuracy), {}};
    if (!cavity_.empty()) out.cavity = cavity_.select(kCavityAccuracy);
    return out;
  }

 private:
  CubatureTraining wall_, cavity_;
};

// Pressure and tension of sample j of the loads.
WallLoad sample_load(Samples& samples, int j, const Anatomy& anatomy, Protocol protocol,
                     const polyaffine::WallPoints& points) {
  WallLoad load;
  const double level = (j + samples.uniform(0, 1)) / kLoads;
  double highest = protocol.cavities ? protocol.cavities->pressure_mmHg : kPressure_mmHg;
  if (protocol.contraction) {
    highest *= std::min(1.0, 0.2 + 1.5 * level);
    protocol.regions.clear();
    if (j > 0) protocol.regions = samples.overrides(&protocol::RegionOverride::tension_factor, 0, 0.5);
    load.tension = Vector::Constant(static_cast<Eigen::Index>(points.tet.size()), level * kTension_kPa);
    const auto factors = region_factors(anatomy, protocol, points).tension;
    if (!factors.empty())
      load.tension.array() *= Eigen::Map<const Eigen::ArrayXd>(factors.data(), std::ssize(factors));
  }
  if (protocol.cavities || protocol.circulation)
    load.pressure_kPa = samples.uniform(0.1, 1) * highest * kPa_per_mmHg;
  return load;
}

// States on the way to a load: half of the steps, and the last one (which may not be the whole load).
std::vector<State> loaded_states(const Ventricle& ventricle, const WallLoad& load) {
  std::vector<State> path;
  polyaffine::LoadOptions options;
  options.first_step = 0.25;
  options.path_slack = 100;
  options.newton.tolerance = options.newton.dilatation_tolerance = 1e-5;
  options.on_step = [&](double reached, const Vector& at) { path.push_back({at, reached}); };
  Vector c = Vector::Zero(ventricle.num_coefficients());
  polyaffine::load_stepping(loaded_ventricle(ventricle, load), *ventricle.make_system(), c, options);
  if (path.size() > 2) path = {path[path.size() / 2 - 1], path.back()};
  return path;
}

}  // namespace

TrainedRule train_rule(const std::shared_ptr<const Anatomy>& anatomy, const Protocol& protocol) {
  const Discretisation all = discretise(anatomy, protocol, protocol::Method::polyaffine);
  Samples samples;
  std::optional<Trainer> trainer;
  Protocol sampled = protocol;
  for (int i = 0; i < kStiffnesses; ++i) {
    sampled.regions.clear();
    if (i > 0) sampled.regions = samples.overrides(&protocol::RegionOverride::stiffness_factor, 1, 4);
    const Ventricle ventricle = assemble_ventricle(anatomy, sampled, all);
    if (!trainer) trainer.emplace(ventricle);
    for (int j = 0; j < kLoads; ++j) {
      const WallLoad load = sample_load(samples, j, *anatomy, sampled, all.points);
      const std::vector<State> states = loaded_states(ventricle, load);
      for (const State& state : states)
        trainer->add(ventricle, state.c, (states.back().c - states.front().c) / kViscousTime_ms,
                     {state.share * load.pressure_kPa, state.share * load.tension});
    }
  }
  return trainer->rule();
}

double rule_error(const Ventricle& ventricle, const HeartState& state, double clock_ms) {
  const Ventricle& all = *ventricle.all_points;
  const Vector& c = state.c;
  const auto tension = [clock_ms](const Ventricle& v) {
    return v.contraction ? v.contraction->tension(clock_ms) : Vector();
  };
  const auto system = all.make_system();
  system->set_zero();
  Vector lack = Vector::Zero(c.size());
  const auto add = [&](const Ventricle& v, double sign) {
    const auto problem = loaded_ventricle(v, {state.pressure_kPa, tension(v)});
    for (const auto& term : problem.terms) {
      lack += sign * term.scale(1) * term.energy->evaluate({c, term.state(1)}).gradient;
      if (sign > 0) term.energy->add_tangent({c, term.state(1)}, *system, term.scale(1));
    }
  };
  add(all, 1);
  add(ventricle, -1);
  if (!system->factorise()) return std::numeric_limits<double>::infinity();
  const Vector step = solve(*system, lack, all.discretisation.fixed);
  const auto& points = all.discretisation.points;
  const polyaffine::DisplacementMap displacement(*all.discretisation.basis, points.tet, points.barycentric);
  const auto square = [&](const Vector& x) {
    const Vector at_points = displacement.apply(x).colwise().squaredNorm();
    return points.weights.dot(at_points);
  };
  return std::sqrt(square(step) / square(c));
}

}  // namespace cardiac
