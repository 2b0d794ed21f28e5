#include "polyaffine/system/field_term.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace polyaffine {
namespace {

// What an energy is evaluated at, with the vectors that it refers to.
struct Held {
  Vector c, rate, pressures;
  std::shared_ptr<const Vector> state;

  Motion motion() const {
    Motion out{c};
    if (state) out.state = {state->data(), static_cast<std::size_t>(state->size())};
    if (rate.size() > 0) out.rate = &rate;
    if (pressures.size() > 0) out.pressure = &pressures;
    return out;
  }
};

Held held(const At& at, const FieldEnergy& energy, Unknowns c, const std::optional<Unknowns>& pressures,
          const PointValues& state) {
  Held out{c.of(at.y), {}, {}, nullptr};
  if (at.rate && energy.feels_rate()) out.rate = c.of(*at.rate);
  if (pressures) out.pressures = pressures->of(at.y);
  if (state) out.state = state(at.t);
  return out;
}

}  // namespace

FieldTerm::FieldTerm(std::shared_ptr<const FieldEnergy> energy, bool is_solid, Scale scale, PointValues state)
    : energy_(std::move(energy)),
      is_solid_(is_solid),
      scale_(std::move(scale)),
      state_(std::move(state)),
      c_{0, energy_->table().num_unknowns()} {}

void FieldTerm::add_residual(const At& at, Residual& out) const {
  const double s = scale(at.t);
  if (s == 0) return;
  const Held now = held(at, *energy_, c_, pressures_, state_);
  const EnergyValue e = energy_->evaluate(now.motion());
  if (is_solid_) {
    out.min_det = std::min(out.min_det, e.min_det);
    out.max_det = std::max(out.max_det, e.max_det);
  }
  out.potential += s * e.value;
  c_.of(out.values) += s * e.gradient;
  out.forces += std::abs(s) * e.gradient.norm();
  if (!pressures_) return;
  pressures_->of(out.values) += e.pressure_gradient;
  const double kappa = energy_->pressure_space()->bulk_modulus;
  out.defect =
      std::max(out.defect, energy_->penalty_pressure(e.pressure_gradient).cwiseAbs().maxCoeff() / kappa);
}

void FieldTerm::add_tangent(const At& at, double alpha, Tangent& out) const {
  const double s = scale(at.t);
  if (s == 0) return;
  const Held now = held(at, *energy_, c_, pressures_, state_);
  energy_->add_tangent(now.motion(), out.field, s, at.rate ? alpha : 0);
}

void FieldTerm::condense(const At& at, double, const Vector& rhs, Eigen::Ref<Vector> field) const {
  const double s = scale(at.t);
  if (!pressures_ || s == 0) return;
  field += s * energy_->pressure_force(c_.of(at.y), energy_->penalty_pressure(pressures_->of(rhs)));
}

void FieldTerm::recover(const At& at, double, const Vector& rhs, Vector& step) const {
  if (!pressures_ || scale(at.t) == 0) return;
  pressures_->of(step) =
      energy_->penalty_pressure(energy_->volume_change(c_.of(at.y), c_.of(step)) - pressures_->of(rhs));
}

std::shared_ptr<const Term> FieldTerm::mixed(StateLayout& layout) const {
  if (!energy_->pressure_space()) return nullptr;
  auto out = std::make_shared<FieldTerm>(*this);
  const std::string name = "pressures " + std::to_string(layout.blocks().size());
  out->pressures_ = layout.add({.name = name, .unit = "kPa", .solved = Solved::apart},
                               energy_->pressure_space()->num_functions);
  return out;
}

void FieldTerm::start(Vector& y) const {
  if (pressures_) pressures_->of(y) = energy_->pressure(c_.of(y));
}

std::optional<double> FieldTerm::strain(const Vector& step) const {
  if (!is_solid_) return {};
  const Vector c = c_.of(step);
  double largest = 0;
  for (const PointBlock& block : energy_->table().blocks) {
    Matrix change = Matrix::Zero(9, block.count);
    add_field(block, gather(block, c), change.data());
    largest = std::max(largest, change.cwiseAbs().maxCoeff());
  }
  return largest;
}

void FieldTerm::add_tables(std::vector<const FieldTable*>& out) const {
  out.push_back(&energy_->table());
}

std::shared_ptr<const Term> solid(std::shared_ptr<const FieldEnergy> energy, PointValues state) {
  return std::make_shared<FieldTerm>(std::move(energy), true, FieldTerm::Scale(), std::move(state));
}

std::shared_ptr<const Term> load(std::shared_ptr<const FieldEnergy> energy, FieldTerm::Scale scale) {
  return std::make_shared<FieldTerm>(std::move(energy), false, std::move(scale));
}

}  // namespace polyaffine
