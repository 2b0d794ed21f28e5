#include <gtest/gtest.h>

#include <cmath>

#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/frame_basis.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include "polyaffine/mesh/unit_cube.hpp"

namespace polyaffine {
namespace {

// Two frames on the unit cube with weights s and 1 − s, s = sin²(x + y/2), and bent local coordinates.
class TwoFrames : public FrameField {
 public:
  int num_frames() const override { return 2; }
  FramesAtPoint sample(int tet, const Vec4& barycentric) const override {
    return at(space_.nodes()(Eigen::all, space_.elements().col(tet)) * barycentric);
  }
  static FramesAtPoint at(const Vec3& X) {
    const double a = X[0] + X[1] / 2;
    const Vec3 slope = std::sin(2 * a) * Vec3(1, 0.5, 0);
    FramesAtPoint out;
    for (int i = 0; i < 2; ++i) {
      FrameSample f;
      f.frame = i;
      f.weight = i == 0 ? std::pow(std::sin(a), 2) : std::pow(std::cos(a), 2);
      f.weight_gradient = i == 0 ? slope : Vec3(-slope);
      f.xi = Vec3(X[0] * X[1] - i, X[1] + 0.5 * i, X[2] * X[2] - 0.3);
      f.xi_gradient << X[1], X[0], 0, 0, 1, 0, 0, 0, 2 * X[2];
      out.frames.push_back(f);
    }
    return out;
  }

 private:
  TetMesh mesh_{testing::unit_cube().points, testing::unit_cube().tets};
  LagrangeBasis space_{mesh_, 1};
};

std::vector<Monomial> some_monomials() {
  auto out = affine_monomials();
  for (const char* text : {"tt", "lt", "lct", "ltt", "llcc"}) out.push_back(parse_monomial(text));
  return out;
}

TEST(Monomial, IsReadFromItsLetters) {
  EXPECT_EQ(parse_monomial("1"), (Monomial{0, 0, 0}));
  EXPECT_EQ(parse_monomial("l"), (Monomial{1, 0, 0}));
  EXPECT_EQ(parse_monomial("ltt"), (Monomial{1, 0, 2}));
  EXPECT_EQ(parse_monomial("tlt"), (Monomial{1, 0, 2}));
  EXPECT_EQ(parse_monomial("cccc"), (Monomial{0, 4, 0}));
}

TEST(Monomial, RejectsOtherTexts) {
  for (const char* text : {"", "x", "1l", "l t", "T", "lctlc"})
    EXPECT_THROW(parse_monomial(text), InputError) << text;
  try {
    parse_monomial("rr");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"rr\""), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("l, c, t"), std::string::npos);
  }
}

TEST(FrameBasis, NumbersFunctionsFrameByFrame) {
  const FrameBasis basis(std::make_shared<TwoFrames>(),
                         {{affine_monomials(), false}, {{{0, 0, 0}, {0, 0, 2}}, true}});
  EXPECT_EQ(basis.num_functions(), 6);
  EXPECT_EQ(basis.function(0, {0, 0, 1}), 3);
  EXPECT_EQ(basis.function(1, {0, 0, 2}), 5);
  EXPECT_EQ(basis.function(1, {1, 0, 0}), -1);
  EXPECT_FALSE(basis.in_local_axes(3));
  EXPECT_TRUE(basis.in_local_axes(4));
}

TEST(FrameBasis, ConstantFunctionsAreAPartitionOfUnity) {
  const FrameBasis basis(std::make_shared<TwoFrames>(),
                         {{some_monomials(), false}, {some_monomials(), false}});
  for (int tet = 0; tet < 6; ++tet) {
    const BasisSample s = basis.sample(tet, Vec4(0.1, 0.2, 0.3, 0.4));
    double sum = 0;
    Vec3 slope = Vec3::Zero();
    for (int frame = 0; frame < 2; ++frame) {
      const int a = basis.function(frame, {0, 0, 0});
      ASSERT_EQ(s.functions[a], a);
      sum += s.N[a];
      slope += s.gradient.col(a);
    }
    EXPECT_NEAR(sum, 1, 1e-15);
    EXPECT_LT(slope.norm(), 1e-15);
  }
}

TEST(FrameBasis, GradientsAreThoseOfTheFunctions) {
  const auto monomials = some_monomials();
  const FrameBasis basis(std::make_shared<TwoFrames>(), {{monomials, false}, {monomials, false}});
  const TetMesh mesh(testing::unit_cube().points, testing::unit_cube().tets);
  const Vec4 at(0.15, 0.35, 0.3, 0.2);
  constexpr double kStep = 1e-5;
  for (int tet = 0; tet < 6; ++tet) {
    const BasisSample s = basis.sample(tet, at);
    ASSERT_EQ(s.N.size(), 18);
    const Points corners = mesh.points()(Eigen::all, mesh.tets().col(tet));
    double smallest = 1;
    for (int k = 1; k < 4; ++k) {  // along the edges of the tet
      const Vec4 h = kStep * (Vec4::Unit(k) - Vec4::Unit(0));
      const Vector difference = (basis.sample(tet, at + h).N - basis.sample(tet, at - h).N) / (2 * kStep);
      // Central difference: step² times third derivatives of order ten.
      EXPECT_LT((difference - s.gradient.transpose() * (corners.col(k) - corners.col(0))).norm(), 1e-8);
    }
    for (Eigen::Index a = 0; a < s.N.size(); ++a) smallest = std::min(smallest, s.gradient.col(a).norm());
    EXPECT_GT(smallest, 1e-5) << "no function is constant";
    // Values by their definition.
    const auto frames = TwoFrames::at(corners * at).frames;
    for (std::size_t a = 0; a < s.functions.size(); ++a) {
      const auto& f = frames[a / monomials.size()];
      const Monomial& m = monomials[a % monomials.size()];
      EXPECT_NEAR(s.N[static_cast<Eigen::Index>(a)],
                  f.weight * std::pow(f.xi[0], m[0]) * std::pow(f.xi[1], m[1]) * std::pow(f.xi[2], m[2]),
                  1e-14);
    }
  }
}

TEST(FrameValues, AreThoseOfTheBasisAndSkipFramesWithoutMonomials) {
  const auto field = std::make_shared<TwoFrames>();
  Eigen::Matrix4Xd at(4, 2);
  at << 0.1, 0.4, 0.2, 0.3, 0.3, 0.2, 0.4, 0.1;
  const std::vector<int> tet{1, 4};
  const Matrix values = frame_values(*field, {{}, some_monomials()}, tet, at);
  const FrameBasis basis(field, {{{}, false}, {some_monomials(), false}});
  ASSERT_EQ(values.rows(), basis.num_functions());
  for (int p = 0; p < 2; ++p) EXPECT_EQ(values.col(p), basis.sample(tet[p], at.col(p)).N);
}

}  // namespace
}  // namespace polyaffine
