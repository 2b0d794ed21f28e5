#pragma once

#include <polyaffine/system/field_energy.hpp>

namespace polyaffine {

/// Stress at the points of an energy's field by what it comes from: first Piola–Kirchhoff P, kPa, from the
/// deformation gradients F at its points (evaluate_field of its table); all are 9 × points, column-major.
/// Sums over the points give the forces of FieldEnergy: f_a = Σ_q w_q P_q row_a.

/// Of the laws that feel neither state nor rate, and of the pressure space with the coefficients p (kPa; not
/// read without one): p cof F.
Matrix elastic_stress(const FieldEnergy& energy, const Matrix& F, const Vector& p);
/// Of the laws that feel the state (active tension).
Matrix driven_stress(const FieldEnergy& energy, const Matrix& F, PointState state);
/// Of the laws that feel the rate Ḟ, 1/ms.
Matrix viscous_stress(const FieldEnergy& energy, const Matrix& F, const Matrix& rate);

/// Energy (µJ) of the laws that feel neither state nor rate and of the pressure space, with the pressures
/// that belong to the displacement; an incompressible space stores nothing.
double elastic_energy(const FieldEnergy& energy, const Vector& c);

/// Ḟ at all points for rates of the coefficients, 1/ms: the field without its constant part.
Matrix field_rate(const FieldTable& table, const Vector& rate);
/// Σ_q w_q P_q : H_q, µJ for a change H of F, µJ/ms for its rate.
double work(const Vector& weights, const Matrix& P, const Matrix& H);
/// Cauchy stress P Fᵀ / det F of one point.
Mat3 cauchy_stress(const Mat3& P, const Mat3& F);

}  // namespace polyaffine
