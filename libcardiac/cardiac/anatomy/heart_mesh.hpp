#pragma once

#include <cardiac/anatomy/fibre_fields.hpp>
#include <cardiac/anatomy/surface_names.hpp>
#include <cardiac/anatomy/tet_regions.hpp>
#include <polyaffine/mesh_io/assemble.hpp>

namespace cardiac {

/// How a mesh file is to be understood.
struct HeartMeshOptions {
  double mm_per_unit = 1;     ///< 1 for mm, 10 for cm, 1000 for m, 0.001 for µm
  std::string label_array{};  ///< empty: the usual names (read_triangle_labels)
  SurfaceLabelMap labels{};
  RegionChoice regions{};
  FibreArrays fibre_arrays{};
  bool all_fields = false;  ///< keep every numeric array, not only fibres
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
/// surfaces are recognised from the shape; numbers then mean what most of their area is. Triangles of other
/// labels are left out, with a note; so are, when regions are chosen, those of other parts. A wall of less
/// than 1 or more than 1500 mL is a warning. Throws InputError, naming file and place, as
/// read_triangle_labels, keep_regions, polyaffine::assemble, recognise_surfaces and check_heart_surfaces,
/// when a surface lies inside, and when a fibre has no length; where the tets have several regions and none
/// is chosen, the message lists them. `surface` may gain triangle labels that are made of those of its
/// points.
HeartMesh make_heart_mesh(polyaffine::MeshData volume, polyaffine::MeshData* surface,
                          const HeartMeshOptions& options);

}  // namespace cardiac
