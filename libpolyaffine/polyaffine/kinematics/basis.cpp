#include "polyaffine/kinematics/basis.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace polyaffine {
namespace {

using Lift = FunctionGroup::Lift;

// Functions in local axes add u = Q Σ c_a N_a. With the vectors w = Σ c_a N_a and w_J = Σ c_a ∂N_a/∂X_J in
// these axes, the gradient of u has the columns ∂Q/∂X_J w + Q w_J, a linear map of (w, w_1, w_2, w_3):
//
//     ⎡ ∂Q/∂X_1   Q         ⎤
//     ⎢ ∂Q/∂X_2       Q     ⎥
//     ⎣ ∂Q/∂X_3           Q ⎦
Lift gradient_lift(const BasisSample& s) {
  Lift L = Lift::Zero(9, 12);
  for (int J = 0; J < 3; ++J) {
    L.block<3, 3>(3 * J, 0) = s.dQ[J];
    L.block<3, 3>(3 * J, 3 + 3 * J) = s.Q;
  }
  return L;
}

// The same on a surface for (u, u_ξ, u_η) as a map of (w, w_ξ, w_η), with Q_ξ = Σ_J ∂Q/∂X_J X_J,ξ:
//
//     ⎡ Q           ⎤
//     ⎢ Q_ξ   Q     ⎥
//     ⎣ Q_η       Q ⎦
Lift surface_lift(const BasisSample& s, const Vec3& X_xi, const Vec3& X_eta) {
  Lift L = Lift::Zero(9, 9);
  for (int k = 0; k < 3; ++k) L.block<3, 3>(3 * k, 3 * k) = s.Q;
  for (int J = 0; J < 3; ++J) {
    L.block<3, 3>(3, 0) += X_xi[J] * s.dQ[J];
    L.block<3, 3>(6, 0) += X_eta[J] * s.dQ[J];
  }
  return L;
}

using ModeRows = Eigen::Matrix<double, 9, 3>;  // a column of the field for each of three modes

// What a kind of table writes for one function, d numbers `stride` apart (d_local for a function in local
// axes), and the lift that leads from the sums over such functions to the field.
struct RowKind {
  int d, d_local;
  virtual ~RowKind() = default;
  RowKind(int rows, int rows_local) : d(rows), d_local(rows_local) {}
  virtual void fill(double N, const Vec3& g, int point, bool local, double* rows,
                    Eigen::Index stride) const = 0;
  virtual Lift lift(const BasisSample& s, int point) const = 0;
  virtual ModeRows modes(const BasisSample::Modes& m, int point) const = 0;
};

struct GradientRows : RowKind {
  GradientRows() : RowKind(3, 4) {}
  void fill(double N, const Vec3& g, int, bool local, double* rows, Eigen::Index stride) const override {
    if (local) *rows = N;
    for (int J = 0; J < 3; ++J) rows[(J + (local ? 1 : 0)) * stride] = g[J];
  }
  Lift lift(const BasisSample& s, int) const override { return gradient_lift(s); }
  ModeRows modes(const BasisSample::Modes& m, int) const override { return m.gradient; }
};

struct SurfaceRows : RowKind {
  const SurfacePoints& points;
  explicit SurfaceRows(const SurfacePoints& p) : RowKind(3, 3), points(p) {}
  void fill(double N, const Vec3& g, int point, bool, double* rows, Eigen::Index stride) const override {
    rows[0] = N;
    rows[stride] = g.dot(points.X_xi.col(point));
    rows[2 * stride] = g.dot(points.X_eta.col(point));
  }
  Lift lift(const BasisSample& s, int point) const override {
    return surface_lift(s, points.X_xi.col(point), points.X_eta.col(point));
  }
  ModeRows modes(const BasisSample::Modes& m, int point) const override {
    ModeRows out;
    out.topRows<3>() = m.value;
    for (int k = 0; k < 3; ++k) {
      const auto gradient = m.gradient.col(k).reshaped(3, 3);
      out.col(k).segment<3>(3) = gradient * points.X_xi.col(point);
      out.col(k).tail<3>() = gradient * points.X_eta.col(point);
    }
    return out;
  }
};

struct ValueRows : RowKind {
  ValueRows() : RowKind(3, 3) {}
  void fill(double N, const Vec3&, int, bool, double* rows, Eigen::Index) const override { rows[0] = N; }
  Lift lift(const BasisSample& s, int) const override {
    Lift L = Lift::Zero(9, 9);
    L.topLeftCorner<3, 3>() = s.Q;
    return L;
  }
  ModeRows modes(const BasisSample::Modes& m, int) const override {
    ModeRows out = ModeRows::Zero();
    out.topRows<3>() = m.value;
    return out;
  }
};

FunctionGroup make_group(const std::vector<BasisSample>& samples, const std::vector<int>& functions,
                         int first, bool local, const RowKind& kind) {
  FunctionGroup group;
  group.functions = functions;
  group.d = local ? kind.d_local : kind.d;
  group.rows =
      Matrix::Zero(static_cast<Eigen::Index>(functions.size()), group.d * static_cast<int>(samples.size()));
  for (std::size_t q = 0; q < samples.size(); ++q) {
    const auto& s = samples[q];
    for (std::size_t k = 0; k < s.functions.size(); ++k) {
      const auto at = std::lower_bound(functions.begin(), functions.end(), s.functions[k]);
      if (at == functions.end() || *at != s.functions[k]) continue;
      kind.fill(s.N[static_cast<Eigen::Index>(k)], s.gradient.col(static_cast<Eigen::Index>(k)),
                first + static_cast<int>(q), local,
                &group.rows(at - functions.begin(), group.d * static_cast<int>(q)), group.rows.rows());
    }
    if (local) group.lift.push_back(kind.lift(s, first + static_cast<int>(q)));
  }
  return group;
}

FunctionGroup make_mode_group(const std::vector<BasisSample>& samples, const std::vector<int>& functions,
                              int first, const RowKind& kind) {
  FunctionGroup group;
  group.functions = functions;
  group.d = 9;
  const auto count = static_cast<Eigen::Index>(samples.size());
  group.modes = Matrix::Zero(3 * std::ssize(functions), 9 * count);
  for (Eigen::Index q = 0; q < count; ++q)
    for (const auto& m : samples[static_cast<std::size_t>(q)].modes) {
      const auto at = std::ranges::lower_bound(functions, m.function) - functions.begin();
      group.modes.block<3, 9>(3 * at, 9 * q) = kind.modes(m, first + static_cast<int>(q)).transpose();
    }
  return group;
}

FieldTable make_table(const Basis& basis, const std::vector<int>& tet, const Eigen::Matrix4Xd& barycentric,
                      const Vector& weights, const std::vector<int>& starts, const RowKind& kind) {
  FieldTable table;
  table.num_functions = basis.num_functions();
  table.weights = weights;
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
    PointBlock block{starts[k], starts[k + 1] - starts[k], {}};
    std::vector<BasisSample> samples;
    std::vector<int> plain, local, modes;
    for (int q = block.first; q < block.first + block.count; ++q) {
      samples.push_back(basis.sample(tet[q], barycentric.col(q)));
      for (const int f : samples.back().functions) (basis.in_local_axes(f) ? local : plain).push_back(f);
      for (const auto& m : samples.back().modes) modes.push_back(m.function);
    }
    for (auto* functions : {&plain, &local, &modes}) {
      std::sort(functions->begin(), functions->end());
      functions->erase(std::unique(functions->begin(), functions->end()), functions->end());
      if (functions->empty()) continue;
      block.groups.push_back(functions == &modes
                                 ? make_mode_group(samples, modes, block.first, kind)
                                 : make_group(samples, *functions, block.first, functions == &local, kind));
    }
    table.blocks.push_back(std::move(block));
  }
  return table;
}

}  // namespace

FieldTable deformation_table(const Basis& basis, const WallPoints& points) {
  return make_table(basis, points.tet, points.barycentric, points.weights, points.starts, GradientRows());
}

FieldTable surface_table(const Basis& basis, const SurfacePoints& points, const Vec3& origin) {
  FieldTable table =
      make_table(basis, points.tet, points.barycentric, points.weights, points.starts, SurfaceRows(points));
  table.base.resize(9, points.X.cols());
  table.base.topRows<3>() = points.X.colwise() - origin;
  table.base.middleRows<3>(3) = points.X_xi;
  table.base.bottomRows<3>() = points.X_eta;
  return table;
}

FieldTable displacement_table(const Basis& basis, const SurfacePoints& points) {
  FieldTable table =
      make_table(basis, points.tet, points.barycentric, points.weights, points.starts, ValueRows());
  for (Eigen::Index q = 0; q < points.X.cols(); ++q)
    table.weights[q] *= Vec3(points.X_xi.col(q)).cross(Vec3(points.X_eta.col(q))).norm();
  table.base = Matrix::Zero(9, points.X.cols());
  return table;
}

FieldTable displacement_table(const Basis& basis, const WallPoints& points) {
  FieldTable table =
      make_table(basis, points.tet, points.barycentric, points.weights, points.starts, ValueRows());
  table.base = Matrix::Zero(9, points.weights.size());
  return table;
}

DisplacementMap::DisplacementMap(const Basis& basis, const std::vector<int>& tet,
                                 const Eigen::Matrix4Xd& barycentric)
    : num_functions_(basis.num_functions()), start_{0}, mode_start_{0} {
  bool any_local = false;
  for (std::size_t p = 0; p < tet.size(); ++p) {
    const BasisSample s = basis.sample(tet[p], barycentric.col(static_cast<Eigen::Index>(p)));
    for (std::size_t k = 0; k < s.functions.size(); ++k) {
      functions_.push_back(s.functions[k]);
      N_.push_back(s.N[static_cast<Eigen::Index>(k)]);
      local_.push_back(basis.in_local_axes(s.functions[k]) ? 1 : 0);
      any_local |= local_.back() != 0;
    }
    start_.push_back(static_cast<int>(functions_.size()));
    axes_.push_back(s.Q);
    for (const auto& m : s.modes) {
      mode_functions_.push_back(m.function);
      modes_.push_back(m.value);
    }
    mode_start_.push_back(static_cast<int>(modes_.size()));
  }
  if (!any_local) axes_.clear();
}

Points DisplacementMap::apply(const Vector& c) const {
  const auto n = static_cast<Eigen::Index>(start_.size()) - 1;
  Points u(3, n);
  for (Eigen::Index p = 0; p < n; ++p) {
    Vec3 plain = Vec3::Zero();
    Vec3 local = Vec3::Zero();
    for (int k = start_[p]; k < start_[p + 1]; ++k)
      (local_[k] ? local : plain) += N_[k] * c.segment<3>(3 * functions_[k]);
    for (int k = mode_start_[p]; k < mode_start_[p + 1]; ++k)
      plain += modes_[k] * c.segment<3>(3 * mode_functions_[k]);
    u.col(p) = axes_.empty() ? plain : Vec3(plain + axes_[p] * local);
  }
  return u;
}

Vector DisplacementMap::transpose(const Points& forces) const {
  Vector out = Vector::Zero(3 * num_functions_);
  for (Eigen::Index p = 0; p < forces.cols(); ++p) {
    const Vec3 f = forces.col(p);
    const Vec3 in_axes = axes_.empty() ? f : Vec3(axes_[p].transpose() * f);
    for (int k = start_[p]; k < start_[p + 1]; ++k)
      out.segment<3>(3 * functions_[k]) += N_[k] * (local_[k] ? in_axes : f);
    for (int k = mode_start_[p]; k < mode_start_[p + 1]; ++k)
      out.segment<3>(3 * mode_functions_[k]) += modes_[k].transpose() * f;
  }
  return out;
}

}  // namespace polyaffine
