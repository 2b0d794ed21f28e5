#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/mesh_io/assemble.hpp>
#include <polyaffine/mesh_io/point_labels.hpp>

#include "support/labelled_box.hpp"
#include "support/mesh_writers.hpp"

namespace polyaffine {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

/// Points of a box of 3 × 3 × 3 cells, those of one side with a label of their own.
MeshData box_with_lid() {
  MeshData data = testing_io::data_of(testing::labelled_cube(3));
  data.triangle_fields.clear();
  Matrix& part = data.point_fields["part"] = Matrix::Constant(1, data.points.cols(), 7);
  for (Eigen::Index p = 0; p < data.points.cols(); ++p)
    if (data.points(2, p) > 1 - 1e-9) part(0, p) = 9;
  return data;
}

TEST(PointLabels, BordersLieOnSharpEdges) {
  for (const bool own_triangles : {true, false}) {
    MeshData data = box_with_lid();
    if (!own_triangles) data.triangles.resize(3, 0);
    label_triangles_by_points(data, "part");
    const MeshFile out = assemble(data, labelled_surface(data, "part"), 1);
    EXPECT_NEAR(surface_area(out.mesh, {9}), 1, 1e-12);
    EXPECT_NEAR(surface_area(out.mesh, {7}), 5, 1e-12);
    EXPECT_THAT(data.notes, Contains(AllOf(HasSubstr("\"part\""), HasSubstr("84 by all three corners"),
                                           HasSubstr("24 on borders"))));
  }
}

TEST(PointLabels, WhatNoNeighbourReachesFollowsMostCornersOrTheRarestLabel) {
  MeshData data;
  data.points = Points::Random(3, 6);
  data.triangles.resize(3, 3);
  data.triangles.transpose() << 0, 1, 2, 0, 1, 3, 2, 4, 5;
  data.point_fields["part"] = (Matrix(1, 6) << 7, 7, 7, 8, 8, 9).finished();
  label_triangles_by_points(data, "part");
  // The second has 8 at one corner and 7 across its edge; the third has three labels and no neighbour.
  EXPECT_EQ(data.triangle_fields.at("part"), (Matrix(1, 3) << 7, 7, 9).finished());
}

TEST(PointLabels, OfNoTriangleAloneAreThoseOfTwoCorners) {
  MeshData data;
  data.points = Points::Random(3, 4);
  data.triangles.resize(3, 2);
  data.triangles.transpose() << 0, 1, 2, 1, 2, 3;
  data.point_fields["part"] = (Matrix(1, 4) << 7, 7, 8, 8).finished();
  label_triangles_by_points(data, "part");
  EXPECT_EQ(data.triangle_fields.at("part"), (Matrix(1, 2) << 7, 8).finished());
}

TEST(PointLabels, AreIntegers) {
  MeshData data = box_with_lid();
  data.point_fields["part"](0, 4) = 0.5;
  EXPECT_THROW(label_triangles_by_points(data, "part"), InputError);
}

}  // namespace
}  // namespace polyaffine
