#include "cardiac/model/rest_check.hpp"

#include <polyaffine/core/error.hpp>

namespace cardiac {

using polyaffine::Vector;

namespace {

std::string text_of(const protocol::Reduction& r, std::size_t points, int unknowns) {
  std::string functions, rings;
  for (const std::string& word : *r.enrichment) functions += (functions.empty() ? "" : ", ") + word;
  for (const int n : r.ring_nodes) rings += (rings.empty() ? "" : ", ") + std::to_string(n);
  return "ring_nodes [" + rings + "], enrichment [" + functions + "], " + std::to_string(unknowns) +
         " unknowns and " + std::to_string(points) + " integration points";
}

}  // namespace

void check_rest(const Ventricle& ventricle, const Protocol& protocol) {
  const auto system = ventricle.make_system();
  const Vector rest = Vector::Zero(ventricle.num_coefficients());
  // Without contraction: what a passive wall resists. Tensions of zero where its laws want them.
  const Vector tension =
      ventricle.contraction ? Vector::Zero(ventricle.contraction->delay_ms.size()).eval() : Vector();
  system->set_zero();
  ventricle.wall->add_tangent(
      {rest, polyaffine::PointState(tension.data(), static_cast<std::size_t>(tension.size()))}, *system);
  for (const auto& spring : ventricle.springs) spring->add_tangent({rest}, *system);
  if (system->factorise() && system->positive_definite()) return;
  const auto& d = ventricle.discretisation;
  throw polyaffine::InputError(
      "reduction: the wall at rest resists some motions with nothing or less (its stiffness is not positive "
      "definite); found " +
      text_of(protocol.reduction, d.points.tet.size(), d.num_unknowns) +
      "; expected control nodes apart from each other, functions that do not depend on each other, and "
      "integration points that see them all: fewer words in reduction.enrichment, fewer "
      "reduction.ring_nodes, a finer mesh, or reduction.integration = \"gauss\"");
}

}  // namespace cardiac
