#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <cardiac/anatomy/heart_mesh.hpp>
#include <cardiac/protocol/sections.hpp>

namespace cardiac::app {

/// The unit behind a word of --length-unit. Throws InputError for another word.
protocol::LengthUnit length_unit(const std::string& word);

/// Labels as words of a command line: numbers or names.
std::vector<SurfaceLabel> surface_labels(const std::vector<std::string>& words);

/// Files with the triangles of surfaces beside a mesh of tetrahedra.
struct SurfaceFiles {
  std::filesystem::path labelled;  ///< one file with labelled triangles; empty: none
  std::vector<std::pair<int, std::filesystem::path>>
      of_surface;                  ///< files that are one surface each: its label
  std::vector<std::string> notes;  ///< what was taken from the names of files
};

/// Surface files as words of a command line: NAME=FILE for a file that is the surface NAME (endo, epi, base,
/// rv_endo, …); FILE alone is one labelled file or, beside others, a surface by the name of the file. Throws
/// InputError naming the word when a name is no surface, or one labelled file stands beside others.
SurfaceFiles surface_files(const std::vector<std::string>& words);

/// Reads any mesh file by its extension, in small or capital letters. Throws InputError as the readers, and
/// when this build lacks VTK and the file is none of .vtu.
polyaffine::MeshData read_any_mesh(const std::filesystem::path& file);

/// The heart in the data of a file and in the files of its surfaces. A single file without labels is the
/// surface that its name tells. Without a file of the base, the boundary that no file covers is base. Throws
/// InputError as read_any_mesh and make_heart_mesh, and when labels are given for files of one surface each.
HeartMesh read_heart(polyaffine::MeshData volume, const SurfaceFiles& surfaces,
                     const HeartMeshOptions& options);

}  // namespace cardiac::app
