#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include <polyaffine/kinematics/lagrange.hpp>

namespace polyaffine {

/// Functions by their values at the nodes of elements: nodes × functions.
using NodalFunctions = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Values of scalar functions of a basis (modes and functions in local axes have none) at the nodes.
NodalFunctions nodal_functions(const Basis& basis, const LagrangeBasis& elements);

/// Functions that are nested in a space of finite elements: scalar functions interpolated in the elements,
/// and modes, vector functions given by their nodal displacements. With the points and pressures of the
/// elements a model of such functions is a Galerkin projection of theirs.
class NestedBasis : public Basis {
 public:
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// `modes`: 3 · nodes × modes, a column a mode, their number a multiple of three (columns of zeros may fill
  /// it up; their unknowns are then to be fixed). Function f < functions.cols() is scalar, the following ones
  /// are three modes each. Throws std::invalid_argument when sizes do not fit.
  NestedBasis(std::shared_ptr<const LagrangeBasis> elements, NodalFunctions functions, Matrix modes);

  int num_functions() const override { return num_scalar_ + static_cast<int>(modes_.cols()) / 3; }
  BasisSample sample(int tet, const Vec4& barycentric) const override;

  int num_scalar() const { return num_scalar_; }
  const LagrangeBasis& elements() const { return *elements_; }
  const NodalFunctions& functions() const { return functions_; }
  const RowMatrix& modes() const { return modes_; }
  /// Displacement at the nodes, 3 · nodes: the coefficients of the same field in the elements' space.
  Vector nodal(const Vector& c) const;
  /// The same of many, a column each: the modes are read once.
  Matrix nodal_of_each(const Matrix& c) const;
  /// The transpose: generalised forces of forces at the nodes.
  Matrix transpose(const Matrix& forces) const;

 private:
  std::shared_ptr<const LagrangeBasis> elements_;
  int num_scalar_;
  NodalFunctions functions_;
  RowMatrix modes_;  // the modes of a node side by side, as sample reads them
};

}  // namespace polyaffine
