#include "polyaffine/system/support.hpp"

#include <utility>

#include <polyaffine/material/parameters.hpp>

namespace polyaffine {
namespace {

FieldEnergy unit_springs(FieldTable surface, Points normals, SpringDirection direction) {
  const auto law = normals.size() > 0 ? std::make_shared<SurfaceSpring>(1.0, std::move(normals), direction)
                                      : std::make_shared<SurfaceSpring>(1.0);
  return FieldEnergy(std::move(surface), {law});
}

}  // namespace

Support::Support(FieldTable surface, SupportParameters parameters)
    : unit_(unit_springs(std::move(surface), std::move(parameters.normals), parameters.direction)),
      stiffness_(parameters.stiffness_kPa_per_mm),
      damping_(parameters.damping_kPa_ms_per_mm),
      c_{0, unit_.table().num_unknowns()} {
  require_not_negative("support stiffness", stiffness_, "kPa/mm");
  require_not_negative("support damping", damping_, "kPa ms/mm");
}

void Support::add_residual(const At& at, Residual& out) const {
  const auto add = [&](const Vector& u, double factor, bool stores) {
    const EnergyValue e = unit_.evaluate({u});
    c_.of(out.values) += factor * e.gradient;
    out.forces += factor * e.gradient.norm();
    if (stores) out.potential += factor * e.value;
  };
  if (stiffness_ > 0) add(c_.of(at.y), stiffness_, true);
  if (damping_ > 0 && at.rate) add(c_.of(*at.rate), damping_, false);
}

void Support::add_tangent(const At& at, double alpha, Tangent& out) const {
  const double factor = stiffness_ + (at.rate ? alpha * damping_ : 0);
  if (factor > 0) unit_.add_tangent({c_.of(at.y)}, out.field, factor);
}

void Support::add_parameter_derivative(const std::string& parameter, const At& at, Vector& out) const {
  if (parameter == "stiffness")
    c_.of(out) += unit_.evaluate({c_.of(at.y)}).gradient;
  else if (parameter == "damping")
    c_.of(out) += unit_.evaluate({at.rate_of(c_)}).gradient;
  else
    Term::add_parameter_derivative(parameter, at, out);
}

void Support::add_tables(std::vector<const FieldTable*>& out) const {
  out.push_back(&unit_.table());
}

}  // namespace polyaffine
