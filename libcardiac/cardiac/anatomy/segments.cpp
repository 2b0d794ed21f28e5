#include "cardiac/anatomy/segments.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <cardiac/anatomy/right_ventricle.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/geodesic_regions.hpp>

namespace cardiac {
namespace {

constexpr std::array<int, 4> kFirst{17, 13, 7, 1};
constexpr std::array<int, 4> kSize{1, 4, 6, 6};

// Of the right free wall: apex and rings above it.
constexpr std::array<int, 4> kRightFirst{29, 26, 22, 18};
constexpr std::array<int, 4> kRightSize{1, 3, 4, 4};
constexpr double kRightApex = 1.0 / 8;

}  // namespace

const std::string& aha_name(int segment) {
  static const std::array<std::string, kBothSegments> names{"basal anterior",
                                                            "basal anteroseptal",
                                                            "basal inferoseptal",
                                                            "basal inferior",
                                                            "basal inferolateral",
                                                            "basal anterolateral",
                                                            "mid anterior",
                                                            "mid anteroseptal",
                                                            "mid inferoseptal",
                                                            "mid inferior",
                                                            "mid inferolateral",
                                                            "mid anterolateral",
                                                            "apical anterior",
                                                            "apical septal",
                                                            "apical inferior",
                                                            "apical lateral",
                                                            "apex",
                                                            "RV basal anterior",
                                                            "RV basal anterolateral",
                                                            "RV basal inferolateral",
                                                            "RV basal inferior",
                                                            "RV mid anterior",
                                                            "RV mid anterolateral",
                                                            "RV mid inferolateral",
                                                            "RV mid inferior",
                                                            "RV apical anterior",
                                                            "RV apical lateral",
                                                            "RV apical inferior",
                                                            "RV apex"};
  return names.at(segment - 1);
}

int aha_ring(int segment) {
  return segment == 17 ? 0 : segment >= 13 ? 1 : segment >= 7 ? 2 : 3;
}
int aha_ring_first(int ring) {
  return kFirst.at(ring);
}
int aha_ring_size(int ring) {
  return kSize.at(ring);
}

double aha_centre_angle(int segment) {
  const int ring = aha_ring(segment);
  if (ring == 0) return 0;
  const double angle = 2 * polyaffine::kPi * (segment - kFirst[ring]) / kSize[ring];
  return angle > polyaffine::kPi ? angle - 2 * polyaffine::kPi : angle;
}

int aha_segment(double long_axis_height, double psi) {
  if (long_axis_height < 0) return 17;
  const int ring = long_axis_height < 1.0 / 3 ? 1 : long_axis_height < 2.0 / 3 ? 2 : 3;
  const int n = kSize[ring];
  const int sector = static_cast<int>(std::floor(psi * n / (2 * polyaffine::kPi) + 0.5));
  return kFirst[ring] + (sector % n + n) % n;
}

std::array<double, kAhaSegments> segment_shares(double height, double psi, double border) {
  // 0 below the edge, 1 above it, over the width.
  const auto step = [](double distance, double width) {
    if (width <= 0) return distance < 0 ? 0.0 : 1.0;
    const double s = std::clamp(distance / width + 0.5, 0.0, 1.0);
    return s * s * (3 - 2 * s);
  };
  std::array<double, kAhaSegments> share{};
  const std::array<double, 5> above{1, step(height, border / 3), step(height - 1.0 / 3, border / 3),
                                    step(height - 2.0 / 3, border / 3), 0};
  for (int ring = 0; ring < 4; ++ring) {
    const double in_ring = above[ring] - above[ring + 1];
    for (int j = 0; j < kSize[ring]; ++j) {
      const double sector = 2 * polyaffine::kPi / kSize[ring];
      const double from_centre = std::abs(std::remainder(psi - j * sector, 2 * polyaffine::kPi)) / sector;
      share[kFirst[ring] + j - 1] = ring == 0 ? in_ring : in_ring * step(0.5 - from_centre, border);
    }
  }
  return share;
}

int right_segment(double height, double psi) {
  const int ring = height < kRightApex ? 0 : height < 1.0 / 3 ? 1 : height < 2.0 / 3 ? 2 : 3;
  const int n = kRightSize[ring];
  return kRightFirst[ring] + std::clamp(static_cast<int>(std::floor((psi + 1) / 2 * n)), 0, n - 1);
}

int num_segments(const VentricularCoordinates& coordinates) {
  return coordinates.right() ? kBothSegments : kAhaSegments;
}

int segment_at(const VentricularCoordinates& coordinates, int tet, const polyaffine::Vec4& barycentric,
               const polyaffine::Vec3& X) {
  if (const auto* right = coordinates.right(); right && right->border(tet, barycentric).w > 0.5)
    return right_segment(right->height(X), right->sample(tet, barycentric).psi);
  return aha_segment(coordinates.long_axis_height(X), coordinates.sector_angle(X));
}

std::vector<double> shares_at(const VentricularCoordinates& coordinates, int tet,
                              const polyaffine::Vec4& barycentric, double border) {
  std::vector<double> out(num_segments(coordinates), 0.0);
  const polyaffine::Vec3 X = coordinates.position(tet, barycentric);
  if (const int segment = segment_at(coordinates, tet, barycentric, X); segment > kAhaSegments) {
    out[segment - 1] = 1;
    return out;
  }
  const auto left = segment_shares(coordinates.long_axis_height(X), coordinates.sector_angle(X), border);
  std::copy(left.begin(), left.end(), out.begin());
  return out;
}

std::vector<int> segment_tets(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates) {
  std::vector<int> segment(mesh.num_tets());
  for (int t = 0; t < mesh.num_tets(); ++t)
    segment[t] = segment_at(coordinates, t, polyaffine::Vec4::Constant(0.25), mesh.tet_centroid(t));
  if (coordinates.right()) segment = polyaffine::connect_regions(mesh, std::move(segment));
  std::vector<int> count(num_segments(coordinates), 0);
  for (const int s : segment) ++count[s - 1];
  for (std::size_t s = 1; s <= count.size(); ++s)
    if (count[s - 1] == 0)
      throw polyaffine::InputError("mesh: AHA segment " + std::to_string(s) + " (" +
                                   aha_name(static_cast<int>(s)) +
                                   ") has size zero: no tet lies in it; a finer mesh is needed");
  return segment;
}

std::vector<double> segment_volumes(const polyaffine::TetMesh& mesh, const std::vector<int>& segment,
                                    int count) {
  std::vector<double> volume(count, 0.0);
  for (int t = 0; t < mesh.num_tets(); ++t) volume[segment[t] - 1] += mesh.tet_volume(t);
  return volume;
}

}  // namespace cardiac
