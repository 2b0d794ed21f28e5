#include "cardiac/model/rest_check.hpp"

#include <polyaffine/core/error.hpp>
#include <polyaffine/system/linearised.hpp>

namespace cardiac {

using polyaffine::Vector;

namespace {

std::string text_of(const scene::Reduction& r, std::size_t points, int unknowns) {
  std::string functions, rings;
  for (const std::string& word : *r.enrichment) functions += (functions.empty() ? "" : ", ") + word;
  for (const int n : r.ring_nodes) rings += (rings.empty() ? "" : ", ") + std::to_string(n);
  return "ring_nodes [" + rings + "], enrichment [" + functions + "], " + std::to_string(unknowns) +
         " unknowns and " + std::to_string(points) + " integration points";
}

}  // namespace

void check_rest(const Ventricle& ventricle, const Scene& scene) {
  // Without contraction: what a passive wall resists. Tensions of zero where its laws want them.
  const auto no_tension =
      ventricle.contraction && !ventricle.muscle
          ? polyaffine::constant_values(Vector::Zero(ventricle.contraction->delay_ms.size()))
          : nullptr;
  const polyaffine::System system = wall_system(ventricle, no_tension);
  const auto linear = system.make_linear();
  const Vector rest = Vector::Zero(system.size());
  polyaffine::Linearised at_rest(system, *linear);
  if (at_rest.factorise({0, rest}, 0) && at_rest.positive_definite()) return;
  const auto& d = ventricle.discretisation;
  throw polyaffine::InputError(
      "reduction: the wall at rest resists some motions with nothing or less (its stiffness is not positive "
      "definite); found " +
      text_of(scene.reduction, d.points.tet.size(), d.num_unknowns) +
      "; expected control nodes apart from each other, functions that do not depend on each other, and "
      "integration points that see them all: fewer words in reduction.enrichment, fewer "
      "reduction.ring_nodes, a finer mesh, or reduction.integration = \"gauss\"");
}

}  // namespace cardiac
