#include "polyaffine/system/term.hpp"

#include <stdexcept>

namespace polyaffine {

void Term::add_parameter_derivative(const std::string& parameter, const At&, Vector&) const {
  throw std::invalid_argument("term: no parameter " + parameter);
}

double Term::stored_energy(const At&) const {
  return 0;
}
double Term::dissipation(const At&) const {
  return 0;
}

std::shared_ptr<const Term> Term::mixed(StateLayout&) const {
  return nullptr;
}
void Term::start(Vector&, Vector*) const {}

std::optional<double> Term::strain(const Vector&) const {
  return {};
}
void Term::add_tables(std::vector<const FieldTable*>&) const {}

}  // namespace polyaffine
