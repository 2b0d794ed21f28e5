#include "cardiac/training/nested_rule.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace cardiac {

using polyaffine::CubatureTraining;
using polyaffine::Matrix;
using polyaffine::Vector;

namespace {

constexpr double kVolumeMatters = 3;  // a relative error of the cavity's volume counts so many times
constexpr double kCavityShare = 0.5;  // of the accuracy of the wall
// One in so many of the wall's points is a candidate, within bounds.
constexpr Eigen::Index kThinned = 15, kFewestCandidates = 2000, kMostCandidates = 3000;
constexpr int kCavityCandidates = 1200;

// About `wanted` of some points, each for the same share of the whole.
KeptPoints candidates_of(const polyaffine::Basis& basis, const std::vector<int>& tet,
                         const Eigen::Matrix4Xd& barycentric, const Vector& weights, int wanted) {
  if (weights.size() <= wanted) {
    std::vector<int> all(static_cast<std::size_t>(weights.size()));
    for (std::size_t q = 0; q < all.size(); ++q) all[q] = static_cast<int>(q);
    return in_blocks(basis, tet, barycentric, all, weights);
  }
  const double share = weights.sum() / wanted;
  std::vector<int> points;
  double sum = 0;
  for (Eigen::Index q = 0; q < weights.size(); ++q) {
    sum += weights[q];
    if (sum < share * (static_cast<double>(points.size()) + 0.5)) continue;
    points.push_back(static_cast<int>(q));
  }
  const Vector even =
      Vector::Constant(std::ssize(points), weights.sum() / static_cast<double>(points.size()));
  return in_blocks(basis, tet, barycentric, points, even);
}

KeptPoints chosen(const polyaffine::Basis& basis, const std::vector<int>& tet,
                  const Eigen::Matrix4Xd& barycentric, const KeptPoints& candidates,
                  const polyaffine::CompressedRule& rule) {
  std::vector<int> points;
  Vector weights(rule.weights.size());
  for (std::size_t k = 0; k < rule.points.size(); ++k) {
    points.push_back(candidates.points[rule.points[k]]);
    weights[static_cast<Eigen::Index>(k)] =
        rule.weights[static_cast<Eigen::Index>(k)] * candidates.weights[rule.points[k]];
  }
  return in_blocks(basis, tet, barycentric, points, weights);
}

}  // namespace

NestedRule candidate_rule(const Discretisation& nested) {
  NestedRule out;
  const auto& points = nested.points;
  out.wall = candidates_of(*nested.basis, points.tet, points.barycentric, points.weights,
                           static_cast<int>(std::clamp<Eigen::Index>(points.weights.size() / kThinned,
                                                                     kFewestCandidates, kMostCandidates)));
  for (const CavitySurface& cavity : nested.cavities)
    out.cavities.push_back(candidates_of(*nested.basis, cavity.points.tet, cavity.points.barycentric,
                                         cavity.points.weights, kCavityCandidates));
  return out;
}

Discretisation with_rule(const Discretisation& nested, const NestedRule& rule) {
  Discretisation out = nested;
  out.points = kept(nested.points, rule.wall);
  for (std::size_t k = 0; k < rule.cavities.size(); ++k)
    out.cavities[k].points = kept(nested.cavities[k].points, rule.cavities[k]);
  return out;
}

struct NestedRuleTraining::Measure {
  Ventricle ventricle;  // on the candidates
  Vector c, pressure;
  WallLoad load;
  std::unique_ptr<polyaffine::LinearSystem> tangent;
  double weight = 1;
  double size = 0;  // ‖c‖_G over the weight

  // root K⁻¹ of forces that add up to the last column.
  Matrix displaced(Matrix forces, const std::vector<char>& fixed, const Matrix& root) const {
    for (std::size_t i = 0; i < fixed.size(); ++i)
      if (fixed[i]) forces.row(static_cast<Eigen::Index>(i)).setZero();
    return root * tangent->solve(forces) / size;
  }
};

NestedRuleTraining::NestedRuleTraining(FullOrder& full, const HeartModes& modes, const NestedSpace& space)
    : full_(full),
      modes_(modes),
      space_(space),
      nested_(nested_discretisation(*full.anatomy(), full.scene(), space, full.discretisation())),
      basis_(dynamic_cast<const polyaffine::NestedBasis&>(*nested_.basis)),
      chosen_from_(candidate_rule(nested_)),
      candidates_(with_rule(nested_, chosen_from_)),
      metric_(modes.metric(space)),
      root_(metric_.llt().matrixU()),
      wall_(std::ssize(chosen_from_.wall.points)) {
  for (std::size_t k = 0; k < nested_.cavities.size(); ++k) {
    cavities_.emplace_back(std::ssize(chosen_from_.cavities[k].points));
    whole_cavities_.push_back(cavity_of(basis_, nested_.cavities[k]));
  }
}

bool NestedRuleTraining::add(const FullState& state, double weight) {
  Measure at;
  at.ventricle = assemble_ventricle(full_.anatomy(), with_regions(full_.scene(), state.load), candidates_);
  at.c = modes_.nearest(space_, metric_, state.u);
  at.weight = weight;
  at.load = wall_load(at.ventricle, state.load);
  at.size = (root_ * at.c).norm() / weight;
  const polyaffine::FieldEnergy& wall = *at.ventricle.wall;
  const bool mixed = wall.pressure_space().has_value();
  if (mixed) at.pressure = modes_.nearest_pressure(space_, state.pressure);
  at.tangent = polyaffine::dense_system(static_cast<int>(at.c.size()), nested_.fixed);
  at.tangent->set_zero();
  wall.add_tangent({at.c, at.load.state(), nullptr, mixed ? &at.pressure : nullptr}, *at.tangent);
  for (std::size_t k = 0; k < at.ventricle.cavities.size(); ++k)
    at.ventricle.cavities[k].volume->add_tangent({at.c}, *at.tangent,
                                                 -at.load.pressures_kPa[static_cast<Eigen::Index>(k)]);
  polyaffine::System held = wall_system(at.ventricle);
  polyaffine::Tangent springs{held.layout, *at.tangent, {}, {}, {}};
  for (const auto& support : at.ventricle.supports) support->add_tangent({1, at.c}, 0, springs);
  if (!(at.size > 0) || !at.tangent->factorise() || !at.tangent->positive_definite()) return false;
  add_wall(at, state);
  for (std::size_t k = 0; k < cavities_.size(); ++k) add_cavity(at, k);
  states_ += weight * weight;
  return true;
}

void NestedRuleTraining::add_wall(const Measure& at, const FullState& state) {
  const polyaffine::FieldEnergy& wall = *at.ventricle.wall;
  const bool mixed = wall.pressure_space().has_value();
  const Ventricle full = full_.ventricle(state.load);
  const WallLoad full_load = wall_load(full, state.load);
  const Vector element_pressure = mixed ? Vector(space_.pressures.transpose() * at.pressure) : Vector();
  const auto whole = full.wall->evaluate(
      {basis_.nodal(at.c), full_load.state(), nullptr, mixed ? &element_pressure : nullptr});
  const auto terms = wall.point_terms({at.c, at.load.state(), nullptr, mixed ? &at.pressure : nullptr});
  const Eigen::Index n = terms.gradient.cols();
  Matrix forces(at.c.size(), n + 1);
  forces << terms.gradient, basis_.transpose(whole.gradient);
  if (mixed) {
    // g − M p/κ of each candidate and of all points; what the pressure's own mass adds is the same for both.
    Matrix changes(space_.pressures.rows(), n + 1);
    changes << terms.pressure_gradient, space_.pressures * whole.pressure_gradient;
    const auto& space = *wall.pressure_space();
    for (Eigen::Index q = 0; q < n; ++q) {
      const auto values = space_.pressures.col(candidates_.points.tet[static_cast<std::size_t>(q)]);
      changes.col(q) += candidates_.points.weights[q] / space.bulk_modulus * values.dot(at.pressure) * values;
    }
    changes.col(n) += nested_.pressure_mass * at.pressure / space.bulk_modulus;
    const Matrix penalty = space.bulk_modulus * nested_.pressure_mass.llt().solve(changes);
    forces += wall.volume_gradient(at.c).transpose_times(penalty);
  }
  const Matrix moved = at.displaced(std::move(forces), nested_.fixed, root_);
  wall_.add(moved.leftCols(n), moved.col(n), moved);
}

void NestedRuleTraining::add_cavity(const Measure& at, std::size_t cavity) {
  const auto terms = at.ventricle.cavities[cavity].volume->point_terms({at.c});
  const auto all = whole_cavities_[cavity].volume->evaluate({at.c});
  const double pressure = at.load.pressures_kPa[static_cast<Eigen::Index>(cavity)];
  const Eigen::Index n = terms.value.size();
  Matrix forces(at.c.size(), n + 1);
  forces << pressure * terms.gradient, pressure * all.gradient;
  const Matrix moved = at.displaced(std::move(forces), nested_.fixed, root_);
  const double matters = kVolumeMatters * at.weight;
  Matrix rows(moved.rows() + 1, n + 1);
  rows.topRows(moved.rows()) = moved;
  rows.bottomRows(1) << matters / all.value * terms.value.transpose(), matters;
  cavities_[cavity].add(rows.leftCols(n), rows.col(n), rows);
}

NestedRule NestedRuleTraining::select(double accuracy) const {
  const auto share = [&](const CubatureTraining& training, double wanted) {
    return wanted * std::sqrt(states_) / training.norm();
  };
  NestedRule out;
  const auto& points = nested_.points;
  out.wall =
      chosen(basis_, points.tet, points.barycentric, chosen_from_.wall, wall_.select(share(wall_, accuracy)));
  for (std::size_t k = 0; k < cavities_.size(); ++k) {
    const auto& surface = nested_.cavities[k].points;
    out.cavities.push_back(chosen(basis_, surface.tet, surface.barycentric, chosen_from_.cavities[k],
                                  cavities_[k].select(share(cavities_[k], kCavityShare * accuracy))));
  }
  return out;
}

}  // namespace cardiac
