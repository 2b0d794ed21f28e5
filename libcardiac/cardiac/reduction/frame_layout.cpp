#include "cardiac/reduction/frame_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include <cardiac/anatomy/right_ventricle.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {

using polyaffine::InputError;
using polyaffine::kPi;
using polyaffine::Vec4;

namespace {

// Fewest nodes of a ring: with fewer, weights would reach around the axis.
constexpr int kFewestNodes = 3;

void check(const RingOptions& options) {
  const auto& nodes = options.nodes;
  if (nodes.empty() || *std::min_element(nodes.begin(), nodes.end()) < kFewestNodes)
    throw InputError("reduction.ring_nodes: expected at least one ring, and three nodes or more in each");
  const auto& u = options.positions;
  if (!u.empty() && (u.size() != nodes.size() || u.front() <= 0 || u.back() >= 1 ||
                     std::adjacent_find(u.begin(), u.end(), std::greater_equal<>()) != u.end()))
    throw InputError("reduction.ring_positions: expected " + std::to_string(nodes.size()) +
                     " rising numbers between 0 and 1, one a ring");
  if (!options.angles.empty() && options.angles.size() != nodes.size())
    throw InputError("reduction.ring_angles_deg: expected " + std::to_string(nodes.size()) +
                     " angles, one a ring");
}

bool is_aha(const RingOptions& options) {
  return options.nodes == RingOptions().nodes &&
         std::all_of(options.angles.begin(), options.angles.end(), [](double a) { return a == 0; });
}

// Positions of AHA's apical, mid and basal ring. Near the ends, where the wall bends and is held, they stand
// closer.
constexpr std::array<double, 3> kAhaPositions{0.2, 0.5, 0.85};

// Positions of the rows of the right free wall, in shares of its apicobasal range, for the same reason; and
// their numbers of nodes: one for each of its segments 29, 26–28, 22–25 and 18–21.
constexpr std::array<double, 4> kRightPositions{0, 0.3, 0.55, 0.85};
constexpr std::array<int, 4> kRightNodes{1, 3, 4, 4};

std::vector<FrameRing> make_rings(const RingOptions& options) {
  std::vector<FrameRing> rings(options.nodes.size());
  const auto n = static_cast<int>(rings.size());
  int frame = 0;
  for (int k = n - 1; k >= 0; --k) {
    FrameRing& ring = rings[k];
    ring.u = options.positions.empty() ? (k + 1) / (n + 0.5) : options.positions[k];
    ring.nodes = options.nodes[k];
    ring.angle = options.angles.empty() ? 0.0 : options.angles[k];
    ring.first_frame = frame;
    frame += ring.nodes;
  }
  return rings;
}

// Ring that owns a frame, counted from 1 at the apex; 0 for the cap.
int ring_of(const FrameLayout& layout, int frame) {
  auto k = static_cast<int>(layout.rings.size());
  while (k > 0 && frame >= layout.rings[k - 1].first_frame + layout.rings[k - 1].nodes) --k;
  return k;
}

// Means of the right free wall: distance to its axis, and thickness 1/|∇t|.
void measure_right_wall(const polyaffine::TetMesh& mesh, const RightVentricularCoordinates& right,
                        const std::vector<int>& frame, FrameLayout& layout) {
  double volume = 0;
  for (int t = 0; t < mesh.num_tets(); ++t) {
    if (frame[t] <= layout.cap()) continue;
    const double v = mesh.tet_volume(t);
    volume += v;
    layout.right_radius += v * right.radius(mesh.tet_centroid(t));
    layout.right_thickness += v / right.sample(t, Vec4::Constant(0.25)).grad_t.norm();
  }
  layout.right_radius /= volume;
  layout.right_thickness /= volume;
}

// Position of the first row: the mean of the apical region, but so high that the weights of the other rows,
// which depend on the angle about the right axis, vanish where the axis leaves the wall (which it does within
// a thickness of the highest tet that close to it).
double first_right_position(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                            const std::vector<int>& frame, int apex_frame, const FrameLayout& layout) {
  double apex = 0, apex_volume = 0, on_axis = 0;
  for (int t = 0; t < mesh.num_tets(); ++t) {
    if (frame[t] <= layout.cap()) continue;
    const double u = coordinates.sample(t, Vec4::Constant(0.25)).u;
    if (frame[t] == apex_frame) {
      apex += mesh.tet_volume(t) * u;
      apex_volume += mesh.tet_volume(t);
    }
    if (coordinates.right()->radius(mesh.tet_centroid(t)) < layout.right_thickness)
      on_axis = std::max(on_axis, u);
  }
  if (apex_volume > 0) apex /= apex_volume;
  return std::max(apex, on_axis);
}

void add_right_rows(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                    const std::vector<int>& frame, FrameLayout& layout) {
  measure_right_wall(mesh, *coordinates.right(), frame, layout);
  const int apex_frame = layout.cap() + kBothSegments - kAhaSegments;
  const double first = first_right_position(mesh, coordinates, frame, apex_frame, layout);
  int next = apex_frame + 1;  // frames are numbered from the base to the apex
  for (std::size_t k = 0; k < kRightNodes.size(); ++k) {
    next -= kRightNodes[k];
    layout.right.push_back({first + kRightPositions[k] * (1 - first), kRightNodes[k], next});
  }
}

// Throws InputError where a region has no tet.
void check_regions(const std::vector<int>& frame, int num_nodes) {
  std::vector<int> tets(num_nodes, 0);
  for (const int i : frame) ++tets[i];
  for (int i = 0; i < num_nodes; ++i)
    if (tets[i] == 0)
      throw InputError("mesh: no tet lies in the region of control node " + std::to_string(i + 1) + " of " +
                       std::to_string(num_nodes) +
                       " (counted from the base); a finer mesh or fewer reduction.ring_nodes are needed");
}

// Means of the rings (index 0: of the cap): distance to the axis 1/|∇ψ|, thickness 1/|∇t|.
struct Mean {
  double volume = 0, radius = 0, thickness = 0;
};
std::vector<Mean> measure_rings(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                                const std::vector<int>& frame, const FrameLayout& layout) {
  std::vector<Mean> means(layout.rings.size() + 1);
  for (int t = 0; t < mesh.num_tets(); ++t) {
    if (frame[t] > layout.cap()) continue;
    const CoordinateSample s = coordinates.sample(t, Vec4::Constant(0.25));
    const double v = mesh.tet_volume(t);
    Mean& mean = means[ring_of(layout, frame[t])];
    mean.volume += v;
    mean.radius += v / s.grad_psi.norm();
    mean.thickness += v / s.grad_t.norm();
  }
  for (Mean& mean : means) {
    mean.radius /= mean.volume;
    mean.thickness /= mean.volume;
  }
  return means;
}

}  // namespace

double FrameRing::node_angle(int j) const {
  const double psi = angle + 2 * kPi * j / nodes;
  return psi > kPi ? psi - 2 * kPi : psi;
}

int FrameLayout::region(double u, double psi) const {
  std::size_t k = rings.size();
  while (k > 0 && u < (rings[k - 1].u + (k > 1 ? rings[k - 2].u : 0.0)) / 2) --k;
  if (k == 0) return cap();
  const FrameRing& ring = rings[k - 1];
  const auto j = static_cast<int>(std::floor((psi - ring.angle) / ring.step() + 0.5));
  return ring.first_frame + (j % ring.nodes + ring.nodes) % ring.nodes;
}

std::vector<int> region_tets(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                             const FrameLayout& layout) {
  std::vector<int> frame(mesh.num_tets());
  for (int t = 0; t < mesh.num_tets(); ++t) {
    const polyaffine::Vec3 X = mesh.tet_centroid(t);
    const int segment = segment_at(coordinates, t, Vec4::Constant(0.25), X);
    if (segment > kAhaSegments)
      frame[t] = layout.cap() + segment - kAhaSegments;
    else
      frame[t] = layout.follows_segments
                     ? segment - 1
                     : layout.region(coordinates.sample(t, Vec4::Constant(0.25)).u, coordinates.angle(X));
  }
  return frame;
}

FrameLayout frame_layout(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                         const RingOptions& options) {
  check(options);
  FrameLayout layout;
  layout.rings = make_rings(options);
  layout.follows_segments = is_aha(options);
  const std::vector<int> frame = region_tets(mesh, coordinates, layout);

  if (coordinates.right()) add_right_rows(mesh, coordinates, frame, layout);
  check_regions(frame, layout.num_nodes());
  const std::vector<Mean> means = measure_rings(mesh, coordinates, frame, layout);
  layout.cap_thickness = means[0].thickness;
  for (std::size_t k = 0; k < layout.rings.size(); ++k) {
    layout.rings[k].radius = means[k + 1].radius;
    layout.rings[k].thickness = means[k + 1].thickness;
    if (layout.follows_segments && options.positions.empty()) layout.rings[k].u = kAhaPositions[k];
  }
  layout.length = std::cbrt(mesh.volume() / layout.num_nodes());
  return layout;
}

}  // namespace cardiac
