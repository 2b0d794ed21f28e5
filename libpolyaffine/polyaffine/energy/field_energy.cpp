#include "polyaffine/energy/field_energy.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace polyaffine {
namespace {

constexpr int kChunk = 256;  // blocks whose local matrices are kept before they are added in order

Mat3 cofactor(const Mat3& F) {
  Mat3 c;
  c.col(0) = F.col(1).cross(F.col(2));
  c.col(1) = F.col(2).cross(F.col(0));
  c.col(2) = F.col(0).cross(F.col(1));
  return c;
}

// Adds s·∂²det/∂F² to a 9×9 matrix.
void add_cofactor_derivative(const Mat3& F, double s, double* A) {
  Eigen::Map<Eigen::Matrix<double, 9, 9>> out(A);
  const auto cross = [&](int i, int j, int col, double sign) {
    const Vec3 f = sign * s * F.col(col);
    // ∂(col i of cof)/∂(col j of F) = sign [F_col]×
    Mat3 m;
    m << 0, -f.z(), f.y(), f.z(), 0, -f.x(), -f.y(), f.x(), 0;
    out.block<3, 3>(3 * i, 3 * j) += m;
  };
  cross(0, 1, 2, -1);
  cross(0, 2, 1, 1);
  cross(1, 0, 2, 1);
  cross(1, 2, 0, -1);
  cross(2, 0, 1, -1);
  cross(2, 1, 0, 1);
}

void scatter(const std::vector<int>& functions, const Matrix& local, Vector& global) {
  for (std::size_t a = 0; a < functions.size(); ++a)
    global.segment<3>(3 * functions[a]) += local.col(static_cast<Eigen::Index>(a));
}

// Runs work(k) for the blocks of a chunk in parallel and then finish(k) in order: the sums do not depend on
// threads.
template <class Work, class Finish>
void for_blocks(int count, const Work& work, const Finish& finish) {
  for (int begin = 0; begin < count; begin += kChunk) {
    const int end = std::min(count, begin + kChunk);
    tbb::parallel_for(begin, end, [&](int k) { work(k, k - begin); });
    for (int k = begin; k < end; ++k) finish(k, k - begin);
  }
}

}  // namespace

struct FieldEnergy::Kinematics {
  Matrix F;    // 9 × points
  Vector J;    // det F
  Matrix cof;  // 9 × points; only with a pressure space
  Vector p;    // pressure coefficients
  double volumetric_energy = 0;
};

FieldEnergy::FieldEnergy(FieldTable table, std::vector<std::shared_ptr<const Law>> laws,
                         std::optional<PressureSpace> pressure, std::optional<KelvinVoigt> viscosity)
    : table_(std::move(table)),
      laws_(std::move(laws)),
      pressure_(std::move(pressure)),
      viscosity_(std::move(viscosity)) {
  if (pressure_) inverse_mass_ = InverseMass(*pressure_, table_);
}

FieldEnergy::Kinematics FieldEnergy::kinematics(const Motion& motion) const {
  Kinematics kin;
  kin.F = evaluate_field(table_, motion.c);
  kin.J.resize(table_.num_points());
  for (int q = 0; q < table_.num_points(); ++q) kin.J[q] = kin.F.col(q).reshaped(3, 3).determinant();
  if (!pressure_) return kin;

  kin.cof.resize(9, table_.num_points());
  for (int q = 0; q < table_.num_points(); ++q)
    kin.cof.col(q) = cofactor(kin.F.col(q).reshaped(3, 3)).reshaped();
  Vector g = Vector::Zero(pressure_->num_functions);
  for (std::size_t k = 0; k < table_.blocks.size(); ++k) {
    const auto& block = table_.blocks[k];
    const Vector dilatation = table_.weights.segment(block.first, block.count).array() *
                              (kin.J.segment(block.first, block.count).array() - 1);
    g(pressure_->blocks[k].functions) += pressure_->blocks[k].values * dilatation;
  }
  kin.p = pressure_->bulk_modulus * inverse_mass_.apply(g);
  kin.volumetric_energy = 0.5 * g.dot(kin.p);
  return kin;
}

// Stress (and tangent) of all laws and of the pressure at the points of a block, times the integration
// weights.
void FieldEnergy::evaluate_laws(const Kinematics& kin, const Matrix& rate, const Motion& motion,
                                std::size_t k, double* energy, Matrix& P, Matrix* A,
                                double rate_factor) const {
  const auto& block = table_.blocks[k];
  const double* F = kin.F.col(block.first).data();
  P.setZero(9, block.count);
  if (A) A->setZero(81, block.count);
  Vector W = Vector::Zero(energy ? block.count : 0);
  for (const auto& law : laws_)
    law->evaluate(block.first, block.count, F, motion.state, energy ? W.data() : nullptr, P.data(),
                  A ? A->data() : nullptr);
  if (viscosity_ && motion.rate) {
    Matrix A_dot;
    if (A) A_dot.setZero(81, block.count);
    viscosity_->evaluate(block.first, block.count, F, rate.col(block.first).data(), P.data(),
                         A ? A_dot.data() : nullptr);
    if (A) *A += rate_factor * A_dot;
  }
  if (pressure_) {
    const auto& space = pressure_->blocks[k];
    const Vector p = space.values.transpose() * kin.p(space.functions);
    P.noalias() += kin.cof.middleCols(block.first, block.count) * p.asDiagonal();
    if (A)
      for (int q = 0; q < block.count; ++q)
        add_cofactor_derivative(kin.F.col(block.first + q).reshaped(3, 3), p[q], A->col(q).data());
  }
  const auto w = table_.weights.segment(block.first, block.count);
  if (energy) *energy = W.dot(w);
  P *= w.asDiagonal();
  if (A) *A *= w.asDiagonal();
}

Matrix FieldEnergy::field_rate(const Motion& motion) const {
  if (!viscosity_ || !motion.rate) return {};
  Matrix rate = Matrix::Zero(9, table_.num_points());
  for (const auto& block : table_.blocks)
    add_field(block, gather(block, *motion.rate), rate.col(block.first).data());
  return rate;
}

EnergyValue FieldEnergy::evaluate(const Motion& motion) const {
  const Kinematics kin = kinematics(motion);
  const Matrix rate = field_rate(motion);
  EnergyValue out;
  out.gradient = Vector::Zero(table_.num_unknowns());
  out.min_det = kin.J.minCoeff();
  out.max_det = kin.J.maxCoeff();
  out.value = kin.volumetric_energy;
  std::vector<double> energy(kChunk);
  std::vector<Matrix> force(kChunk);
  for_blocks(
      static_cast<int>(table_.blocks.size()),
      [&](int k, int slot) {
        Matrix P;
        evaluate_laws(kin, rate, motion, k, &energy[slot], P, nullptr, 1);
        force[slot].setZero(3, table_.blocks[k].num_functions());
        add_field_transpose(table_.blocks[k], P.data(), force[slot]);
      },
      [&](int k, int slot) {
        out.value += energy[slot];
        scatter(table_.blocks[k].functions(), force[slot], out.gradient);
      });
  return out;
}

// Rows D_b = ∂g_b/∂c of the pressure functions of a block, by local unknown.
Matrix FieldEnergy::dilatation_rows(const Kinematics& kin, std::size_t k) const {
  const auto& block = table_.blocks[k];
  const auto& space = pressure_->blocks[k];
  Matrix rows(static_cast<Eigen::Index>(space.functions.size()), 3 * block.num_functions());
  for (Eigen::Index b = 0; b < rows.rows(); ++b) {
    const Vector weight =
        space.values.row(b).transpose().array() * table_.weights.segment(block.first, block.count).array();
    const Matrix S = kin.cof.middleCols(block.first, block.count) * weight.asDiagonal();
    Matrix force = Matrix::Zero(3, block.num_functions());
    add_field_transpose(block, S.data(), force);
    rows.row(b) = force.reshaped().transpose();
  }
  return rows;
}

void FieldEnergy::add_tangent(const Motion& motion, LinearSystem& system, double scale,
                              double rate_factor) const {
  const Kinematics kin = kinematics(motion);
  const Matrix rate = rate_factor != 0 ? field_rate(motion) : Matrix();
  const Motion used{motion.c, motion.state, rate.size() > 0 ? motion.rate : nullptr};
  const bool global = pressure_ && !inverse_mass_.local();
  Matrix D;
  if (global) D = Matrix::Zero(pressure_->num_functions, table_.num_unknowns());
  std::vector<Matrix> K(kChunk), rows(kChunk);
  for_blocks(
      static_cast<int>(table_.blocks.size()),
      [&](int k, int slot) {
        Matrix P, A;
        evaluate_laws(kin, rate, used, k, nullptr, P, &A, rate_factor);
        if (!pressure_ && A.isZero(0)) {  // a dead load
          K[slot].resize(0, 0);
          return;
        }
        block_stiffness(table_.blocks[k], A.data(), K[slot]);
        if (!pressure_) return;
        rows[slot] = dilatation_rows(kin, k);
        if (!global)
          K[slot].noalias() +=
              pressure_->bulk_modulus * rows[slot].transpose() * (inverse_mass_.block(k) * rows[slot]);
      },
      [&](int k, int slot) {
        if (K[slot].size() == 0) return;
        const std::vector<int> functions = table_.blocks[k].functions();
        system.add(functions, scale * K[slot]);
        if (!global) return;
        const auto& pressures = pressure_->blocks[k].functions;
        for (std::size_t b = 0; b < pressures.size(); ++b)
          for (std::size_t a = 0; a < functions.size(); ++a)
            D.row(pressures[b]).segment<3>(3 * functions[a]) +=
                rows[slot].row(static_cast<Eigen::Index>(b)).segment<3>(static_cast<Eigen::Index>(3 * a));
      });
  if (global) system.add_dense(scale * pressure_->bulk_modulus * D.transpose() * inverse_mass_.apply(D));
}

Vector FieldEnergy::pressure(const Vector& c) const {
  return kinematics({c}).p;
}

}  // namespace polyaffine
