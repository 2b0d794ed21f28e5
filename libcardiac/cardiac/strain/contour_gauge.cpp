#include "cardiac/strain/contour_gauge.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <cardiac/anatomy/right_ventricle.hpp>
#include <cardiac/anatomy/segments.hpp>

namespace cardiac {

using polyaffine::Points;
using polyaffine::TetMesh;
using polyaffine::Vec3;
using polyaffine::Vec4;
using polyaffine::Vector;

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::array kPlanesDeg{0.0, 60.0, 120.0};        // of apical views, from anterior
constexpr std::array kLevels{1.0 / 6, 1.0 / 2, 5.0 / 6};  // of short-axis views: middles of the thirds
constexpr std::array kRightAngles{-0.5, 0.0, 0.5};        // rotational coordinates of the right free wall
constexpr double kLargestJump = 1;                        // of that coordinate across a triangle
constexpr int kLeftApex = kAhaSegments;
constexpr int kRightApex = kBothSegments;

bool is_right(int segment) {
  return segment > kAhaSegments;
}

// The coordinate of the right free wall's angle at every vertex of the mesh.
Vector right_angle(const TetMesh& mesh, const RightVentricularCoordinates& right) {
  Vector out(mesh.num_points());
  for (int t = 0; t < mesh.num_tets(); ++t)
    for (int k = 0; k < 4; ++k) out[mesh.tets()(k, t)] = right.sample(t, Vec4::Unit(k)).psi;
  return out;
}

std::vector<double> lengths(const std::vector<MaterialLine>& lines, const Points& positions) {
  std::vector<double> out;
  for (const MaterialLine& line : lines) out.push_back(line.length(positions));
  return out;
}

// Mean change of length of lines, percent; lines that are empty do not count.
double mean_strain(const std::vector<double>& now, const std::vector<double>& before) {
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < now.size(); ++k) {
    if (before[k] <= 0) continue;
    sum += now[k] / before[k] - 1;
    ++count;
  }
  return count == 0 ? kNone : 100 * sum / count;
}

}  // namespace

ContourGauge::ContourGauge(const TetMesh& mesh, const VentricularCoordinates& coordinates,
                           const std::vector<int>& segment, const SurfaceLabels& labels, Side side,
                           const Points& x_ed)
    : side_(side), axis_(coordinates.axis()) {
  add_sheets(mesh, coordinates, segment, labels);
  add_lines(mesh, coordinates);
  add_wall(mesh, segment);
  add_rim(mesh, segment, labels);
  for (const int layer : {inner, middle, outer}) {
    const Points positions = sheets_[layer].positions(x_ed);
    longitudinal_ed_[layer] = lengths(longitudinal_[layer], positions);
    circumferential_ed_[layer] = lengths(circumferential_[layer], positions);
  }
  thickness_ed_ = thickness(x_ed);
  if (!rim_.empty()) height_ed_ = height(x_ed);
  apex_ed_ = x_ed.col(apex_);
}

void ContourGauge::add_sheets(const TetMesh& mesh, const VentricularCoordinates& coordinates,
                              const std::vector<int>& segment, const SurfaceLabels& labels) {
  const bool right = side_ == Side::right;
  const int inside = right ? labels.rv_endo.value() : labels.endo;
  std::vector<int> in, out, in_wall, out_wall, tets;
  for (int f = 0; f < static_cast<int>(mesh.boundary_labels().size()); ++f) {
    const int label = mesh.boundary_labels()[f];
    const int s = segment[mesh.boundary_tets()[f]];
    if (is_right(s) != right) continue;
    const bool apex = s == (right ? kRightApex : kLeftApex);
    if (label == inside) {
      in.push_back(f);
      if (!apex) in_wall.push_back(f);
    } else if (label == labels.epi || (labels.rv_endo && label == *labels.rv_endo)) {
      out.push_back(f);
      if (!apex) out_wall.push_back(f);
    }
  }
  for (int t = 0; t < mesh.num_tets(); ++t)
    if (is_right(segment[t]) == right) tets.push_back(t);
  const Vector depth =
      (right ? coordinates.right()->transmural() : coordinates.transmural()).head(mesh.num_points());
  sheets_[inner] = boundary_sheet(mesh, in);
  sheets_[middle] = level_sheet(mesh, tets, depth, 0.5);
  sheets_[outer] = boundary_sheet(mesh, out);
  inner_wall_ = boundary_sheet(mesh, in_wall);
  outer_wall_ = boundary_sheet(mesh, out_wall);
}

void ContourGauge::add_lines(const TetMesh& mesh, const VentricularCoordinates& coordinates) {
  const auto cut = [&](std::array<Lines, 3>& lines, const Vector& field, double largest_jump) {
    for (const int layer : {inner, middle, outer})
      lines[layer].push_back(zero_line(sheets_[layer], field, largest_jump));
  };
  constexpr double kAny = std::numeric_limits<double>::infinity();
  if (side_ == Side::right) {
    const Vector angle = right_angle(mesh, *coordinates.right());
    for (const double level : kRightAngles) cut(longitudinal_, angle.array() - level, kLargestJump);
    return;
  }
  const Points X = mesh.points().colwise() - coordinates.base_centre();
  for (const double degrees : kPlanesDeg) {
    const double a = degrees * polyaffine::kPi / 180;
    const Vec3 across = axis_.cross(coordinates.anterior());
    const Vec3 normal = std::cos(a) * across - std::sin(a) * coordinates.anterior();
    cut(longitudinal_, X.transpose() * normal, kAny);
  }
  Vector height(mesh.num_points());
  for (Eigen::Index v = 0; v < height.size(); ++v)
    height[v] = coordinates.long_axis_height(mesh.points().col(v));
  for (const double level : kLevels) cut(circumferential_, height.array() - level, kAny);
}

void ContourGauge::add_wall(const TetMesh& mesh, const std::vector<int>& segment) {
  std::vector<int> tets;
  for (int t = 0; t < mesh.num_tets(); ++t)
    if (is_right(segment[t]) == (side_ == Side::right) && segment[t] != kLeftApex && segment[t] != kRightApex)
      tets.push_back(t);
  wall_ = mesh.tets()(Eigen::all, tets);
}

void ContourGauge::add_rim(const TetMesh& mesh, const std::vector<int>& segment,
                           const SurfaceLabels& labels) {
  const bool right = side_ == Side::right;
  std::set<int> base, inside;
  double lowest = std::numeric_limits<double>::infinity();
  for (int f = 0; f < static_cast<int>(mesh.boundary_labels().size()); ++f) {
    const int label = mesh.boundary_labels()[f];
    for (const int v : mesh.boundary().col(f)) {
      if (label == labels.base) base.insert(v);
      if (label == (right ? labels.rv_endo.value() : labels.endo) &&
          is_right(segment[mesh.boundary_tets()[f]]) == right)
        inside.insert(v);
      if (label == labels.epi && mesh.points().col(v).dot(axis_) < lowest) {
        lowest = mesh.points().col(v).dot(axis_);
        apex_ = v;
      }
    }
  }
  std::ranges::set_intersection(base, inside, std::back_inserter(rim_));
}

double ContourGauge::thickness(const Points& x) const {
  double volume = 0;
  for (const auto& tet : wall_.colwise()) volume += polyaffine::signed_volume(x, tet);
  const double in = inner_wall_.area(inner_wall_.positions(x));
  const double out = outer_wall_.area(outer_wall_.positions(x));
  return volume / ((in + std::sqrt(in * out) + out) / 3);
}

double ContourGauge::height(const Points& x) const {
  return axis_.dot(x(Eigen::all, rim_).rowwise().mean() - x.col(apex_));
}

void ContourGauge::measure(const Points& x, GlobalStrain& out) const {
  for (const int layer : {inner, middle, outer}) {
    const Points positions = sheets_[layer].positions(x);
    const auto member = std::array{&LayerStrain::endocardial_percent, &LayerStrain::midwall_percent,
                                   &LayerStrain::epicardial_percent}[layer];
    out.longitudinal.*member = mean_strain(lengths(longitudinal_[layer], positions), longitudinal_ed_[layer]);
    out.circumferential.*member =
        mean_strain(lengths(circumferential_[layer], positions), circumferential_ed_[layer]);
  }
  out.wall_thickening_percent = 100 * (thickness(x) / thickness_ed_ - 1);
  out.base_excursion_mm = rim_.empty() ? kNone : height_ed_ - height(x);
  out.apex_motion_mm = (x.col(apex_) - apex_ed_).norm();
}

}  // namespace cardiac
