#include "cardiac/model/muscle.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include <polyaffine/core/parallel.hpp>

namespace cardiac {

using polyaffine::At;
using polyaffine::Matrix;
using polyaffine::Vector;

namespace {

constexpr int kMost = kMostSarcomereStates;
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMost, kMost>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMost, 1>;
constexpr int kSerialPoints = 4096;  // that one thread computes sooner than it wakes another

template <class Work>
void for_each(bool parallel, int count, const Work& work) {
  if (parallel)
    polyaffine::parallel_for(0, count, work);
  else
    for (int k = 0; k < count; ++k) work(k);
}

// The displacement gradient of coefficients at all points, 9 × points, without the identity.
Matrix gradient(const polyaffine::FieldEnergy& energy, const Vector& c) {
  Matrix out(9, energy.table().num_points());
  const auto& blocks = energy.blocks();
  const auto work = [&](int k) {
    const polyaffine::PackedBlock& block = blocks[static_cast<std::size_t>(k)];
    thread_local std::vector<polyaffine::Mat3Pack> M;
    M.resize(static_cast<std::size_t>(block.num_packs()));
    block.field(c, false, block.all(), M.data());
    for (int pack = 0; pack < block.num_packs(); ++pack) {
      const auto [point, lanes] = block.points(pack);
      for (int lane = 0; lane < lanes; ++lane)
        for (int i = 0; i < 9; ++i) out(i, point + lane) = M[static_cast<std::size_t>(pack)].m[i][lane];
    }
  };
  for_each(energy.table().num_points() > kSerialPoints, static_cast<int>(blocks.size()), work);
  return out;
}

polyaffine::PointState of(const Vector& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

template <class Work>
void for_points(int count, const Work& work) {
  constexpr int kChunk = 256;
  for_each(count > kSerialPoints, (count + kChunk - 1) / kChunk, [&](int k) {
    for (int q = k * kChunk; q < std::min(count, (k + 1) * kChunk); ++q) work(q);
  });
}

// τ = T/λ and its change with λ, from T and dT/dλ.
void set_stress(int q, double stretch, double tension, double by_stretch, Vector& stress) {
  stress[q] = tension / stretch;
  stress[stress.size() / 2 + q] = (by_stretch - tension / stretch) / stretch;
}

}  // namespace

Vector Muscle::drive(double time_ms) const {
  Vector out(delay_ms.size());
  for (Eigen::Index q = 0; q < out.size(); ++q)
    out[q] = q > 0 && delay_ms[q] == delay_ms[q - 1] ? out[q - 1] : sarcomere->drive(time_ms - delay_ms[q]);
  return out;
}

FibreStretch fibre_stretch(const Muscle& muscle, const Vector& c, const Vector* rate) {
  const Matrix F = gradient(*muscle.energy, c);
  Matrix F_rate;
  if (rate) F_rate = gradient(*muscle.energy, *rate);
  FibreStretch out;
  const int n = muscle.num_points();
  out.stretch.resize(n);
  out.by_F.resize(9, n);
  if (rate) out.rate.resize(n);
  for_points(n, [&](int q) {
    const polyaffine::Vec3 f = muscle.fibres.col(q);
    const polyaffine::Vec3 moved = f + F.col(q).reshaped(3, 3) * f;
    out.stretch[q] = moved.norm();
    out.by_F.col(q) = (moved / out.stretch[q] * f.transpose()).reshaped();
    if (rate) out.rate[q] = out.by_F.col(q).dot(F_rate.col(q));
  });
  return out;
}

MuscleTerm::MuscleTerm(std::shared_ptr<const Muscle> muscle, polyaffine::StateLayout& layout)
    : muscle_(std::move(muscle)),
      num_states_(muscle_->sarcomere->num_states()),
      c_{0, muscle_->energy->table().num_unknowns()} {
  constexpr double kTolerance = 1e-3;  // of states that are of the order of one
  z_ = layout.add({.name = "contraction",
                   .unit = "1",
                   .solved = polyaffine::Solved::apart,
                   .absolute_tolerance = kTolerance},
                  num_states_ * muscle_->num_points());
}

SarcomereModel::States MuscleTerm::states(const Vector& y, int point) const {
  SarcomereModel::States out{};
  for (int i = 0; i < num_states_; ++i) out[i] = y[z_.first + num_states_ * point + i];
  return out;
}

void MuscleTerm::add_residual(const At& at, polyaffine::Residual& out) const {
  const Vector c = c_.of(at.y), rate = at.rate_of(c_);
  const FibreStretch fibre = fibre_stretch(*muscle_, c, &rate);
  const Vector drive = muscle_->drive(at.t);
  const int n = muscle_->num_points();
  Vector tension = Vector::Zero(2 * n);
  for_points(n, [&](int q) {
    SarcomereResponse r;
    muscle_->sarcomere->respond({drive[q], fibre.stretch[q], fibre.rate[q]}, states(at.y, q), false, r);
    tension[q] = muscle_->scale[q] * r.tension_kPa / fibre.stretch[q];
    for (int i = 0; i < num_states_; ++i) {
      const int k = z_.first + num_states_ * q + i;
      out.values[k] += (at.rate ? (*at.rate)[k] : 0) - r.rates[i];
    }
  });
  const Vector force = muscle_->energy->evaluate({c, of(tension)}).gradient;
  c_.of(out.values) += force;
  out.forces += force.norm();
}

class MuscleTerm::EliminatedStates : public polyaffine::Elimination {
 public:
  EliminatedStates(const MuscleTerm& of, Vector c, FibreStretch fibre)
      : of_(of), n_(of.num_states_), c_(std::move(c)), fibre_(std::move(fibre)) {
    const int points = of.muscle_->num_points();
    inverse_.resize(n_ * n_, points);
    by_stretch_.resize(n_, points);
    tension_by_.resize(n_, points);
  }

  // M⁻¹, M⁻¹ h and ∂T/∂z of a point; returns ∂T/∂z M⁻¹ h.
  double set(int q, const SarcomereResponse& r, double alpha) {
    Small M(n_, n_);
    SmallVector h(n_), by_state(n_);
    for (int i = 0; i < n_; ++i) {
      for (int j = 0; j < n_; ++j) M(i, j) = (i == j ? alpha : 0) - r.rates_by_state[i][j];
      h[i] = r.rates_by_stretch[i] + alpha * r.rates_by_rate[i];
      by_state[i] = r.by_state[i];
    }
    const Small inverse = M.partialPivLu().inverse();
    inverse_.col(q) = inverse.reshaped();
    by_stretch_.col(q) = inverse * h;
    tension_by_.col(q) = by_state;
    return by_state.dot(by_stretch_.col(q));
  }

  void condense(const Vector& rhs, Eigen::Ref<Vector> field) const override {
    const Muscle& muscle = *of_.muscle_;
    const int points = muscle.num_points();
    Vector tension = Vector::Zero(2 * points);
    for_points(points, [&](int q) {
      tension[q] = muscle.scale[q] / fibre_.stretch[q] * tension_by_.col(q).dot(apart(rhs, q));
    });
    field.segment(of_.c_.first, of_.c_.size) -= muscle.energy->evaluate({c_, of(tension)}).gradient;
  }
  void recover(const Vector& rhs, Vector& step) const override {
    const Matrix change = gradient(*of_.muscle_->energy, of_.c_.of(step));
    for_points(of_.muscle_->num_points(), [&](int q) {
      step.segment(of_.z_.first + n_ * q, n_) =
          apart(rhs, q) + by_stretch_.col(q) * fibre_.by_F.col(q).dot(change.col(q));
    });
  }

 private:
  // M⁻¹ ρ_z of a point.
  SmallVector apart(const Vector& rhs, int q) const {
    return inverse_.col(q).reshaped(n_, n_) * rhs.segment(of_.z_.first + n_ * q, n_);
  }

  const MuscleTerm& of_;
  int n_;
  Vector c_;
  FibreStretch fibre_;
  Matrix inverse_, by_stretch_, tension_by_;  // a column for each point
};

void MuscleTerm::add_tangent(const At& at, double alpha, polyaffine::Tangent& out) const {
  const Vector c = c_.of(at.y), rate = at.rate_of(c_);
  const FibreStretch fibre = fibre_stretch(*muscle_, c, &rate);
  const Vector drive = muscle_->drive(at.t);
  const int n = muscle_->num_points();
  auto eliminated = std::make_unique<EliminatedStates>(*this, c, fibre);
  Vector stress(2 * n);
  for_points(n, [&](int q) {
    SarcomereResponse r;
    muscle_->sarcomere->respond({drive[q], fibre.stretch[q], fibre.rate[q]}, states(at.y, q), true, r);
    const double along = r.by_stretch + eliminated->set(q, r, alpha);
    set_stress(q, fibre.stretch[q], muscle_->scale[q] * r.tension_kPa, muscle_->scale[q] * along, stress);
  });
  muscle_->energy->add_tangent({c, of(stress)}, out.field);
  out.eliminations.push_back(std::move(eliminated));
}

void MuscleTerm::add_tables(std::vector<const polyaffine::FieldTable*>& out) const {
  out.push_back(&muscle_->energy->table());
}

void MuscleTerm::rest(double time_ms, Vector& y) const {
  const FibreStretch fibre = fibre_stretch(*muscle_, c_.of(y));
  const Vector drive = muscle_->drive(time_ms);
  for (int q = 0; q < muscle_->num_points(); ++q) {
    const auto z = muscle_->sarcomere->at_rest(drive[q], fibre.stretch[q]);
    for (int i = 0; i < num_states_; ++i) y[z_.first + num_states_ * q + i] = z[i];
  }
}

Vector MuscleTerm::tension(const Vector& y) const {
  const FibreStretch fibre = fibre_stretch(*muscle_, c_.of(y));
  Vector out(muscle_->num_points());
  for_points(muscle_->num_points(), [&](int q) {
    SarcomereResponse r;
    muscle_->sarcomere->respond({0, fibre.stretch[q], 0}, states(y, q), false, r);
    out[q] = muscle_->scale[q] * r.tension_kPa / fibre.stretch[q];
  });
  return out;
}

RestingMuscle::RestingMuscle(std::shared_ptr<const Muscle> muscle, double time_ms, double from, double to)
    : muscle_(std::move(muscle)),
      drive_(muscle_->drive(time_ms)),
      from_(from),
      to_(to),
      c_{0, muscle_->energy->table().num_unknowns()} {}

Vector RestingMuscle::tension_and_stiffness(double t, const Vector& c) const {
  const FibreStretch fibre = fibre_stretch(*muscle_, c);
  const int n = muscle_->num_points();
  const double share = (1 - t) * from_ + t * to_;
  Vector out(2 * n);
  for_points(n, [&](int q) {
    const RestingTension r = resting_tension(*muscle_->sarcomere, drive_[q], fibre.stretch[q]);
    const double scale = share * muscle_->scale[q];
    set_stress(q, fibre.stretch[q], scale * r.tension_kPa, scale * r.by_stretch, out);
  });
  return out;
}

void RestingMuscle::add_residual(const At& at, polyaffine::Residual& out) const {
  const Vector c = c_.of(at.y), tension = tension_and_stiffness(at.t, c);
  const Vector force = muscle_->energy->evaluate({c, of(tension)}).gradient;
  c_.of(out.values) += force;
  out.forces += force.norm();
}

void RestingMuscle::add_tangent(const At& at, double, polyaffine::Tangent& out) const {
  const Vector c = c_.of(at.y), tension = tension_and_stiffness(at.t, c);
  muscle_->energy->add_tangent({c, of(tension)}, out.field);
}

void RestingMuscle::add_tables(std::vector<const polyaffine::FieldTable*>& out) const {
  out.push_back(&muscle_->energy->table());
}

}  // namespace cardiac
