#include "polyaffine/mesh/digest.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/labelled_box.hpp"

namespace polyaffine {
namespace {

TEST(Digest, OfAMeshChangesWithEveryPart) {
  const TetMesh mesh = testing::labelled_cube(1);
  const auto with = [&](Points points, std::vector<int> labels) {
    return digest(
        TetMesh(std::move(points), mesh.tets(), mesh.regions(), {mesh.boundary(), std::move(labels)}));
  };
  const std::string same = with(mesh.points(), mesh.boundary_labels());
  EXPECT_EQ(same, digest(mesh));
  Points moved = mesh.points();
  moved(0, 0) += std::numeric_limits<double>::epsilon();
  EXPECT_NE(with(moved, mesh.boundary_labels()), same);
  std::vector<int> labels = mesh.boundary_labels();
  ++labels.back();
  EXPECT_NE(with(mesh.points(), labels), same);
}

TEST(Digest, OfValuesIsTheirFnv1a) {
  Matrix values = Matrix::Zero(1, 1);
  // FNV-1a of eight zero bytes: the offset basis times the prime to the eighth, modulo 2⁶⁴.
  std::uint64_t expected = 0xcbf29ce484222325;
  for (int k = 0; k < 8; ++k) expected *= 0x100000001b3;
  EXPECT_EQ(std::stoull(digest(values), nullptr, 16), expected);
  values(0, 0) = -0.0;
  EXPECT_NE(std::stoull(digest(values), nullptr, 16), expected);
}

}  // namespace
}  // namespace polyaffine
