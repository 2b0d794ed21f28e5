#include "polyaffine/quadrature/cell_rule.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <iterator>

#include <polyaffine/quadrature/moment_compression.hpp>

namespace polyaffine {
namespace {

std::vector<std::array<int, 3>> exponents(const CellDegree& degree) {
  std::vector<std::array<int, 3>> out;
  const auto share = [&](int k, int e) {
    return degree[k] > 0 ? static_cast<double>(e) / degree[k] : e > 0 ? 2.0 : 0.0;
  };
  for (int a = 0; a <= degree[0]; ++a)
    for (int b = 0; b <= degree[1]; ++b)
      for (int c = 0; c <= degree[2]; ++c)
        if (share(0, a) + share(1, b) + share(2, c) <= 1 + 1e-12) out.push_back({a, b, c});
  return out;
}

std::vector<std::vector<int>> filled_cells(const std::vector<int>& cell) {
  auto out = points_of_cells(cell);
  std::erase_if(out, [](const auto& points) { return points.empty(); });
  return out;
}

WallPoints select(const WallPoints& candidates, const std::vector<std::vector<int>>& chosen,
                  const std::vector<Vector>& weights) {
  WallPoints out;
  std::vector<int> all;
  out.starts.push_back(0);
  for (const auto& points : chosen) {
    all.insert(all.end(), points.begin(), points.end());
    out.starts.push_back(static_cast<int>(all.size()));
  }
  out.barycentric = candidates.barycentric(Eigen::all, all);
  out.weights.resize(static_cast<Eigen::Index>(all.size()));
  for (std::size_t k = 0; k < chosen.size(); ++k)
    out.weights.segment(out.starts[k], weights[k].size()) = weights[k];
  for (const int p : all) out.tet.push_back(candidates.tet[p]);
  return out;
}

template <class Values>
void append_columns(const Values& more, Values& out) {
  out.conservativeResize(Eigen::NoChange, out.cols() + more.cols());
  out.rightCols(more.cols()) = more;
}

template <class Places>
void append_places(const Places& more, Places& out) {
  const auto first = static_cast<int>(out.tet.size());
  for (std::size_t k = 1; k < more.starts.size(); ++k) out.starts.push_back(first + more.starts[k]);
  out.tet.insert(out.tet.end(), more.tet.begin(), more.tet.end());
  append_columns(more.barycentric, out.barycentric);
  out.weights.conservativeResize(first + more.weights.size());
  out.weights.tail(more.weights.size()) = more.weights;
}

}  // namespace

Vector legendre(int n, double x) {
  Vector p(n + 1);
  const double s = 2 * x - 1;
  p[0] = 1;
  if (n > 0) p[1] = s;
  for (int k = 1; k < n; ++k) p[k + 1] = ((2 * k + 1) * s * p[k] - k * p[k - 1]) / (k + 1);
  return p;
}

void append(const WallPoints& more, WallPoints& rule) {
  append_places(more, rule);
}

void append(const SurfacePoints& more, SurfacePoints& rule) {
  append_places(more, rule);
  append_columns(more.X, rule.X);
  append_columns(more.X_xi, rule.X_xi);
  append_columns(more.X_eta, rule.X_eta);
}

WallPoints compress_cells(const WallPoints& candidates, const std::vector<int>& cell,
                          const Points& coordinates, const CellDegree& degree) {
  const auto powers = exponents(degree);
  std::vector<std::vector<int>> chosen;
  std::vector<Vector> weights;
  for (const auto& points : filled_cells(cell)) {
    Matrix features(static_cast<Eigen::Index>(powers.size()), static_cast<Eigen::Index>(points.size()));
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Vec3 x = coordinates.col(points[p]);
      const std::array<Vector, 3> L{legendre(degree[0], x[0]), legendre(degree[1], x[1]),
                                    legendre(degree[2], x[2])};
      for (std::size_t m = 0; m < powers.size(); ++m)
        features(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(p)) =
            L[0][powers[m][0]] * L[1][powers[m][1]] * L[2][powers[m][2]];
    }
    const CompressedRule rule = compress_moments(features, candidates.weights(points));
    std::vector<int> kept;
    for (const int p : rule.points) kept.push_back(points[p]);
    chosen.push_back(std::move(kept));
    weights.push_back(rule.weights);
  }
  return select(candidates, chosen, weights);
}

SurfacePoints compress_surface_cells(const SurfacePoints& candidates, const std::vector<int>& cell,
                                     const Matrix& coordinates, int degree) {
  std::vector<int> all;
  std::vector<double> factors;  // on the weights of the candidates
  SurfacePoints out;
  out.starts.push_back(0);
  for (const auto& points : filled_cells(cell)) {
    std::vector<Vector> columns;
    Vector area(static_cast<Eigen::Index>(points.size()));
    for (const int p : points) {
      const Vec3 normal = Vec3(candidates.X_xi.col(p)).cross(Vec3(candidates.X_eta.col(p)));
      area[static_cast<Eigen::Index>(columns.size())] = candidates.weights[p] * normal.norm();
      const Vector Lx = legendre(degree, coordinates(0, p)), Ly = legendre(degree, coordinates(1, p));
      std::vector<double> features;
      for (int a = 0; a <= degree; ++a)
        for (int b = 0; a + b <= degree; ++b) {
          features.push_back(Lx[a] * Ly[b]);
          for (int k = 0; k < 3 && a + b <= degree / 2; ++k)
            features.push_back(Lx[a] * Ly[b] * normal[k] / normal.norm());
        }
      columns.emplace_back(Eigen::Map<const Vector>(features.data(), std::ssize(features)));
    }
    Matrix features(columns[0].size(), area.size());
    for (std::size_t p = 0; p < columns.size(); ++p) features.col(static_cast<Eigen::Index>(p)) = columns[p];
    const CompressedRule rule = compress_moments(features, area);
    for (std::size_t k = 0; k < rule.points.size(); ++k) {
      all.push_back(points[rule.points[k]]);
      factors.push_back(rule.weights[static_cast<Eigen::Index>(k)] / area[rule.points[k]]);
    }
    out.starts.push_back(static_cast<int>(all.size()));
  }
  for (const int p : all) out.tet.push_back(candidates.tet[p]);
  out.barycentric = candidates.barycentric(Eigen::all, all);
  out.weights =
      candidates.weights(all).array() * Eigen::Map<const Eigen::ArrayXd>(factors.data(), std::ssize(factors));
  out.X = candidates.X(Eigen::all, all);
  out.X_xi = candidates.X_xi(Eigen::all, all);
  out.X_eta = candidates.X_eta(Eigen::all, all);
  return out;
}

std::vector<std::vector<int>> points_of_cells(const std::vector<int>& cell) {
  std::vector<std::vector<int>> out(cell.empty() ? 0 : *std::max_element(cell.begin(), cell.end()) + 1);
  for (std::size_t p = 0; p < cell.size(); ++p) out[cell[p]].push_back(static_cast<int>(p));
  return out;
}

WallPoints group_cells(const WallPoints& candidates, const std::vector<int>& cell) {
  const auto chosen = filled_cells(cell);
  std::vector<Vector> weights;
  for (const auto& points : chosen) weights.emplace_back(candidates.weights(points));
  return select(candidates, chosen, weights);
}

}  // namespace polyaffine
