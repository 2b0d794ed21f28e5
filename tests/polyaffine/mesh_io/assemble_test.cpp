#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numeric>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/tet_faces.hpp>
#include <polyaffine/mesh_io/assemble.hpp>

#include "support/error_of.hpp"
#include "support/labelled_box.hpp"
#include "support/mesh_writers.hpp"

namespace polyaffine {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

MeshData box() {
  MeshData out = testing_io::data_of(testing::labelled_cube(2, 0.1));
  out.source = "box.msh";
  return out;
}

MeshFile made(const MeshData& data, double mm_per_unit = 1) {
  return assemble(data, labelled_surface(data, ""), mm_per_unit);
}

std::string refusal(const std::function<void(MeshData&)>& damage) {
  MeshData data = box();
  damage(data);
  return testing::error_of([&] { made(data); });
}

TEST(Assemble, AValidMeshComesThroughAsItIs) {
  const MeshData data = box();
  const MeshFile out = made(data, 10);
  EXPECT_EQ(out.mesh.points(), 10 * data.points);
  EXPECT_EQ(out.mesh.tets(), data.tets);
  for (int label = 1; label <= 6; ++label) EXPECT_EQ(out.mesh.surface({label}).cols(), 8);
  EXPECT_THAT(out.notes, IsEmpty());
}

TEST(Assemble, MirroredTetsAreTurned) {
  MeshData data = box();
  for (const int t : {0, 7, 11}) data.tets.col(t).head(2).reverseInPlace();
  const MeshFile out = made(data);
  EXPECT_NEAR(out.mesh.volume(), 1, 1e-12);
  EXPECT_THAT(out.notes, Contains(HasSubstr("3 tets turned")));
  data = box();
  data.tets.row(0).swap(data.tets.row(1));
  EXPECT_NEAR(made(data).mesh.volume(), 1, 1e-12);
}

TEST(Assemble, PointsInTheSamePlaceAreJoined) {
  // Every tet on points of its own, apart by rounding.
  const MeshData data = box();
  MeshData split = data;
  split.points.resize(3, 4 * data.tets.cols());
  for (Eigen::Index i = 0; i < data.tets.size(); ++i) {
    split.points.col(i) = data.points.col(data.tets.data()[i]) + 1e-9 * Vec3::Random();
    split.tets.data()[i] = static_cast<int>(i);
  }
  const MeshFile out = assemble(split, labelled_surface(data, ""), 1);
  EXPECT_EQ(out.mesh.num_points(), data.points.cols());
  EXPECT_EQ(out.mesh.surface({3}).cols(), 8);
  EXPECT_THAT(out.notes, Contains(HasSubstr("joined")));
}

TEST(Assemble, FieldsFollowTheirPoints) {
  MeshData data = box();
  const Eigen::Index n = data.points.cols();
  Points more(3, n + 2);
  more << Vec3(7, 7, 7), data.points, data.points.col(0);
  data.points = more;
  data.tets.array() += 1;
  data.triangles.array() += 1;
  std::ranges::replace(data.tets.reshaped(), 1, static_cast<int>(n) + 1);
  data.point_fields["position"] = data.points;
  data.tet_fields["centre"] = Matrix(3, data.tets.cols());
  for (Eigen::Index t = 0; t < data.tets.cols(); ++t)
    data.tet_fields["centre"].col(t) = data.points(Eigen::all, data.tets.col(t)).rowwise().mean();
  const MeshFile out = made(data);
  EXPECT_EQ(out.mesh.num_points(), n);
  EXPECT_EQ(out.point_fields.at("position"), out.mesh.points());
  for (int t = 0; t < out.mesh.num_tets(); ++t)
    EXPECT_LT((out.cell_fields.at("centre").col(t) - out.mesh.tet_centroid(t)).norm(), 1e-12);
}

TEST(Assemble, TrianglesInsideTheWallAreLeftOut) {
  MeshData data = box();
  const Eigen::Index n = data.triangles.cols();
  data.triangles.conservativeResize(3, n + 4);
  data.triangle_fields["physical"].conservativeResize(1, n + 4);
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 3; ++i) data.triangles(i, n + k) = data.tets(kTetFaces[k][i], 0);
    data.triangle_fields["physical"](0, n + k) = 1;
  }
  EXPECT_THAT(made(data).notes, Contains(HasSubstr("inside the wall left out")));
}

/// A triangle more, off the box or on a face of it, with a label.
void add_triangle(MeshData& data, const Eigen::Vector3i& corners, int label) {
  const Eigen::Index n = data.triangles.cols();
  data.triangles.conservativeResize(3, n + 1);
  data.triangles.col(n) = corners;
  data.triangle_fields["physical"].conservativeResize(1, n + 1);
  data.triangle_fields["physical"](0, n) = label;
}

TEST(Assemble, OptionalTrianglesThatAreNoFacesAreLeftOut) {
  MeshData data = box();
  const MeshFile plain = made(data);
  const auto lost = static_cast<int>(data.points.cols());
  data.points.conservativeResize(3, lost + 1);
  data.points.col(lost) = Vec3(9, 9, 9);
  add_triangle(data, {0, 13, 26}, 7);
  add_triangle(data, {0, 1, lost}, 7);
  SurfaceData surface = labelled_surface(data, "");
  surface.optional = {7};
  const MeshFile out = assemble(data, surface, 1);
  EXPECT_EQ(out.mesh.boundary_labels(), plain.mesh.boundary_labels());
  EXPECT_THAT(out.notes, Contains(HasSubstr("2 triangles with label 7 left out")));
  surface.optional = {};
  EXPECT_THROW(assemble(data, surface, 1), InputError);
}

TEST(Assemble, SurfacesThatAreAllAwayAreRefusedEvenWhenOptional) {
  const MeshData volume = box();
  MeshData surface = box();
  surface.points.array() *= 1000;
  SurfaceData labels = labelled_surface(surface, "");
  labels.optional = {1, 2, 3, 4, 5, 6};
  EXPECT_THROW(assemble(volume, labels, 1), InputError);
}

TEST(Assemble, OfTwoLabelsOfATriangleThatWhichIsNotOptionalCounts) {
  for (const bool first : {true, false}) {
    MeshData data = box();
    const MeshFile plain = made(data);
    for (const int t : {0, 5}) add_triangle(data, data.triangles.col(t).reverse(), 9);
    if (first) {
      data.triangles = Triangles(data.triangles.rowwise().reverse());
      data.triangle_fields["physical"] = Matrix(data.triangle_fields["physical"].rowwise().reverse());
    }
    SurfaceData surface = labelled_surface(data, "");
    surface.optional = {9};
    const MeshFile out = assemble(data, surface, 1);
    EXPECT_EQ(out.mesh.boundary_labels(), plain.mesh.boundary_labels());
    EXPECT_THAT(out.notes, Contains(HasSubstr("2 repeated triangles left out")));
  }
  MeshData data = box();
  const MeshFile plain = made(data);
  add_triangle(data, data.triangles.col(0), 9);
  const MeshFile out = made(data);
  EXPECT_EQ(out.mesh.boundary_labels(), plain.mesh.boundary_labels());
  EXPECT_THAT(out.notes, Contains(HasSubstr("1 triangles are listed with two labels: the first one counts")));
}

TEST(Assemble, LabelsThatAreNotNumbersAreNone) {
  MeshData data = box();
  data.triangle_fields["physical"](0, 3) = std::numeric_limits<double>::quiet_NaN();
  const SurfaceData surface = labelled_surface(data, "");
  EXPECT_EQ(surface.labels[3], TetMesh::kUnlabelled);
  EXPECT_THAT(surface.notes, Contains(HasSubstr("1 triangles whose label is not a number")));
}

TEST(Assemble, RefusalsNameFileAndPlace) {
  EXPECT_THAT(refusal([](MeshData& m) { m.points(1, 3) = std::nan(""); }),
              AllOf(HasSubstr("box.msh: "), HasSubstr("point 3"), HasSubstr("not a number")));
  EXPECT_THAT(refusal([](MeshData& m) { m.points.setZero(); }), HasSubstr("all points in one place"));
  EXPECT_THAT(refusal([](MeshData& m) { m.tets.resize(4, 0); }), HasSubstr("no tetrahedra"));
  // A vertex pushed through the opposite face turns its tets over: numbering is not to blame.
  EXPECT_THAT(refusal([](MeshData& m) { m.points.col(13) += Vec3(2, 0, 0); }),
              AllOf(HasSubstr("is inverted"), HasSubstr("near ("), HasSubstr("mm")));
  EXPECT_THAT(refusal([](MeshData& m) {
                m.points.col(m.tets(0, 5)) = m.points(Eigen::all, m.tets.col(5).tail(3)).rowwise().mean();
              }),
              AllOf(HasSubstr("is flat"), HasSubstr("near (")));
  EXPECT_THAT(refusal([](MeshData& m) { m.tets(0, 5) = m.tets(1, 5); }), HasSubstr("is flat"));
  EXPECT_THAT(refusal([](MeshData& m) {
                m.tets.conservativeResize(4, m.tets.cols() + 1);
                m.tets.rightCols(1) = m.tets.col(4);
              }),
              HasSubstr("is inverted"))
      << "a tet given twice lies on the same side as itself";
  EXPECT_THAT(refusal([](MeshData& m) {
                const Eigen::Index t = m.tets.cols(), p = m.points.cols();
                m.tets.conservativeResize(4, t + 1);
                m.points.conservativeResize(3, p + 4);
                m.points.rightCols(4) << 5, 6, 5, 5, 5, 5, 6, 5, 5, 5, 5, 6;
                for (int k = 0; k < 4; ++k) m.tets(k, t) = static_cast<int>(p) + k;
              }),
              AllOf(HasSubstr("is isolated"), HasSubstr("near (5.25, 5.25, 5.25)")));
  EXPECT_THAT(refusal([](MeshData& m) { m.triangles.col(0) = Eigen::Vector3i(0, 13, 26); }),
              AllOf(HasSubstr("triangle 0"), HasSubstr("not a face of the boundary")));
  EXPECT_THAT(refusal([](MeshData& m) { m.triangle_fields["physical"](0, 2) = 0.5; }),
              AllOf(HasSubstr("\"physical\""), HasSubstr("expected an integer")));
  EXPECT_THAT(
      refusal([](MeshData& m) { m.point_fields["f"] = Matrix::Constant(1, m.points.cols(), std::nan("")); }),
      AllOf(HasSubstr("\"f\""), HasSubstr("not a finite number")));
}

/// Tets of the box around a list of kept cells of 1/2 mm.
MeshData without(const std::function<bool(const Vec3&)>& gone) {
  MeshData data = testing_io::data_of(testing::labelled_cube(2));
  data.source = "box.msh";
  std::vector<int> kept;
  for (int t = 0; t < static_cast<int>(data.tets.cols()); ++t)
    if (!gone(data.points(Eigen::all, data.tets.col(t)).rowwise().mean())) kept.push_back(t);
  data.tets = Tets(data.tets(Eigen::all, kept));
  data.triangles.resize(3, 0);
  return data;
}

TEST(Assemble, BoundariesThatAreNoSurfacesAreRefused) {
  const auto refused = [](const MeshData& data) {
    try {
      assemble(data, {data}, 1);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  // Columns over two opposite quarters are missing: the rest touches along the middle line.
  const MeshData edge = without([](const Vec3& x) { return (x.x() < 0.5) == (x.y() < 0.5) && x.z() < 0.5; });
  EXPECT_THAT(refused(edge),
              AllOf(HasSubstr("not manifold"), HasSubstr("edge"), HasSubstr("(0.5, 0.5, 0.25) mm")));
  // Two opposite cells are missing: the holes touch in the middle.
  const MeshData point =
      without([](const Vec3& x) { return (x.x() < 0.5) == (x.y() < 0.5) && (x.x() < 0.5) == (x.z() < 0.5); });
  EXPECT_THAT(refused(point), AllOf(HasSubstr("not manifold"), HasSubstr("(0.5, 0.5, 0.5) mm")));
}

TEST(Assemble, ASecondFileIsJoinedByPosition) {
  const MeshData volume = box();
  MeshData surface = box();
  surface.source = "labels.vtp";
  surface.tets.resize(4, 0);
  // Other points in another order.
  std::vector<int> order(surface.points.cols());
  std::iota(order.rbegin(), order.rend(), 0);
  surface.points = Points(volume.points(Eigen::all, order));
  for (int& p : surface.triangles.reshaped()) p = static_cast<int>(order.size()) - 1 - p;
  const MeshFile out = assemble(volume, labelled_surface(surface, "physical"), 1);
  EXPECT_EQ(out.mesh.boundary_labels(), made(volume).mesh.boundary_labels());
  surface.points.array() *= 1000;
  try {
    assemble(volume, labelled_surface(surface, ""), 1);
    FAIL() << "in another unit";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("labels.vtp"), HasSubstr("away from every tet vertex")));
  }
}

}  // namespace
}  // namespace polyaffine
