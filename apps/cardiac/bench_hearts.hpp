#pragma once

#include <filesystem>

#include <cardiac/bench/heart_scene.hpp>

namespace cardiac::app {

/// The hearts of the bench's scenes: `biv` from the project's example meshes, the others from a folder of
/// meshes of other origin, which has data/hearts/lv_1260.msh, data/arostica2025/{lv,biv}_volume.vtu with
/// their _surface.vtu, and field/papillary/pap.msh. A heart whose mesh is not there is left out, with a line
/// on the standard error. Coarse meshes are made inside the surface of a heart's own mesh, with the longest
/// edges that leave it valid, and kept under `made`.
HeartSource heart_source(const std::filesystem::path& folder, const std::filesystem::path& made);

/// The folder of hearts of other origin: what is given, else the environment's CARDIAC_HEARTS, else
/// ../shared.
std::filesystem::path heart_folder(const std::filesystem::path& given);

}  // namespace cardiac::app
