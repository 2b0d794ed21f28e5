#include "polyaffine/geometry/straight_path.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace polyaffine {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// What rounding leaves of a barycentric coordinate that is zero.
constexpr double kRounding = 1e-9;

// Barycentric coordinates in a tet along the line from s = 0 to s = 1: at + s · slope.
struct Line {
  Vec4 at, slope;

  Vec4 operator()(double s) const { return at + s * slope; }
};

Line line_in(const TetMesh& mesh, int t, const Vec3& from, const Vec3& direction) {
  const Eigen::Vector4i v = mesh.tets().col(t);
  const Vec3 origin = mesh.points().col(v[0]);
  Mat3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = mesh.points().col(v[k + 1]) - origin;
  const Mat3 inverse = edges.inverse();
  Line line;
  line.at.tail<3>() = inverse * (from - origin);
  line.at[0] = 1 - line.at.tail<3>().sum();
  line.slope.tail<3>() = inverse * direction;
  line.slope[0] = -line.slope.tail<3>().sum();
  return line;
}

bool has_vertex(const TetMesh& mesh, int t, int vertex) {
  return (mesh.tets().col(t).array() == vertex).any();
}

// A tet that holds the start and into which the line leads; −1 when there is none.
int first_tet(const EikonalSolver& solver, const MeshPoint& from, const Vec3& start, const Vec3& direction,
              const std::vector<char>& allowed) {
  const TetMesh& mesh = solver.mesh();
  int corner = 0;
  from.barycentric.maxCoeff(&corner);
  for (const int t : solver.tets_around(mesh.tets()(corner, from.tet))) {
    if (!allowed.empty() && !allowed[t]) continue;
    bool holds = true;
    for (int k = 0; k < 4; ++k)
      holds = holds && (from.barycentric[k] <= kRounding || has_vertex(mesh, t, mesh.tets()(k, from.tet)));
    if (!holds) continue;
    const Line line = line_in(mesh, t, start, direction);
    if (((line.at.array() > kRounding) || (line.slope.array() >= -kRounding)).all()) return t;
  }
  return -1;
}

// Where the line leaves a tet.
struct Exit {
  double s = kInfinity;
  int face = -1;  // opposite to this corner; −1: nowhere
};

// The line leaves through the face whose coordinate falls to zero first; not through the one it came in by,
// on which that coordinate is zero already.
Exit leave(const TetMesh& mesh, int t, int entered_from, const Line& line) {
  Exit out;
  for (int k = 0; k < 4; ++k) {
    const int next = mesh.neighbours()(k, t);
    if (line.slope[k] >= 0 || (next >= 0 && next == entered_from)) continue;
    const double s = -line.at[k] / line.slope[k];
    if (s < out.s) out = {s, k};
  }
  return out;
}

}  // namespace

double straight_time(const EikonalSolver& solver, const MeshPoint& from, int vertex,
                     const std::vector<char>& allowed) {
  const TetMesh& mesh = solver.mesh();
  const Vec3 start = position(mesh, from.tet, from.barycentric);
  const Vec3 direction = mesh.points().col(vertex) - start;
  int t = first_tet(solver, from, start, direction, allowed), entered_from = -1;
  double s = 0, time = 0;
  // From tet to tet along the line; a straight line crosses none of them twice.
  for (int crossed = 0; t >= 0 && crossed < mesh.num_tets(); ++crossed) {
    if (!allowed.empty() && !allowed[t]) return kInfinity;
    const Line line = line_in(mesh, t, start, direction);
    if (line(s).minCoeff() < -kRounding) return kInfinity;
    const double slowness = solver.travel_time(t, direction);
    if (has_vertex(mesh, t, vertex)) return time + (1 - s) * slowness;
    const Exit exit = leave(mesh, t, entered_from, line);
    if (exit.face < 0) return kInfinity;
    const double s_exit = std::max(exit.s, s);
    time += (s_exit - s) * slowness;
    s = s_exit;
    entered_from = t;
    t = mesh.neighbours()(exit.face, t);
  }
  return kInfinity;
}

}  // namespace polyaffine
