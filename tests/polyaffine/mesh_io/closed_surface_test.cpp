#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/mesh_io/closed_surface.hpp>

#include "support/error_of.hpp"
#include "support/labelled_box.hpp"
#include "support/mesh_writers.hpp"

namespace polyaffine {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

MeshData surface() {
  MeshData out = testing_io::data_of(testing::labelled_cube(3));
  out.source = "box.stl";
  out.tets.resize(4, 0);
  make_closed_surface(out);
  out.notes.clear();
  return out;
}

std::string refusal(const std::function<void(MeshData&)>& damage) {
  MeshData data = surface();
  data.triangle_fields.clear();  // of as many triangles as there were
  damage(data);
  return testing::error_of([&] { make_closed_surface(data); });
}

/// Volume inside, positive when the triangles look outwards.
double inside(const MeshData& data) {
  return -EnclosedVolume(data.triangles).value(data.points);
}

TEST(ClosedSurface, AGoodOneStays) {
  MeshData data = surface();
  make_closed_surface(data);
  EXPECT_EQ(data.triangles.cols(), surface().triangles.cols());
  EXPECT_THAT(data.notes, IsEmpty());
  EXPECT_NEAR(inside(data), 1, 1e-12);
}

TEST(ClosedSurface, PointsOfNoTriangleAreLeftOut) {
  MeshData data = testing_io::data_of(testing::labelled_cube(3));  // with the points inside
  data.tets.resize(4, 0);
  make_closed_surface(data);
  EXPECT_EQ(data.points.cols(), 64 - 8);
  EXPECT_THAT(data.notes, Contains(HasSubstr("8 points of no triangle")));
  EXPECT_NEAR(inside(data), 1, 1e-12);
}

TEST(ClosedSurface, SoupIsRepaired) {
  // Points of each triangle's own, every third triangle turned, one collapsed, one twice.
  const MeshData whole = surface();
  MeshData soup = whole;
  const Eigen::Index n = whole.triangles.cols();
  soup.triangles.resize(3, n + 2);
  soup.points.resize(3, 3 * (n + 2));
  for (Eigen::Index t = 0; t < n + 2; ++t) {
    for (int k = 0; k < 3; ++k) {
      soup.triangles(k, t) = static_cast<int>(3 * t + k);
      soup.points.col(3 * t + k) = whole.points.col(whole.triangles(t == n ? 0 : k, t % n));
    }
    if (t % 3 == 0) soup.triangles.col(t).head(2).reverseInPlace();
  }
  make_closed_surface(soup);
  EXPECT_EQ(soup.triangles.cols(), n);
  EXPECT_NEAR(inside(soup), 1, 1e-12);
  EXPECT_THAT(soup.notes,
              AllOf(Contains(HasSubstr("joined")), Contains(HasSubstr("1 triangles without area")),
                    Contains(HasSubstr("1 repeated triangles")), Contains(HasSubstr("turned outwards"))));
}

TEST(ClosedSurface, InsideOutIsTurned) {
  MeshData data = surface();
  data.triangles.row(0).swap(data.triangles.row(1));
  make_closed_surface(data);
  EXPECT_NEAR(inside(data), 1, 1e-12);
}

TEST(ClosedSurface, RefusalsNameThePlace) {
  EXPECT_THAT(refusal([](MeshData& m) { m.triangles.resize(3, 0); }), HasSubstr("no triangles"));
  EXPECT_THAT(refusal([](MeshData& m) { m.points(0, 0) = std::nan(""); }), HasSubstr("not a number"));
  EXPECT_THAT(
      refusal([](MeshData& m) { m.triangles.conservativeResize(3, m.triangles.cols() - 1); }),
      AllOf(HasSubstr("box.stl: surface: "), HasSubstr("3 edges of one triangle"), HasSubstr("near (")));
  EXPECT_THAT(refusal([](MeshData& m) {
                const Eigen::Index n = m.triangles.cols();
                m.triangles.conservativeResize(3, 2 * n);
                m.triangles.rightCols(n) = m.triangles.leftCols(n);
                const auto p = static_cast<int>(m.points.cols());
                m.points.conservativeResize(3, 2 * p);
                m.points.rightCols(p) = m.points.leftCols(p).colwise() + Vec3(4, 0, 0);
                m.triangles.rightCols(n).array() += p;
              }),
              AllOf(HasSubstr("2 separate surfaces"), HasSubstr("near (")));
  // A fin on an edge.
  EXPECT_THAT(refusal([](MeshData& m) {
                const Eigen::Index n = m.triangles.cols(), p = m.points.cols();
                m.triangles.conservativeResize(3, n + 1);
                m.points.conservativeResize(3, p + 1);
                m.points.col(p) = Vec3(3, 3, 3);
                m.triangles.col(n) << m.triangles(0, 0), m.triangles(1, 0), static_cast<int>(p);
              }),
              HasSubstr("edges of more than two triangles"));
  EXPECT_THAT(refusal([](MeshData& m) { m.points.row(2) *= 1e-9; }), ::testing::Not(HasSubstr("no error")));
}

}  // namespace
}  // namespace polyaffine
