#pragma once

#include <filesystem>
#include <vector>

#include <cardiac/heart/result.hpp>

namespace cardiac::app {

/// Does this build write .vtu files?
bool writes_mesh_series();

/// Writes heart_0000.vtu … and heart.pvd: the deformed mesh at every output time with displacement (mm), the
/// segment, fibre direction and activation time (where there are any) and the strains of the segment each tet
/// belongs to. The first frame is the first output time of the last beat. Throws InputError where
/// writes_mesh_series is false.
void write_mesh_series(const Ventricle& ventricle, const Protocol& protocol, const HeartPath& path,
                       const BeatResult& result, const std::filesystem::path& out);

}  // namespace cardiac::app
