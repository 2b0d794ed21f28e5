#include <cardiac/core/units.hpp>
#include <cardiac/protocol/conditions.hpp>
#include <cardiac/protocol/key_binding.hpp>

namespace cardiac::protocol {
namespace {

KeyFacts surface_label(const std::string& surface, const std::string& number) {
  KeyFacts facts;
  facts.range = {0, 1e6};
  facts.meaning =
      "what the mesh file calls the " + surface + ": numbers of the label array, or names of physical groups";
  facts.absent = "a name in common use (endo, ENDO_LV, rv_endo, Epicardium, base, top, …) or the number " +
                 number + "; a mesh without known labels is recognised by its shape";
  facts.used_with = "file";
  return facts;
}

Table mesh_table() {
  TableBuilder table("mesh", "Geometry of the ventricle: a mesh file or an idealised shape.",
                     &Protocol::mesh);
  table
      .key("file", &Mesh::file,
           {.meaning =
                "tetrahedral mesh (.vtu, .vtk, Gmsh .msh, openCARP .pts), path relative to the protocol "
                "file (in --set: to the current folder); its shape is taken as free of stress (unloaded) "
                "unless pressure_mmHg says under which pressure it was imaged",
            .absent = "an idealised shape is meshed",
            .path = true})
      .key("length_unit", &Mesh::length_unit,
           {.meaning = "length unit of the coordinates in the mesh file",
            .absent = "required with file, never guessed",
            .used_with = "file"})
      .key(
          "shape", &Mesh::shape,
          {.meaning =
               "idealised shape: truncated ellipsoid human_lv (human-sized left ventricle) or land_ellipsoid "
               "(endocardial semi-axes 7 and 17 mm, epicardial 10 and 20 mm, base at z = 5 mm); "
               "human_biventricle: human-sized left and right ventricle",
           .source = "land_ellipsoid: Land 2015, problem 2",
           .absent = "the mesh is read from file"})
      .key("size_mm", &Mesh::size_mm,
           {.unit = "mm",
            .range = above_zero(50),
            .meaning = "target edge length of the tetrahedra of an idealised shape",
            .absent = "the shape's own size",
            .used_with = "shape"})
      .key("cavity_scale", &Mesh::cavity_scale,
           {.range = {0.5, 2},
            .meaning = "factor on all lengths of the cavity of human_lv: semi-axes of the endocardium and "
                       "height of the base; its volume changes by the third power",
            .source = "convention: the shape as it is",
            .used_with = "shape",
            .used_values = {"human_lv"}})
      .key("wall_scale", &Mesh::wall_scale,
           {.range = {0.3, 3},
            .meaning = "factor on the thickness of the wall of human_lv, 10 mm at the equator, outwards",
            .source = "convention: the shape as it is",
            .used_with = "shape",
            .used_values = {"human_lv"}})
      .key("pressure_mmHg", &Mesh::pressure_kPa,
           {.unit = "mmHg",
            .range = {0, 60},
            .meaning =
                "pressure of the (left) cavity under which the relaxed heart has the shape of the mesh, such "
                "as the end-diastolic pressure at an image of end diastole: the stress-free shape is found "
                "first, and everything is computed on it",
            .source = "Sellier 2011; Rausch et al. 2017",
            .absent = "the shape of the mesh is free of stress"},
           {kPa_per_mmHg})
      .key("right_pressure_mmHg", &Mesh::right_pressure_kPa,
           {.unit = "mmHg",
            .range = {0, 60},
            .meaning = "the same of the right cavity",
            .absent = "0 mmHg, with a warning where there is a right cavity",
            .used_with = "pressure_mmHg",
            .also = {two_ventricles()}},
           {kPa_per_mmHg})
      .key("surface_file", &Mesh::surface_file,
           {.meaning =
                "second file with the labelled surface triangles (.vtu, .vtp, .vtk), in the unit of the "
                "mesh, path relative to the protocol file (in --set: to the current folder)",
            .absent = "the triangles of the mesh file",
            .used_with = "file",
            .path = true})
      .key("surface_files", &Mesh::surface_files,
           {.meaning =
                "files that are one surface each, as \"NAME=FILE\" with NAME endo, epi, base or rv_endo; "
                "unit and paths as of surface_file. Without a file of the base the rest of the boundary "
                "is base",
            .absent = "surface_file, or the triangles of the mesh file",
            .used_with = "file",
            .path = true})
      .key("label_array", &Mesh::label_array,
           {.meaning = "array of triangles, or of points, that holds the surface labels",
            .absent = "the first of the usual names: surface, label, tag, physical (Gmsh), …",
            .used_with = "file"})
      .key("region", &Mesh::region,
           {.range = {0, 1e9},
            .meaning = "tets of the mesh file that are the wall: numbers of their region array, or names of "
                       "physical volumes",
            .absent = "all tets",
            .used_with = "file"})
      .key("region_array", &Mesh::region_array,
           {.meaning = "array of tets that holds their regions",
            .absent = "the first of the usual names: region, material, tag, physical, …",
            .used_with = "region"})
      .key("endo_label", &Mesh::endo_label, surface_label("endocardium (of the left ventricle)", "1"))
      .key("epi_label", &Mesh::epi_label, surface_label("epicardium (outer side)", "2"))
      .key("base_label", &Mesh::base_label, surface_label("base (valve plane)", "3"))
      .key("rv_endo_label", &Mesh::rv_endo_label, surface_label("endocardium of the right ventricle", "4"));
  return table.build_required();
}

Table anatomy_table() {
  TableBuilder table("anatomy", "How the ventricle lies and is divided into segments.", &Protocol::anatomy);
  table
      .key("scheme", &Anatomy::scheme,
           {.meaning = "division into segments: aha17, those of a left ventricle; aha29, with twelve more of "
                       "the right free wall, for a mesh of two ventricles",
            .source = "AHA, Cerqueira 2002",
            .absent = "aha29 with shape human_biventricle and with a mesh file of two ventricles (a right "
                      "endocardium), else aha17"})
      .key("long_axis", &Anatomy::long_axis,
           {.meaning = "direction from apex to base in mesh coordinates, of any length",
            .absent =
                "from the apex of the cavity to the centre of the base (of the mitral opening), found on "
                "the mesh; the normal of a flat base where both agree within 3°"})
      .key(
          "anterior_direction", &Anatomy::anterior_direction,
          {.meaning =
               "direction from the long axis to the anterior wall in mesh coordinates, of any length; "
               "its part across the long axis counts, so it must not be parallel to it; a right ventricle "
               "tells where anterior is, and this is not used",
           .source = "convention: the idealised shapes have their anterior wall at +y",
           .absent = "told by septum_point or rv_insertion_point; else +y, with a warning unless the wall is "
                     "the same all round the z axis",
           .also = {one_ventricle()}})
      .key("septum_point", &Anatomy::septum_point,
           {.meaning = "a point in the middle of the septum (the border of segments 2 and 3), in mesh "
                       "coordinates and unit; instead of anterior_direction",
            .absent = "anterior_direction tells",
            .also = {one_ventricle()}})
      .key("rv_insertion_point", &Anatomy::rv_insertion_point,
           {.meaning = "a point of the anterior insertion of the right ventricle (the border of segments 1 "
                       "and 2), in mesh coordinates and unit; instead of anterior_direction",
            .source = "AHA, Cerqueira 2002",
            .absent = "anterior_direction tells",
            .also = {one_ventricle()}})
      .key(
          "mitral_point", &Anatomy::mitral_point,
          {.meaning = "a point near the mitral opening, in mesh coordinates and unit: of several openings of "
                      "the left cavity the nearest one is the mitral, to which the long axis runs",
           .absent = "the largest opening is the mitral one"});
  return table.build();
}

}  // namespace

std::vector<Table> heart_tables() {
  return {mesh_table(), anatomy_table()};
}

}  // namespace cardiac::protocol
