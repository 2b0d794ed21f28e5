#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cardiac/anatomy/tet_regions.hpp>
#include <polyaffine/core/error.hpp>

#include "support/error_of.hpp"

namespace cardiac {
namespace {

using polyaffine::Matrix;
using testing::AllOf;
using testing::HasSubstr;

polyaffine::MeshData data() {
  polyaffine::MeshData out;
  out.source = "heart.msh";
  out.tets = polyaffine::Tets::Random(4, 5);
  out.tet_fields["region"] = (Matrix(1, 5) << 1, 2, 1, 3, 2).finished();
  out.tet_fields["depth"] = (Matrix(1, 5) << 0.1, 0.2, 0.3, 0.4, 0.5).finished();
  out.region_names = {{1, "wall"}, {2, "blood"}};
  return out;
}

TEST(TetRegions, KeepTheirTetsAndFields) {
  const polyaffine::MeshData before = data();
  for (const SurfaceLabel& wanted : {SurfaceLabel(1), SurfaceLabel("wall")}) {
    polyaffine::MeshData mesh = before;
    keep_regions(mesh, {{wanted, 3}, ""});
    EXPECT_EQ(mesh.tets, before.tets(Eigen::all, std::vector{0, 2, 3}));
    EXPECT_EQ(mesh.tet_fields.at("depth"), (Matrix(1, 3) << 0.1, 0.3, 0.4).finished());
    EXPECT_EQ(mesh.notes.back(),
              "region 1 \"wall\" (2 tets), 3 (1 tets) kept, 2 \"blood\" (2 tets) left out");
  }
  polyaffine::MeshData all = before;
  keep_regions(all, {});
  EXPECT_EQ(all.tets, before.tets);
}

TEST(TetRegions, AreTold) {
  EXPECT_EQ(regions_in_words(data(), ""), "1 \"wall\" (2 tets), 2 \"blood\" (2 tets), 3 (1 tets)");
  polyaffine::MeshData one = data();
  one.tet_fields["region"].setConstant(1);
  EXPECT_EQ(regions_in_words(one, ""), "");
  EXPECT_EQ(regions_in_words(data(), "depth"), "") << "no whole numbers";
}

std::string refusal(const RegionChoice& choice, polyaffine::MeshData mesh = data()) {
  return polyaffine::testing::error_of([&] { keep_regions(mesh, choice); });
}

TEST(TetRegions, RefusalsListWhatTheFileHas) {
  EXPECT_THAT(refusal({{"lung"}, ""}),
              AllOf(HasSubstr("heart.msh"), HasSubstr("\"lung\""), HasSubstr("2 \"blood\" (2 tets)")));
  EXPECT_THAT(refusal({{7}, ""}), HasSubstr("region 7"));
  EXPECT_THAT(refusal({{7}, "part"}), AllOf(HasSubstr("\"part\""), HasSubstr("\"depth\", \"region\"")));
  EXPECT_THAT(refusal({{1}, "depth"}), HasSubstr("expected an integer"));
  polyaffine::MeshData none = data();
  none.tet_fields.erase("region");
  EXPECT_THAT(refusal({{1}, ""}, none), AllOf(HasSubstr("\"depth\""), HasSubstr("region_array")));
}

}  // namespace
}  // namespace cardiac
