#include "cardiac/model/cavity_coupling.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace cardiac {

using polyaffine::At;
using polyaffine::Vector;

CavityCoupling::CavityCoupling(std::shared_ptr<const polyaffine::FieldEnergy> enclosed,
                               polyaffine::Unknowns volume, polyaffine::Unknowns pressure)
    : enclosed_(std::move(enclosed)),
      c_{0, enclosed_->table().num_unknowns()},
      volume_(volume),
      pressure_(pressure) {
  if (volume.size != 1 || pressure.size != 1)
    throw std::invalid_argument("cavity: its volume and its pressure are one unknown each");
}

void CavityCoupling::add_residual(const At& at, polyaffine::Residual& out) const {
  const double p = at.y[pressure_.first], V = at.y[volume_.first];
  const auto cavity = enclosed_->evaluate({c_.of(at.y)});
  c_.of(out.values) -= p * cavity.gradient;
  out.forces += std::abs(p) * cavity.gradient.norm();
  out.values[volume_.first] += V - cavity.value;
  out.defect = std::max(out.defect, std::abs(V - cavity.value) / std::abs(cavity.value));
}

void CavityCoupling::add_tangent(const At& at, double, polyaffine::Tangent& out) const {
  const Vector c = c_.of(at.y);
  const int volume = out.few_index(volume_.first), pressure = out.few_index(pressure_.first);
  enclosed_->add_tangent({c}, out.field, -at.y[pressure_.first]);
  const Vector gradient = enclosed_->evaluate({c}).gradient;
  out.columns.push_back({pressure, -gradient});
  out.rows.push_back({volume, -gradient});
  out.corner(volume, volume) += 1;
}

void CavityCoupling::add_tables(std::vector<const polyaffine::FieldTable*>& out) const {
  out.push_back(&enclosed_->table());
}

}  // namespace cardiac
