#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "support/heart_run.hpp"

namespace cardiac {
namespace {

using polyaffine::Matrix;
using polyaffine::Vec3;
using polyaffine::Vec4;
using polyaffine::Vector;

struct Case {
  const char* name;
  std::vector<std::string> overrides;
  int nodes;
  double smallest_eigenvalue = 1e-5;  // of the scaled Gram matrix, over its largest
};

const std::vector<Case> kCases{
    {"Five", {"reduction.ring_nodes=[4]"}, 5},
    {"Aha", {}, 17},
    // With ll it is 1.4e-7 and 5.2e-7: between two rings the parabolas of both nearly cancel.
    {"AhaEnriched", {"reduction.preset=accurate"}, 17, 3e-8},
    {"TwentyNineEnriched", {"reduction.ring_nodes=[4, 8, 8, 8]", "reduction.preset=accurate"}, 29, 3e-8},
    {"Turned", {"reduction.ring_nodes=[3, 5]", "reduction.ring_angles_deg=[0, 20]"}, 9},
    {"SixtyOne", {"reduction.ring_nodes=[12, 12, 12, 12, 12]", "reduction.enrichment=[\"tt\"]"}, 61},
    // Of 61 frames with lt as well it is 3.7e-6; functions that depend on each other leave 1e-15.
    {"SixtyOneFast", {"reduction.ring_nodes=[12, 12, 12, 12, 12]"}, 61, 1e-6},
    {"FiveSigmoid", {"reduction.ring_nodes=[4]", "reduction.weights=sigmoid"}, 5},
    {"ThirteenSigmoid", {"reduction.ring_nodes=[6, 6]", "reduction.weights=sigmoid"}, 13}};

class Layouts : public ::testing::TestWithParam<int> {
 protected:
  const Case& at() const { return kCases[GetParam()]; }
  Protocol protocol() const {
    return testing::shipped_protocol("passive_inflation", testing::on_land_ellipsoid(at().overrides));
  }
};

TEST_P(Layouts, FunctionsAreIndependent) {
  const Protocol p = protocol();
  const auto anatomy = testing::read_anatomy(p);
  const Discretisation d = reduced_discretisation(*anatomy, p);
  EXPECT_EQ(d.layout.num_nodes(), at().nodes);
  const auto& basis = *d.basis;
  // The Gram matrix of the functions, scaled to one on the diagonal, at the Gauss points of the mesh.
  const auto points = anatomy->coordinates->space().wall_points(4);
  Matrix gram = Matrix::Zero(basis.num_functions(), basis.num_functions());
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const auto k = static_cast<Eigen::Index>(q);
    const auto s = basis.sample(points.tet[q], points.barycentric.col(k));
    // In local axes and in Cartesian ones functions of the same scalar value differ; they are compared along
    // one direction at a time, which a set that is dependent anywhere does not survive.
    gram(s.functions, s.functions) += points.weights[k] * s.N * s.N.transpose();
  }
  const Vector scale = gram.diagonal().cwiseSqrt().cwiseInverse();
  const Vector values =
      Eigen::SelfAdjointEigenSolver<Matrix>(scale.asDiagonal() * gram * scale.asDiagonal()).eigenvalues();
  EXPECT_GT(values.minCoeff(), at().smallest_eigenvalue * values.maxCoeff());
}

TEST_P(Layouts, BaseStaysWhereItIsWhateverTheUnknowns) {
  const Protocol p = protocol();
  const auto anatomy = testing::read_anatomy(p);
  const Discretisation d = reduced_discretisation(*anatomy, p);
  const auto points = anatomy->coordinates->space().surface_points(anatomy->mesh, {anatomy->labels.base}, 4);
  double slope = 0;
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const auto s = d.basis->sample(points.tet[q], points.barycentric.col(static_cast<Eigen::Index>(q)));
    EXPECT_LT(s.N.cwiseAbs().maxCoeff(), 1e-12);
    slope = std::max(slope, s.gradient.cwiseAbs().maxCoeff());
  }
  EXPECT_GT(slope, 0.01);  // 1/mm
}

TEST_P(Layouts, IntegrationPointsKeepTheVolumeOfTheWall) {
  const Protocol p = protocol();
  const auto anatomy = testing::read_anatomy(p);
  const Discretisation d = reduced_discretisation(*anatomy, p);
  const double volume = anatomy->coordinates->space().wall_points(4).weights.sum();
  EXPECT_NEAR(d.points.weights.sum(), volume, 1e-9 * volume);
  EXPECT_GT(d.points.weights.minCoeff(), 0);
}

std::string case_name(const ::testing::TestParamInfo<int>& one) {
  return kCases[one.param].name;
}

INSTANTIATE_TEST_SUITE_P(Cases, Layouts, ::testing::Range(0, static_cast<int>(kCases.size())), case_name);

TEST(LayoutRun, TellsItsItsNodesAndStrainBySegment) {
  const Protocol p = testing::shipped_protocol("passive_inflation",
                                               testing::on_land_ellipsoid({"reduction.ring_nodes=[6, 6]"}));
  const testing::HeartRun run(p);
  EXPECT_TRUE(run.path.completed);
  EXPECT_EQ(run.result.control_nodes, 13);
  ASSERT_EQ(run.result.instants.back().strain.size(), kAhaSegments);
  ASSERT_EQ(run.result.instants.back().frames.size(), kAhaSegments);
  const auto& aha =
      testing::HeartRun(testing::shipped_protocol("passive_inflation", testing::on_land_ellipsoid()));
  // The same wall seen through other nodes: circumferential stretches agree to a few per cent.
  for (int s = 0; s < 16; ++s) {
    EXPECT_NEAR(run.result.instants.back().strain[s].circumferential,
                aha.result.instants.back().strain[s].circumferential, 0.05)
        << s + 1;
    EXPECT_NEAR(run.result.instants.back().frames[s].A(1, 1), aha.result.instants.back().frames[s].A(1, 1),
                0.1)
        << s + 1;
  }
}

}  // namespace
}  // namespace cardiac
