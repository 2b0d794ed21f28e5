#include "cardiac/anatomy/recognise_surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <queue>
#include <sstream>
#include <tuple>

#include <cardiac/anatomy/bare_ring.hpp>
#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/core/units.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/triangle_tree.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/mesh/triangle_adjacency.hpp>

namespace cardiac {
namespace {

using polyaffine::InputError;
using polyaffine::Mat3;
using polyaffine::Points;
using polyaffine::TetMesh;
using polyaffine::Triangles;
using polyaffine::Vector;

// What a triangle is while it is being found.
constexpr int kUnknown = -1, kOutside = 0, kInside = 1;
// Rays from a triangle (48 tell shares apart by 2 %), and the most triangles that are probed: a larger
// surface is probed in every n-th one.
constexpr int kRays = 48, kMostProbes = 20000;
// A triangle is inside or outside beyond doubt when more or less than this share of its rays meets the wall
// again: of a rim, half of them do.
constexpr double kEnclosed = 0.6, kFree = 0.2;
// Cosines between a normal outside and the direction of the opening. The base goes on from the rim while it
// faces up (53°); what faces aside or down (73° and more) is epicardium beyond doubt.
constexpr double kFacesUp = 0.6, kFacesAside = 0.3;
// A part of the inside that is smaller than this share of the largest cavity's area is a pocket, not a
// cavity.
constexpr double kPocket = 0.05;
// Cosines between the normals of neighbours. A wall whose faces meet at less than 75° tapers to an edge
// (normals 105° apart); faces that bend by less than 45° have no edge of a base between them.
constexpr double kTapered = -0.26, kSmooth = 0.7;
// Borders lose their teeth in this many passes; each takes the last triangle of a tooth.
constexpr int kSmoothings = 3;
// A ray leaves its own triangle by this share of the edge before it may meet the wall.
constexpr double kOffTriangle = 1e-6;

struct Surface {
  Points centre, normal;  ///< 3 × triangles, normals of unit length
  Vector area;
  Triangles across;
};

Surface describe(const Points& points, const Triangles& triangles) {
  Surface s;
  const Eigen::Index n = triangles.cols();
  s.centre.resize(3, n);
  s.normal.resize(3, n);
  s.area = polyaffine::triangle_areas(points, triangles);
  for (Eigen::Index f = 0; f < n; ++f) {
    const Mat3 x = points(Eigen::all, triangles.col(f));
    s.centre.col(f) = x.rowwise().mean();
    s.normal.col(f) = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).normalized();
  }
  s.across = polyaffine::triangle_adjacency(triangles).across;
  return s;
}

/// Share of the rays from a triangle that meet the wall again: the cosine-weighted directions are points of a
/// sunflower on the unit disc, raised to the hemisphere.
double enclosure(const polyaffine::TriangleTree& tree, const Vec3& from, const Vec3& normal, double edge) {
  const Vec3 x = normal.unitOrthogonal(), y = normal.cross(x);
  const double golden = polyaffine::kPi * (3 - std::sqrt(5.0));
  int hits = 0;
  for (int i = 0; i < kRays; ++i) {
    const double r2 = (i + 0.5) / kRays, r = std::sqrt(r2), phi = golden * i;
    const Vec3 direction = r * (std::cos(phi) * x + std::sin(phi) * y) + std::sqrt(1 - r2) * normal;
    hits += tree.hit(from, direction, kOffTriangle * edge);
  }
  return static_cast<double>(hits) / kRays;
}

/// Grows the seeds (labels other than kUnknown) over all triangles, flat edges first.
std::vector<int> watershed(const Surface& s, std::vector<int> label) {
  using Step = std::tuple<double, int, int, int>;  // sharpness, order of arrival, triangle, label
  std::priority_queue<Step, std::vector<Step>, std::greater<>> front;
  int arrival = 0;
  const auto spread = [&](int f) {
    for (int k = 0; k < 3; ++k)
      if (const int n = s.across(k, f); n >= 0 && label[n] == kUnknown)
        front.emplace(1 - s.normal.col(f).dot(s.normal.col(n)), arrival++, n, label[f]);
  };
  const auto size = static_cast<int>(label.size());
  for (int f = 0; f < size; ++f)
    if (label[f] != kUnknown) spread(f);
  while (!front.empty()) {
    const auto [sharpness, order, f, grown] = front.top();
    front.pop();
    if (label[f] != kUnknown) continue;
    label[f] = grown;
    spread(f);
  }
  return label;
}

std::vector<int> inside_or_outside(const Points& points, const Triangles& triangles, const Surface& s) {
  const polyaffine::TriangleTree tree(points, triangles);
  const auto size = static_cast<int>(s.area.size());
  const int step = 1 + size / kMostProbes;
  std::vector<int> seeds(size, kUnknown);
  for (int f = 0; f < size; f += step) {
    const double share = enclosure(tree, s.centre.col(f), s.normal.col(f), std::sqrt(s.area[f]));
    if (share > kEnclosed) seeds[f] = kInside;
    if (share < kFree) seeds[f] = kOutside;
  }
  std::vector<int> label = watershed(s, std::move(seeds));
  // A triangle that two of another kind surround belongs to them: borders without teeth.
  for (int pass = 0; pass < kSmoothings; ++pass)
    for (int f = 0; f < size; ++f) {
      int others = 0;
      for (int k = 0; k < 3; ++k) others += label[s.across(k, f)] != label[f];
      if (others >= 2) label[f] = 1 - label[f];
    }
  return label;
}

double area_of(const Surface& s, const std::vector<int>& faces) {
  double sum = 0;
  for (const int f : faces) sum += s.area[f];
  return sum;
}

/// The triangles of each cavity.
std::vector<std::vector<int>> cavities(const Surface& s, const std::vector<int>& label, int wanted) {
  const auto part =
      polyaffine::connected_parts(s.across, [&](int f, int k) { return label[f] == label[s.across(k, f)]; });
  std::map<int, std::vector<int>> parts;
  for (std::size_t f = 0; f < part.size(); ++f)
    if (label[f] == wanted) parts[part[f]].push_back(static_cast<int>(f));
  double largest = 0;
  for (const auto& [p, faces] : parts) largest = std::max(largest, area_of(s, faces));
  std::vector<std::vector<int>> out;
  for (const auto& [p, faces] : parts)
    if (area_of(s, faces) >= kPocket * largest) out.push_back(faces);
  return out;
}

/// V / A^1.5 of a cavity: 0.09 for a sphere, less for a crescent.
double roundness(const TetMesh& mesh, const Surface& s, const std::vector<int>& faces) {
  const polyaffine::EnclosedVolume cavity(Triangles(mesh.boundary()(Eigen::all, faces)));
  return cavity.value(mesh.points()) / std::pow(area_of(s, faces), 1.5);
}

/// The left ventricle's cavity first.
void order_cavities(const TetMesh& mesh, const Surface& s, std::vector<std::vector<int>>& found,
                    std::vector<std::string>& notes) {
  if (found.size() != 2) return;
  double left = roundness(mesh, s, found[0]), right = roundness(mesh, s, found[1]);
  if (left < right) {
    std::swap(found[0], found[1]);
    std::swap(left, right);
  }
  std::ostringstream text;
  text.precision(2);
  text << "two cavities: the left ventricle's is the rounder one (V/A^1.5 " << left << " against " << right
       << ")";
  notes.push_back(text.str());
}

/// Labels as base what is outside, faces the direction and hangs together with the rim of a cavity.
void spread_base(const Surface& s, const std::vector<int>& cavity, const Vector& facing,
                 const std::vector<int>& inside, std::vector<int>& label) {
  std::vector<int> front = cavity;
  while (!front.empty()) {
    const int f = front.back();
    front.pop_back();
    for (int k = 0; k < 3; ++k) {
      const int n = s.across(k, f);
      if (n < 0 || inside[n] == kInside || label[n] == kBase || facing[n] < kFacesUp) continue;
      label[n] = kBase;
      front.push_back(n);
    }
  }
}

/// The surface without the ways from a triangle inside to another one.
Surface outside_of(Surface s, const std::vector<int>& inside) {
  for (Eigen::Index f = 0; f < s.across.cols(); ++f)
    for (int k = 0; k < 3; ++k)
      if (inside[f] == kInside || inside[s.across(k, f)] == kInside) s.across(k, f) = -1;
  return s;
}

/// Base or epicardium for all triangles outside: seeds of both, a watershed between them, and base along
/// every rim.
std::vector<int> divide_outside(const Surface& s, const std::vector<std::vector<int>>& found,
                                const std::vector<int>& inside) {
  const auto size = static_cast<int>(inside.size());
  std::vector<int> label(size, kUnknown);
  Vector most_up = Vector::Constant(size, -1);
  for (const auto& faces : found) {
    const Vec3 up = (s.normal(Eigen::all, faces) * s.area(faces)).normalized();
    const Vector facing = s.normal.transpose() * up;
    most_up = most_up.cwiseMax(facing);
    spread_base(s, faces, facing, inside, label);
  }
  if (std::ranges::count(label, kBase) == 0) return label;
  for (int f = 0; f < size; ++f)
    if (label[f] == kUnknown && inside[f] == kOutside && most_up[f] < kFacesAside) label[f] = kEpicardium;
  label = watershed(outside_of(s, inside), std::move(label));
  for (int f = 0; f < size; ++f)
    for (int k = 0; k < 3; ++k)
      if (inside[f] == kOutside && inside[s.across(k, f)] == kInside) label[f] = kBase;
  return label;
}

/// Number of each triangle's smooth part of the inside or of the outside.
std::vector<int> smooth_parts(const Surface& s, const std::vector<int>& inside) {
  return polyaffine::connected_parts(s.across, [&](int f, int k) {
    const int n = s.across(k, f);
    return inside[f] == inside[n] && s.normal.col(f).dot(s.normal.col(n)) > kSmooth;
  });
}

/// The largest smooth part of the outside, which is the epicardium; nothing without an outside.
std::optional<int> epicardial_part(const Surface& s, const std::vector<int>& part,
                                   const std::vector<int>& inside) {
  std::map<int, double> outside;
  for (std::size_t f = 0; f < part.size(); ++f)
    if (inside[f] == kOutside) outside[part[f]] += s.area[static_cast<Eigen::Index>(f)];
  if (outside.empty()) return {};
  return std::ranges::max_element(outside, {}, [](const auto& p) { return p.second; })->first;
}

/// Throws InputError when at most of a cavity's rim the wall tapers to an edge from which the epicardium goes
/// on.
void check_rims(const Points& points, const Triangles& triangles, const Surface& s,
                const std::vector<std::vector<int>>& found, const std::vector<int>& inside) {
  const std::vector<int> part = smooth_parts(s, inside);
  const std::optional<int> epicardium = epicardial_part(s, part, inside);
  if (!epicardium) return;
  RingEdges bare;
  for (const auto& faces : found) {
    double rim = 0, tapered = 0;
    RingEdges edges;
    for (const int f : faces)
      for (int k = 0; k < 3; ++k) {
        const int n = s.across(k, f), a = triangles(k, f), b = triangles((k + 1) % 3, f);
        if (inside[n] == kInside) continue;
        const double length = (points.col(a) - points.col(b)).norm();
        rim += length;
        if (part[n] != *epicardium || s.normal.col(f).dot(s.normal.col(n)) > kTapered) continue;
        tapered += length;
        edges.push_back({a, b});
      }
    if (tapered > rim / 2) bare.insert(bare.end(), edges.begin(), edges.end());
  }
  if (!bare.empty()) throw InputError(bare_ring_text(points, bare));
}

std::vector<int> inside_of(std::size_t size, const std::vector<std::vector<int>>& found) {
  std::vector<int> out(size, kOutside);
  for (const auto& faces : found)
    for (const int f : faces) out[f] = kInside;
  return out;
}

[[noreturn]] void fail(const std::string& found, const std::string& expected) {
  throw InputError("mesh: the surfaces have no labels and could not be recognised from the shape: found " +
                   found + ", expected " + expected +
                   "; give labels in the file or a second file with labelled triangles");
}

}  // namespace

RecognisedSurfaces recognise_surfaces(const TetMesh& mesh) {
  const Surface s = describe(mesh.points(), mesh.boundary());
  RecognisedSurfaces out;
  const std::vector<int> first = inside_or_outside(mesh.points(), mesh.boundary(), s);
  auto found = cavities(s, first, kInside);
  if (found.empty())
    fail("no cavity (nothing that the wall surrounds)", "one or two ventricles open at the base");
  if (found.size() > 2) fail(std::to_string(found.size()) + " cavities", "one or two ventricles");
  const std::vector<int> inside = inside_of(first.size(), found);
  if (std::ranges::count(inside, kOutside) == 0) fail("only a cavity", "a wall with an outside");
  check_rims(mesh.points(), mesh.boundary(), s, found, inside);
  order_cavities(mesh, s, found, out.notes);
  out.labels = divide_outside(s, found, inside);
  if (std::ranges::count(out.labels, kBase) == 0)
    fail("a closed cavity without a rim that faces its opening", "a base around an opening");
  for (std::size_t c = 0; c < found.size(); ++c)
    for (const int f : found[c]) out.labels[f] = c == 0 ? kEndocardium : kRvEndocardium;
  for (int& label : out.labels)
    if (label == kUnknown) label = kEpicardium;
  out.notes.insert(
      out.notes.begin(),
      "surfaces recognised from the shape (enclosed by the wall: endocardium; facing the opening from "
      "its rim: base; rest: epicardium)");
  return out;
}

void check_tapered_rims(const Points& points, const Triangles& boundary) {
  const Surface s = describe(points, boundary);
  const std::vector<int> first = inside_or_outside(points, boundary, s);
  const auto found = cavities(s, first, kInside);
  check_rims(points, boundary, s, found, inside_of(first.size(), found));
}

void split_cavities(const TetMesh& mesh, std::vector<int>& labels, std::vector<std::string>& notes) {
  if (std::ranges::count(labels, kRvEndocardium) > 0) return;
  const Surface s = describe(mesh.points(), mesh.boundary());
  auto found = cavities(s, labels, kEndocardium);
  if (found.size() != 2) return;
  order_cavities(mesh, s, found, notes);
  for (const int f : found[1]) labels[f] = kRvEndocardium;
}

}  // namespace cardiac
