#include "cardiac/reduction/discretisation.hpp"

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

// Of a reduced model: its tangent is dense, 1 GB.
constexpr int kMostUnknowns = 12000;

}  // namespace

void add_surface_points(const Anatomy& anatomy, const Scene& scene, const LagrangeBasis& geometry,
                        const FaceRule& rule, Discretisation& discretisation) {
  const auto points = [&](int label) { return geometry.surface_points(anatomy.mesh, {label}, rule); };
  if (scene.circulation || scene.cavities) {
    const VentricularCoordinates& heart = *anatomy.coordinates;
    discretisation.cavities.push_back({"lv", turned(points(anatomy.labels.endo)), heart.base_centre()});
    if (anatomy.labels.rv_endo)
      discretisation.cavities.push_back(
          {"rv", turned(points(*anatomy.labels.rv_endo)), heart.right()->base_centre()});
  }
  if (scene.boundary.epicardial_stiffness_kPa_per_mm > 0 ||
      scene.boundary.epicardial_damping_kPa_ms_per_mm > 0)
    discretisation.epicardium_points = points(anatomy.labels.epi);
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
  for (const int node : basis->surface_nodes(anatomy.mesh, {anatomy.labels.base}))
    for (int k = 0; k < 3; ++k) {
      out.fixed[3 * node + k] = 1;
      --out.num_unknowns;
    }
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
