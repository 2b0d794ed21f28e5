#include "cardiac/run/segment_mechanics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <cardiac/run/active_tension.hpp>
#include <cardiac/run/segment_shares.hpp>
#include <polyaffine/kinematics/packed_field.hpp>
#include <polyaffine/system/point_stress.hpp>

namespace cardiac {

using polyaffine::Mat3;
using polyaffine::Matrix;
using polyaffine::Points;
using polyaffine::Vec3;
using polyaffine::Vector;

namespace {

constexpr double kMicrojoule = 1e-3;  // mJ
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Work by segment, mJ.
struct Work {
  Vector all, active;
};

// A state of the wall: deformation and first Piola–Kirchhoff stresses at the points.
struct WallState {
  double time_ms = 0;
  Matrix F, elastic, active;
};

class MechanicsGauge {
 public:
  MechanicsGauge(const Ventricle& ventricle, const Scene& scene, const HeartPath& path, const Vector& c_ed)
      : model_(ventricle),
        told_(ventricle.all_points ? *ventricle.all_points : ventricle),
        path_(path),
        deformation_(told_.wall->table()),
        shares_(segment_shares(*told_.anatomy, told_.discretisation)),
        volumes_(shares_.rowwise().sum()) {
    if (!scene.fibres) return;
    const auto& points = told_.discretisation.points;
    fibre_ = fibres_at(*told_.anatomy, *scene.fibres, points.tet, points.barycentric).topRows<3>();
    const Matrix F_ed = deformation_.at(c_ed);
    ed_length_.resize(fibre_.cols());
    for (Eigen::Index q = 0; q < fibre_.cols(); ++q) ed_length_[q] = (at(F_ed, q) * fibre_.col(q)).norm();
  }

  Work none() const { return {Vector::Zero(volumes_.size()), Vector::Zero(volumes_.size())}; }

  WallState state(const HeartState& of) const {
    WallState out{of.time_ms, deformation_.at(of.c), {}, {}};
    const Vector tension = active_tension(told_, path_, of);
    out.elastic = polyaffine::elastic_stress(*told_.wall, out.F, pressure(of.c));
    out.active = polyaffine::driven_stress(told_.active(), out.F,
                                           {tension.data(), static_cast<std::size_t>(tension.size())});
    return out;
  }

  // Of viscosity between two states; zero where nothing moves.
  Matrix viscous(const WallState& from, const WallState& to) const {
    const double lasts = to.time_ms - from.time_ms;
    if (!told_.wall->feels_rate() || !(lasts > 0)) return Matrix::Zero(9, from.F.cols());
    return polyaffine::viscous_stress(*told_.wall, (from.F + to.F) / 2, (to.F - from.F) / lasts);
  }

  void add_work(const WallState& from, const WallState& to, const Matrix& viscous, Work& sum) const {
    const Matrix change = to.F - from.F, active = (from.active + to.active) / 2;
    const Matrix all = active + viscous + (from.elastic + to.elastic) / 2;
    const auto by_segment = [&](const Matrix& P) {
      return Vector(kMicrojoule * shares_ * P.cwiseProduct(change).colwise().sum().transpose());
    };
    sum.all -= by_segment(all);
    sum.active -= by_segment(active);
  }

  std::vector<SegmentMechanics> measure(const WallState& now, const Matrix& viscous, const Work& work) const {
    Matrix at_points = Matrix::Constant(5, now.F.cols(), kNone);
    for (Eigen::Index q = 0; q < now.F.cols(); ++q) {
      const Mat3 F = at(now.F, q), active = polyaffine::cauchy_stress(at(now.active, q), F);
      const Mat3 all = active + polyaffine::cauchy_stress(at(now.elastic, q) + at(viscous, q), F);
      const double third = all.trace() / 3;
      at_points.col(q).tail<2>() << third, std::sqrt(1.5) * (all - third * Mat3::Identity()).norm();
      if (fibre_.cols() == 0) continue;
      const Vec3 turned = F * fibre_.col(q), n = turned.normalized();
      at_points.col(q).head<3>() << turned.norm() / ed_length_[q] - 1, n.dot(all * n), n.dot(active * n);
    }
    const Matrix sums = at_points * shares_.transpose();
    std::vector<SegmentMechanics> out;
    for (Eigen::Index s = 0; s < volumes_.size(); ++s) {
      const Vector mean = sums.col(s) / volumes_[s];
      const bool there = volumes_[s] > 0;
      out.push_back({mean[0], mean[1], mean[2], mean[3], mean[4], there ? work.all[s] : kNone,
                     there ? work.active[s] : kNone});
    }
    return out;
  }

 private:
  static Mat3 at(const Matrix& values, Eigen::Index q) { return values.col(q).reshaped(3, 3); }
  // Of the model, whose points give the volumes that it was solved with.
  Vector pressure(const Vector& c) const {
    return model_.wall->pressure_space() ? model_.wall->pressure(c) : Vector();
  }

  const Ventricle &model_, &told_;
  const HeartPath& path_;
  polyaffine::PackedField deformation_;
  Matrix shares_;     // segments × points
  Vector volumes_;    // of the segments
  Points fibre_;      // of each point; none without fibres
  Vector ed_length_;  // |F_ed f|
};

}  // namespace

std::vector<std::vector<SegmentMechanics>> segment_mechanics(const Ventricle& ventricle, const Scene& scene,
                                                             const HeartPath& path, const Vector& c_ed) {
  const MechanicsGauge gauge(ventricle, scene, path, c_ed);
  std::vector<std::vector<SegmentMechanics>> out;
  Work done = gauge.none();
  WallState before = gauge.state(path.steps.front());
  auto output = path.outputs.begin();
  const std::size_t steps = path.steps.size() - 1;
  for (std::size_t n = std::min<std::size_t>(1, steps); output != path.outputs.end(); ++n) {
    WallState now = gauge.state(path.steps[n]);
    const Matrix viscous = gauge.viscous(before, now);
    for (; output != path.outputs.end() && (n == steps || output->time_ms < now.time_ms); ++output) {
      const WallState between = gauge.state(*output);
      Work work = done;
      gauge.add_work(before, between, viscous, work);
      out.push_back(gauge.measure(between, viscous, work));
    }
    gauge.add_work(before, now, viscous, done);
    before = std::move(now);
  }
  return out;
}

}  // namespace cardiac
