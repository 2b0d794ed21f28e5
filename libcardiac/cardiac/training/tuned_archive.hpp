#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <cardiac/training/tuned_model.hpp>
#include <polyaffine/core/archive.hpp>

namespace cardiac {

/// A tuned model with all that it learned. What it takes of its heart (control frames) is not in it.
void archive(polyaffine::ArchiveWriter& a, TunedModel& x);
void archive(polyaffine::ArchiveReader& a, TunedModel& x);

/// A heart with its tuned model and the protocol that it was learned for: all that a run needs.
struct HeartModel {
  std::string protocol;                ///< text of the protocol file (TOML)
  std::string source;                  ///< its path
  std::vector<std::string> overrides;  ///< key=value on top of it
  std::string structure;               ///< structure_key of its scene
  std::shared_ptr<const Anatomy> heart;
  std::shared_ptr<const TunedModel> tuned;
};

/// The model file: an archive "cardiac heart model" with a checksum. Writing is atomic. Throws InputError as
/// polyaffine::write_archive and read_archive, and when the parts of a file do not fit each other.
void write_heart_model(const std::filesystem::path& file, const HeartModel& model);
HeartModel read_heart_model(const std::filesystem::path& file);

/// What a scene must share with the one that a model was learned for: mesh, kind of tissue, fibres, boundary
/// and the functions themselves. Loads, contraction, regions and parameters of the tissue may differ.
std::string structure_key(const Anatomy& anatomy, const Scene& scene);
/// What tells the tuned models of two scenes apart: the structure and all that their training reads.
std::string tuned_key(const Anatomy& anatomy, const Scene& scene);

/// The model of a scene from the cache (polyaffine::read_cache), if it is there; one that did not reach its
/// accuracy only for the budget that it was learned in. Hearts with fibres of a file
/// or of a program are not kept there.
std::optional<TunedModel> cached_model(const Anatomy& anatomy, const Scene& scene);
void keep_model(const Anatomy& anatomy, const Scene& scene, const TunedModel& model);

/// The parts of a space that are not stored: control frames and their functions at the nodes.
void complete(const Anatomy& anatomy, const Scene& scene, TunedModel& model);

}  // namespace cardiac
