#include "polyaffine/system/linearised.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include <polyaffine/core/stopwatch.hpp>

namespace polyaffine {
namespace {

constexpr int kMostIterations = 30;      // of the few unknowns' own Newton method
constexpr double kFewTolerance = 1e-10;  // its last step over their whole correction

}  // namespace

SystemCost& SystemCost::operator+=(const SystemCost& more) {
  residuals += more.residuals;
  factorisations += more.factorisations;
  linear_solves += more.linear_solves;
  residual_s += more.residual_s;
  tangent_s += more.tangent_s;
  factorisation_s += more.factorisation_s;
  linear_solve_s += more.linear_solve_s;
  return *this;
}

bool Linearised::factorise(const At& at, double alpha) {
  ++cost_.factorisations;
  const auto n = static_cast<Eigen::Index>(system_.layout.few().size());
  Tangent tangent{system_.layout, linear_, {}, {}, Matrix::Zero(n, n)};
  eliminations_.clear();
  {
    const Stopwatch watch(cost_.tangent_s);
    linear_.set_zero();
    for (const auto& term : system_.terms)
      if (!term->is_met_exactly()) term->add_tangent(at, alpha, tangent);
  }
  const Stopwatch watch(cost_.factorisation_s);
  alpha_ = alpha;
  eliminations_ = std::move(tangent.eliminations);
  if (system_.layout.field().size > 0 && !linear_.factorise()) return false;
  columns_ = std::move(tangent.columns);
  rows_ = std::move(tangent.rows);
  corner_ = std::move(tangent.corner);
  few_ = corner_;
  responses_.clear();
  for (auto* lines : {&columns_, &rows_})
    for (Tangent::Line& line : *lines) system_.restrict(line.by_field);
  for (const Tangent::Line& column : columns_) responses_.emplace_back(linear_.solve(column.by_field));
  for (const Tangent::Line& row : rows_)
    for (std::size_t k = 0; k < columns_.size(); ++k)
      few_(row.few, columns_[k].few) -= row.by_field.dot(responses_[k]);
  // With terms that are met exactly the matrix of the few unknowns is whole only at a solution.
  const bool is_whole =
      std::ranges::none_of(system_.terms, [](const auto& term) { return term->is_met_exactly(); });
  return !is_whole || n == 0 || (few_.allFinite() && Eigen::FullPivLU<Matrix>(few_).isInvertible());
}

Vector Linearised::response(int unknown) const {
  const int few = system_.layout.few_index(unknown);
  Vector out = Vector::Zero(system_.layout.field().size);
  for (std::size_t k = 0; k < columns_.size(); ++k)
    if (columns_[k].few == few) out += responses_[k];
  return out;
}

Vector Linearised::row(int unknown) const {
  const int few = system_.layout.few_index(unknown);
  Vector out = Vector::Zero(system_.layout.field().size);
  for (const Tangent::Line& line : rows_)
    if (line.few == few) out += line.by_field;
  return out;
}

Vector Linearised::solve_few(const At& at, const Vector& rhs, const Vector& field) const {
  const std::vector<int>& places = system_.layout.few();
  Vector wanted = rhs(places);
  for (const Tangent::Line& row : rows_) wanted[row.few] -= row.by_field.dot(field);
  Terms exact;
  for (const auto& term : system_.terms)
    if (term->is_met_exactly()) exact.push_back(term);
  if (exact.empty()) return few_.partialPivLu().solve(wanted);

  Vector y = at.y, rate = at.rate ? *at.rate : Vector::Zero(y.size());
  const At moved{at.t, y, &rate};
  const auto residual = [&] {
    Residual out;
    out.values = Vector::Zero(y.size());
    for (const auto& term : exact) term->add_residual(moved, out);
    return Vector(out.values(places));
  };
  const Vector start = residual();
  Vector now = start, step = Vector::Zero(wanted.size());
  for (int k = 0; k < kMostIterations; ++k) {
    Tangent tangent{system_.layout, linear_, {}, {}, few_};
    for (const auto& term : exact) term->add_tangent(moved, alpha_, tangent);
    const Vector more = tangent.corner.partialPivLu().solve(wanted - few_ * step - (now - start));
    step += more;
    if (more.norm() <= kFewTolerance * step.norm()) break;
    y(places) += more;
    rate(places) += alpha_ * more;
    now = residual();
  }
  return step;
}

bool Linearised::solve(const At& at, const Vector& rhs, Vector& step) {
  const Stopwatch watch(cost_.linear_solve_s);
  ++cost_.linear_solves;
  const Unknowns c = system_.layout.field();
  step = Vector::Zero(system_.size());
  if (c.size > 0) {
    Vector eliminated = Vector::Zero(c.size);
    for (const auto& own : eliminations_) own->condense(rhs, eliminated);
    system_.restrict(eliminated);
    c.of(step) = linear_.solve(c.of(rhs) + eliminated).col(0);
  }
  if (const std::vector<int>& places = system_.layout.few(); !places.empty()) {
    const Vector few = solve_few(at, rhs, c.of(step));
    for (std::size_t k = 0; k < columns_.size(); ++k) c.of(step) -= few[columns_[k].few] * responses_[k];
    step(places) = few;
  }
  for (const auto& own : eliminations_) own->recover(rhs, step);
  return step.allFinite();
}

}  // namespace polyaffine
