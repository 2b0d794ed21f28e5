#include "cardiac/reduction/discretisation.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/anatomy/right_ventricle.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/lagrange.hpp>

namespace cardiac {

using polyaffine::LagrangeBasis;
using polyaffine::Vec3;

namespace {

// The same surface seen from the other side.
polyaffine::SurfacePoints turned(polyaffine::SurfacePoints points) {
  points.X_xi.swap(points.X_eta);
  return points;
}

// The nodes of the base, as the protocol holds them.
void hold_base(const Anatomy& anatomy, const scene::Boundary& boundary, const LagrangeBasis& basis,
               Discretisation& out) {
  if (boundary.base == scene::Base::elastic) return;
  const Vec3 normal = base_normal(anatomy);
  for (const int node : basis.surface_nodes(anatomy.mesh, {anatomy.labels.base})) {
    if (boundary.base == scene::Base::sliding) {
      out.held.push_back({node, normal});
      --out.num_unknowns;
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      out.fixed[3 * node + k] = 1;
      --out.num_unknowns;
    }
  }
}

// Of a reduced model: its tangent is dense, 1 GB.
constexpr int kMostUnknowns = 12000;

}  // namespace

Vec3 base_normal(const Anatomy& anatomy) {
  const auto& X = anatomy.mesh.points();
  Vec3 area = Vec3::Zero();
  const polyaffine::Triangles faces = anatomy.mesh.surface({anatomy.labels.base});
  for (const auto& f : faces.colwise())
    area += Vec3(X.col(f[1]) - X.col(f[0])).cross(Vec3(X.col(f[2]) - X.col(f[0])));
  return area.normalized();
}

void add_surface_points(const Anatomy& anatomy, const Scene& scene, const LagrangeBasis& geometry,
                        const FaceRule& rule, Discretisation& discretisation) {
  const auto points = [&](int label) { return geometry.surface_points(anatomy.mesh, {label}, rule); };
  const scene::Boundary& boundary = scene.boundary;
  const auto rim = [&](int label, const Vec3& centre) {
    return polyaffine::moving_rim(geometry, anatomy.mesh, {label}, centre);
  };
  if (scene.circulation || scene.cavities) {
    const VentricularCoordinates& heart = *anatomy.coordinates;
    const auto add = [&](const char* name, int label, const Vec3& centre) {
      discretisation.cavities.push_back({name, turned(points(label)), centre});
      if (boundary.base_moves()) discretisation.cavities.back().rim = rim(label, centre);
    };
    add("lv", anatomy.labels.endo, heart.base_centre());
    if (anatomy.labels.rv_endo) add("rv", *anatomy.labels.rv_endo, heart.right()->base_centre());
  }
  if (boundary.holds_epicardium()) discretisation.epicardium_points = points(anatomy.labels.epi);
  if (boundary.holds_base()) discretisation.base_points = points(anatomy.labels.base);
  if (boundary.base == scene::Base::sliding)
    discretisation.ring = {rim(anatomy.labels.endo, anatomy.coordinates->base_centre()),
                           base_normal(anatomy)};
}

Discretisation full_discretisation(const Anatomy& anatomy, const Scene& scene) {
  Discretisation out;
  const int order = scene.reduction.element_order;
  const std::shared_ptr<const LagrangeBasis> basis =
      order == 2 ? std::shared_ptr<const LagrangeBasis>(anatomy.coordinates, &anatomy.coordinates->space())
                 : std::make_shared<LagrangeBasis>(anatomy.mesh, order);
  out.basis = basis;
  out.points = basis->wall_points(order == 1 ? 1 : 3);
  out.sparse = true;
  out.num_unknowns = 3 * basis->num_functions();
  out.fixed.assign(out.num_unknowns, 0);
  hold_base(anatomy, scene.boundary, *basis, out);
  const polyaffine::TriangleRule rule = polyaffine::triangle_rule(order == 1 ? 1 : 4);
  add_surface_points(
      anatomy, scene, *basis, [&](int, const LagrangeBasis::FaceCorners&) { return rule; }, out);
  return out;
}

void check_size(const Discretisation& d) {
  const std::string found = std::to_string(d.num_unknowns) + " unknowns";
  const std::string remedy = "fewer control nodes (reduction.ring_nodes)";
  if (!d.sparse && d.num_unknowns > kMostUnknowns)
    throw polyaffine::InputError("found " + found + ", expected at most " + std::to_string(kMostUnknowns) +
                                 " of a reduced model: " + remedy + " or reduction.method = \"fem\"");
  const std::size_t points = d.points.tet.size();
  if (6 * points < static_cast<std::size_t>(d.num_unknowns))
    throw polyaffine::InputError("found " + std::to_string(points) + " integration points for " + found +
                                 ", expected at least a sixth of them (" +
                                 std::to_string((d.num_unknowns + 5) / 6) + "): " + remedy +
                                 " or a finer mesh");
}

}  // namespace cardiac
