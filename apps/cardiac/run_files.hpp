#pragma once

#include <filesystem>
#include <vector>

#include <cardiac/protocol/protocol.hpp>
#include <cardiac/run/result.hpp>

namespace cardiac::app {

/// Does this build write .vtu files?
bool writes_mesh_series();

/// Writes heart_0000.vtu … and heart.pvd: the deformed mesh at every output time; the first frame is the
/// first output time of the last beat, times are in ms. Strain is Lagrangian, (L − L₀)/L₀, against end
/// diastole, in local axes (longitudinal, circumferential, radial).
///
/// - Points: "displacement_mm" from the mesh; "activation_ms" where the wall contracts, the delays of regions
///   included.
/// - Cells: "segment" (integer), "fibre" where there are fibres, F f / |F f| with the deformation gradient F
/// of
///   the tet; "strain_lcr" of each tet and "segment_strain_lcr", the mean of its segment (as in strain.csv).
/// - Field data: "segment_name" (of segment 1 first), "time_ms".
///
/// Throws InputError where writes_mesh_series is false.
void write_mesh_series(const Ventricle& ventricle, const Protocol& protocol, const HeartPath& path,
                       const BeatResult& result, const std::filesystem::path& out);

}  // namespace cardiac::app
