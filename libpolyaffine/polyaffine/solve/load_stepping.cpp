#include "polyaffine/solve/load_stepping.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace polyaffine {
namespace {

constexpr double kTarget = 4;    // tangents a step for which its length is kept
constexpr double kNearly = 0.1;  // steps may be longer by this share to make the last one no shorter
constexpr double kLeast = 0.75;  // of a step, that an even division of the rest may leave of it
constexpr double kBetter = 0.7;  // the last equilibrium is the better start below this share of residual

// The path through its last equilibria, at most three of them, continued by Lagrange's polynomial.
class Path {
 public:
  void add(double load, const Vector& y) {
    if (loads_.size() == 3) {
      loads_.erase(loads_.begin());
      states_.erase(states_.begin());
    }
    loads_.push_back(load);
    states_.push_back(y);
  }
  const Vector& last() const { return states_.back(); }
  Vector at(double load) const {
    Vector out = last();
    for (std::size_t i = 0; i + 1 < loads_.size(); ++i) {
      double weight = 1;
      for (std::size_t j = 0; j < loads_.size(); ++j)
        if (j != i) weight *= (load - loads_[j]) / (loads_[i] - loads_[j]);
      out += weight * (states_[i] - last());
    }
    return out;
  }

 private:
  std::vector<double> loads_;
  std::vector<Vector> states_;
};

RestState prescribed_state(const System& system, double load, Vector y) {
  system.prescribe(load, y);
  return rest_state(system, load, std::move(y));
}

// The next load after one that was reached: all of the rest, or a share of it of about a step.
double next_load(double reached, double step) {
  const double rest = 1 - reached;
  const int steps_left = static_cast<int>(std::ceil(rest / step - kNearly));
  return steps_left <= 1 ? 1 : reached + std::max(rest / steps_left, kLeast * step);
}

// Newton from the path continued, or from its last equilibrium where that promises more or the other failed.
NewtonReport follow(Newton& newton, const System& system, const Path& path, bool may_continue, double load,
                    const NewtonOptions& options, Vector& y, LoadReport& report) {
  const auto attempt_from = [&](RestState start) {
    const NewtonReport out = newton.solve(load, std::move(start), y, options);
    report.iterations += out.iterations;
    report.tangents += out.tangents;
    return out;
  };
  RestState last = prescribed_state(system, load, path.last());
  if (may_continue) {
    RestState ahead = prescribed_state(system, load, path.at(load));
    if (ahead.residual.admissible() && last.relative >= kBetter * ahead.relative) {
      NewtonReport attempt = attempt_from(std::move(ahead));
      if (attempt.converged()) return attempt;
    }
  }
  return attempt_from(std::move(last));
}

}  // namespace

LoadReport load_stepping(const System& system, LinearSystem& linear, Vector& c, const LoadOptions& options,
                         double from) {
  const System mixed = mixed_form(system);
  Newton newton(mixed, linear);
  LoadReport report;
  report.reached = from;
  double step = options.first_step;
  NewtonOptions on_path = options.newton;
  on_path.tolerance *= options.path_slack;
  on_path.defect_tolerance *= options.path_slack;
  Path path;
  path.add(from, mixed_start(mixed, from, c));
  while (report.reached < 1) {
    if (options.interrupted && options.interrupted()) {
      report.reason = StopReason::interrupted;
      return report;
    }
    const double load = next_load(report.reached, step);
    Vector y;
    report.last =
        follow(newton, mixed, path, report.steps > 0, load, load < 1 ? on_path : options.newton, y, report);
    const double length = load - report.reached;
    if (!report.last.converged()) {
      ++report.cuts;
      step = length / 2;
      if (step < options.smallest_step) {
        report.reason = StopReason::step_too_small;
        return report;
      }
      continue;
    }
    ++report.steps;
    if (report.last.unstable && !report.unstable_from) report.unstable_from = load;
    path.add(load, y);
    c = mixed.layout.field().of(y);
    report.reached = load;
    if (options.on_step) options.on_step(load, c);
    step = std::min(options.largest_step,
                    length * std::clamp(kTarget / std::max(1, report.last.tangents), 0.5, 2.0));
  }
  return report;
}

}  // namespace polyaffine
