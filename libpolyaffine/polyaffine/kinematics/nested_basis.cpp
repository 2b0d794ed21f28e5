#include "polyaffine/kinematics/nested_basis.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace polyaffine {

NodalFunctions nodal_functions(const Basis& basis, const LagrangeBasis& elements) {
  const Eigen::Matrix4Xd corners = elements.node_barycentric();
  std::vector<char> seen(elements.num_functions(), 0);
  std::vector<Eigen::Triplet<double>> entries;
  for (int tet = 0; tet < static_cast<int>(elements.elements().cols()); ++tet)
    for (Eigen::Index k = 0; k < corners.cols(); ++k) {
      const int node = elements.elements()(k, tet);
      if (seen[node]++) continue;
      const BasisSample s = basis.sample(tet, corners.col(k));
      for (std::size_t i = 0; i < s.functions.size(); ++i) {
        const double value = s.N[static_cast<Eigen::Index>(i)];
        if (value != 0 && !basis.in_local_axes(s.functions[i]))
          entries.emplace_back(node, s.functions[i], value);
      }
    }
  NodalFunctions out(elements.num_functions(), basis.num_functions());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

NestedBasis::NestedBasis(std::shared_ptr<const LagrangeBasis> elements, NodalFunctions functions,
                         Matrix modes)
    : elements_(std::move(elements)),
      num_scalar_(static_cast<int>(functions.cols())),
      functions_(std::move(functions)),
      modes_(std::move(modes)) {
  const Eigen::Index nodes = elements_->num_functions();
  if (functions_.rows() != nodes || (modes_.cols() > 0 && modes_.rows() != 3 * nodes) ||
      modes_.cols() % 3 != 0)
    throw std::invalid_argument("nested basis: found " + std::to_string(functions_.rows()) + " nodes and " +
                                std::to_string(modes_.rows()) + " × " + std::to_string(modes_.cols()) +
                                " modes, expected " + std::to_string(nodes) +
                                " nodes and a multiple of three modes");
}

BasisSample NestedBasis::sample(int tet, const Vec4& barycentric) const {
  const ElementSample at = elements_->element_sample(tet, barycentric);
  BasisSample out;
  for (const int node : at.functions)
    for (NodalFunctions::InnerIterator entry(functions_, node); entry; ++entry)
      out.functions.push_back(static_cast<int>(entry.col()));
  std::ranges::sort(out.functions);
  out.functions.erase(std::unique(out.functions.begin(), out.functions.end()), out.functions.end());
  const auto count = static_cast<Eigen::Index>(out.functions.size());
  out.N = Vector::Zero(count);
  out.gradient = Points::Zero(3, count);
  for (Eigen::Index i = 0; i < at.functions.size(); ++i)
    for (NodalFunctions::InnerIterator entry(functions_, at.functions[i]); entry; ++entry) {
      const auto k =
          std::ranges::lower_bound(out.functions, static_cast<int>(entry.col())) - out.functions.begin();
      out.N[k] += entry.value() * at.N[i];
      out.gradient.col(k) += entry.value() * at.gradient.col(i);
    }
  out.modes.resize(static_cast<std::size_t>(modes_.cols() / 3));
  for (std::size_t m = 0; m < out.modes.size(); ++m) {
    BasisSample::Modes& mode = out.modes[m];
    mode.function = num_scalar_ + static_cast<int>(m);
    mode.value.setZero();
    mode.gradient.setZero();
    for (Eigen::Index i = 0; i < at.functions.size(); ++i) {
      const auto nodal = modes_.block<3, 3>(3 * static_cast<Eigen::Index>(at.functions[i]),
                                            3 * static_cast<Eigen::Index>(m));
      mode.value += at.N[i] * nodal;
      for (int J = 0; J < 3; ++J) mode.gradient.middleRows<3>(3 * J) += at.gradient(J, i) * nodal;
    }
  }
  return out;
}

Vector NestedBasis::nodal(const Vector& c) const {
  const Eigen::Index modes = modes_.cols(), scalar = 3 * static_cast<Eigen::Index>(num_scalar_);
  const Eigen::Matrix<double, Eigen::Dynamic, 3> u =
      functions_ * c.head(scalar).reshaped(3, num_scalar_).transpose();
  Vector out = u.transpose().reshaped();
  if (modes > 0) out.noalias() += modes_ * c.tail(modes);
  return out;
}

Matrix NestedBasis::nodal_of_each(const Matrix& c) const {
  Matrix out(3 * functions_.rows(), c.cols());
  for (Eigen::Index k = 0; k < c.cols(); ++k) {
    const Matrix u =
        functions_ *
        c.col(k).head(3 * static_cast<Eigen::Index>(num_scalar_)).reshaped(3, num_scalar_).transpose();
    out.col(k) = u.transpose().reshaped();
  }
  if (modes_.cols() > 0) out.noalias() += modes_ * c.bottomRows(modes_.cols());
  return out;
}

Matrix NestedBasis::transpose(const Matrix& forces) const {
  Matrix out(3 * num_functions(), forces.cols());
  const Eigen::Index nodes = functions_.rows(), scalar = 3 * static_cast<Eigen::Index>(num_scalar_);
  for (Eigen::Index k = 0; k < forces.cols(); ++k) {
    const Matrix f = forces.col(k).reshaped(3, nodes).transpose();
    const Matrix reduced = functions_.transpose() * f;
    out.col(k).head(scalar) = reduced.transpose().reshaped();
  }
  if (modes_.cols() > 0) out.bottomRows(modes_.cols()).noalias() = modes_.transpose() * forces;
  return out;
}

}  // namespace polyaffine
