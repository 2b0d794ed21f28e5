#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/vtk/read.hpp>
#include <polyaffine/vtk/write.hpp>

#include "program.hpp"
#include "support/mesh_writers.hpp"
#include "support/shuffled.hpp"

namespace {

namespace fs = std::filesystem;
using polyaffine::Matrix;
using polyaffine::MeshData;
using polyaffine::TetMesh;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kLand = PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu";

const TetMesh& land() {
  static const TetMesh mesh = polyaffine::read_vtu(kLand, 1);
  return mesh;
}

MeshData land_data() {
  MeshData out = testing_io::data_of(land());
  out.surface_names = {{1, "ENDO"}, {2, "EPI"}, {3, "BASE"}};
  out.tet_fields["fibre"] = Matrix::Random(3, out.tets.cols());
  out.tet_fields["fibre"].colwise().normalize();
  return out;
}

class ImportCommand : public testing::Test {
 protected:
  fs::path in(const std::string& name) const { return folder_.path / name; }
  ProgramRun import(const std::string& file, const std::string& options = "--length-unit mm") const {
    return run_program("mesh import " + in(file).string() + " --out " + in("out.vtu").string() + ' ' +
                       options);
  }
  polyaffine::MeshFile written() const {
    return polyaffine::read_mesh_file(in("out.vtu"), 1, {.fields = true});
  }

  TemporaryFolder folder_;
};

/// The label of each boundary triangle by its centre, so that meshes in another order can be compared.
std::map<std::array<long, 3>, int> labels_by_place(const TetMesh& mesh) {
  std::map<std::array<long, 3>, int> out;
  for (Eigen::Index f = 0; f < mesh.boundary().cols(); ++f) {
    const polyaffine::Vec3 x = mesh.points()(Eigen::all, mesh.boundary().col(f)).rowwise().mean();
    out[{std::lround(1e3 * x.x()), std::lround(1e3 * x.y()), std::lround(1e3 * x.z())}] =
        mesh.boundary_labels()[f];
  }
  return out;
}

TEST_F(ImportCommand, EveryFormatGivesTheSameHeartAndSegments) {
  using namespace testing_io;
  const MeshData data = land_data();
  write_gmsh_2(in("text2.msh"), data, false);
  write_gmsh_2(in("binary2.msh"), data, true);
  write_gmsh_4(in("text4.msh"), data, false);
  write_gmsh_4(in("binary4.msh"), data, true);
  write_opencarp(in("carp.pts"), data);
  write_legacy_vtk(in("legacy.vtk"), data);
  fs::copy_file(kLand, in("xml.vtu"));
  std::map<std::array<long, 3>, int> segments;
  for (const char* file :
       {"xml.vtu", "text2.msh", "binary2.msh", "text4.msh", "binary4.msh", "carp.pts", "legacy.vtk"}) {
    const ProgramRun run = import(file);
    ASSERT_EQ(run.status, 0) << file << run.err;
    EXPECT_THAT(run.err, IsEmpty()) << file;
    const polyaffine::MeshFile heart = written();
    EXPECT_NEAR(heart.mesh.volume(), land().volume(), 1e-9 * land().volume()) << file;
    EXPECT_EQ(labels_by_place(heart.mesh), labels_by_place(land())) << file;
    if (std::string(file).ends_with(".msh") || std::string(file) == "carp.pts") {
      EXPECT_LT((heart.cell_fields.at("fibre") - data.tet_fields.at("fibre")).norm(), 1e-3) << file;
    }
    // The file itself, as `segment` reads it.
    const ProgramRun cut =
        run_program("segment " + in(file).string() + " --scheme aha17 --length-unit mm --out " +
                    in("segments.vtu").string());
    ASSERT_EQ(cut.status, 0) << file << cut.err;
    const auto result = polyaffine::read_mesh_file(in("segments.vtu"), 1, {.fields = true});
    std::map<std::array<long, 3>, int> found;
    for (int t = 0; t < result.mesh.num_tets(); ++t) {
      const polyaffine::Vec3 x = result.mesh.tet_centroid(t);
      found[{std::lround(1e3 * x.x()), std::lround(1e3 * x.y()), std::lround(1e3 * x.z())}] =
          static_cast<int>(result.cell_fields.at("segment")(0, t));
    }
    if (segments.empty()) segments = found;
    EXPECT_EQ(found, segments) << file;
  }
}

TEST_F(ImportCommand, ShapeAloneIsEnough) {
  polyaffine::write_vtu(in("bare.vtu"), TetMesh(land().points(), land().tets()));
  const ProgramRun run = import("bare.vtu");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("recognised from the shape"), HasSubstr("cavity_volume_mL"),
                             HasSubstr("wall_volume_mL")));
  EXPECT_EQ(labels_by_place(written().mesh), labels_by_place(land()));
}

TEST_F(ImportCommand, LabelsFromASecondFileUnderOtherNumbers) {
  polyaffine::write_vtu(in("bare.vtu"), TetMesh(land().points(), land().tets()));
  std::vector<int> numbers = land().boundary_labels();
  for (int& n : numbers) n *= 10;
  polyaffine::write_vtu(in("labels.vtu"), land().with_labels(numbers));
  const std::string second = "--length-unit mm --surface-file " + in("labels.vtu").string();
  const ProgramRun said = import("bare.vtu", second + " --endo-label 10 --epi-label 20 --base-label 30");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(labels_by_place(written().mesh), labels_by_place(land()));
  const ProgramRun guessed = import("bare.vtu", second);
  ASSERT_EQ(guessed.status, 0) << guessed.err;
  EXPECT_THAT(guessed.out, HasSubstr("10 is endocardium, 20 is epicardium, 30 is base"));
  EXPECT_EQ(labels_by_place(written().mesh), labels_by_place(land()));
}

TEST_F(ImportCommand, RepairsAreSaidAndUnitsKept) {
  MeshData data = land_data();
  data.points /= 1000;
  data.tets.col(3).head(2).reverseInPlace();
  testing_io::write_gmsh_4(in("metres.msh"), data, true);
  const ProgramRun run = import("metres.msh", "--length-unit m");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("1 tets turned"));
  EXPECT_NEAR(written().mesh.volume(), land().volume(), 1e-9 * land().volume());
}

TEST_F(ImportCommand, AWallOfNoHeartsSizeIsRefusedUnlessForced) {
  testing_io::write_opencarp(in("heart.pts"), land_data());
  const ProgramRun run = import("heart.elem", "--length-unit m");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err,
              AllOf(HasSubstr("--length-unit: the wall has "), HasSubstr(" mL in m, "),
                    HasSubstr("expected 0.015 to 10000 mL"), HasSubstr(" mL in mm"), HasSubstr("--force")));
  const ProgramRun forced = import("heart.elem", "--length-unit m --force");
  ASSERT_EQ(forced.status, 0) << forced.err;
  EXPECT_THAT(forced.err, AllOf(HasSubstr("warning"), HasSubstr("--length-unit: the wall has ")));
}

// A closed surface is held to the bounds before it is filled, by the unit of its file.
TEST_F(ImportCommand, AClosedSurfaceOfNoHeartsSizeIsRefused) {
  testing_io::write_stl(in("heart.stl"), land_data(), true);
  const ProgramRun run = import("heart.stl", "--length-unit m");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("--length-unit: the wall has "), HasSubstr(" mL in m, "),
                             HasSubstr(" mL in mm")));
}

TEST_F(ImportCommand, FieldsOnRequest) {
  polyaffine::WriteFields fields;
  fields.point_fields["fiber"] = Matrix::Random(3, land().num_points());
  fields.point_fields["temperature"] = Matrix::Random(1, land().num_points());
  polyaffine::write_vtu(in("fields.vtu"), land(), fields);
  ASSERT_EQ(import("fields.vtu").status, 0);
  EXPECT_EQ(written().point_fields.at("fibre"), fields.point_fields["fiber"]);
  EXPECT_FALSE(written().point_fields.contains("temperature"));
  ASSERT_EQ(import("fields.vtu", "--length-unit mm --keep-fields").status, 0);
  EXPECT_EQ(written().point_fields.at("temperature"), fields.point_fields["temperature"]);
}

TEST_F(ImportCommand, AClosedSurfaceIsFilledLabelledAndBeats) {
  const TetMesh heart = polyaffine::read_vtu(PROJECT_DIR "/meshes/healthy_lv.vtu", 1);
  testing_io::write_stl(in("heart.stl"), testing_io::data_of(heart), true);
  const ProgramRun run = import("heart.stl", "--length-unit mm --size 8");
  if (run.status == 2 && run.err.find("POLYAFFINE_WITH_CGAL") != std::string::npos) GTEST_SKIP() << run.err;
  ASSERT_EQ(run.status, 0) << run.err;
  const TetMesh filled = written().mesh;
  EXPECT_NEAR(filled.volume(), heart.volume(), 0.03 * heart.volume());
  const auto cavity = [](const TetMesh& mesh) {
    return polyaffine::EnclosedVolume(mesh, {1}).value(mesh.points());
  };
  EXPECT_NEAR(cavity(filled), cavity(heart), 0.03 * cavity(heart));
  const std::string protocol = PROJECT_DIR "/protocols/healthy_lv.toml";
  const ProgramRun beat = run_program("run " + protocol + " --set mesh.file=" + in("out.vtu").string() +
                                      " --set time.max_beats=1 --out " + in("beat").string());
  EXPECT_EQ(beat.status, 0) << beat.err;
  EXPECT_THAT(beat.out, HasSubstr("EF"));
}

/// XML polydata with a label of each triangle.
void write_vtp(const fs::path& file, const TetMesh& mesh, const std::string& name,
               const std::vector<int>& labels) {
  std::ofstream out(file);
  out.precision(17);
  const Eigen::Index n = mesh.boundary().cols();
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><Piece "
         "NumberOfPoints=\""
      << mesh.num_points() << "\" NumberOfPolys=\"" << n
      << "\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
      << mesh.points().transpose()
      << "</DataArray></Points><Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">"
      << mesh.boundary().transpose()
      << "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">";
  for (Eigen::Index f = 1; f <= n; ++f) out << 3 * f << ' ';
  out << "</DataArray></Polys><CellData><DataArray type=\"Int32\" Name=\"" << name << "\" format=\"ascii\">";
  for (const int label : labels) out << label << ' ';
  out << "</DataArray></CellData></Piece></PolyData></VTKFile>\n";
}

TEST_F(ImportCommand, LabelsOfAClosedSurfaceAreCarriedOver) {
  const TetMesh heart = polyaffine::read_vtu(PROJECT_DIR "/meshes/healthy_lv.vtu", 1);
  // Numbers of the file's own; a part of the epicardium is labelled by hand, as no shape tells it.
  const auto is_patch = [&](const polyaffine::Vec3& x) { return x.x() > 15 && x.z() < 0; };
  std::vector<int> labels;
  for (Eigen::Index f = 0; f < heart.boundary().cols(); ++f) {
    const int label = heart.boundary_labels()[f];
    const polyaffine::Vec3 x = heart.points()(Eigen::all, heart.boundary().col(f)).rowwise().mean();
    labels.push_back(label == 2 && is_patch(x) ? 77 : 10 * label);
  }
  write_vtp(in("heart.vtp"), heart, "part", labels);
  const std::string options =
      "--length-unit mm --size 8 --label-array part --endo-label 10 --epi-label 20 --base-label 30";
  const ProgramRun run = import("heart.vtp", options);
  if (run.status == 2 && run.err.find("POLYAFFINE_WITH_CGAL") != std::string::npos) GTEST_SKIP() << run.err;
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("labels \"part\" of the surface carried over"), HasSubstr("label 77"),
                             HasSubstr("unlabelled")));
  const TetMesh filled = written().mesh;
  const auto area = [](const TetMesh& mesh, int label) { return polyaffine::surface_area(mesh, {label}); };
  for (const int label : {1, 3})
    EXPECT_NEAR(area(filled, label), area(heart, label), 0.03 * area(heart, label)) << label;
  double patch = 0;
  const polyaffine::Vector areas = polyaffine::triangle_areas(heart.points(), heart.boundary());
  for (std::size_t f = 0; f < labels.size(); ++f)
    if (labels[f] == 77) patch += areas[static_cast<Eigen::Index>(f)];
  EXPECT_GT(patch, 500);
  EXPECT_NEAR(area(filled, TetMesh::kUnlabelled), patch, 0.1 * patch);
  EXPECT_NEAR(area(filled, 2), area(heart, 2) - patch, 0.05 * area(heart, 2));

  const ProgramRun wrong = import("heart.vtp", "--length-unit mm --size 8 --label-array parts");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, AllOf(HasSubstr("\"parts\""), HasSubstr("part")));
}

}  // namespace
