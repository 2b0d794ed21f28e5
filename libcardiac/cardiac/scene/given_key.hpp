#pragma once

#include <string>

#include <cardiac/scene/scene.hpp>

namespace cardiac {

/// What the tables and networks of a scene say, as a text that differs where they do; empty where it has
/// none. The names of their files are no part of it.
std::string given_key(const Scene& scene);

}  // namespace cardiac
