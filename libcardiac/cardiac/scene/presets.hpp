#pragma once

#include <cardiac/scene/scene.hpp>

/// What a scene leaves open and its other values decide.
namespace cardiac {

/// The presets, written out: enrichment, pressure space and border functions that the scene does not name,
/// and the duration of the contraction by the heart rate. The accurate preset has more functions along the
/// wall where regions differ. What is named stays.
void fill_presets(Scene& scene);

/// Raises the local bulk modulus where the muscle of one ventricle contracts.
void raise_local_bulk_modulus(bool two_ventricles, Scene& scene);

/// Do the frames belong to the AHA segments, with tents as weights?
bool aha_tents(const scene::Reduction& reduction);

/// Does some region move otherwise than the rest: another stiffness or, where something contracts, another
/// tension or time?
bool regions_differ(const Scene& scene);
bool region_differs(const Scene& scene, const scene::RegionOverride& region);

}  // namespace cardiac
