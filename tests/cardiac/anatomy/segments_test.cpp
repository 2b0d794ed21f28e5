#include "cardiac/anatomy/segments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "support/land_ellipsoid.hpp"

namespace cardiac {
namespace {

using polyaffine::kPi;
using polyaffine::Vec3;
using testing::LandEllipsoid;

struct Place {
  int segment;
  double degrees;  // from the anterior wall (+y) towards the septum (+x)
  double z;        // mm; thirds of the axis end at −17, −9.67, −2.33 and 5
  const char* name;
};

// Cerqueira et al. 2002, figures 1 to 3: the septum holds 2, 3, 8, 9 and 14, the free wall 5, 6, 11, 12
// and 16.
const std::vector<Place> kPlaces{{1, 0, 2, "basal anterior"},
                                 {2, 60, 2, "basal anteroseptal"},
                                 {3, 120, 2, "basal inferoseptal"},
                                 {4, 180, 2, "basal inferior"},
                                 {5, 240, 2, "basal inferolateral"},
                                 {6, 300, 2, "basal anterolateral"},
                                 {7, 20, -6, "mid anterior"},
                                 {8, 80, -6, "mid anteroseptal"},
                                 {9, 100, -6, "mid inferoseptal"},
                                 {10, 200, -6, "mid inferior"},
                                 {11, 215, -6, "mid inferolateral"},
                                 {12, 325, -6, "mid anterolateral"},
                                 {13, -40, -12, "apical anterior"},
                                 {14, 90, -12, "apical septal"},
                                 {15, 180, -12, "apical inferior"},
                                 {16, 270, -12, "apical lateral"},
                                 {17, 77, -18, "apex"}};

TEST(Segments, PositionsOnTheEllipsoidHaveTheirAhaNumber) {
  const auto& c = *LandEllipsoid::get().coordinates;
  for (const Place& p : kPlaces) {
    const double a = p.degrees * kPi / 180;
    const Vec3 X(c.base_centre().x() + 8 * std::sin(a), c.base_centre().y() + 8 * std::cos(a), p.z);
    EXPECT_EQ(aha_segment(c.long_axis_height(X), c.angle(X)), p.segment) << p.name;
    EXPECT_EQ(aha_name(p.segment), p.name);
  }
}

TEST(Segments, EdgesLieAtThirdsAndHalfwayBetweenCentres) {
  constexpr double kDegree = kPi / 180;
  EXPECT_EQ(aha_segment(2.0 / 3 + 1e-9, 29.9 * kDegree), 1);
  EXPECT_EQ(aha_segment(2.0 / 3 + 1e-9, 30.1 * kDegree), 2);
  EXPECT_EQ(aha_segment(2.0 / 3 - 1e-9, -30.1 * kDegree), 12);
  EXPECT_EQ(aha_segment(1.0 / 3 + 1e-9, -29.9 * kDegree), 7);
  EXPECT_EQ(aha_segment(1.0 / 3 - 1e-9, 44.9 * kDegree), 13);
  EXPECT_EQ(aha_segment(1e-9, 45.1 * kDegree), 14);
  EXPECT_EQ(aha_segment(-1e-9, 1), 17);
  EXPECT_EQ(aha_segment(1.2, kPi), 4);
  EXPECT_EQ(aha_segment(0.9, -kPi), 4);
}

TEST(Segments, CentresAndRingsAgreeWithTheNumbers) {
  const std::array<double, 4> height{-0.1, 1.0 / 6, 0.5, 5.0 / 6};
  int count = 0;
  for (int ring = 0; ring < 4; ++ring)
    for (int j = 0; j < aha_ring_size(ring); ++j, ++count) {
      const int segment = aha_ring_first(ring) + j;
      EXPECT_EQ(aha_ring(segment), ring);
      EXPECT_EQ(aha_segment(height[ring], aha_centre_angle(segment)), segment);
      EXPECT_LE(std::abs(aha_centre_angle(segment)), kPi + 1e-15);
    }
  EXPECT_EQ(count, kAhaSegments);
}

TEST(Segments, SharesSumToOneAndMatchTheNumberInside) {
  for (const double border : {0.0, 0.1, 0.5})
    for (double h = -0.195; h < 1.05; h += 0.05)
      for (double psi = -kPi + 0.01; psi < kPi; psi += 0.05) {
        const auto share = segment_shares(h, psi, border);
        EXPECT_NEAR(std::accumulate(share.begin(), share.end(), 0.0), 1, 1e-14);
        EXPECT_GE(*std::min_element(share.begin(), share.end()), 0);
        const int segment = aha_segment(h, psi);
        EXPECT_GE(share[segment - 1], 0.25 - 1e-14);  // half along the axis, half around it at a corner
        if (border == 0) {
          EXPECT_EQ(share[segment - 1], 1);
        }
      }
  for (int s = 1; s <= 16; ++s) {
    const double h = (aha_ring(s) - 0.5) / 3;
    EXPECT_EQ(segment_shares(h, aha_centre_angle(s), 0.5)[s - 1], 1);
    const double edge = aha_centre_angle(s) + kPi / aha_ring_size(aha_ring(s));
    EXPECT_NEAR(segment_shares(h, edge, 0.2)[s - 1], 0.5, 1e-12);
  }
  // Half the border beyond the edge nothing is left, and in between the share falls.
  const double edge = kPi / 6;
  EXPECT_EQ(segment_shares(5.0 / 6, edge * 1.21, 0.2)[0], 0);
  EXPECT_EQ(segment_shares(5.0 / 6, edge * 0.79, 0.2)[0], 1);
  EXPECT_GT(segment_shares(5.0 / 6, edge * 0.9, 0.2)[0], segment_shares(5.0 / 6, edge * 1.1, 0.2)[0]);
}

TEST(Segments, TetsCoverTheMesh) {
  const auto& land = LandEllipsoid::get();
  const std::vector<int> segment = segment_tets(land.mesh, *land.coordinates);
  ASSERT_EQ(static_cast<int>(segment.size()), land.mesh.num_tets());
  const std::vector<double> volume = segment_volumes(land.mesh, segment);
  EXPECT_NEAR(std::accumulate(volume.begin(), volume.end(), 0.0), land.mesh.volume(),
              1e-9 * land.mesh.volume());
  // An axisymmetric wall: segments of a ring are equal but for the size of a tet.
  for (int ring = 1; ring < 4; ++ring) {
    double sum = 0;
    for (int j = 0; j < aha_ring_size(ring); ++j) sum += volume[aha_ring_first(ring) + j - 1];
    for (int j = 0; j < aha_ring_size(ring); ++j) {
      const double mean = sum / aha_ring_size(ring);
      EXPECT_NEAR(volume[aha_ring_first(ring) + j - 1], mean, 0.35 * mean);
    }
  }
  // The cap is the solid of the epicardial ellipsoid below z = −17: π a² (2c/3 + z − z³/(3c²)).
  const double cap = kPi * 100 * (40.0 / 3 - 17 + std::pow(17, 3) / 1200);
  EXPECT_NEAR(volume[16], cap, 0.35 * cap);
}

}  // namespace
}  // namespace cardiac
