#pragma once

#include <memory>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/scene/scene.hpp>

namespace cardiac::testing {

/// A scene put together in C++: a coarse human left ventricle that contracts, without a load.
inline Scene contracting_heart() {
  static const auto heart = [] {
    CurvedMesh mesh = structured_ellipsoid(human_lv(), {8, 16, 1});
    return std::make_shared<const Anatomy>(make_anatomy(mesh.mesh, {.midpoints = mesh.midpoints}));
  }();
  Scene out;
  out.heart = heart;
  out.fibres.emplace();
  out.activation.emplace();
  out.contraction.emplace();
  return out;
}

}  // namespace cardiac::testing
