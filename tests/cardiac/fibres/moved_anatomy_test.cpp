#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/fibres/file_fibres.hpp>
#include <cardiac/fibres/moved_anatomy.hpp>

namespace cardiac {
namespace {

using polyaffine::Mat3;
using polyaffine::MeshFile;
using polyaffine::Points;
using polyaffine::Vec3;

Mat3 stretch() {
  Mat3 F = Vec3(0.8, 0.7, 0.9).asDiagonal();
  F(0, 1) = 0.1;
  return F;
}

MeshFile ventricle() {
  MeshFile out;
  out.mesh = structured_ellipsoid(human_lv(), {6, 8, 1}).mesh;
  return out;
}

polyaffine::Matrix everywhere(const Vec3& v, Eigen::Index count) {
  return v.replicate(1, count);
}

TEST(MovedAnatomy, CarriesFibresSheetsAndNormals) {
  const Vec3 f(1, 2, 0), n(2, -1, 0), moved_f = (stretch() * f).normalized(),
                                      moved_n = (stretch().inverse().transpose() * n).normalized();
  for (const bool of_tets : {true, false}) {
    MeshFile file = ventricle();
    const Points points = stretch() * file.mesh.points();
    auto& fields = of_tets ? file.cell_fields : file.point_fields;
    const Eigen::Index count = of_tets ? file.mesh.num_tets() : file.mesh.num_points();
    fields["fibre"] = everywhere(f, count);
    fields["sheet_normal"] = everywhere(n, count);
    const FileFibres moved = FileFibres(file, "file").moved(file.mesh, points);
    ASSERT_EQ(moved.fields().size(), 2);
    EXPECT_EQ(moved.fields().at("fibre")->of_tets(), of_tets);
    for (const auto& v : moved.fields().at("fibre")->vectors().colwise())
      EXPECT_LT(v.cross(moved_f).norm(), 1e-12);
    for (const auto& v : moved.fields().at("sheet_normal")->vectors().colwise())
      EXPECT_LT(v.cross(moved_n).norm(), 1e-12);
  }
}

TEST(MovedAnatomy, GoesThereAndBack) {
  MeshFile file = ventricle();
  file.cell_fields["fibre"] = everywhere({1, 2, 0}, file.mesh.num_tets());
  AnatomyOptions options;
  options.septum_point = Vec3(24, 0, 0);
  Anatomy heart =
      make_anatomy(file.mesh, options, FileFibreFunction{std::make_shared<const FileFibres>(file, "file")});
  heart.epicardial_weight = polyaffine::Vector::LinSpaced(file.mesh.num_points(), 0, 1);
  const Anatomy moved = moved_anatomy(heart, stretch() * heart.mesh.points());
  EXPECT_EQ(moved.mesh.boundary_labels(), heart.mesh.boundary_labels());
  EXPECT_EQ(moved.epicardial_weight, heart.epicardial_weight);
  EXPECT_GT((*moved.options.septum_point - *options.septum_point).norm(), 3);
  const Anatomy back = moved_anatomy(moved, heart.mesh.points());
  const std::vector<int> tet{0, 10, 20};
  const Eigen::Matrix4Xd at = Eigen::Matrix4Xd::Constant(4, 3, 0.25);
  EXPECT_LT((back.fibres(*back.coordinates, tet, at) - heart.fibres(*heart.coordinates, tet, at)).norm(),
            1e-9);
  EXPECT_EQ(back.segment, heart.segment);
  EXPECT_LT((back.coordinates->transmural() - heart.coordinates->transmural()).norm(), 1e-9);
}

TEST(MovedAnatomy, MovesAPlaceWithTheVertexNextToIt) {
  const polyaffine::TetMesh mesh = ventricle().mesh;
  Points points = mesh.points();
  points.col(7) += Vec3(1, 2, 3);
  EXPECT_LT((way_of_nearest(mesh, points, mesh.points().col(7) + Vec3(0.1, 0, 0)) - Vec3(1, 2, 3)).norm(),
            1e-12);
}

}  // namespace
}  // namespace cardiac
