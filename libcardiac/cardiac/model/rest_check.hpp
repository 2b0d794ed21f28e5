#pragma once

#include <cardiac/model/ventricle.hpp>

namespace cardiac {

/// Throws InputError, naming the keys, when the tangent stiffness of a reduced model without load or tension
/// is not positive definite: it would move without a force, or against it, whatever is asked of it.
void check_rest(const Ventricle& ventricle, const Scene& scene);

}  // namespace cardiac
