#pragma once

#include <memory>
#include <string>
#include <vector>

#include <cardiac/core/beat_result.hpp>
#include <cardiac/run/beat.hpp>

namespace cardiac {

/// A heart free of stress, and how it was found.
struct Unloading {
  std::shared_ptr<const Anatomy> heart;
  UnloadingResult result;
  std::vector<std::string> warnings;
};

/// Inflations of shapes on the way to the stress-free one, at most.
inline constexpr int kMostInflations = 15;
/// Largest distance of a vertex from the image, of the heart's extent (the diagonal of its box), at which the
/// stress-free shape is found (0.026 mm of a human left ventricle); beyond which a warning tells it; and
/// beyond which none was found. Small jumps of a reduced model from shape to shape, on which its functions
/// depend, can keep it above the first.
inline constexpr double kUnloaded = 2e-4, kNotQuite = 7.5e-4, kNotUnloaded = 1e-2;

/// The shape that the heart of a scene has without load, so that its passive wall under the pressures of
/// scene.imaged has the shape of the mesh: X + u(X) = x at every vertex. Fixed-point iteration X ← x − u(X)
/// (Sellier 2011) with Anderson's acceleration (Walker and Ni 2011). A first inflation of the imaged shape,
/// by as much as hearts fill according to Klotz et al. 2006, gives the start; where one shape comes out too
/// large and another too small, the next lies between them. On every X the anatomy and the model are built
/// anew (moved_anatomy), so that the forward problem is inverted as it is computed. What is inflated is the
/// model of the scene, full order for a tuned one (that learns from full order on the stress-free shape), all
/// points where a rule is to be trained. Springs are at rest in the stress-free shape. A last inflation tells
/// the filling, to 30 mmHg or the pressure of the image, as far as there are equilibria.
///
/// Throws InputError as build_ventricle; ComputationError, naming the key, when there is no such shape, and
/// with its reason when the control stops it.
Unloading unload(const Scene& scene, const RunControl& control = {});

/// A scene with `imaged` on the heart free of stress. Sites and maps of activation, which refer to the image,
/// move with it.
Scene unloaded_scene(const Scene& scene, std::shared_ptr<const Anatomy> heart);

}  // namespace cardiac
