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

std::optional<int> right_label(const polyaffine::TetMesh& mesh) {
  const auto& found = mesh.boundary_labels();
  if (std::find(found.begin(), found.end(), kRvEndocardium) == found.end()) return {};
  return kRvEndocardium;
}

void check_scheme(bool two_ventricles, const std::optional<protocol::Scheme>& scheme) {
  if (!scheme || two_ventricles == (*scheme == protocol::Scheme::aha29)) return;
  throw polyaffine::InputError(
      two_ventricles ? "anatomy.scheme: found aha17, but the mesh has two ventricles (a right endocardium); "
                       "expected aha29"
                     : "anatomy.scheme: found aha29, but the mesh has no right endocardium (boundary label " +
                           std::to_string(kRvEndocardium) + "); expected aha17");
}

}  // namespace

Anatomy build_anatomy(polyaffine::TetMesh mesh, const Protocol& protocol, const ExactGeometry& exact) {
  Anatomy out;
  out.mesh = std::move(mesh);
  out.labels.rv_endo = right_label(out.mesh);
  check_scheme(out.labels.rv_endo.has_value(), protocol.anatomy.scheme);
  AnatomyOptions options;
  const double mm = protocol.mesh.length_unit ? mm_per_unit(*protocol.mesh.length_unit) : 1;
  const auto vector = [](const std::optional<protocol::Vector3>& v, double factor) {
    return v ? std::optional(Vec3(factor * Vec3(v->data()))) : std::nullopt;
  };
  options.long_axis = vector(protocol.anatomy.long_axis, 1);
  options.anterior = vector(protocol.anatomy.anterior_direction, 1);
  options.septum_point = vector(protocol.anatomy.septum_point, mm);
  options.rv_insertion_point = vector(protocol.anatomy.rv_insertion_point, mm);
  options.mitral_point = vector(protocol.anatomy.mitral_point, mm);
  options.midpoints = exact.midpoints;
  out.fibres = exact.fibres;
  out.coordinates = std::make_shared<VentricularCoordinates>(out.mesh, out.labels, options);
  out.segment = segment_tets(out.mesh, *out.coordinates);
  return out;
}

void add_surface_points(const Anatomy& anatomy, const Protocol& protocol, const LagrangeBasis& geometry,
                        const FaceRule& rule, Discretisation& discretisation) {
  const auto points = [&](int label) { return geometry.surface_points(anatomy.mesh, {label}, rule); };
  if (protocol.circulation || protocol.cavities) {
    const VentricularCoordinates& heart = *anatomy.coordinates;
    discretisation.cavities.push_back({"lv", turned(points(anatomy.labels.endo)), heart.base_centre()});
    if (anatomy.labels.rv_endo)
      discretisation.cavities.push_back(
          {"rv", turned(points(*anatomy.labels.rv_endo)), heart.right()->base_centre()});
  }
  if (protocol.boundary.epicardial_stiffness_kPa_per_mm > 0)
    discretisation.epicardium_points = points(anatomy.labels.epi);
}

Discretisation full_discretisation(const Anatomy& anatomy, const Protocol& protocol) {
  Discretisation out;
  const int order = protocol.reduction.element_order;
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
      anatomy, protocol, *basis, [&](int, const LagrangeBasis::FaceCorners&) { return rule; }, out);
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
