#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <polyaffine/vtk/read.hpp>
#include <set>

#include "program.hpp"

namespace {

using polyaffine::Matrix;
using polyaffine::Vec3;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kLand = PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu";

class SegmentCommand : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_.path / "segments.vtu"; }
  ProgramRun segment(const std::string& options) const {
    return run_program("segment " + kLand + " --out " + file().string() + ' ' + options);
  }
  polyaffine::MeshFile written() const { return polyaffine::read_mesh_file(file(), 1, {.fields = true}); }

  TemporaryFolder folder_;
};

/// The segment by the standard's definition, written out for the Land ellipsoid: cavity from z = −17 to 5 mm,
/// anterior at +y, septum at +x.
int expected_segment(const Vec3& x) {
  const double height = (x.z() + 17) / 22;
  if (height < 0) return 17;
  double degrees = std::atan2(x.x(), x.y()) * 180 / polyaffine::kPi;
  if (degrees < 0) degrees += 360;
  if (height < 1.0 / 3) return 13 + static_cast<int>((degrees + 45) / 90) % 4;
  return (height < 2.0 / 3 ? 7 : 1) + static_cast<int>((degrees + 30) / 60) % 6;
}

TEST_F(SegmentCommand, WritesSegmentsCoordinatesAxesAndFibres) {
  const auto run = segment("--scheme aha17 --length-unit mm --endo-angle 50 --epi-angle -40");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, IsEmpty());
  auto result = written();
  const auto& mesh = result.mesh;

  // The mesh is faceted and its rim a polygon, so the axis and the height are off by about 1e-3 of the size.
  int differ = 0;
  for (int t = 0; t < mesh.num_tets(); ++t)
    differ += result.cell_fields.at("segment")(0, t) != expected_segment(mesh.tet_centroid(t));
  EXPECT_LE(differ, mesh.num_tets() / 100);

  std::set<int> nodes;
  for (const double n : result.cell_fields.at("control_node").reshaped()) nodes.insert(static_cast<int>(n));
  EXPECT_EQ(nodes.size(), 18U) << "0 and each of the 17 nodes";
  for (int t = 0; t < mesh.num_tets(); ++t)
    EXPECT_NEAR(result.cell_fields.at("fibre").col(t).norm(), 1, 1e-12);

  auto& points = result.point_fields;
  for (int p = 0; p < mesh.num_points(); ++p) {
    polyaffine::Mat3 axes;
    axes << points["e_l"].col(p), points["e_c"].col(p), points["e_r"].col(p);
    EXPECT_LT((axes.transpose() * axes - polyaffine::Mat3::Identity()).norm(), 1e-9);
    EXPECT_NEAR(points["rotational_rad"](0, p), std::atan2(mesh.points()(0, p), mesh.points()(1, p)), 0.02)
        << "about an axis that lies within 0.02 of the radius of the mesh's points";
  }
  // On the surfaces the coordinates are the Dirichlet values, exact but for the solver.
  const auto helix = [&](int p) {
    const Vec3 f = points["fibre"].col(p);
    return std::atan2(f.dot(points["e_l"].col(p)), f.dot(points["e_c"].col(p))) * 180 / polyaffine::kPi;
  };
  for (const int p : mesh.surface_points({1})) {
    EXPECT_NEAR(points["transmural"](0, p), 0, 1e-9);
    EXPECT_NEAR(helix(p), 50, 1e-6);
  }
  for (const int p : mesh.surface_points({2})) {
    EXPECT_NEAR(points["transmural"](0, p), 1, 1e-9);
    EXPECT_NEAR(helix(p), -40, 1e-6);
  }
  for (const int p : mesh.surface_points({3})) EXPECT_NEAR(points["apicobasal"](0, p), 1, 1e-9);
}

TEST_F(SegmentCommand, PrintsATableThatAddsUpToTheWall) {
  const auto run = segment("--scheme aha17 --length-unit cm");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto mesh = written().mesh;
  const auto given = polyaffine::read_vtu(kLand, 1);
  // A .vtu holds doubles: ten times the coordinates but for rounding.
  EXPECT_NEAR(mesh.volume(), 1000 * given.volume(), 1e-9 * mesh.volume());
  std::istringstream lines(run.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, testing::AllOf(HasSubstr("volume_mL"), HasSubstr("tets"), HasSubstr("node_x_mm")));
  double volume_mL = 0;
  int tets = 0;
  for (int s = 1; s <= 17; ++s) {
    std::getline(lines, line);
    EXPECT_EQ(std::stoi(line), s);
    std::istringstream row(line.substr(30));
    double v = 0, n = 0;
    row >> v >> n;
    EXPECT_GT(n, 0) << line;
    volume_mL += v;
    tets += static_cast<int>(n);
  }
  EXPECT_EQ(tets, mesh.num_tets());
  EXPECT_NEAR(volume_mL, mesh.volume() / 1000, 17 * 5e-5) << "17 numbers with four decimals";
  EXPECT_THAT(run.out, HasSubstr("apex"));
}

TEST_F(SegmentCommand, DirectionsTurnTheSegments) {
  ASSERT_EQ(segment("--scheme aha17 --length-unit mm --anterior 1 0 0 --long-axis 0 0 2").status, 0);
  const auto result = written();
  int differ = 0;
  for (int t = 0; t < result.mesh.num_tets(); ++t) {
    const Vec3 x = result.mesh.tet_centroid(t);
    differ += result.cell_fields.at("segment")(0, t) != expected_segment({-x.y(), x.x(), x.z()});
  }
  EXPECT_LE(differ, result.mesh.num_tets() / 100);
}

TEST_F(SegmentCommand, ThePictureNumbersTheSegmentsThatAreSeen) {
  const auto svg = folder_.path / "segments.svg";
  const ProgramRun run = run_program("segment " PROJECT_DIR
                                     "/meshes/healthy_biv_coarse.vtu --scheme aha29 --length-unit mm --out " +
                                     file().string() + " --picture " + svg.string());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("touching both endocardia  segments 2 3 8 9 14"));
  const std::string text = whole_file(svg);
  std::multiset<int> numbers;
  for (std::size_t at = text.find("<text"); at != std::string::npos; at = text.find("<text", at + 1)) {
    const std::string content = text.substr(text.find('>', at) + 1, 2);
    if (std::isdigit(static_cast<unsigned char>(content[0]))) numbers.insert(std::stoi(content));
  }
  // The section shows the middle ring of either ventricle, the septum only there; the free walls are seen
  // from outside.
  for (const int s : {7, 8, 9, 10, 11, 12, 22, 23, 24, 25}) EXPECT_TRUE(numbers.contains(s)) << s;
  for (const int s : {1, 4, 13, 15, 17, 18, 21, 29}) EXPECT_TRUE(numbers.contains(s)) << s;
  EXPECT_LE(numbers.count(8), 2);
  EXPECT_EQ(segment("--scheme aha17 --length-unit mm --picture segments.png").status, 2);
}

TEST_F(SegmentCommand, WrongInputIsStatusTwoAndTouchesNothing) {
  std::ofstream(file()) << "earlier";
  const std::string sound = "--scheme aha17 --length-unit mm";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"--scheme aha29 --length-unit mm", "no right endocardium"},
      {"--scheme aha16 --length-unit mm", "expected aha17"},
      {"--scheme aha17", "--length-unit"},
      {"--scheme aha17 --length-unit inch", "expected the length unit of the mesh: mm, cm, m or um"},
      {"--length-unit mm", "--scheme"},
      {sound + " --endo-label 9", "label 9"},
      {sound + " --label-array faces", "\"faces\""},
      {sound + " --anterior 0 0 1", "parallel to the long axis"},
      {sound + " --anterior 0 0 0", "--anterior: found"},
      {sound + " --anterior 1 0", "--anterior"},
      {sound + " --long-axis nan 0 1", "--long-axis: found"},
      {sound + " --long-axis 0 0 -1", "expected a direction from apex to base"},
      {sound + " --septum-point 0 0 -18", "on the long axis"},
      {sound + " --endo-angle 120", "--endo-angle"},
      {sound + " --epi-angle nan", "--epi-angle"}};
  for (const auto& [options, message] : cases) {
    const auto run = segment(options);
    EXPECT_EQ(run.status, 2) << options;
    EXPECT_THAT(run.err, HasSubstr(message)) << options;
    EXPECT_THAT(run.out, IsEmpty()) << options;
  }
  EXPECT_EQ(run_program("segment none.vtu " + sound + " --out " + file().string()).status, 2);
  const std::string into = "segment " + kLand + ' ' + sound + " --out ";
  for (const std::string& out :
       {(folder_.path / "segments.csv").string(), folder_.path.string() + "/no/a.vtu"}) {
    const auto run = run_program(into + out);
    EXPECT_EQ(run.status, 2) << out;
    EXPECT_THAT(run.err, HasSubstr("--out"));
  }
  const auto copy = folder_.path / "copy.vtu";
  std::filesystem::copy_file(kLand, copy);
  EXPECT_THAT(run_program("segment " + copy.string() + ' ' + sound + " --out " + copy.string()).err,
              HasSubstr("--out: found \"" + copy.string() + "\", the file that is read"));
  EXPECT_EQ(whole_file(copy), whole_file(kLand));
  std::filesystem::remove(copy);
  EXPECT_EQ(whole_file(file()), "earlier");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path), {}), 1);
}

}  // namespace
