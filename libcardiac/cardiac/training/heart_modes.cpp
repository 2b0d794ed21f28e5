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

HeartModes::HeartModes(const Anatomy& anatomy, const Scene& scene) : affine_(affine_space(anatomy, scene)) {
  const LagrangeBasis& elements = anatomy.coordinates->space();
  const polyaffine::WallPoints points = elements.wall_points(kExact);
  std::vector<Eigen::Triplet<double>> entries;
  tet_volumes_ = Vector::Zero(anatomy.mesh.num_tets());
  node_volumes_ = Vector::Zero(elements.num_functions());
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const auto column = static_cast<Eigen::Index>(q);
    const auto at = elements.element_sample(points.tet[q], points.barycentric.col(column));
    const double weight = points.weights[column];
    tet_volumes_[points.tet[q]] += weight;
    for (Eigen::Index i = 0; i < at.functions.size(); ++i) {
      node_volumes_[at.functions[i]] += weight / static_cast<double>(at.functions.size());
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

NestedSpace HeartModes::space(const std::vector<FullState>& path, const std::vector<FullState>& neighbours,
                              const Options& options) const {
  std::vector<const FullState*> states;
  for (const auto* list : {&path, &neighbours})
    for (const FullState& s : *list) states.push_back(&s);
  const auto count = static_cast<Eigen::Index>(states.size()), first = std::ssize(path);
  const Eigen::Index nodes = nabla_.cols();
  const bool with_frames = frame_metric_.size() > 0;
  const Eigen::LDLT<Matrix> frames(with_frames ? frame_metric_ : Matrix::Identity(1, 1));

  // What the frames leave of each state over its norm: nodal values and gradients.
  Matrix rests(3 * nodes, count), slopes(3 * nabla_.rows(), count);
  for (Eigen::Index s = 0; s < count; ++s) {
    const Vector& u = states[static_cast<std::size_t>(s)]->u;
    const Matrix own = gradient(u);
    const double norm = own.norm();
    if (!with_frames) {
      rests.col(s) = u / norm;
      slopes.col(s) = flattened(own) / norm;
      continue;
    }
    const Matrix c = frames.solve(frame_gradients_.transpose() * own);
    rests.col(s) = (u.reshaped(3, nodes) - (affine_.frames * c).transpose()).reshaped() / norm;
    slopes.col(s) = flattened(own - frame_gradients_ * c) / norm;
  }
  const auto modes_of = [&](Eigen::Index from, Eigen::Index number, double tolerance, Eigen::Index most) {
    const auto own = slopes.middleCols(from, number);
    const SingularVectors vectors = singular_vectors(own.transpose() * own);
    const Eigen::Index keep = std::min(needed(vectors, tolerance), most);
    return Matrix(vectors.combinations.leftCols(keep));
  };
  const Matrix of_path = modes_of(0, first, options.tolerance, options.most);
  Matrix modes = rests.leftCols(first) * of_path;
  if (first < count) {
    const Matrix mode_slopes = slopes.leftCols(first) * of_path;
    const Matrix along = mode_slopes.transpose() * slopes.rightCols(count - first);
    slopes.rightCols(count - first) -= mode_slopes * along;
    rests.rightCols(count - first) -= modes * along;
    const Matrix more =
        modes_of(first, count - first, options.neighbour_tolerance, options.most - of_path.cols());
    Matrix all(3 * nodes, modes.cols() + more.cols());
    all << modes, rests.rightCols(count - first) * more;
    modes = std::move(all);
  }

  NestedSpace out = affine_;
  out.num_modes = static_cast<int>(modes.cols());
  out.modes = Matrix::Zero(3 * nodes, (modes.cols() + 2) / 3 * 3);
  for (Eigen::Index k = 0; k < modes.cols(); ++k)  // a coefficient is the largest displacement, mm
    out.modes.col(k) = modes.col(k) / modes.col(k).cwiseAbs().maxCoeff();

  Matrix pressures(tet_volumes_.size(), count);
  for (Eigen::Index s = 0; s < count; ++s) {
    const Vector& p = states[static_cast<std::size_t>(s)]->pressure;
    if (p.size() == 0) return out;
    const Vector rest = p - affine_.pressures.transpose() * nearest_pressure(affine_, p);
    pressures.col(s) = rest / std::sqrt(p.dot(tet_volumes_.cwiseProduct(p)));
  }
  const SingularVectors vectors =
      singular_vectors(pressures.transpose() * tet_volumes_.asDiagonal() * pressures);
  const Eigen::Index keep = std::min<Eigen::Index>(needed(vectors, options.pressure_tolerance), options.most);
  out.pressures.conservativeResize(affine_.pressures.rows() + keep, Eigen::NoChange);
  out.pressures.bottomRows(keep) =
      std::sqrt(tet_volumes_.sum()) * (pressures * vectors.combinations.leftCols(keep)).transpose();
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

double HeartModes::size(const Vector& u) const {
  return std::sqrt(node_volumes_.dot(Vector(u.reshaped(3, node_volumes_.size()).colwise().squaredNorm())));
}

}  // namespace cardiac
