#pragma once

#include <filesystem>

#include <cardiac/anatomy/anatomy.hpp>
#include <polyaffine/core/archive.hpp>

namespace cardiac {

/// An anatomy with all that was computed of its mesh: one read back gives the same coordinates, axes,
/// segments and fibres to the last bit, without a mesh file and without solving. Fibres are none or those of
/// a file (FileFibreFunction).
///
/// Writing throws InputError where the fibres are another function; reading, where the parts do not fit each
/// other.
void archive(polyaffine::ArchiveWriter& a, Anatomy& x);
void archive(polyaffine::ArchiveReader& a, Anatomy& x);

/// The anatomy as a file of its own. Throws as polyaffine::write_archive and read_archive.
void write_anatomy(const std::filesystem::path& file, const Anatomy& anatomy);
Anatomy read_anatomy(const std::filesystem::path& file);

}  // namespace cardiac
