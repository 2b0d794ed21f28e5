#include "polyaffine/system/point_stress.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include <polyaffine/core/parallel.hpp>

namespace polyaffine {
namespace {

constexpr int kChunk = 512;  // points that a thread takes at a time; whole packs

// Calls add(first, count) for the points, in chunks on any threads.
template <class Add>
Matrix at_points(Eigen::Index points, const Add& add) {
  Matrix P = Matrix::Zero(9, points);
  const int count = static_cast<int>(points);
  parallel_for(0, (count + kChunk - 1) / kChunk, [&](int k) {
    const int first = k * kChunk;
    add(first, std::min(kChunk, count - first), P.col(first).data());
  });
  return P;
}

void add_pressure(const PressureSpace& space, const FieldTable& table, const Matrix& F, const Vector& p,
                  Matrix& P) {
  for (std::size_t k = 0; k < table.blocks.size(); ++k) {
    const auto& [functions, values] = space.blocks[k];
    const Vector at_points = values.transpose() * p(functions);
    for (Eigen::Index q = 0; q < at_points.size(); ++q) {
      const Eigen::Index point = table.blocks[k].first + q;
      const Mat3 f = F.col(point).reshaped(3, 3);
      Mat3 cofactor;
      for (int i = 0; i < 3; ++i) cofactor.col(i) = f.col((i + 1) % 3).cross(f.col((i + 2) % 3));
      P.col(point) += at_points[q] * cofactor.reshaped();
    }
  }
}

}  // namespace

Matrix elastic_stress(const FieldEnergy& energy, const Matrix& F, const Vector& p) {
  Matrix P = at_points(F.cols(), [&](int first, int count, double* to) {
    for (const auto& law : energy.laws())
      if (!law->feels_state()) law->evaluate(first, count, F.col(first).data(), {}, nullptr, to, nullptr);
  });
  if (const auto& space = energy.pressure_space()) add_pressure(*space, energy.table(), F, p, P);
  return P;
}

Matrix driven_stress(const FieldEnergy& energy, const Matrix& F, PointState state) {
  return at_points(F.cols(), [&](int first, int count, double* to) {
    for (const auto& law : energy.laws())
      if (law->feels_state()) law->evaluate(first, count, F.col(first).data(), state, nullptr, to, nullptr);
  });
}

Matrix viscous_stress(const FieldEnergy& energy, const Matrix& F, const Matrix& rate) {
  return at_points(F.cols(), [&](int first, int count, double* to) {
    for (int start = first; start < first + count; start += kLanes, to += 9 * kLanes) {
      const int lanes = std::min(kLanes, first + count - start);
      const Mat3Pack f = gather_matrix(F.col(start).data(), lanes);
      const Mat3Pack f_dot = gather_matrix(rate.col(start).data(), lanes);
      PackResponse r;
      clear(r, false);
      for (const auto& law : energy.viscous_laws())
        law->respond({start, lanes}, {f, {}, &f_dot, 0}, false, r);
      scatter_add_points<9>(to, lanes, r.P);
    }
  });
}

double elastic_energy(const FieldEnergy& energy, const Vector& c) {
  const FieldTable& table = energy.table();
  const Matrix F = evaluate_field(table, c);
  const int points = table.num_points();
  Vector W = Vector::Zero(points);
  for (const auto& law : energy.laws())
    if (!law->feels_state()) law->evaluate(0, points, F.data(), {}, W.data(), nullptr, nullptr);
  double sum = table.weights.dot(W);
  const auto& space = energy.pressure_space();
  if (!space || space->incompressible) return sum;
  Vector J(points);
  for (Eigen::Index q = 0; q < points; ++q) J[q] = Mat3(F.col(q).reshaped(3, 3)).determinant();
  const Vector g = dilatation(*space, table, J);
  return sum + 0.5 * g.dot(energy.penalty_pressure(g));
}

Matrix field_rate(const FieldTable& table, const Vector& rate) {
  Matrix out = evaluate_field(table, rate);
  if (table.base.size() > 0)
    out -= table.base;
  else
    out.colwise() -= Mat3::Identity().reshaped();
  return out;
}

double work(const Vector& weights, const Matrix& P, const Matrix& H) {
  return weights.dot(P.cwiseProduct(H).colwise().sum().transpose());
}

Mat3 cauchy_stress(const Mat3& P, const Mat3& F) {
  return P * F.transpose() / F.determinant();
}

}  // namespace polyaffine
