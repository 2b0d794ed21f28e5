#pragma once

#include <optional>

#include <cardiac/anatomy/fibre_fields.hpp>
#include <cardiac/anatomy/surface_names.hpp>
#include <cardiac/anatomy/wall_size.hpp>
#include <polyaffine/mesh_io/assemble.hpp>

namespace cardiac {

/// How a mesh file is to be understood.
struct HeartMeshOptions {
  double mm_per_unit = 1;     ///< 1 for mm, 10 for cm, 1000 for m, 0.001 for µm
  std::string label_array{};  ///< empty: the first of the usual names (polyaffine::label_field)
  SurfaceLabelMap labels{};
  FibreArrays fibre_arrays{};
  bool all_fields = false;  ///< keep every numeric array, not only fibres
  WallSizeRule size{};
  std::optional<double> told_mm_per_unit{};  ///< of the user's file, where the data are in mm already
};

/// A mesh whose boundary carries the labels kEndocardium, kEpicardium, kBase and, of two ventricles,
/// kRvEndocardium; with the fields "fibre", "sheet" and "sheet_normal" where the file has them.
struct HeartMesh {
  polyaffine::MeshFile file;          ///< its notes: what was read, repaired and recognised
  std::vector<std::string> fibres;    ///< which fields of fibres were kept
  std::vector<std::string> warnings;  ///< what the user should look at
};

/// Makes a heart of the data of a mesh file and, if there is one, of a second file with the labelled
/// triangles (null: those of the mesh file). Without any label, or with numbers of which none is known, the
/// surfaces are recognised from the shape; numbers then mean what most of their area is. Throws
/// InputError, naming file and place, as polyaffine::assemble, heart_labels, recognise_surfaces,
/// check_heart_surfaces and check_wall_size, and when a fibre has no length.
HeartMesh make_heart_mesh(polyaffine::MeshData volume, const polyaffine::MeshData* surface,
                          const HeartMeshOptions& options);

/// Throws InputError when a labelled endocardium surrounds no cavity, has no rim, or one off the base, or
/// when the epicardium does not surround the cavities: as when labels are swapped.
void check_heart_surfaces(const polyaffine::TetMesh& mesh);

}  // namespace cardiac
