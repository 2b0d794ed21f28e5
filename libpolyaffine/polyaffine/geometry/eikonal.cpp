#include "polyaffine/geometry/eikonal.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <stdexcept>
#include <string>

#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/straight_path.hpp>

namespace polyaffine {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The earliest arrival at a vertex found so far.
struct Update {
  double time = kInfinity;
  int from = -1;  // the corner that contributes most

  void offer(double candidate, int corner) {
    if (candidate < time) *this = {candidate, corner};
  }
};

// A front that passes corners with known times t_i arrives at a vertex, to which the edges v_i lead from
// them, at T. It is plane with the unit slowness s, s · v_i = T − t_i = τ − dt_i, where dt_i counts from the
// earliest corner. With s = Σ λ_i v_i and the Gram matrix G_ij = v_i · v_j of the edges this is G λ = τ 1 −
// dt, and |s| = 1 gives
//
//     α τ² − 2 β τ + γ = 0,   α = 1ᵀQ1,  β = 1ᵀQ dt,  γ = dtᵀQ dt − det G,   Q = adj G.
//
// It comes from between the corners where λ ∝ τ Q1 − Q dt is not negative. The later root is the one whose
// front has passed the corners.

// The larger root τ; nothing where the front is faster than the corners allow.
std::optional<double> later_root(double alpha, double beta, double gamma) {
  const double root = beta * beta - alpha * gamma;
  if (root < 0) return {};
  return (beta + std::sqrt(root)) / alpha;
}

// From between two corners i and j.
void update_edge(const Mat3& g, const Vec3& t, int i, int j, Update& best) {
  const double det = g(i, i) * g(j, j) - g(i, j) * g(i, j);
  const double dt = t[j] - t[i];
  const auto tau =
      later_root(g(i, i) - 2 * g(i, j) + g(j, j), (g(i, i) - g(i, j)) * dt, g(i, i) * dt * dt - det);
  if (!tau) return;
  const double li = g(j, j) * *tau - g(i, j) * (*tau - dt);
  const double lj = g(i, i) * (*tau - dt) - g(i, j) * *tau;
  if (li > 0 && lj > 0) best.offer(t[i] + *tau, li >= lj ? i : j);
}

Mat3 adjugate(const Mat3& g) {
  Mat3 q;
  q(0, 0) = g(1, 1) * g(2, 2) - g(1, 2) * g(1, 2);
  q(0, 1) = q(1, 0) = g(0, 2) * g(1, 2) - g(0, 1) * g(2, 2);
  q(0, 2) = q(2, 0) = g(0, 1) * g(1, 2) - g(0, 2) * g(1, 1);
  q(1, 1) = g(0, 0) * g(2, 2) - g(0, 2) * g(0, 2);
  q(1, 2) = q(2, 1) = g(0, 1) * g(0, 2) - g(0, 0) * g(1, 2);
  q(2, 2) = g(0, 0) * g(1, 1) - g(0, 1) * g(0, 1);
  return q;
}

// From inside the triangle of all three corners; false where the front does not come from there.
bool update_face(const Mat3& g, const Vec3& t, Update& best) {
  const Mat3 q = adjugate(g);
  const double det = g.row(0).dot(q.col(0));
  const Vec3 dt = t.array() - t.minCoeff();
  const Vec3 q1 = q.rowwise().sum(), qt = q * dt;
  const auto tau = later_root(q1.sum(), qt.sum(), dt.dot(qt) - det);
  if (!tau) return false;
  const Vec3 lambda = *tau * q1 - qt;
  if (!(lambda.minCoeff() >= 0)) return false;
  Eigen::Index corner = 0;
  lambda.maxCoeff(&corner);
  best.offer(t.minCoeff() + *tau, static_cast<int>(corner));
  return true;
}

// The least over λ ≥ 0, Σ λ = 1, of Σ λ_i t_i + |Σ λ_i v_i| for the three edges v_i towards the vertex; t may
// hold infinities. The function is convex, so a minimum inside the face needs no look at its edges and
// corners.
Update update_vertex(const Mat3& v, const Vec3& t) {
  const Mat3 g = v.transpose() * v;
  Update best;
  const bool all_known = std::isfinite(t[0]) && std::isfinite(t[1]) && std::isfinite(t[2]);
  if (all_known && update_face(g, t, best)) return best;
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(t[i])) continue;
    best.offer(t[i] + std::sqrt(g(i, i)), i);
    const int j = (i + 1) % 3;
    if (std::isfinite(t[j])) update_edge(g, t, i, j, best);
  }
  return best;
}

Mat3 metric_root(const Mat3& speed, size_t t) {
  const Eigen::LLT<Mat3> factor(speed);
  if (!speed.allFinite() || factor.info() != Eigen::Success ||
      (speed - speed.transpose()).norm() > 1e-10 * speed.norm())
    throw InputError("speed tensor of tet " + std::to_string(t) +
                     ": found one that is not symmetric positive definite, expected D in (mm/ms)^2");
  return factor.matrixL().solve(Mat3::Identity());  // D = LLᵀ, so D⁻¹ = L⁻ᵀL⁻¹
}

}  // namespace

EikonalSolver::EikonalSolver(const TetMesh& mesh, const std::vector<Mat3>& speed)
    : mesh_(mesh), around_(mesh.num_points()) {
  if (!speed.empty() && static_cast<int>(speed.size()) != mesh.num_tets())
    throw InputError("eikonal: found " + std::to_string(speed.size()) +
                     " speed tensors, expected one a tet, " + std::to_string(mesh.num_tets()));
  metric_root_.reserve(speed.size());
  for (size_t t = 0; t < speed.size(); ++t) metric_root_.push_back(metric_root(speed[t], t));
  for (int t = 0; t < mesh.num_tets(); ++t)
    for (int k = 0; k < 4; ++k) around_[mesh.tets()(k, t)].push_back(t);
}

double EikonalSolver::travel_time(int t, const Vec3& v) const {
  return metric_root_.empty() ? v.norm() : (metric_root_[t] * v).norm();
}

Eigen::Matrix<double, 3, 4> EikonalSolver::metric_corners(int t) const {
  Eigen::Matrix<double, 3, 4> corners;
  for (int k = 0; k < 4; ++k) corners.col(k) = mesh_.points().col(mesh_.tets()(k, t));
  if (!metric_root_.empty()) corners = metric_root_[t] * corners;
  return corners;
}

// Spreads from the source's tet over the vertices that it sees and reaches before the sources so far.
void EikonalSolver::start_straight(const MeshPoint& from, double time, int label,
                                   const std::vector<char>& allowed, Arrival& initial) const {
  const Vec3 x = position(mesh_, from.tet, from.barycentric);
  std::vector<char> seen(mesh_.num_points(), 0);
  std::vector<int> spreading;
  const auto offer = [&](int v, double arrival) {
    seen[v] = 1;
    if (!(arrival < initial.time[v])) return;
    initial.time[v] = arrival;
    initial.label[v] = label;
    spreading.push_back(v);
  };
  for (const int v : mesh_.tets().col(from.tet))
    offer(v, time + travel_time(from.tet, mesh_.points().col(v) - x));
  for (size_t next = 0; next < spreading.size(); ++next)
    for (const int t : around_[spreading[next]])
      for (const int v : mesh_.tets().col(t))
        if (!seen[v]) offer(v, time + straight_time(*this, from, v, allowed));
}

Arrival EikonalSolver::march(const std::vector<EikonalSource>& sources,
                             const std::vector<char>& allowed) const {
  Arrival initial{Vector::Constant(mesh_.num_points(), kInfinity), std::vector<int>(mesh_.num_points(), -1)};
  for (size_t s = 0; s < sources.size(); ++s) {
    const MeshPoint& at = sources[s].at;
    if (at.tet < 0 || at.tet >= mesh_.num_tets())
      throw InputError("eikonal source " + std::to_string(s) + ": found tet " + std::to_string(at.tet) +
                       ", expected 0 to " + std::to_string(mesh_.num_tets() - 1));
    start_straight(at, sources[s].time, static_cast<int>(s), allowed, initial);
  }
  return march_from(std::move(initial), allowed);
}

// The arrival at corner k of a tet from its three other corners, if it is earlier than what is known; whether
// it was.
bool EikonalSolver::improve(int t, int k, const Eigen::Matrix<double, 3, 4>& corners,
                            Arrival& arrival) const {
  constexpr double kRounding = 1e-12;  // of the longest edge: a smaller gain is not passed on
  const auto others = [k](int i) { return i < k ? i : i + 1; };
  Mat3 edges;
  Vec3 times;
  for (int i = 0; i < 3; ++i) {
    edges.col(i) = corners.col(k) - corners.col(others(i));
    times[i] = arrival.time[mesh_.tets()(others(i), t)];
  }
  const Update update = update_vertex(edges, times);
  const double gain = kRounding * std::sqrt(edges.colwise().squaredNorm().maxCoeff());
  const int target = mesh_.tets()(k, t);
  if (!(update.time < arrival.time[target] - gain)) return false;
  arrival.time[target] = update.time;
  arrival.label[target] = arrival.label[mesh_.tets()(others(update.from), t)];
  return true;
}

// Vertices leave the queue in the order of their times, as in Dijkstra's algorithm, and each one tries to
// improve those it shares a tet with. One that is improved again later is queued again: in obtuse tets and
// with speeds that differ by direction an early time need not be final.
Arrival EikonalSolver::march_from(Arrival arrival, const std::vector<char>& allowed) const {
  if (arrival.time.size() != mesh_.num_points() ||
      arrival.label.size() != static_cast<size_t>(mesh_.num_points()) ||
      (!allowed.empty() && static_cast<int>(allowed.size()) != mesh_.num_tets()))
    throw std::invalid_argument("EikonalSolver::march_from: sizes do not match the mesh");
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (int v = 0; v < mesh_.num_points(); ++v) {
    if (std::isnan(arrival.time[v])) throw InputError("eikonal: found an initial time that is not a number");
    if (std::isfinite(arrival.time[v])) queue.emplace(arrival.time[v], v);
  }
  while (!queue.empty()) {
    const auto [time, vertex] = queue.top();
    queue.pop();
    if (time > arrival.time[vertex]) continue;  // improved since it was queued
    for (const int t : around_[vertex]) {
      if (!allowed.empty() && !allowed[t]) continue;
      const Eigen::Matrix<double, 3, 4> corners = metric_corners(t);
      for (int k = 0; k < 4; ++k) {
        const int target = mesh_.tets()(k, t);
        if (target != vertex && improve(t, k, corners, arrival)) queue.emplace(arrival.time[target], target);
      }
    }
  }
  return arrival;
}

Vector arrival_times(const TetMesh& mesh, const std::vector<EikonalSource>& sources,
                     const std::vector<Mat3>& speed) {
  return EikonalSolver(mesh, speed).march(sources).time;
}

}  // namespace polyaffine
