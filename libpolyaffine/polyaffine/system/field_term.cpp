#include "polyaffine/system/field_term.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <polyaffine/system/point_stress.hpp>

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

class EliminatedPressures : public Elimination {
 public:
  EliminatedPressures(std::shared_ptr<const FieldEnergy> energy, double scale, Unknowns c, Unknowns pressures,
                      VolumeGradient D)
      : energy_(std::move(energy)), scale_(scale), c_(c), pressures_(pressures), D_(std::move(D)) {}

  void condense(const Vector& rhs, Eigen::Ref<Vector> field) const override {
    field.segment(c_.first, c_.size) +=
        scale_ * D_.transpose_times(energy_->penalty_pressure(pressures_.of(rhs)));
  }
  void recover(const Vector& rhs, Vector& step) const override {
    pressures_.of(step) = energy_->penalty_pressure(D_.times(c_.of(step)) - pressures_.of(rhs));
  }

 private:
  std::shared_ptr<const FieldEnergy> energy_;
  double scale_;
  Unknowns c_, pressures_;
  VolumeGradient D_;
};

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
  VolumeGradient D = energy_->add_tangent(now.motion(), out.field, s, at.rate ? alpha : 0);
  if (pressures_)
    out.eliminations.push_back(
        std::make_unique<EliminatedPressures>(energy_, s, c_, *pressures_, std::move(D)));
}

double FieldTerm::stored_energy(const At& at) const {
  return scale_ ? 0 : elastic_energy(*energy_, c_.of(at.y));
}

double FieldTerm::dissipation(const At& at) const {
  if (scale_ || !at.rate || !energy_->feels_rate()) return 0;
  const Matrix F = evaluate_field(energy_->table(), c_.of(at.y));
  const Matrix rate = field_rate(energy_->table(), c_.of(*at.rate));
  return work(energy_->table().weights, viscous_stress(*energy_, F, rate), rate);
}

std::shared_ptr<const Term> FieldTerm::mixed(StateLayout& layout) const {
  if (!energy_->pressure_space()) return nullptr;
  auto out = std::make_shared<FieldTerm>(*this);
  const std::string name = "pressures " + std::to_string(layout.blocks().size());
  out->pressures_ = layout.add({.name = name,
                                .unit = "kPa",
                                .solved = Solved::apart,
                                .absolute_tolerance = std::numeric_limits<double>::infinity(),
                                .error_tested = false},
                               energy_->pressure_space()->num_functions);
  return out;
}

void FieldTerm::start(Vector& y, Vector* rate) const {
  if (!pressures_) return;
  const Vector c = c_.of(y);
  pressures_->of(y) = energy_->pressure(c);
  if (rate)
    pressures_->of(*rate) = energy_->penalty_pressure(energy_->volume_gradient(c).times(c_.of(*rate)));
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
