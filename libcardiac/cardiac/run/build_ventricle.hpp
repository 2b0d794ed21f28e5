#pragma once

#include <cardiac/run/beat.hpp>

namespace cardiac {

/// Builds what `plan(protocol)` says, from a mesh in mm. Throws InputError as the discretisation does,
/// check_size included.
Ventricle build_ventricle(std::shared_ptr<const Anatomy> anatomy, const Protocol& protocol,
                          protocol::Method method);

/// The larger rule_error at end diastole and end systole of a path (without circulation: at its end).
double rule_error(const Ventricle& ventricle, const Protocol& protocol, const HeartPath& path);

}  // namespace cardiac
