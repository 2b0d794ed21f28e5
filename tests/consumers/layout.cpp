// What crosses between a program and the library: packs, Eigen's fixed and dynamic types, memory that one
// allocates and the other frees, classes of the program called by the library. Both may be compiled for
// different processors.

#include <Eigen/LU>
#include <memory>
#include <vector>

#include <polyaffine/geometry/locate.hpp>
#include <polyaffine/kinematics/basis.hpp>
#include <polyaffine/linear/linear_system.hpp>
#include <polyaffine/material/lagrangian_response.hpp>
#include <polyaffine/material/law.hpp>
#include <polyaffine/material/volumetric_response.hpp>
#include <polyaffine/system/field_energy.hpp>

#include "check.hpp"

using namespace polyaffine;

namespace {

// One tet, its functions the barycentric coordinates.
class OneTet : public Basis {
 public:
  explicit OneTet(const TetMesh& mesh) {
    Eigen::Matrix4d A;
    A << Eigen::RowVector4d::Ones(), mesh.points();
    gradients_ = A.inverse().rightCols<3>().transpose();
  }
  int num_functions() const override { return 4; }
  BasisSample sample(int, const Vec4& barycentric) const override {
    BasisSample out;
    out.functions = {0, 1, 2, 3};
    out.N = barycentric;
    out.gradient = gradients_;
    return out;
  }

 private:
  Eigen::Matrix<double, 3, 4> gradients_;
};

// W = a ln(J) + b exp(J) + c ∛J, whose derivatives by F are those by J times the cofactors.
class OfVolume : public Law {
 public:
  void respond(PackPoints, const PackMotion& at, bool tangent, PackResponse& r) const override {
    const Mat3Pack& F = at.F;
    const Mat3Pack cof = cofactor(F);
    const Pack J = determinant(F, cof), root = cbrt(J);
    add_volumetric(F, cof,
                   {log(J) + 2 * exp(J) + 3 * root, 1 / J + 2 * exp(J) + 1 / (root * root),
                    -1 / (J * J) + 2 * exp(J) - 2.0 / 3 / (root * root * J)},
                   tangent, r);
    // Results of expressions as arguments of compiled functions; both add nothing.
    const IsochoricStrain strain = isochoric_strain(right_cauchy_green(F), 1 / (1 / J));
    add_constant_stress(F, strain.g * root * root - 1, SymPack{}, tangent, r);
  }
};

// Keeps the matrix that energies add to.
class Sum : public LinearSystem {
 public:
  Matrix K = Matrix::Zero(12, 12);
  void set_zero() override { K.setZero(); }
  void add(const std::vector<int>& functions, const Matrix& local) override {
    for (std::size_t a = 0; a < functions.size(); ++a)
      for (std::size_t b = 0; b < functions.size(); ++b)
        K.block<3, 3>(3 * functions[a], 3 * functions[b]) +=
            local.block<3, 3>(3 * static_cast<Eigen::Index>(a), 3 * static_cast<Eigen::Index>(b));
  }
  void add_dense(const Matrix& more) override { K += more; }
  bool factorise() override { return false; }
  Matrix solve(const Matrix& rhs) const override { return rhs; }
  bool positive_definite() const override { return false; }
};

}  // namespace

int main() {
  check("alignment of a pack", alignof(Pack), 32, 0);
  check("size of a pack", sizeof(Pack), 32, 0);
  check("alignment of Vec4", alignof(Vec4), 32, 0);
  check("size of MeshPoint", sizeof(MeshPoint), 96, 0);

  Points X(3, 4);
  X << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  Tets corners(4, 1);
  corners << 0, 1, 2, 3;
  const TetMesh mesh(X, corners);
  check("volume", mesh.volume(), 1.0 / 6, 1e-15);
  std::vector<MeshPoint> places;
  for (int k = 0; k < 100; ++k) places.push_back(locate(mesh, Vec3(0.1, 0.2, 0.3)));
  check("barycentric coordinate", places.back().barycentric[0], 0.4, 1e-14);

  // F = I + G everywhere.
  const OneTet basis(mesh);
  WallPoints points{{}, Eigen::Matrix4Xd::Constant(4, 7, 0.25), Vector::Constant(7, 1.0 / 42), {0, 7}};
  points.tet.assign(7, 0);
  const FieldEnergy energy(deformation_table(basis, points), {std::make_shared<OfVolume>()});
  Mat3 G;
  G << 0.1, 0.2, -0.1, 0.05, -0.1, 0.15, -0.2, 0.1, 0.3;
  const Matrix u = G * X;
  const Vector c = u.reshaped();
  const double J = (Mat3::Identity() + G).determinant(), root = std::cbrt(J);
  const EnergyValue at = energy.evaluate({c});
  check("energy", at.value, (std::log(J) + 2 * std::exp(J) + 3 * root) / 6, 1e-13);
  const Mat3 P =
      (1 / J + 2 * std::exp(J) + 1 / (root * root)) * J * (Mat3::Identity() + G).inverse().transpose();
  const Matrix forces = P * basis.sample(0, Vec4::Constant(0.25)).gradient / 6;
  check("error of the forces", (at.gradient - forces.reshaped()).norm(), 0, 1e-13);

  Sum sum;
  energy.add_tangent({c}, sum);
  Vector direction = Vector::LinSpaced(12, -1, 2);
  const double h = 1e-5;
  const Vector difference =
      (energy.evaluate({c + h * direction}).gradient - energy.evaluate({c - h * direction}).gradient) /
      (2 * h);
  check("error of the tangent", (sum.K * direction - difference).norm() / difference.norm(), 0, 1e-8);

  // Memory of the library that grows here, and the reverse.
  const auto dense = dense_system(60);
  for (int n = 1; n <= 60; ++n) {
    Matrix A = Matrix::Random(60, n);
    dense->set_zero();
    dense->add_dense(Matrix::Identity(60, 60) + A * A.transpose());
    if (!dense->factorise()) return 1;
    Matrix x = dense->solve(A);
    check("residual", (x + A * (A.transpose() * x) - A).norm() / A.norm(), 0, 1e-12);
    x.conservativeResize(60 + n, n + 1);
    A = x;
  }
}
