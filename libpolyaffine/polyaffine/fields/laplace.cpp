#include "polyaffine/fields/laplace.hpp"

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <cstdint>
#include <utility>

#include <polyaffine/core/error.hpp>
#include <polyaffine/core/serial_blas.hpp>
#include <polyaffine/linear/two_level.hpp>

namespace polyaffine {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr double kTolerance = 1e-12;  // of the residual, relative to the right-hand side
constexpr int kMostIterations = 300;

using ElementMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 10, 10>;

ElementMatrix element_matrix(const LagrangeBasis& basis, const WallPoints& points,
                             const std::function<DiffusionPoint(std::size_t)>& at, std::size_t t) {
  const Eigen::Index n = basis.elements().rows();
  ElementMatrix K = ElementMatrix::Zero(n, n);
  for (int q = points.starts[t]; q < points.starts[t + 1]; ++q) {
    const ElementSample s = basis.element_sample(points.tet[q], points.barycentric.col(q));
    const DiffusionPoint d = at(static_cast<std::size_t>(q));
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 10> gradient(3, n), flux(3, n);
    for (Eigen::Index a = 0; a < n; ++a) {
      gradient.col(a) = d.factor * s.gradient.col(a) + s.N[a] * d.factor_gradient;
      flux.col(a) = points.weights[q] * (d.conductivity * gradient.col(a));
    }
    for (Eigen::Index b = 0; b < n; ++b)
      for (Eigen::Index a = 0; a < n; ++a) K(a, b) += gradient.col(a).dot(flux.col(b));
  }
  return K;
}

// Number of each point along a curve through space (Morton 1966), so that neighbours are near each other in
// memory however a mesh numbers them.
std::vector<int> along_curve(const Points& X) {
  constexpr int kBits = 20;  // of a coordinate
  const Vec3 low = X.rowwise().minCoeff();
  const double side = (X.rowwise().maxCoeff() - low).maxCoeff();
  std::vector<std::pair<std::uint64_t, int>> codes(X.cols());
  for (Eigen::Index p = 0; p < X.cols(); ++p) {
    std::uint64_t code = 0;
    for (int k = 0; k < 3; ++k) {
      const auto place = static_cast<std::uint64_t>((X(k, p) - low[k]) / side * ((1 << kBits) - 1));
      for (int bit = 0; bit < kBits; ++bit) code |= (place >> bit & 1) << (3 * bit + k);
    }
    codes[p] = {code, static_cast<int>(p)};
  }
  std::ranges::sort(codes);
  std::vector<int> number(codes.size());
  for (std::size_t n = 0; n < codes.size(); ++n) number[codes[n].second] = static_cast<int>(n);
  return number;
}

Sparse assembled(const LagrangeBasis& basis, const std::vector<int>& number, const WallPoints& points,
                 const std::function<DiffusionPoint(std::size_t)>& at) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve((points.starts.size() - 1) *
                  static_cast<std::size_t>(basis.elements().rows() * (basis.elements().rows() + 1) / 2));
  for (std::size_t t = 0; t + 1 < points.starts.size(); ++t) {
    const ElementMatrix K = element_matrix(basis, points, at, t);
    const auto nodes = basis.elements().col(points.tet[points.starts[t]]);
    for (Eigen::Index b = 0; b < nodes.size(); ++b)
      for (Eigen::Index a = 0; a < nodes.size(); ++a)
        if (const int i = number[nodes[a]], j = number[nodes[b]]; i >= j) entries.emplace_back(i, j, K(a, b));
  }
  Sparse lower(basis.num_functions(), basis.num_functions());
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower.selfadjointView<Eigen::Lower>();
}

// Values of the linear functions of the vertices (columns, in the order of their numbers) at the numbered
// nodes of a quadratic basis.
Sparse linear_in_quadratic(const LagrangeBasis& basis, const std::vector<int>& number,
                           const std::vector<int>& vertices) {
  const auto& elements = basis.elements();
  if (basis.order() == 1) return Sparse(basis.num_functions(), 0);
  const Eigen::Matrix4Xd corners = basis.node_barycentric();
  std::vector<int> column(basis.num_functions());
  for (std::size_t v = 0; v < vertices.size(); ++v) column[vertices[v]] = static_cast<int>(v);
  std::vector<char> done(basis.num_functions(), 0);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index t = 0; t < elements.cols(); ++t)
    for (Eigen::Index k = 0; k < elements.rows(); ++k) {
      if (done[elements(k, t)]++) continue;
      for (int v = 0; v < 4; ++v)
        if (corners(v, k) > 0)
          entries.emplace_back(number[elements(k, t)], column[number[elements(v, t)]], corners(v, k));
    }
  Sparse out(basis.num_functions(), static_cast<Eigen::Index>(vertices.size()));
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

// Rows and columns that are numbered, in their order.
Sparse part(const Sparse& A, const std::vector<int>& row, const std::vector<int>& column) {
  const auto count = [](const std::vector<int>& number) {
    return std::ranges::count_if(number, [](int n) { return n >= 0; });
  };
  Sparse out(count(row), count(column));
  out.reserve(A.nonZeros());
  for (Eigen::Index c = 0; c < A.cols(); ++c) {
    if (column[c] < 0) continue;
    out.startVec(column[c]);
    for (Sparse::InnerIterator it(A, c); it; ++it)
      if (row[it.row()] >= 0) out.insertBack(row[it.row()], column[c]) = it.value();
  }
  out.finalize();
  return out;
}

Vector factorised(const Sparse& A, const Vector& b) {
  const SerialBlas serial;
  const Eigen::CholmodSupernodalLLT<Sparse, Eigen::Lower> factors(A);
  if (factors.info() != Eigen::Success) throw ComputationError("Laplace problem: the system is singular");
  return factors.solve(b);
}

}  // namespace

DiffusionProblem::DiffusionProblem(const LagrangeBasis& basis, const WallPoints& points,
                                   const std::function<DiffusionPoint(std::size_t)>& at)
    : number_(along_curve(basis.nodes())), matrix_(assembled(basis, number_, points, at)) {
  vertices_.assign(number_.begin(), number_.begin() + basis.elements().topRows<4>().maxCoeff() + 1);
  std::ranges::sort(vertices_);
  interpolation_ = linear_in_quadratic(basis, number_, vertices_);
}

Vector DiffusionProblem::solve(const std::vector<NodeValue>& dirichlet) const {
  if (dirichlet.empty()) throw ComputationError("Laplace problem: no boundary value is given");
  Vector values = Vector::Zero(matrix_.rows());
  std::vector<int> unknown(number_.size(), 0);
  for (const auto& [node, value] : dirichlet) {
    unknown[number_[node]] = -1;
    values[number_[node]] = value;
  }
  int count = 0;
  for (int& n : unknown)
    if (n >= 0) n = count++;
  if (count > 0) solve_free(unknown, count, values);
  return values(number_);
}

void DiffusionProblem::solve_free(const std::vector<int>& unknown, int count, Vector& values) const {
  std::vector<int> coarse(interpolation_.cols());
  int vertices = 0;
  for (std::size_t v = 0; v < coarse.size(); ++v) coarse[v] = unknown[vertices_[v]] >= 0 ? vertices++ : -1;
  const Vector known = matrix_ * values;
  Vector rhs(count);
  for (std::size_t n = 0; n < unknown.size(); ++n)
    if (unknown[n] >= 0) rhs[unknown[n]] = -known[static_cast<Eigen::Index>(n)];
  const Sparse A = part(matrix_, unknown, unknown);
  std::optional<Vector> x;
  if (vertices > 0)
    x = solve_two_level(A, part(interpolation_, unknown, coarse), rhs, kTolerance, kMostIterations);
  if (!x) x = factorised(A, rhs);
  for (std::size_t n = 0; n < unknown.size(); ++n)
    if (unknown[n] >= 0) values[static_cast<Eigen::Index>(n)] = (*x)[unknown[n]];
}

DiffusionProblem laplace_problem(const LagrangeBasis& basis) {
  // |∇N|² of quadratic functions on straight elements
  return {basis, basis.wall_points(2), [](std::size_t) { return DiffusionPoint{}; }};
}

Vector solve_laplace(const LagrangeBasis& basis, const std::vector<NodeValue>& dirichlet) {
  return laplace_problem(basis).solve(dirichlet);
}

Vector solve_diffusion(const LagrangeBasis& basis, const WallPoints& points,
                       const std::function<DiffusionPoint(std::size_t)>& at,
                       const std::vector<NodeValue>& dirichlet) {
  return DiffusionProblem(basis, points, at).solve(dirichlet);
}

}  // namespace polyaffine
