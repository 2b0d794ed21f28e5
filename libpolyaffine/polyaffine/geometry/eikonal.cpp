#include "polyaffine/geometry/eikonal.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <queue>
#include <stdexcept>
#include <string>

#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/straight_path.hpp>

namespace polyaffine {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Update {
  double time = kInfinity;
  int from = -1;  // the corner that contributes most

  void offer(double candidate, int corner) {
    if (candidate < time) *this = {candidate, corner};
  }
};

// Two known corners with times t and Gram matrix g of the edges towards the updated vertex.
void update_edge(const Mat3& g, const Vec3& t, int i, int j, Update& best) {
  const double det = g(i, i) * g(j, j) - g(i, j) * g(i, j);
  const double dt = t[j] - t[i];
  // With s·v_i = T − t_i, s·v_j = T − t_j, |s| = 1 in the plane of the edges: α τ² − 2 β τ + γ = 0, τ = T −
  // t_i.
  const double alpha = g(i, i) - 2 * g(i, j) + g(j, j);
  const double beta = (g(i, i) - g(i, j)) * dt;
  const double gamma = g(i, i) * dt * dt - det;
  const double root = beta * beta - alpha * gamma;
  if (root < 0) return;
  const double tau = (beta + std::sqrt(root)) / alpha;
  const double li = g(j, j) * tau - g(i, j) * (tau - dt);
  const double lj = g(i, i) * (tau - dt) - g(i, j) * tau;
  if (li > 0 && lj > 0) best.offer(t[i] + tau, li >= lj ? i : j);
}

// min over λ of Σ λ_i t_i + |Σ λ_i v_i| for the three edges v_i towards the vertex; t may hold infinities.
Update update_vertex(const Mat3& v, const Vec3& t) {
  const Mat3 g = v.transpose() * v;
  Update best;
  if (std::isfinite(t[0]) && std::isfinite(t[1]) && std::isfinite(t[2])) {
    Mat3 q;  // adjugate of g
    q(0, 0) = g(1, 1) * g(2, 2) - g(1, 2) * g(1, 2);
    q(0, 1) = q(1, 0) = g(0, 2) * g(1, 2) - g(0, 1) * g(2, 2);
    q(0, 2) = q(2, 0) = g(0, 1) * g(1, 2) - g(0, 2) * g(1, 1);
    q(1, 1) = g(0, 0) * g(2, 2) - g(0, 2) * g(0, 2);
    q(1, 2) = q(2, 1) = g(0, 1) * g(0, 2) - g(0, 0) * g(1, 2);
    q(2, 2) = g(0, 0) * g(1, 1) - g(0, 1) * g(0, 1);
    const double det = g.row(0).dot(q.col(0));
    const Vec3 dt = t.array() - t.minCoeff();
    const Vec3 q1 = q.rowwise().sum(), qt = q * dt;
    const double alpha = q1.sum(), beta = qt.sum(), gamma = dt.dot(qt) - det;
    const double root = beta * beta - alpha * gamma;
    if (root >= 0) {
      const double tau = (beta + std::sqrt(root)) / alpha;
      const Vec3 lambda = tau * q1 - qt;
      Eigen::Index corner = 0;
      if (lambda.minCoeff() >= 0) {
        lambda.maxCoeff(&corner);
        best.offer(t.minCoeff() + tau, static_cast<int>(corner));
        return best;  // the function is convex, so an interior critical point is its minimum
      }
    }
  }
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

Arrival EikonalSolver::march_from(Arrival arrival, const std::vector<char>& allowed) const {
  constexpr double kRounding = 1e-12;  // of the longest edge: a smaller gain is not passed on
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
    if (time > arrival.time[vertex]) continue;
    for (const int t : around_[vertex]) {
      if (!allowed.empty() && !allowed[t]) continue;
      const Eigen::Matrix<double, 3, 4> corners = metric_corners(t);
      for (int k = 0; k < 4; ++k) {
        const int target = mesh_.tets()(k, t);
        if (target == vertex) continue;
        Mat3 edges;
        Vec3 times;
        for (int i = 0, j = 0; j < 4; ++j)
          if (j != k) {
            edges.col(i) = corners.col(k) - corners.col(j);
            times[i++] = arrival.time[mesh_.tets()(j, t)];
          }
        const Update update = update_vertex(edges, times);
        const double gain = kRounding * std::sqrt(edges.colwise().squaredNorm().maxCoeff());
        if (!(update.time < arrival.time[target] - gain)) continue;
        arrival.time[target] = update.time;
        arrival.label[target] =
            arrival.label[mesh_.tets()(update.from < k ? update.from : update.from + 1, t)];
        queue.emplace(update.time, target);
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
