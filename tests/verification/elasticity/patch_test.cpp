#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>

#include <polyaffine/geometry/locate.hpp>
#include <polyaffine/linear/projection.hpp>
#include <polyaffine/material/neo_hookean.hpp>
#include <polyaffine/material/springs.hpp>
#include <polyaffine/material/volumetric.hpp>
#include <polyaffine/quadrature/cell_rule.hpp>
#include <polyaffine/quadrature/nearest_weights.hpp>
#include <polyaffine/solve/load_stepping.hpp>
#include <polyaffine/system/field_term.hpp>

#include "support/random_regions.hpp"

namespace polyaffine {
namespace {

using Laws = std::vector<std::shared_ptr<const Law>>;

constexpr double kMu = 3;  // kPa
constexpr int kFrames = 5;

// Frames with their coefficients in axes turned by one rotation.
struct TurnedFrames : FrameField {
  std::shared_ptr<const FrameField> frames;
  Mat3 axes;
  TurnedFrames(std::shared_ptr<const FrameField> of, const Mat3& Q) : frames(std::move(of)), axes(Q) {}
  int num_frames() const override { return frames->num_frames(); }
  FramesAtPoint sample(int tet, const Vec4& barycentric) const override {
    FramesAtPoint out = frames->sample(tet, barycentric);
    out.Q = axes;
    return out;
  }
};

struct Option {
  const char* name;
  std::vector<std::string> enrichment, pressures;  // no pressures: every point on its own
  bool cells, turned;
  double poisson;
};

const std::vector<std::string> kFast{"tt", "lt"};
const std::vector<std::string> kAccurate{"tt", "lt", "ct", "ltt", "ctt", "ttt"};
const std::vector<std::string> kAll{"tt", "lt", "ct", "ltt", "ctt", "ttt", "ll", "lc", "cc"};

const std::vector<Option> kOptions{
    {"Affine", {}, {"1"}, false, false, 0.3},
    {"Fast", kFast, {"1", "t"}, true, true, 0.49},
    {"Accurate", kAccurate, {"1", "l", "c", "t", "lt", "ct"}, true, true, 0.4999},
    {"Regions", kAll, {"1", "l", "c", "t", "lt", "ct"}, true, true, 0.4999},
    {"EveryPoint", kAll, {}, true, true, 0.49},
    {"EveryGaussPoint", kAll, {"1", "l", "c", "t"}, false, true, 0.4999}};

std::vector<Monomial> monomials(const std::vector<std::string>& words, std::vector<Monomial> first = {}) {
  for (const auto& word : words) first.push_back(parse_monomial(word));
  return first;
}

// A cube in random control regions with frames whose own axes are all different, under the tractions of a
// homogeneous stress.
class Patch : public ::testing::TestWithParam<int> {
 protected:
  const Option& option = kOptions[GetParam()];
  testing::RandomRegions regions{kFrames, 20, 4};
  std::shared_ptr<const FrameBasis> cartesian = frames(Mat3::Identity()), basis = cartesian;
  double bulk = 2 * kMu * (1 + option.poisson) / (3 * (1 - 2 * option.poisson));
  Mat3 F;

  Patch() {
    if (option.turned) basis = frames(Eigen::AngleAxisd(0.8, Vec3(2, -1, 1).normalized()).matrix());
    F << 1.08, 0.05, -0.03, 0.02, 0.97, 0.04, -0.02, 0.03, 0.96;
    F *= std::cbrt((1 + kMu / bulk * 0.1) / F.determinant());  // a pressure of a tenth of μ
  }

  std::shared_ptr<const FrameBasis> frames(const Mat3& axes) const {
    std::vector<ControlNode> nodes = regions.nodes;
    for (int i = 0; i < kFrames; ++i)
      nodes[i].axes = Eigen::AngleAxisd(0.4 * i, Vec3(1, i, 2).normalized()).matrix();
    const auto field = std::make_shared<RegionFrames>(regions.geometry, regions.weights, nodes, 0.5);
    return std::make_shared<FrameBasis>(
        std::make_shared<TurnedFrames>(field, axes),
        std::vector<FrameFunctions>(kFrames,
                                    {monomials(option.enrichment, affine_monomials()), !axes.isIdentity()}));
  }

  // Points of the mesh, or few of each region; weights with the integration constraint of all functions.
  WallPoints points() const {
    const WallPoints all = regions.geometry->wall_points(2);
    std::vector<int> cell;
    for (const int t : all.tet) cell.push_back(regions.label[t]);
    WallPoints out =
        option.cells
            ? compress_cells(all, cell, regions.geometry->positions(all.tet, all.barycentric), {6, 6, 6})
            : group_cells(all, cell);
    const NearestWeights consistent =
        nearest_weights(integration_constraint(deformation_table(*cartesian, out),
                                               boundary_integrals(*cartesian, regions.boundary())),
                        out.weights);
    EXPECT_TRUE(consistent.met);
    EXPECT_GE(consistent.weights.minCoeff(), 0);
    if (option.cells) {
      EXPECT_LT(3 * out.tet.size(), all.tet.size());
    }
    out.weights = consistent.weights;
    return out;
  }

  // μ/2 (Ī₁ − 3) + κ/2 (J − 1)².
  Mat3 stress() const {
    const double J = F.determinant(), I1 = F.squaredNorm();
    const Mat3 inverse = F.inverse().transpose();
    return kMu * std::pow(J, -2.0 / 3) * (F - I1 / 3 * inverse) + bulk * (J - 1) * J * inverse;
  }

  std::shared_ptr<const FieldEnergy> wall() const {
    const WallPoints at = points();
    const FieldTable table = deformation_table(*basis, at);
    Laws laws{std::make_shared<IsochoricNeoHookean>(kMu)};
    std::optional<PressureSpace> pressure;
    if (option.pressures.empty())
      laws.push_back(std::make_shared<QuadraticVolumetric>(bulk));
    else
      pressure =
          dense_pressure(table,
                         frame_values(basis->field(), std::vector(kFrames, monomials(option.pressures)),
                                      at.tet, at.barycentric),
                         bulk);
    return std::make_shared<FieldEnergy>(table, laws, pressure);
  }
};

TEST_P(Patch, AHomogeneousStressHasAnAffineSolution) {
  const std::shared_ptr<const FieldEnergy> body = wall();
  System system = field_system(3 * basis->num_functions(), {solid(body)});
  const Mat3 P = stress();
  for (int face = 1; face <= 6; ++face) {
    const SurfacePoints points = regions.geometry->surface_points(regions.mesh, {face}, 4);
    const Vec3 normal = Vec3(points.X_xi.col(0)).cross(Vec3(points.X_eta.col(0))).normalized();
    system.terms.push_back(
        load(std::make_shared<FieldEnergy>(displacement_table(*basis, points),
                                           Laws{std::make_shared<DeadTraction>(P * normal)}),
             [](double t) { return t; }));
  }
  // Held where the affine map is: (0, 0, 0) entirely, (1, 0, 0) across x, (0, 1, 0) along z.
  std::vector<int> tets;
  Eigen::Matrix4Xd barycentric(4, 3);
  Points moved(3, 3);
  for (int k = 0; k < 3; ++k) {
    const Vec3 X = k == 0 ? Vec3::Zero() : Vec3(Vec3::Unit(k - 1));
    const MeshPoint at = locate(regions.mesh, X);
    tets.push_back(at.tet);
    barycentric.col(k) = at.barycentric;
    moved.col(k) = F * X - X;
  }
  const LinearConstraints all = displacement_constraints(*basis, tets, barycentric, moved);
  const std::vector<int> rows{0, 1, 2, 4, 5, 8};
  system.projection = std::make_shared<const Projection>(project({all.C(rows, Eigen::all), all.d(rows)}));

  Vector c = Vector::Zero(3 * basis->num_functions());
  LoadOptions options;
  options.newton.tolerance = 1e-11;
  options.newton.defect_tolerance = 1e-12;
  ASSERT_TRUE(load_stepping(system, *system.make_linear(), c, options).converged());
  const SurfacePoints boundary = regions.boundary();
  const Points u = DisplacementMap(*basis, boundary.tet, boundary.barycentric).apply(c);
  const Points exact = (F - Mat3::Identity()) * boundary.X;
  EXPECT_GT(exact.cwiseAbs().maxCoeff(), 0.05);
  EXPECT_LT((u - exact).cwiseAbs().maxCoeff(),
            1e-8);  // mm of a cube of 1 mm: the residual through the stiffness
  const Matrix at_points = evaluate_field(body->table(), c);
  EXPECT_LT((at_points.colwise() - F.reshaped()).cwiseAbs().maxCoeff(), 1e-7);
}

INSTANTIATE_TEST_SUITE_P(EveryOption, Patch, ::testing::Range(0, static_cast<int>(kOptions.size())),
                         [](const auto& one) { return std::string(kOptions[one.param].name); });

}  // namespace
}  // namespace polyaffine
