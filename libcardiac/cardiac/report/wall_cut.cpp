#include <cardiac/report/wall_cut.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace cardiac {

using polyaffine::Points;
using polyaffine::TetMesh;
using polyaffine::Vec3;

namespace {

class Cutter {
 public:
  Cutter(const TetMesh& mesh, const Vec3& origin, const Vec3& normal)
      : mesh_(mesh),
        normal_(normal),
        height_((mesh.points().colwise() - origin).transpose() * normal.normalized()) {}

  WallCut cut() && {
    for (int i = 0; i < mesh_.boundary().cols(); ++i) add_surface(i);
    for (int t = 0; t < mesh_.num_tets(); ++t) add_section(t);
    return std::move(cut_);
  }

 private:
  bool stays(int vertex) const { return height_[vertex] <= 0; }

  int corner(int a, int b) {
    if (a > b) std::swap(a, b);
    const auto [entry, added] = known_.try_emplace({a, b}, static_cast<int>(cut_.corners.size()));
    if (added) cut_.corners.push_back({a, b, a == b ? 0 : height_[a] / (height_[a] - height_[b])});
    return entry->second;
  }

  Vec3 position(int corner) const {
    const WallCut::Corner& c = cut_.corners[static_cast<std::size_t>(corner)];
    return (1 - c.share) * mesh_.points().col(c.from) + c.share * mesh_.points().col(c.to);
  }

  void add_surface(int triangle) {
    WallCut::Face face{{}, mesh_.boundary_tets()[static_cast<std::size_t>(triangle)], false};
    for (int k = 0; k < 3; ++k) {
      const int a = mesh_.boundary()(k, triangle), b = mesh_.boundary()((k + 1) % 3, triangle);
      if (stays(a)) face.corners.push_back(corner(a, a));
      if (stays(a) != stays(b)) face.corners.push_back(corner(a, b));
    }
    if (face.corners.size() > 2) cut_.faces.push_back(std::move(face));
  }

  void add_section(int t) {
    std::vector<int> kept, gone;
    for (const int v : mesh_.tets().col(t)) (stays(v) ? kept : gone).push_back(v);
    if (kept.empty() || gone.empty()) return;
    WallCut::Face face{{}, t, true};
    // Round the section every corner shares a vertex with the next.
    for (std::size_t i = 0; i < kept.size(); ++i)
      for (std::size_t j = 0; j < gone.size(); ++j)
        face.corners.push_back(corner(kept[i], gone[i % 2 == 0 ? j : gone.size() - 1 - j]));
    const Vec3 first = position(face.corners[0]);
    const Vec3 turn = (position(face.corners[1]) - first).cross(position(face.corners[2]) - first);
    if (turn.dot(normal_) < 0) std::ranges::reverse(face.corners);
    cut_.faces.push_back(std::move(face));
  }

  const TetMesh& mesh_;
  Vec3 normal_;
  polyaffine::Vector height_;
  std::map<std::pair<int, int>, int> known_;
  WallCut cut_;
};

}  // namespace

Points WallCut::positions(const Points& points) const {
  Points x(3, static_cast<Eigen::Index>(corners.size()));
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Corner& c = corners[static_cast<std::size_t>(i)];
    x.col(i) = (1 - c.share) * points.col(c.from) + c.share * points.col(c.to);
  }
  return x;
}

WallCut cut_wall(const TetMesh& mesh, const Vec3& origin, const Vec3& normal) {
  return Cutter(mesh, origin, normal).cut();
}

}  // namespace cardiac
