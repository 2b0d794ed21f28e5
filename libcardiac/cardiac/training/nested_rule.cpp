#include "cardiac/training/nested_rule.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdlib>

namespace cardiac {

using polyaffine::CubatureTraining;
using polyaffine::Matrix;
using polyaffine::PointState;
using polyaffine::Vector;

namespace {

constexpr double kVolumeMatters = 3;   // a relative error of the cavity's volume counts so many times
constexpr double kCavityShare = 0.5;   // of the accuracy of the wall
const double kRidge = getenv("RIDGE") ? atof(getenv("RIDGE")) : 1e-4;        // of the correction, over the largest square
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

PointState state_of(const Vector& tension) {
  return {tension.data(), static_cast<std::size_t>(tension.size())};
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

struct NestedRuleTraining::Measure {
  Ventricle ventricle;  // on the candidates
  Vector c, pressure;
  WallLoad load;
  std::unique_ptr<polyaffine::LinearSystem> tangent;
  double size = 0;  // ‖c‖_G

  // root K⁻¹ of forces that add up to the last column.
  Matrix displaced(Matrix forces, const std::vector<char>& fixed, const Matrix& root) const {
    for (std::size_t i = 0; i < fixed.size(); ++i)
      if (fixed[i]) forces.row(static_cast<Eigen::Index>(i)).setZero();
    return root * tangent->solve(forces) / size;
  }
};

NestedRuleTraining::NestedRuleTraining(FullOrder& full, const HeartModes& modes, const NestedSpace& space,
                                       int candidates)
    : full_(full),
      modes_(modes),
      space_(space),
      nested_(nested_discretisation(*full.anatomy(), full.scene(), space, full.discretisation())),
      candidates_(nested_),
      basis_(dynamic_cast<const polyaffine::NestedBasis&>(*nested_.basis)),
      metric_(modes.metric(space)),
      root_(metric_.llt().matrixU()),
      wall_(0) {
  const auto& points = nested_.points;
  wall_points_ = candidates_of(basis_, points.tet, points.barycentric, points.weights, candidates);
  candidates_.points = kept(points, wall_points_);
  wall_ = CubatureTraining(std::ssize(wall_points_.points));
  for (std::size_t k = 0; k < nested_.cavities.size(); ++k) {
    const auto& surface = nested_.cavities[k].points;
    cavity_points_.push_back(
        candidates_of(basis_, surface.tet, surface.barycentric, surface.weights, kCavityCandidates));
    candidates_.cavities[k].points = kept(surface, cavity_points_.back());
    cavities_.emplace_back(std::ssize(cavity_points_.back().points));
  }
}

bool NestedRuleTraining::add(const FullState& state) {
  Measure at;
  at.ventricle =
      assemble_ventricle(full_.anatomy(), with_regions(full_.scene(), state.load), candidates_);
  at.c = modes_.nearest(space_, metric_, state.u);
  at.load = wall_load(at.ventricle, state.load);
  at.size = (root_ * at.c).norm();
  const polyaffine::FieldEnergy& wall = *at.ventricle.wall;
  const bool mixed = wall.pressure_space().has_value();
  if (mixed) at.pressure = modes_.nearest_pressure(space_, state.pressure);
  at.tangent = polyaffine::dense_system(static_cast<int>(at.c.size()), nested_.fixed);
  at.tangent->set_zero();
  wall.add_tangent({at.c, state_of(at.load.tension), nullptr, mixed ? &at.pressure : nullptr}, *at.tangent);
  for (std::size_t k = 0; k < at.ventricle.cavities.size(); ++k)
    at.ventricle.cavities[k].volume->add_tangent({at.c}, *at.tangent,
                                                 -at.load.pressures_kPa[static_cast<Eigen::Index>(k)]);
  if (!(at.size > 0) || !at.tangent->factorise()) return false;
  add_wall(at, state);
  for (std::size_t k = 0; k < cavities_.size(); ++k) add_cavity(at, k);
  return true;
}

void NestedRuleTraining::add_wall(const Measure& at, const FullState& state) {
  const polyaffine::FieldEnergy& wall = *at.ventricle.wall;
  const bool mixed = wall.pressure_space().has_value();
  const Ventricle full = full_.ventricle(state.load);
  const WallLoad full_load = wall_load(full, state.load);
  const Vector element_pressure = mixed ? Vector(space_.pressures.transpose() * at.pressure) : Vector();
  const auto whole = full.wall->evaluate({basis_.nodal(at.c), state_of(full_load.tension), nullptr,
                                          mixed ? &element_pressure : nullptr});
  const auto terms = wall.point_terms(
      {at.c, state_of(at.load.tension), nullptr, mixed ? &at.pressure : nullptr});
  const Eigen::Index n = terms.gradient.cols();
  Matrix forces(at.c.size(), n + 1);
  forces << terms.gradient, basis_.transpose(whole.gradient);
  Target target{state.load, at.c, at.pressure, forces.col(n), {}};
  if (mixed) target.change = space_.pressures * whole.pressure_gradient;
  if (mixed) {
    // g − M p/κ of each candidate and of all points; what the pressure's own mass adds is the same for both.
    Matrix changes(space_.pressures.rows(), n + 1);
    changes << terms.pressure_gradient, target.change;
    const auto& space = *wall.pressure_space();
    for (Eigen::Index q = 0; q < n; ++q) {
      const auto values = space_.pressures.col(candidates_.points.tet[static_cast<std::size_t>(q)]);
      changes.col(q) += candidates_.points.weights[q] / space.bulk_modulus * values.dot(at.pressure) * values;
    }
    changes.col(n) += nested_.pressure_mass * at.pressure / space.bulk_modulus;
    const Matrix penalty = space.bulk_modulus * nested_.pressure_mass.llt().solve(changes);
    for (Eigen::Index b = 0; b < changes.rows(); ++b)
      forces.noalias() += wall.pressure_force(at.c, Vector::Unit(changes.rows(), b)) * penalty.row(b);
  }
  const Matrix moved = at.displaced(std::move(forces), nested_.fixed, root_);
  wall_.add(moved.leftCols(n), moved.col(n), moved);
  targets_.push_back(std::move(target));
}

void NestedRuleTraining::add_cavity(const Measure& at, std::size_t cavity) {
  const auto terms = at.ventricle.cavities[cavity].volume->point_terms({at.c});
  const Cavity whole = cavity_of(basis_, nested_.cavities[cavity]);
  const auto all = whole.volume->evaluate({at.c});
  const double pressure = at.load.pressures_kPa[static_cast<Eigen::Index>(cavity)];
  const Eigen::Index n = terms.value.size();
  Matrix forces(at.c.size(), n + 1);
  forces << pressure * terms.gradient, pressure * all.gradient;
  const Matrix moved = at.displaced(std::move(forces), nested_.fixed, root_);
  Matrix rows(moved.rows() + 1, n + 1);
  rows.topRows(moved.rows()) = moved;
  rows.bottomRows(1) << kVolumeMatters / all.value * terms.value.transpose(), kVolumeMatters;
  cavities_[cavity].add(rows.leftCols(n), rows.col(n), rows);
}

NestedRule NestedRuleTraining::select(double accuracy) const {
  const auto share = [&](const CubatureTraining& training, double wanted) {
    return wanted * std::sqrt(static_cast<double>(targets_.size())) / training.norm();
  };
  NestedRule out;
  const auto& points = nested_.points;
  out.wall = chosen(basis_, points.tet, points.barycentric, wall_points_, wall_.select(share(wall_, accuracy)));
  for (std::size_t k = 0; k < cavities_.size(); ++k) {
    const auto& surface = nested_.cavities[k].points;
    out.cavities.push_back(chosen(basis_, surface.tet, surface.barycentric, cavity_points_[k],
                                  cavities_[k].select(share(cavities_[k], kCavityShare * accuracy))));
  }
  if (!std::getenv("NOCORR")) out.correction = correction_of(with(out));
  return out;
}

Discretisation NestedRuleTraining::with(const NestedRule& rule) const {
  Discretisation out = nested_;
  out.points = kept(nested_.points, rule.wall);
  for (std::size_t k = 0; k < rule.cavities.size(); ++k)
    out.cavities[k].points = kept(nested_.cavities[k].points, rule.cavities[k]);
  out.correction = rule.correction;
  return out;
}

// The errors e_s of the points in the states c_s are taken up by B c_s and H c_s. With the metric G = LᵀL, x =
// L c and y = L⁻ᵀ e, each divided by ‖c_s‖_G, B = −LᵀA L minimises Σ ‖A x_s − y_s‖² + λ ‖A‖², A symmetric:
//   A S + S A + 2λ A = Y Xᵀ + X Yᵀ,  S = X Xᵀ,
// which the eigenvectors of S make a division; H likewise, without symmetry. λ keeps what differs between
// states that hardly differ from making large entries.
std::shared_ptr<const polyaffine::LinearCorrection> NestedRuleTraining::correction_of(
    const Discretisation& points) const {
  const auto count = std::ssize(targets_);
  const Eigen::Index n = metric_.rows(), pressures = targets_.front().change.size();
  Matrix X(n, count), force_errors(n, count), volume_errors(pressures, count);
  Vector sizes(count);
  for (Eigen::Index s = 0; s < count; ++s) {
    const Target& target = targets_[static_cast<std::size_t>(s)];
    const Ventricle v =
        assemble_ventricle(full_.anatomy(), with_regions(full_.scene(), target.load), points);
    const WallLoad load = wall_load(v, target.load);
    const auto found = v.wall->evaluate(
        {target.c, state_of(load.tension), nullptr, pressures > 0 ? &target.pressure : nullptr});
    X.col(s) = root_ * target.c;
    sizes[s] = X.col(s).norm();
    force_errors.col(s) = found.gradient - target.force;
    if (pressures > 0) volume_errors.col(s) = found.pressure_gradient - target.change;
  }
  X = X * sizes.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(X * X.transpose());
  const Vector squares = eigen.eigenvalues().cwiseMax(0);
  const double ridge = kRidge * squares.maxCoeff();
  const Matrix& U = eigen.eigenvectors();

  auto out = std::make_shared<polyaffine::LinearCorrection>();
  if (pressures > 0) {
    const Matrix scaled = volume_errors * sizes.cwiseInverse().asDiagonal();
    const Matrix A = (scaled * X.transpose() * U) *
                     (squares.array() + ridge).inverse().matrix().asDiagonal() * U.transpose();
    out->volume_change = -A * root_;
    for (Eigen::Index s = 0; s < count; ++s)
      force_errors.col(s) += out->volume_change.transpose() * targets_[static_cast<std::size_t>(s)].pressure;
  }
  for (std::size_t i = 0; i < nested_.fixed.size(); ++i)
    if (nested_.fixed[i]) force_errors.row(static_cast<Eigen::Index>(i)).setZero();
  const Matrix Y = root_.transpose().triangularView<Eigen::Lower>().solve(force_errors) *
                   sizes.cwiseInverse().asDiagonal();
  const Matrix sides = U.transpose() * (Y * X.transpose() + X * Y.transpose()) * U;
  Matrix A(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) A(i, j) = sides(i, j) / (squares[i] + squares[j] + 2 * ridge);
  if (std::getenv("NOB")) { out->stiffness = Matrix::Zero(n, n); return out; }
  out->stiffness = -root_.transpose() * (U * A * U.transpose()) * root_;
  return out;
}

}  // namespace cardiac
