#pragma once

#include <cardiac/scene/scene.hpp>

/// What a scene leaves open and its other values decide.
namespace cardiac {

/// The presets, written out: enrichment, pressure space and border functions that the scene does not name,
/// and the duration of the contraction by the heart rate. There are more functions along the wall where
/// regions differ and where components are Cartesian: where the scene asks for them, or leaves the axes to
/// the heart and that wants them (axes_of; two ventricles always do). What is named stays.
void fill_presets(Scene& scene, bool heart_wants_cartesian_axes);

/// Raises the local bulk modulus where muscle contracts (of two ventricles only with the accurate preset),
/// further where regions differ.
void raise_local_bulk_modulus(bool two_ventricles, Scene& scene);

/// Is the model a reduced one that is learned for its heart?
bool is_tuned(const Scene& scene);

/// Do the frames belong to the AHA segments, with tents as weights?
bool aha_tents(const scene::Reduction& reduction);

/// Does some region move otherwise than the rest: another stiffness or, where something contracts, another
/// tension or time?
bool regions_differ(const Scene& scene);
bool region_differs(const Scene& scene, const scene::RegionOverride& region);

}  // namespace cardiac
