#include "cardiac/training/heart_modes.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace cardiac {

using polyaffine::LagrangeBasis;
using polyaffine::Matrix;
using polyaffine::NodalFunctions;
using polyaffine::Vector;

namespace {

constexpr int kExact = 2;  // degree that ∇u · ∇v of quadratic functions has

// Singular vectors of columns by their Gram matrix: columns · combinations are orthonormal, in falling order
// of their singular values.
struct SingularVectors {
  Matrix combinations;
  Matrix shares;  // of column s along vector k: σ_k V_sk
};
SingularVectors singular_vectors(const Matrix& gram) {
  // Below this share of the largest there is rounding alone: a Gram matrix squares.
  constexpr double kRounding = 1e-12;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(gram);
  const Vector squares = eigen.eigenvalues().reverse();
  const Matrix V = eigen.eigenvectors().rowwise().reverse();
  Eigen::Index rank = 0;
  while (rank < squares.size() && squares[rank] > kRounding * squares[0] && squares[rank] > 0) ++rank;
  const Vector sigma = squares.head(rank).cwiseSqrt();
  return {V.leftCols(rank) * sigma.cwiseInverse().asDiagonal(), V.leftCols(rank) * sigma.asDiagonal()};
}

// How many vectors leave of each column no more than the tolerance.
Eigen::Index needed(const SingularVectors& of, double tolerance) {
  Vector left = of.shares.rowwise().squaredNorm();
  Eigen::Index k = 0;
  for (; k < of.shares.cols() && left.maxCoeff() > tolerance * tolerance; ++k)
    left -= of.shares.col(k).cwiseAbs2();
  return k;
}

Matrix flattened(const Matrix& gradients) {
  return gradients.reshaped(gradients.size(), 1);
}

}  // namespace

Vector node_volumes(const LagrangeBasis& elements) {
  const polyaffine::WallPoints points = elements.wall_points(1);
  Vector out = Vector::Zero(elements.num_functions());
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const auto nodes = elements.elements().col(points.tet[q]);
    for (const int node : nodes)
      out[node] += points.weights[static_cast<Eigen::Index>(q)] / static_cast<double>(nodes.size());
  }
  return out;
}

double displacement_size(const Vector& node_volumes, const Vector& u) {
  return std::sqrt(node_volumes.dot(Vector(u.reshaped(3, node_volumes.size()).colwise().squaredNorm())));
}

HeartModes::HeartModes(const Anatomy& anatomy, const Scene& scene) : affine_(affine_space(anatomy, scene)) {
  const LagrangeBasis& elements = anatomy.coordinates->space();
  const polyaffine::WallPoints points = elements.wall_points(kExact);
  std::vector<Eigen::Triplet<double>> entries;
  tet_volumes_ = Vector::Zero(anatomy.mesh.num_tets());
  node_volumes_ = node_volumes(elements);
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const auto column = static_cast<Eigen::Index>(q);
    const auto at = elements.element_sample(points.tet[q], points.barycentric.col(column));
    const double weight = points.weights[column];
    tet_volumes_[points.tet[q]] += weight;
    for (Eigen::Index i = 0; i < at.functions.size(); ++i) {
      for (int J = 0; J < 3; ++J)
        entries.emplace_back(3 * column + J, at.functions[i], std::sqrt(weight) * at.gradient(J, i));
    }
  }
  nabla_.resize(3 * points.weights.size(), elements.num_functions());
  nabla_.setFromTriplets(entries.begin(), entries.end());
  frame_gradients_ = Matrix(nabla_ * affine_.frames);
  frame_metric_ = frame_gradients_.transpose() * frame_gradients_;
}

Matrix HeartModes::gradient(const Vector& u) const {
  return nabla_ * u.reshaped(3, nabla_.cols()).transpose();
}

NestedSpace HeartModes::with_modes(NestedSpace space, const States& states, double tolerance,
                                   int most) const {
  const Matrix metric = this->metric(space);
  const auto count = std::ssize(states);
  Matrix rests(3 * nabla_.cols(), count), slopes(3 * nabla_.rows(), count);
  for (Eigen::Index s = 0; s < count; ++s) {
    const Vector& u = states[static_cast<std::size_t>(s)]->u;
    const double norm = gradient(u).norm();
    rests.col(s) = (u - nodal(space, nearest(space, metric, u))) / norm;
    slopes.col(s) = flattened(gradient(rests.col(s)));
  }
  const SingularVectors vectors = singular_vectors(slopes.transpose() * slopes);
  const Eigen::Index before = space.num_modes,
                     more = std::clamp<Eigen::Index>(most - before, 0, needed(vectors, tolerance));
  Matrix modes = Matrix::Zero(rests.rows(), (before + more + 2) / 3 * 3);
  modes.leftCols(before) = space.modes.leftCols(before);
  modes.middleCols(before, more) = rests * vectors.combinations.leftCols(more);
  for (Eigen::Index k = before; k < before + more; ++k)  // a coefficient is the largest displacement, mm
    modes.col(k) /= modes.col(k).cwiseAbs().maxCoeff();
  space.modes = modes.cast<float>().cast<double>();  // as files have them
  space.num_modes = static_cast<int>(before + more);
  return space;
}

NestedSpace HeartModes::with_pressures(NestedSpace space, const States& states, double tolerance,
                                       int most) const {
  Matrix rests(tet_volumes_.size(), std::ssize(states));
  for (Eigen::Index s = 0; s < rests.cols(); ++s) {
    const Vector& p = states[static_cast<std::size_t>(s)]->pressure;
    if (p.size() == 0) return space;
    rests.col(s) = (p - space.pressures.transpose() * nearest_pressure(space, p)) /
                   std::sqrt(p.dot(tet_volumes_.cwiseProduct(p)));
  }
  const SingularVectors vectors = singular_vectors(rests.transpose() * tet_volumes_.asDiagonal() * rests);
  const Eigen::Index before = space.pressures.rows(),
                     more = std::clamp<Eigen::Index>(most - before, 0, needed(vectors, tolerance));
  space.pressures.conservativeResize(before + more, Eigen::NoChange);
  space.pressures.bottomRows(more) =
      std::sqrt(tet_volumes_.sum()) * (rests * vectors.combinations.leftCols(more)).transpose();
  space.pressures = space.pressures.cast<float>().cast<double>().eval();
  return space;
}

Vector HeartModes::nodal(const NestedSpace& space, const Vector& c) const {
  const Eigen::Index frames = 3 * frame_metric_.rows();
  Vector out = space.modes * c.tail(space.modes.cols());
  out += (affine_.frames * c.head(frames).reshaped(3, frames / 3).transpose()).transpose().reshaped();
  return out;
}

Matrix HeartModes::metric(const NestedSpace& space) const {
  const Eigen::Index scalar = frame_metric_.rows(), modes = space.modes.cols(), rows = nabla_.rows();
  Matrix slopes(3 * rows, modes);
  for (Eigen::Index k = 0; k < modes; ++k) slopes.col(k) = flattened(gradient(space.modes.col(k)));
  Matrix out = Matrix::Zero(3 * scalar + modes, 3 * scalar + modes);
  out.bottomRightCorner(modes, modes) = slopes.transpose() * slopes;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Matrix mixed = frame_gradients_.transpose() * slopes.middleRows(i * rows, rows);
    for (Eigen::Index a = 0; a < scalar; ++a) {
      out.row(3 * a + i).tail(modes) = mixed.row(a);
      out.col(3 * a + i).tail(modes) = mixed.row(a).transpose();
      for (Eigen::Index b = 0; b < scalar; ++b) out(3 * a + i, 3 * b + i) = frame_metric_(a, b);
    }
  }
  for (Eigen::Index k = 3 * scalar + space.num_modes; k < out.rows(); ++k) out(k, k) = 1;
  return out;
}

Vector HeartModes::nearest(const NestedSpace& space, const Matrix& metric, const Vector& u) const {
  const Matrix slopes = gradient(u);
  Vector products(metric.rows());
  products.head(3 * frame_metric_.rows()) = (frame_gradients_.transpose() * slopes).transpose().reshaped();
  const Vector forces = (nabla_.transpose() * slopes).transpose().reshaped();
  products.tail(space.modes.cols()) = space.modes.transpose() * forces;
  return metric.llt().solve(products);
}

Vector HeartModes::nearest_pressure(const NestedSpace& space, const Vector& pressure) const {
  const Matrix mass = space.pressures * tet_volumes_.asDiagonal() * space.pressures.transpose();
  return mass.llt().solve(space.pressures * tet_volumes_.cwiseProduct(pressure));
}

}  // namespace cardiac
