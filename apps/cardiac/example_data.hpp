#pragma once

#include <filesystem>

namespace cardiac::app {

/// The folder of the example protocols and meshes of an installed program, share/cardiac beside the folder of
/// the program; empty where there is none.
std::filesystem::path example_folder();

/// The file as given; where there is none and the installed examples have one of that path, that one, and a
/// line on the standard error says so.
std::filesystem::path given_or_example(const std::filesystem::path& file);

}  // namespace cardiac::app
