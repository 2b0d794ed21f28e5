#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/eikonal.hpp>
#include "polyaffine/geometry/box_mesh.hpp"

namespace polyaffine {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Arrival free_vertices(const TetMesh& mesh) {
  return {Vector::Constant(mesh.num_points(), kInfinity), std::vector<int>(mesh.num_points(), -1)};
}

Mat3 tilted_speed() {
  const Mat3 axes =
      (Eigen::AngleAxisd(0.5, Vec3::UnitZ()) * Eigen::AngleAxisd(0.3, Vec3::UnitX())).toRotationMatrix();
  return axes * Vec3(9, 1, 1).asDiagonal() * axes.transpose();
}

// Mean error of the time from the centre of a unit cube with n³ cells, exact where it is below 0.2.
double point_error(int n, const Mat3& speed) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {n, n, n}, 0.2);
  Arrival start = free_vertices(mesh);
  Vector exact(mesh.num_points());
  for (int v = 0; v < mesh.num_points(); ++v) {
    const Vec3 d = mesh.points().col(v) - Vec3::Constant(0.5);
    exact[v] = std::sqrt(d.dot(speed.inverse() * d));
    if (exact[v] < 0.2) start.time[v] = exact[v];
  }
  const EikonalSolver solver(mesh, std::vector<Mat3>(mesh.num_tets(), speed));
  return (solver.march_from(start).time - exact).cwiseAbs().mean();
}

TEST(Eikonal, ConvergesToTheDistanceFromAPoint) {
  const double coarse = point_error(6, Mat3::Identity()), fine = point_error(24, Mat3::Identity());
  EXPECT_GT(std::log2(coarse / fine) / 2, 0.85) << coarse << " " << fine;
  EXPECT_LT(fine, 0.015);
}

TEST(Eikonal, ConvergesToTheEllipsoidalDistance) {
  const double coarse = point_error(6, tilted_speed()), fine = point_error(24, tilted_speed());
  EXPECT_GT(std::log2(coarse / fine) / 2, 0.85) << coarse << " " << fine;
  EXPECT_LT(fine, 0.015);
}

TEST(Eikonal, IsExactWhereASourceSeesInAHomogeneousMesh) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {8, 8, 8}, 0.2);
  const Vec3 source(0.31, 0.47, 0.52);
  for (const Mat3& speed : {Mat3(Mat3::Identity()), tilted_speed()}) {
    const Vector time =
        arrival_times(mesh, {{locate(mesh, source), 2.0}}, std::vector<Mat3>(mesh.num_tets(), speed));
    for (int v = 0; v < mesh.num_points(); ++v) {
      const Vec3 d = mesh.points().col(v) - source;
      EXPECT_NEAR(time[v] - 2, std::sqrt(d.dot(speed.inverse() * d)), 1e-9);
    }
  }
}

// Fermat's path from the slow half into the fast one bends at the interface; no tensor is constant along it.
double refraction_error(int n) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 2, 0.5), {4 * n, 4 * n, n});
  std::vector<Mat3> speed(mesh.num_tets());
  for (int t = 0; t < mesh.num_tets(); ++t)
    speed[t] = (mesh.tet_centroid(t)[0] < 1 ? 1 : 9) * Mat3::Identity();
  const Vector time = arrival_times(mesh, {{locate(mesh, Vec3(0, 0, 0)), 0}}, speed);
  double sum = 0;
  int count = 0;
  for (int v = 0; v < mesh.num_points(); ++v) {
    const Vec3 x = mesh.points().col(v);
    if (x[0] < 1.3 || x[2] > 0) continue;
    double exact = kInfinity;
    for (int i = 0; i <= 2000;
         ++i) {  // where the path meets x = 1; the minimum is flat, so this is good to 1e-6
      const double y = i * x[1] / 2000;
      exact = std::min(exact, std::hypot(1, y) + std::hypot(x[0] - 1, x[1] - y) / 3);
    }
    sum += std::abs(time[v] - exact) / exact;
    ++count;
  }
  return sum / count;
}

TEST(Eikonal, Refracts) {
  const double coarse = refraction_error(2), fine = refraction_error(8);
  EXPECT_LT(fine, 0.01);
  // Not quite one: behind the interface the fastest paths fan out of a small piece of it.
  EXPECT_GT(std::log2(coarse / fine) / 2, 0.65) << coarse << " " << fine;
}

TEST(Eikonal, IsExactForAPlaneFrontOnTheMeshFace) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3(3, 2, 2), {9, 6, 6}, 0.25);
  Arrival start = free_vertices(mesh);
  for (int v = 0; v < mesh.num_points(); ++v)
    if (mesh.points()(0, v) == 0) start.time[v] = 0, start.label[v] = 0;
  const Arrival arrival = EikonalSolver(mesh).march_from(start);
  // The update is exact for linear T while the front's normal meets the face behind, which is so in the cone
  // of dependence of the face x = 0 away from the sides; near the sides paths along edges are a little
  // longer.
  EXPECT_LT((arrival.time - mesh.points().row(0).transpose()).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_LT((arrival.time - mesh.points().row(0).transpose()).cwiseAbs().mean(), 2e-3);
  EXPECT_TRUE(std::all_of(arrival.label.begin(), arrival.label.end(), [](int l) { return l == 0; }));
}

// Largest error of the time from a tilted plane through the cube's centre, with exact values at the vertices
// next to it, where the foot of the perpendicular lies well inside the cube.
TEST(Eikonal, FollowsATiltedPlaneFront) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {16, 16, 16}, 0.2);
  const Vec3 normal = Vec3(1, 0.4, 0.2).normalized();
  Arrival start = free_vertices(mesh);
  const Vector exact = ((normal.transpose() * mesh.points()).array() - normal.sum() / 2).abs().transpose();
  for (int v = 0; v < mesh.num_points(); ++v)
    if (exact[v] < 1.5 / 16) start.time[v] = exact[v];
  const Vector time = EikonalSolver(mesh).march_from(start).time;
  int checked = 0;
  for (int v = 0; v < mesh.num_points(); ++v) {
    const Vec3 x = mesh.points().col(v);
    const Vec3 foot = x - (normal.dot(x) - normal.sum() / 2) * normal;
    if ((foot.array() - 0.5).abs().maxCoeff() > 0.3 || exact[v] < 0.15) continue;
    ++checked;
    EXPECT_NEAR(time[v], exact[v], 1.5e-3);  // exact for linear T but for a trace of what the sides send in
  }
  EXPECT_GT(checked, 500);
}

TEST(Eikonal, GoesAroundAHole) {
  // A plate with a square hole: from one side to the other the path bends around two corners of the hole.
  const TetMesh mesh = box_mesh(Vec3(-3, -3, 0), Vec3(3, 3, 0.5), {36, 36, 3}, 0,
                                [](const Vec3& x) { return std::abs(x[0]) > 1 || std::abs(x[1]) > 1; });
  const Vec3 from(-2, 0, 0), to(2, 0, 0);
  const Vector time = arrival_times(mesh, {{locate(mesh, from), 0}});
  int target = 0;
  (mesh.points().colwise() - to).colwise().norm().minCoeff(&target);
  const double around = 2 * std::sqrt(2.0) + 2;
  EXPECT_GT(time[target], around - 1e-9);  // a path inside the mesh is never shorter
  EXPECT_LT(time[target], 1.02 * around);
}

TEST(Eikonal, StaysInAllowedTets) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3(4, 1, 1), {8, 2, 2});
  std::vector<char> allowed(mesh.num_tets());
  for (int t = 0; t < mesh.num_tets(); ++t) allowed[t] = mesh.tet_centroid(t)[0] < 2;
  const Arrival arrival = EikonalSolver(mesh).march({{locate(mesh, Vec3(0.1, 0.4, 0.4)), 0}}, allowed);
  for (int v = 0; v < mesh.num_points(); ++v) {
    EXPECT_EQ(std::isfinite(arrival.time[v]), mesh.points()(0, v) <= 2);
    EXPECT_EQ(arrival.label[v], mesh.points()(0, v) <= 2 ? 0 : -1);
  }
}

TEST(Eikonal, TheEarliestSourceWinsAndLabelsFollow) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3(10, 1, 1), {20, 2, 2});
  const std::vector<EikonalSource> sources{{locate(mesh, Vec3(0, 0.5, 0.5)), 0},
                                           {locate(mesh, Vec3(10, 0.5, 0.5)), 4}};
  const Arrival arrival = EikonalSolver(mesh).march(sources);
  for (int v = 0; v < mesh.num_points(); ++v) {  // the fronts meet at x = 7
    if (std::abs(mesh.points()(0, v) - 7) > 0.8) {
      EXPECT_EQ(arrival.label[v], mesh.points()(0, v) > 7 ? 1 : 0);
    }
  }
}

// Stretched 20:1 and sheared, so that nearly every tet is obtuse.
TEST(Eikonal, DoesNotDependOnTheNumberingOfAnObtuseMesh) {
  const TetMesh box = box_mesh(Vec3::Zero(), Vec3::Ones(), {5, 5, 5}, 0.25);
  Mat3 shear;
  shear << 1, 0.9, 0.4, 0, 1, 0.8, 0, 0, 0.05;
  const Points points = shear * box.points();
  std::vector<int> order(points.cols());
  std::iota(order.begin(), order.end(), 0);
  std::mt19937_64 random(5);
  std::shuffle(order.begin(), order.end(), random);
  Points shuffled(3, points.cols());
  for (Eigen::Index v = 0; v < points.cols(); ++v) shuffled.col(order[v]) = points.col(v);
  Tets tets = box.tets();
  for (Eigen::Index t = 0; t < tets.cols(); ++t)
    for (int k = 0; k < 4; ++k) tets(k, t) = order[box.tets()(k, t)];
  const TetMesh one(points, box.tets()),
      two(shuffled, tets.rowwise().reverse().eval().colwise().reverse().eval());
  const Vec3 source = one.tet_centroid(300);
  const Vector a = arrival_times(one, {{locate(one, source), 0}}),
               b = arrival_times(two, {{locate(two, source), 0}});
  double difference = 0;
  for (int v = 0; v < one.num_points(); ++v) difference = std::max(difference, std::abs(a[v] - b[order[v]]));
  EXPECT_LT(difference, 1e-9);  // gains under 1e-12 of an edge are not passed on, over some tens of edges
  EXPECT_GT(a.maxCoeff(), 0.5);
  for (int v = 0; v < one.num_points(); ++v)
    EXPECT_GE(a[v],
              (one.points().col(v) - source).norm() * (1 - 1e-9));  // interpolation only lengthens paths
}

TEST(Eikonal, RejectsBadSpeed) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {1, 1, 1});
  EXPECT_THROW(EikonalSolver(mesh, {Mat3::Identity()}), InputError);
  EXPECT_THROW(EikonalSolver(mesh, std::vector<Mat3>(6, -Mat3::Identity())), InputError);
  Mat3 skew = Mat3::Identity();
  skew(0, 1) = 0.5;
  EXPECT_THROW(EikonalSolver(mesh, std::vector<Mat3>(6, skew)), InputError);
}

}  // namespace
}  // namespace polyaffine
