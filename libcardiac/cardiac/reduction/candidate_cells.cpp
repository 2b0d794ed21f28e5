#include "cardiac/reduction/candidate_cells.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include <cardiac/anatomy/right_ventricle.hpp>

namespace cardiac {

using polyaffine::Points;
using polyaffine::Vec3;
using polyaffine::Vec4;

namespace {

// Rotational coordinate of the middle of each region of a ring, rad; 0 for the others, which do not use it.
std::vector<double> middle_angles(const FrameLayout& layout) {
  std::vector<double> out(layout.num_nodes(), 0.0);
  for (const FrameRing& ring : layout.rings)
    for (int j = 0; j < ring.nodes; ++j) out[ring.first_frame + j] = ring.node_angle(j);
  return out;
}

// Coordinates of a point of a region, not yet scaled:
//   region of a ring   (u, ψ from the region's middle, t);
//   the cap            (across the axis towards anterior and at right angles to it, mm, t): u and ψ mean
//                      little there;
//   right free wall    (u, the right ventricle's own ψ, its own t).
Vec3 place_in_region(const VentricularCoordinates& heart, const FrameLayout& layout, int region,
                     double middle_angle, int tet, const Vec4& barycentric) {
  const CoordinateSample at = heart.sample(tet, barycentric);
  if (region > layout.cap()) {
    const auto right = heart.right()->sample(tet, barycentric);
    return {at.u, right.psi, right.t};
  }
  if (region == layout.cap()) {
    const Vec3 X = heart.position(tet, barycentric) - heart.base_centre();
    return {X.dot(heart.anterior()), X.dot(heart.axis().cross(heart.anterior())), at.t};
  }
  return {at.u, std::remainder(at.psi - middle_angle, 2 * polyaffine::kPi), at.t};
}

}  // namespace

CandidateCells cells_of_tents(const SegmentCells& cells, const std::vector<int>& tet,
                              const Eigen::Matrix4Xd& barycentric) {
  CandidateCells out{{}, Points(3, barycentric.cols())};
  for (Eigen::Index q = 0; q < out.place.cols(); ++q) {
    const auto at = cells(tet[q], barycentric.col(q));
    out.cell.push_back(at.cell);
    out.place.col(q) = at.place;
  }
  return out;
}

CandidateCells cells_of_regions(const VentricularCoordinates& heart, const Discretisation& d,
                                const std::vector<int>& tet, const Eigen::Matrix4Xd& barycentric) {
  const std::vector<double> middle = middle_angles(d.layout);
  CandidateCells out{{}, Points(3, barycentric.cols())};
  Points low = Points::Constant(3, d.layout.num_nodes(), HUGE_VAL);
  Points high = -low;
  for (Eigen::Index q = 0; q < out.place.cols(); ++q) {
    const int region = d.region[tet[q]];
    const Vec3 place = place_in_region(heart, d.layout, region, middle[region], tet[q], barycentric.col(q));
    out.cell.push_back(region);
    out.place.col(q) = place;
    low.col(region) = low.col(region).cwiseMin(place);
    high.col(region) = high.col(region).cwiseMax(place);
  }
  for (Eigen::Index q = 0; q < out.place.cols(); ++q) {
    const int k = out.cell[q];
    out.place.col(q) = (out.place.col(q) - low.col(k)).cwiseQuotient(high.col(k) - low.col(k));
  }
  return out;
}

}  // namespace cardiac
