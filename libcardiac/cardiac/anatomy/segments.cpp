#include "cardiac/anatomy/segments.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

constexpr std::array<int, 4> kFirst{17, 13, 7, 1};
constexpr std::array<int, 4> kSize{1, 4, 6, 6};

}  // namespace

const std::string& aha_name(int segment) {
  static const std::array<std::string, kAhaSegments> names{"basal anterior",
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
                                                           "apex"};
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

std::vector<int> segment_tets(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates) {
  std::vector<int> segment(mesh.num_tets());
  std::array<int, kAhaSegments> count{};
  for (int t = 0; t < mesh.num_tets(); ++t) {
    const polyaffine::Vec3 X = mesh.tet_centroid(t);
    segment[t] = aha_segment(coordinates.long_axis_height(X), coordinates.angle(X));
    ++count[segment[t] - 1];
  }
  for (int s = 1; s <= kAhaSegments; ++s)
    if (count[s - 1] == 0)
      throw polyaffine::InputError("mesh: AHA segment " + std::to_string(s) + " (" + aha_name(s) +
                                   ") has size zero: no tet lies in it; a finer mesh is needed");
  return segment;
}

std::vector<double> segment_volumes(const polyaffine::TetMesh& mesh, const std::vector<int>& segment) {
  std::vector<double> volume(kAhaSegments, 0.0);
  for (int t = 0; t < mesh.num_tets(); ++t) volume[segment[t] - 1] += mesh.tet_volume(t);
  return volume;
}

}  // namespace cardiac
