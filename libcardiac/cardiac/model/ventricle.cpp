#include "cardiac/model/ventricle.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include <cardiac/activation/activation.hpp>
#include <cardiac/anatomy/right_ventricle.hpp>
#include <cardiac/model/vertex_displacement.hpp>
#include <cardiac/protocol/contraction_time.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/material/signed_volume.hpp>
#include <polyaffine/material/springs.hpp>

namespace cardiac {

using polyaffine::FieldEnergy;
using polyaffine::Vec3;
using polyaffine::Vector;

namespace {

std::vector<ActivationSite> sites(const Anatomy& anatomy, const protocol::Activation& activation) {
  std::vector<ActivationSite> out;
  for (const auto& X : activation.sites_mm) out.push_back({Vec3(X.data()), activation.onset_ms});
  for (const int segment : activation.site_segments) {
    // The endocardial vertex nearest to the middle of the segment's own endocardial vertices.
    std::vector<int> own;
    Vec3 middle = Vec3::Zero();
    for (const int p : anatomy.mesh.surface_points({anatomy.labels.endo})) {
      const Vec3 X = anatomy.mesh.points().col(p);
      if (aha_segment(anatomy.coordinates->long_axis_height(X), anatomy.coordinates->sector_angle(X)) !=
          segment)
        continue;
      own.push_back(p);
      middle += X;
    }
    if (own.empty())
      throw polyaffine::InputError(
          "activation.site_segments: segment " + std::to_string(segment) +
          " has no point on the endocardium, expected one that the cavity touches (1 to 16)");
    middle /= static_cast<double>(own.size());
    const int nearest = *std::min_element(own.begin(), own.end(), [&](int a, int b) {
      return (anatomy.mesh.points().col(a) - middle).norm() < (anatomy.mesh.points().col(b) - middle).norm();
    });
    out.push_back({anatomy.mesh.points().col(nearest), activation.onset_ms});
  }
  return out;
}

// Activation time of each vertex, ms, without the delays of regions.
Vector vertex_activation(const Anatomy& anatomy, const Protocol& protocol) {
  const auto& a = *protocol.activation;
  if (a.mode == protocol::ActivationMode::uniform)
    return Vector::Constant(anatomy.mesh.num_points(), a.onset_ms);
  return activation_times(anatomy.mesh, tet_fibres(anatomy, *protocol.fibres),
                          {a.conduction_along_fibre_mm_per_ms, a.conduction_across_fibre_mm_per_ms},
                          sites(anatomy, a));
}

// Of each integration point.
Vector at_points(const Anatomy& anatomy, const Vector& at_vertices, const polyaffine::WallPoints& points) {
  const auto n = static_cast<Eigen::Index>(points.tet.size());
  Vector out(n);
  for (Eigen::Index q = 0; q < n; ++q)
    out[q] = points.barycentric.col(q).dot(at_vertices(anatomy.mesh.tets().col(points.tet[q])));
  return out;
}

// The delays of regions at the vertices, ms.
Vector vertex_region_delay(const Anatomy& anatomy, const Protocol& protocol) {
  const polyaffine::WallPoints vertices = vertex_points(anatomy.mesh);
  const RegionFactors factors = region_factors(anatomy, protocol, vertices);
  return Eigen::Map<const Vector>(factors.delay_ms.data(), anatomy.mesh.num_points());
}

std::shared_ptr<const ContractionField> build_contraction(const Anatomy& anatomy, const Protocol& protocol,
                                                          const polyaffine::WallPoints& points,
                                                          const RegionFactors& factors, BuildCount& built) {
  ++built["contraction"];
  ++built["activation"];
  const Vector at_vertices = vertex_activation(anatomy, protocol);
  ContractionField out{
      TensionCurve(bestel_parameters(*protocol.contraction, protocol.time), beat_ms(protocol.time)),
      at_points(anatomy, at_vertices, points), Vector::Ones(static_cast<Eigen::Index>(points.tet.size())),
      at_vertices};
  if (!factors.tension.empty()) {
    out.scale = Eigen::Map<const Vector>(factors.tension.data(), out.scale.size());
    out.delay_ms += Eigen::Map<const Vector>(factors.delay_ms.data(), out.scale.size());
    out.vertex_delay_ms += vertex_region_delay(anatomy, protocol);
  }
  return std::make_shared<ContractionField>(std::move(out));
}

std::shared_ptr<const FieldEnergy> normal_spring(const polyaffine::Basis& basis,
                                                 const polyaffine::SurfacePoints& points, double stiffness) {
  polyaffine::Points normals(3, points.X.cols());
  for (Eigen::Index q = 0; q < points.X.cols(); ++q)
    normals.col(q) = Vec3(points.X_xi.col(q)).cross(Vec3(points.X_eta.col(q))).normalized();
  return std::make_shared<FieldEnergy>(
      polyaffine::displacement_table(basis, points),
      std::vector<std::shared_ptr<const polyaffine::Law>>{
          std::make_shared<polyaffine::SurfaceSpring>(stiffness, std::move(normals))});
}

std::shared_ptr<const FieldEnergy> cavity_volume(const polyaffine::Basis& basis,
                                                 const polyaffine::SurfacePoints& points,
                                                 const Vec3& base_centre) {
  return std::make_shared<FieldEnergy>(polyaffine::surface_table(basis, points, base_centre),
                                       std::vector<std::shared_ptr<const polyaffine::Law>>{
                                           std::make_shared<polyaffine::SignedVolume>(1.0 / 3)});
}

}  // namespace

Vector ContractionField::tension(double time_ms) const {
  Vector tension(delay_ms.size()), rate(delay_ms.size());
  curve.evaluate(time_ms, delay_ms, scale, tension, rate);
  return tension;
}

std::unique_ptr<polyaffine::LinearSystem> Ventricle::make_system() const {
  if (!discretisation.sparse) return polyaffine::dense_system(num_coefficients(), discretisation.fixed);
  std::vector<const polyaffine::FieldTable*> tables{&wall->table()};
  for (const FieldEnergy* one : cavities()) tables.push_back(&one->table());
  for (const auto& spring : springs) tables.push_back(&spring->table());
  return polyaffine::sparse_system(tables, discretisation.fixed);
}

std::vector<const FieldEnergy*> Ventricle::cavities() const {
  std::vector<const FieldEnergy*> out;
  for (const auto* one : {&cavity, &right_cavity})
    if (*one) out.push_back(one->get());
  return out;
}

Discretisation discretise(const std::shared_ptr<const Anatomy>& anatomy, const Protocol& protocol,
                          protocol::Method method) {
  return method == protocol::Method::fem ? full_discretisation(*anatomy, protocol)
                                         : reduced_discretisation(*anatomy, protocol);
}

Ventricle assemble_ventricle(std::shared_ptr<const Anatomy> anatomy, const Protocol& protocol,
                             Discretisation discretisation) {
  Ventricle out;
  out.discretisation = std::move(discretisation);
  const auto& d = out.discretisation;
  check_size(d);
  const RegionFactors factors = region_factors(*anatomy, protocol, d.points);
  if (!factors.stiffness.empty()) ++out.built["regions"];
  out.wall = build_wall(*anatomy, protocol, d, factors, out.built);
  ++out.built[d.sparse ? "full order" : "reduction"];
  if (!d.cavity_points.tet.empty()) {
    ++out.built["cavity"];
    out.cavity = cavity_volume(*d.basis, d.cavity_points, anatomy->coordinates->base_centre());
  }
  if (!d.right_cavity_points.tet.empty())
    out.right_cavity =
        cavity_volume(*d.basis, d.right_cavity_points, anatomy->coordinates->right()->base_centre());
  if (!d.epicardium_points.tet.empty())
    out.springs.push_back(
        normal_spring(*d.basis, d.epicardium_points, protocol.boundary.epicardial_stiffness_kPa_per_mm));
  if (protocol.contraction)
    out.contraction = build_contraction(*anatomy, protocol, d.points, factors, out.built);
  out.anatomy = std::move(anatomy);
  return out;
}

polyaffine::EquilibriumProblem loaded_ventricle(const Ventricle& ventricle, const WallLoad& load) {
  return loaded_ventricle(ventricle, {0, Vector::Zero(load.tension.size())}, load);
}

polyaffine::EquilibriumProblem loaded_ventricle(const Ventricle& ventricle, const WallLoad& from,
                                                const WallLoad& to) {
  polyaffine::EquilibriumProblem problem;
  polyaffine::PotentialTerm wall{ventricle.wall};
  if (to.tension.size() > 0) {
    const auto now = std::make_shared<Vector>(to.tension.size());
    wall.state = [begin = from.tension, end = to.tension, now](double load) {
      *now = (1 - load) * begin + load * end;
      return polyaffine::PointState(now->data(), now->size());
    };
  }
  problem.terms.push_back(std::move(wall));
  const auto press = [&](const std::shared_ptr<const FieldEnergy>& cavity, double p0, double p1) {
    if (!cavity || (p0 == 0 && p1 == 0)) return;
    polyaffine::PotentialTerm term{cavity};
    term.scale = [p0, p1](double load) { return -(1 - load) * p0 - load * p1; };
    term.wall = false;
    problem.terms.push_back(std::move(term));
  };
  press(ventricle.cavity, from.pressure_kPa, to.pressure_kPa);
  press(ventricle.right_cavity, from.right_pressure_kPa, to.right_pressure_kPa);
  for (const auto& spring : ventricle.springs) {
    polyaffine::PotentialTerm term{spring};
    term.wall = false;
    problem.terms.push_back(std::move(term));
  }
  problem.fixed = ventricle.discretisation.fixed;
  return problem;
}

}  // namespace cardiac
