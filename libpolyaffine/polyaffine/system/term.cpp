#include "polyaffine/system/term.hpp"

#include <stdexcept>

namespace polyaffine {

void Term::add_parameter_derivative(const std::string& parameter, const At&, Vector&) const {
  throw std::invalid_argument("term: no parameter " + parameter);
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
