#include "cardiac/model/circulation_term.hpp"

#include <utility>

namespace cardiac {

using polyaffine::At;
using polyaffine::Unknowns;
using polyaffine::Vector;

CirculationTerm::CirculationTerm(std::shared_ptr<const CirculationModel> model, Unknowns volumes,
                                 Unknowns vessels, Unknowns pressures)
    : model_(std::move(model)), volumes_(volumes), vessels_(vessels), pressures_(pressures) {}

Vector CirculationTerm::states(const Vector& y) const {
  Vector out(volumes_.size + vessels_.size);
  out << volumes_.of(y), vessels_.of(y);
  return out;
}

// The equations of the volumes' rates stand in the rows of the cavities' pressures: the rows of the volumes
// hold what relates them to the wall.
void CirculationTerm::add_residual(const At& at, polyaffine::Residual& out) const {
  const Vector flows = model_->rates(at.t, states(at.y), pressures_.of(at.y)).values;
  pressures_.of(out.values) += at.rate_of(volumes_) - flows.head(volumes_.size);
  vessels_.of(out.values) += at.rate_of(vessels_) - flows.tail(vessels_.size);
}

void CirculationTerm::add_tangent(const At& at, double alpha, polyaffine::Tangent& out) const {
  const auto rates = model_->rates(at.t, states(at.y), pressures_.of(at.y));
  const int m = volumes_.size, n = m + vessels_.size;
  const auto row = [&](int k) {
    return out.few_index(k < m ? pressures_.first + k : vessels_.first + k - m);
  };
  const auto state = [&](int k) {
    return out.few_index(k < m ? volumes_.first + k : vessels_.first + k - m);
  };
  for (int i = 0; i < n; ++i) {
    out.corner(row(i), state(i)) += alpha;
    for (int j = 0; j < n; ++j) out.corner(row(i), state(j)) -= rates.by_states(i, j);
    for (int k = 0; k < m; ++k)
      out.corner(row(i), out.few_index(pressures_.first + k)) -= rates.by_pressures(i, k);
  }
}

}  // namespace cardiac
