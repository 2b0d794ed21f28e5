#include "cardiac/anatomy/check_surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>

#include <cardiac/anatomy/bare_ring.hpp>
#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/anatomy/surface_names.hpp>
#include <cardiac/core/units.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/mesh/triangle_adjacency.hpp>

namespace cardiac {
namespace {

using polyaffine::InputError;
using polyaffine::Triangles;

constexpr double kLeastRoundness = 0.002;  // V/A^1.5 of a cavity; a sphere has 0.09, a lid next to nothing

/// The boundary with its labels.
struct Labelled {
  const Points& points;
  const Triangles& boundary;
  const std::vector<int>& labels;

  Triangles with(int label) const {
    std::vector<int> chosen;
    for (std::size_t f = 0; f < labels.size(); ++f)
      if (labels[f] == label) chosen.push_back(static_cast<int>(f));
    return boundary(Eigen::all, chosen);
  }
};

std::string number(double value) {
  std::ostringstream out;
  out.precision(4);
  out << value;
  return out.str();
}

/// Volume that the surface with a label surrounds with a cone over its rims, mm³, positive for the outside of
/// a body.
double surrounded(const Labelled& heart, int label) {
  const Triangles surface = heart.with(label);
  Vec3 tip = Vec3::Zero();
  const auto rim = polyaffine::triangle_adjacency(surface).open;
  for (const auto& [a, b] : rim)
    tip += (heart.points.col(a) + heart.points.col(b)) / (2.0 * static_cast<double>(rim.size()));
  double sum = 0;
  for (const auto& t : surface.colwise()) {
    const Vec3 a = heart.points.col(t[0]) - tip, b = heart.points.col(t[1]) - tip;
    sum += a.dot(b.cross(heart.points.col(t[2]) - tip)) / 6;
  }
  return sum;
}

[[noreturn]] void fail_contradiction(int label, const std::string& found) {
  throw InputError(std::string("mesh: the surface labelled ") + surface_title(label) + ' ' + found +
                   "; are labels swapped?");
}

/// Volume of a cavity, mm³.
double check_cavity(const Labelled& heart, int label) {
  const Triangles surface = heart.with(label);
  const polyaffine::EnclosedVolume cavity(surface);
  const double volume = cavity.value(heart.points);
  const double area = polyaffine::triangle_areas(heart.points, surface).sum();
  if (cavity.rims().empty()) fail_contradiction(label, "is closed, expected an opening at the base");
  if (volume < kLeastRoundness * std::pow(area, 1.5))
    fail_contradiction(label, "surrounds no cavity: found " + number(volume / mm3_per_mL) + " mL behind " +
                                  number(area / 100) + " cm², expected a cavity inside the wall");
  return volume;
}

void check_rims(const Labelled& heart, int label) {
  const Triangles base_triangles = heart.with(kBase);
  const std::set<int> base(base_triangles.reshaped().begin(), base_triangles.reshaped().end());
  const auto rims = polyaffine::rim_loops(heart.with(label));
  for (const auto& rim : rims)
    for (const int p : rim)
      if (!base.contains(p)) {
        const Vec3 x = heart.points.col(p);
        throw InputError("open cavity: found a rim of the " + std::string(surface_title(label)) +
                         " off the base at (" + number(x.x()) + ", " + number(x.y()) + ", " + number(x.z()) +
                         ") mm, expected the endocardium to reach the base all round");
      }
}

}  // namespace

void check_heart_surfaces(const Points& points, const Triangles& boundary, const std::vector<int>& labels) {
  const Labelled heart{points, boundary, labels};
  std::vector<int> endocardia{kEndocardium};
  if (heart.with(kRvEndocardium).cols() > 0) endocardia.push_back(kRvEndocardium);
  double cavities = 0;
  for (const int label : endocardia) cavities += check_cavity(heart, label);
  if (const double outside = surrounded(heart, kEpicardium); outside < cavities)
    fail_contradiction(kEpicardium, "does not surround the cavities: found " + number(outside / mm3_per_mL) +
                                        " mL within it, expected more than their " +
                                        number(cavities / mm3_per_mL));
  check_bare_rings(points, boundary, labels);
  for (const int label : endocardia) check_rims(heart, label);
}

}  // namespace cardiac
