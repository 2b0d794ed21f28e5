#pragma once

#include <vector>

#include <cardiac/core/beat_result.hpp>
#include <cardiac/run/beat.hpp>

namespace cardiac {

/// Mechanics of all segments, index 0 for segment 1, in each of a path's output states: means over the
/// integration points (of a trained rule: over all its candidates), weighted by the volume that each stands
/// for in the segment (segment_shares).
///   fibre strain   |F f| / |F_ed f| − 1, F_ed at the coefficients `c_ed`,
///   stresses       of the Cauchy stress σ = P Fᵀ/det F of laws, pressure, active tension and viscosity:
///                  n·σ n along n = F f/|F f|, that of the active part alone, tr σ/3 and the equivalent
///                  stress √(3/2 s:s), s = σ − tr σ/3 (von Mises 1913),
///   work           −∫∫ P : Ḟ dt dV from the first step on, of all parts of the stress and of the active one,
///                  trapezoids of the steps as in energy_balance.
/// Fibre columns are NaN where the wall has no fibres, all of a segment without a point.
std::vector<std::vector<SegmentMechanics>> segment_mechanics(const Ventricle& ventricle, const Scene& scene,
                                                             const HeartPath& path,
                                                             const polyaffine::Vector& c_ed);

}  // namespace cardiac
