#include "polyaffine/quadrature/cell_gauss.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include <polyaffine/rules/gauss.hpp>

namespace polyaffine {
namespace {

// A place is looked for in this many elements, those of the nearest candidates. An element has several
// candidates: so many are sorted by their distance to find enough different elements.
constexpr int kElementsTried = 12;
constexpr std::ptrdiff_t kCandidates = 8 * kElementsTried;

// Orthonormal Legendre polynomials on [0, 1] of degrees below n.
Vector orthonormal(int n, double x) {
  Vector p = legendre(n - 1, x);
  for (int k = 0; k < n; ++k) p[k] *= std::sqrt(2 * k + 1.0);
  return p;
}

// All products P_i(x_1) P_j(x_2) P_k(x_3) of degrees below the counts.
Vector products(const CellCounts& counts, const Vec3& x) {
  const Vector a = orthonormal(counts[0], x[0]), b = orthonormal(counts[1], x[1]),
               c = orthonormal(counts[2], x[2]);
  Vector out(a.size() * b.size() * c.size());
  Eigen::Index m = 0;
  for (const double i : a)
    for (const double j : b)
      for (const double k : c) out[m++] = i * j * k;
  return out;
}

// The product Gauss rule of the unit cube.
struct BoxRule {
  Points places;
  Vector weights;
};

BoxRule box_rule(const CellCounts& counts) {
  const LineRule a = line_rule(counts[0]), b = line_rule(counts[1]), c = line_rule(counts[2]);
  const auto n = static_cast<Eigen::Index>(counts[0]) * counts[1] * counts[2];
  BoxRule out{Points(3, n), Vector(n)};
  Eigen::Index m = 0;
  for (int i = 0; i < counts[0]; ++i)
    for (int j = 0; j < counts[1]; ++j)
      for (int k = 0; k < counts[2]; ++k, ++m) {
        out.places.col(m) = Vec3(a.points[i], b.points[j], c.points[k]);
        out.weights[m] = a.weights[i] * b.weights[j] * c.weights[k];
      }
  return out;
}

// The candidates of one cell.
struct Filling {
  int cell = 0;
  std::vector<MeshPoint> points;
  Points places;
  Matrix amounts;  // a column each: what there is of the wall
};

// Points of the nearest candidates in different elements, the nearest first.
std::vector<MeshPoint> nearest(const Filling& filling, const Vec3& place) {
  const Vector squares = (filling.places.colwise() - place).colwise().squaredNorm();
  std::vector<int> order(filling.points.size());
  for (std::size_t p = 0; p < order.size(); ++p) order[p] = static_cast<int>(p);
  const auto end = order.begin() + std::min(kCandidates, std::ssize(order));
  std::partial_sort(order.begin(), end, order.end(), [&](int p, int q) { return squares[p] < squares[q]; });
  std::vector<MeshPoint> out;
  for (auto p = order.begin(); p != end && out.size() < kElementsTried; ++p) {
    const MeshPoint& point = filling.points[*p];
    if (std::none_of(out.begin(), out.end(), [&](const MeshPoint& other) { return other.tet == point.tet; }))
      out.push_back(point);
  }
  return out;
}

// Gauss points in the mesh and the amounts there; no points where the cell is no box.
struct CellRule {
  std::vector<MeshPoint> points;
  Matrix amounts;
};

// With the moments m_k = Σ_p a_p P_k(x_p) of the amounts a_p at the candidates, their density is Σ_k m_k
// P_k(x), and a Gauss point x_q of weight w_q carries w_q Σ_k m_k P_k(x_q). Where that does not point along
// the sum (m_0), or no element holds the place, the cell is no box.
CellRule fill(const Filling& filling, const PlaceOf& place_of, const CellCounts& counts) {
  const BoxRule box = box_rule(counts);
  Matrix moments = Matrix::Zero(filling.amounts.rows(), box.weights.size());
  for (Eigen::Index p = 0; p < filling.places.cols(); ++p)
    moments += filling.amounts.col(p) * products(counts, filling.places.col(p)).transpose();
  CellRule out{{}, Matrix(moments.rows(), box.weights.size())};
  const Vector sum = moments.col(0);
  for (Eigen::Index q = 0; q < box.weights.size(); ++q) {
    const Vec3 place = box.places.col(q);
    out.amounts.col(q) = box.weights[q] * (moments * products(counts, place));
    if (!(out.amounts.col(q).dot(sum) > 0)) return {};
    const auto found = find_place(place_of, {filling.cell, place}, nearest(filling, place));
    if (!found) return {};
    out.points.push_back(*found);
  }
  return out;
}

// Gauss points of all cells that are boxes, the amounts there, and the candidates of the other cells.
struct BoxCells {
  std::vector<MeshPoint> points;
  std::vector<int> starts{0};
  Matrix amounts;
  std::vector<int> rest;
};

template <class Candidates>
BoxCells box_cells(const Candidates& candidates, const Matrix& amounts, const std::vector<int>& cell,
                   const Points& coordinates, const PlaceOf& place_of,
                   const std::function<CellCounts(int cell)>& counts) {
  BoxCells out;
  std::vector<Matrix> found;
  const auto all = points_of_cells(cell);
  for (int c = 0; c < static_cast<int>(all.size()); ++c) {
    const auto& own = all[c];
    if (own.empty()) continue;
    Filling filling{c, {}, coordinates(Eigen::all, own), amounts(Eigen::all, own)};
    for (const int p : own) filling.points.push_back({candidates.tet[p], candidates.barycentric.col(p)});
    const CellRule rule = fill(filling, place_of, counts(c));
    if (rule.points.empty()) {
      out.rest.insert(out.rest.end(), own.begin(), own.end());
      continue;
    }
    out.points.insert(out.points.end(), rule.points.begin(), rule.points.end());
    out.starts.push_back(static_cast<int>(out.points.size()));
    found.push_back(rule.amounts);
  }
  out.amounts.resize(amounts.rows(), std::ssize(out.points));
  for (std::size_t k = 0; k < found.size(); ++k)
    out.amounts.middleCols(out.starts[k], found[k].cols()) = found[k];
  return out;
}

std::vector<int> at(const std::vector<int>& values, const std::vector<int>& which) {
  std::vector<int> out;
  for (const int p : which) out.push_back(values[p]);
  return out;
}

// Tets, barycentric coordinates and blocks.
template <class Places>
void set_points(const BoxCells& boxes, Places& out) {
  out.starts = boxes.starts;
  out.barycentric.resize(4, std::ssize(boxes.points));
  for (const MeshPoint& point : boxes.points) {
    out.barycentric.col(std::ssize(out.tet)) = point.barycentric;
    out.tet.push_back(point.tet);
  }
}

}  // namespace

WallPoints gauss_cells(const WallPoints& candidates, const std::vector<int>& cell, const Points& coordinates,
                       const PlaceOf& place_of, const std::function<CellCounts(int cell)>& counts,
                       const CellDegree& otherwise) {
  const BoxCells boxes =
      box_cells(candidates, candidates.weights.transpose(), cell, coordinates, place_of, counts);
  WallPoints out;
  set_points(boxes, out);
  out.weights = boxes.amounts.transpose();
  const auto& rest = boxes.rest;
  if (rest.empty()) return out;
  const WallPoints part{
      at(candidates.tet, rest), candidates.barycentric(Eigen::all, rest), candidates.weights(rest), {}};
  append(compress_cells(part, at(cell, rest), coordinates(Eigen::all, rest), otherwise), out);
  return out;
}

SurfacePoints gauss_surface_cells(const SurfacePoints& candidates, const std::vector<int>& cell,
                                  const Matrix& coordinates, const PlaceOf& place_of,
                                  const std::function<CellCounts(int cell)>& counts, int otherwise,
                                  const LagrangeBasis& geometry) {
  Points places = Points::Constant(3, coordinates.cols(), 0.5);  // the third coordinate has one Gauss point
  places.topRows<2>() = coordinates;
  Points areas(3, coordinates.cols());
  for (Eigen::Index p = 0; p < areas.cols(); ++p) {
    const Vec3 X_xi = candidates.X_xi.col(p), X_eta = candidates.X_eta.col(p);
    areas.col(p) = candidates.weights[p] * X_xi.cross(X_eta);
  }
  const BoxCells boxes = box_cells(candidates, areas, cell, places, place_of, [&](int c) {
    const CellCounts n = counts(c);
    return CellCounts{n[0], n[1], 1};
  });
  SurfacePoints out;
  set_points(boxes, out);
  const auto n = std::ssize(boxes.points);
  out.weights.setOnes(n);
  for (Points* columns : {&out.X, &out.X_xi, &out.X_eta}) columns->resize(3, n);
  // Only the vector area n dA of a point counts: tangents of weight 1 whose product it is.
  for (std::ptrdiff_t q = 0; q < n; ++q) {
    const Vec3 area = boxes.amounts.col(q), along = area.unitOrthogonal();
    out.X.col(q) = geometry.position(boxes.points[q].tet, boxes.points[q].barycentric);
    out.X_xi.col(q) = along;
    out.X_eta.col(q) = area.cross(along);
  }
  const auto& rest = boxes.rest;
  if (rest.empty()) return out;
  const SurfacePoints part{at(candidates.tet, rest),
                           candidates.barycentric(Eigen::all, rest),
                           candidates.weights(rest),
                           candidates.X(Eigen::all, rest),
                           candidates.X_xi(Eigen::all, rest),
                           candidates.X_eta(Eigen::all, rest),
                           {}};
  append(compress_surface_cells(part, at(cell, rest), coordinates(Eigen::all, rest), otherwise), out);
  return out;
}

}  // namespace polyaffine
