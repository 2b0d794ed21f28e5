#include "polyaffine/system/support.hpp"

#include <utility>

#include <polyaffine/material/parameters.hpp>

namespace polyaffine {
namespace {

FieldEnergy unit_springs(FieldTable surface, Points normals, SpringDirection direction) {
  const auto law = normals.size() > 0 ? std::make_shared<SurfaceSpring>(1.0, std::move(normals), direction)
                                      : std::make_shared<SurfaceSpring>(1.0);
  return FieldEnergy(std::move(surface), {law});
}

// The tangent of an energy as it is.
class WholeMatrix : public LinearSystem {
 public:
  explicit WholeMatrix(int unknowns) : K(Matrix::Zero(unknowns, unknowns)) {}
  void set_zero() override { K.setZero(); }
  void add(const std::vector<int>& functions, const Matrix& block) override {
    for (std::size_t b = 0; b < functions.size(); ++b)
      for (std::size_t a = 0; a < functions.size(); ++a)
        K.block<3, 3>(3 * functions[a], 3 * functions[b]) +=
            block.block<3, 3>(static_cast<Eigen::Index>(3 * a), static_cast<Eigen::Index>(3 * b));
  }
  void add_dense(const Matrix& more) override { K += more; }
  bool factorise() override { return false; }
  Matrix solve(const Matrix&) const override { return {}; }
  bool positive_definite() const override { return false; }

  Matrix K;
};

// Of few functions that all points see, as modes are, the matrix has fewer numbers than the table.
Matrix matrix_of(const FieldEnergy& springs) {
  const FieldTable& table = springs.table();
  double numbers = 0;
  for (const PointBlock& block : table.blocks) numbers += 3.0 * block.count * block.num_functions();
  const int n = table.num_unknowns();
  if (numbers < static_cast<double>(n) * n) return {};
  WholeMatrix out(n);
  springs.add_tangent({Vector::Zero(n)}, out);
  return std::move(out.K);
}

}  // namespace

Support::Support(FieldTable surface, SupportParameters parameters)
    : unit_(unit_springs(std::move(surface), std::move(parameters.normals), parameters.direction)),
      matrix_(matrix_of(unit_)),
      stiffness_(parameters.stiffness_kPa_per_mm),
      damping_(parameters.damping_kPa_ms_per_mm),
      c_{0, unit_.table().num_unknowns()} {
  require_not_negative("support stiffness", stiffness_, "kPa/mm");
  require_not_negative("support damping", damping_, "kPa ms/mm");
}

EnergyValue Support::force(const Vector& u) const {
  if (matrix_.size() == 0) return unit_.evaluate({u});
  EnergyValue out;
  out.gradient = matrix_ * u;
  out.value = 0.5 * u.dot(out.gradient);
  return out;
}

void Support::add_residual(const At& at, Residual& out) const {
  const auto add = [&](const Vector& u, double factor, bool stores) {
    const EnergyValue e = force(u);
    c_.of(out.values) += factor * e.gradient;
    out.forces += factor * e.gradient.norm();
    if (stores) out.potential += factor * e.value;
  };
  if (stiffness_ > 0) add(c_.of(at.y), stiffness_, true);
  if (damping_ > 0 && at.rate) add(c_.of(*at.rate), damping_, false);
}

void Support::add_tangent(const At& at, double alpha, Tangent& out) const {
  const double factor = stiffness_ + (at.rate ? alpha * damping_ : 0);
  if (!(factor > 0)) return;
  if (matrix_.size() > 0)
    out.field.add_dense(factor * matrix_);
  else
    unit_.add_tangent({c_.of(at.y)}, out.field, factor);
}

double Support::stored_energy(const At& at) const {
  return stiffness_ > 0 ? stiffness_ * unit_.evaluate({c_.of(at.y)}).value : 0;
}

double Support::dissipation(const At& at) const {
  return damping_ > 0 && at.rate ? 2 * damping_ * unit_.evaluate({c_.of(*at.rate)}).value : 0;
}

void Support::add_parameter_derivative(const std::string& parameter, const At& at, Vector& out) const {
  if (parameter == "stiffness")
    c_.of(out) += force(c_.of(at.y)).gradient;
  else if (parameter == "damping")
    c_.of(out) += force(at.rate_of(c_)).gradient;
  else
    Term::add_parameter_derivative(parameter, at, out);
}

void Support::add_tables(std::vector<const FieldTable*>& out) const {
  out.push_back(&unit_.table());
}

}  // namespace polyaffine
