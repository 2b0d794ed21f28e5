#include "cardiac/fibres/anatomy_archive.hpp"

#include <algorithm>
#include <string>

#include <cardiac/anatomy/right_ventricle.hpp>
#include <cardiac/fibres/file_fibres.hpp>
#include <polyaffine/core/archive_file.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/tet_mesh_archive.hpp>

namespace cardiac {

using polyaffine::ArchiveReader;
using polyaffine::ArchiveWriter;

namespace {

// Raised with every change of what is stored.
const polyaffine::ArchiveFormat kFormat{"cardiac anatomy", 1};

std::shared_ptr<const FileFibres> fibres_of(const Anatomy& anatomy) {
  if (!anatomy.fibres) return nullptr;
  if (const auto* of_file = anatomy.fibres.target<FileFibreFunction>()) return of_file->fibres;
  throw polyaffine::InputError(
      "anatomy to be stored: found fibres that a program computes, expected none or those of a mesh file");
}

// What is amiss between the parts; empty where nothing is.
std::string misfit(const Anatomy& x, const FileFibres* fibres) {
  const auto n = static_cast<Eigen::Index>(x.mesh.num_tets());
  if (!x.coordinates || x.coordinates->space().elements().cols() != n)
    return "coordinates that are not those of its mesh";
  if (x.labels.rv_endo.has_value() != (x.coordinates->right() != nullptr))
    return "labels and coordinates of different numbers of ventricles";
  const auto is_segment = [last = num_segments(*x.coordinates)](int s) { return s >= 1 && s <= last; };
  if (std::ssize(x.segment) != n || !std::ranges::all_of(x.segment, is_segment))
    return "segments that are not those of its mesh";
  if (fibres && fibres->num_tets() != n) return "fibres that are not those of its mesh";
  return {};
}

template <class Archive>
void visit_parts(Archive& a, Anatomy& x) {
  std::shared_ptr<const FileFibres> fibres;
  if constexpr (!Archive::kReading) fibres = fibres_of(x);
  a.section("mesh", [&] { a(x.mesh, x.labels); });
  a.section("coordinates", [&] { a(x.coordinates); });
  a.section("segments", [&] { a(x.segment); });
  a.section("fibres", [&] { a(fibres); });
  if constexpr (Archive::kReading) {
    if (const std::string found = misfit(x, fibres.get()); !found.empty())
      a.refuse("found an anatomy with " + found + ", expected parts of one heart");
    x.fibres = fibres ? FibreFunction(FileFibreFunction{fibres}) : FibreFunction{};
  }
}

}  // namespace

void archive(ArchiveWriter& a, Anatomy& x) {
  visit_parts(a, x);
}

void archive(ArchiveReader& a, Anatomy& x) {
  visit_parts(a, x);
}

void write_anatomy(const std::filesystem::path& file, const Anatomy& anatomy) {
  polyaffine::write_archive(file, kFormat, anatomy);
}

Anatomy read_anatomy(const std::filesystem::path& file) {
  return polyaffine::read_archive<Anatomy>(file, kFormat);
}

}  // namespace cardiac
