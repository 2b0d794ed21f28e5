#include "cardiac/model/ventricle.hpp"

#include <algorithm>

#include <cardiac/activation/activation.hpp>
#include <cardiac/model/supports.hpp>
#include <cardiac/model/vertex_displacement.hpp>
#include <cardiac/scene/contraction_time.hpp>
#include <cardiac/tissue/active_stress.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/material/signed_volume.hpp>
#include <polyaffine/system/inertia.hpp>
#include <polyaffine/system/sparse_field.hpp>

namespace cardiac {

using polyaffine::FieldEnergy;
using polyaffine::Vec3;
using polyaffine::Vector;

namespace {

std::vector<ActivationSite> sites(const Anatomy& anatomy, const scene::Activation& activation) {
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
Vector vertex_activation(const Anatomy& anatomy, const Scene& scene) {
  const auto& a = *scene.activation;
  if (a.map) return mapped_times(anatomy.mesh, *a.map);
  if (a.mode == scene::ActivationMode::array || a.mode == scene::ActivationMode::table)
    throw polyaffine::InputError(
        "activation.mode: found an array or table whose times were not read (a heart without its mesh "
        "file?), "
        "expected a run from its protocol and mesh");
  if (a.mode == scene::ActivationMode::uniform)
    return Vector::Constant(anatomy.mesh.num_points(), a.onset_ms);
  return activation_times(anatomy.mesh, tet_fibres(anatomy, *scene.fibres),
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
Vector vertex_region_delay(const Anatomy& anatomy, const Scene& scene) {
  const polyaffine::WallPoints vertices = vertex_points(anatomy.mesh);
  const RegionFactors factors = region_factors(anatomy, scene, vertices);
  return Eigen::Map<const Vector>(factors.delay_ms.data(), anatomy.mesh.num_points());
}

std::shared_ptr<const ContractionField> build_contraction(const Anatomy& anatomy, const Scene& scene,
                                                          const polyaffine::WallPoints& points,
                                                          const RegionFactors& factors, BuildCount& built) {
  ++built["contraction"];
  ++built["activation"];
  const Vector at_vertices = vertex_activation(anatomy, scene);
  const Scene timed = with_twitch(scene);
  const TensionCurve curve =
      timed.contraction->tension
          ? TensionCurve(*timed.contraction->tension)
          : TensionCurve(bestel_parameters(*scene.contraction, scene.time), scene.time.beat_ms);
  ContractionField out{curve, at_points(anatomy, at_vertices, points),
                       Vector::Ones(static_cast<Eigen::Index>(points.tet.size())), at_vertices,
                       scene.contraction->feels_fibre() ? 0 : curve.contraction_begin_ms()};
  if (!factors.tension.empty()) {
    out.scale = Eigen::Map<const Vector>(factors.tension.data(), out.scale.size());
    out.delay_ms += Eigen::Map<const Vector>(factors.delay_ms.data(), out.scale.size());
    out.vertex_delay_ms += vertex_region_delay(anatomy, scene);
  }
  return std::make_shared<ContractionField>(std::move(out));
}

// Sarcomeres at the points of the wall.
std::shared_ptr<const Muscle> build_muscle(const Anatomy& anatomy, const Scene& scene,
                                           const Discretisation& d, const FieldEnergy& wall,
                                           const ContractionField& field) {
  const FibreAxes axes = fibres_at(anatomy, *scene.fibres, d.points.tet, d.points.barycentric);
  auto law = std::make_shared<ActiveStress>(axes, scene.contraction->cross_fibre_fraction);
  return std::make_shared<const Muscle>(Muscle{
      sarcomere_model(*scene.contraction, scene.time),
      std::make_shared<FieldEnergy>(wall.table(), std::vector<std::shared_ptr<const polyaffine::Law>>{law}),
      axes.topRows<3>(), field.delay_ms, field.scale});
}

// The mass is integrated at points that are exact for products of two functions: those of the elements, or of
// a reduced model its own.
StateTerm inertia(const Discretisation& d, double density_mg_per_mm3) {
  const auto* elements = dynamic_cast<const polyaffine::LagrangeBasis*>(d.basis.get());
  const polyaffine::WallPoints points = elements ? elements->wall_points(2 * elements->order()) : d.points;
  return [table = polyaffine::displacement_table(*d.basis, points), density_mg_per_mm3](
             polyaffine::StateLayout& layout, const scene::Time& time) {
    // Of the displacement that a velocity makes in the longest step.
    const double tolerance = time.absolute_tolerance_mm / time.max_step_ms;
    return std::make_shared<polyaffine::Inertia>(table, density_mg_per_mm3, tolerance, layout);
  };
}

// The surface of a cavity, closed at its base. Where the base moves: by cones to the moving centre of its
// rim, of elements with points of their own, since else every face would see the functions of the rim.
polyaffine::FieldTable enclosing_table(const polyaffine::Basis& basis, const CavitySurface& surface) {
  if (!surface.rim) return polyaffine::surface_table(basis, surface.points, surface.base_centre);
  if (dynamic_cast<const polyaffine::LagrangeBasis*>(&basis) == nullptr)
    return polyaffine::surface_table(basis, surface.points, surface.rim->centre);
  return polyaffine::joined(polyaffine::surface_table(basis, surface.points, surface.base_centre),
                            polyaffine::lid_table(basis, *surface.rim, surface.base_centre));
}

}  // namespace

Vector ContractionField::tension(double time_ms) const {
  Vector tension(delay_ms.size()), rate(delay_ms.size());
  curve.evaluate(time_ms, delay_ms, scale, tension, rate);
  return tension;
}

Cavity cavity_of(const polyaffine::Basis& basis, const CavitySurface& surface) {
  return {surface.name,
          std::make_shared<FieldEnergy>(enclosing_table(basis, surface),
                                        std::vector<std::shared_ptr<const polyaffine::Law>>{
                                            std::make_shared<polyaffine::SignedVolume>(1.0 / 3)})};
}

polyaffine::PointValues Ventricle::tension() const {
  if (!contraction || muscle) return {};
  return polyaffine::remembered([field = contraction](double t) { return field->tension(t); });
}

Vector Ventricle::tension_at(double time_ms) const {
  return contraction && !muscle ? contraction->tension(time_ms) : Vector();
}

Vector Ventricle::cavity_volumes(const Vector& c) const {
  Vector out(std::ssize(cavities));
  for (Eigen::Index k = 0; k < out.size(); ++k) out[k] = cavity_volume(c, static_cast<std::size_t>(k));
  return out;
}

Discretisation discretise(const std::shared_ptr<const Anatomy>& anatomy, const Scene& scene,
                          scene::Method method) {
  return method == scene::Method::fem ? full_discretisation(*anatomy, scene)
                                      : reduced_discretisation(*anatomy, scene);
}

Ventricle assemble_ventricle(std::shared_ptr<const Anatomy> anatomy, const Scene& scene,
                             Discretisation discretisation) {
  Ventricle out;
  out.discretisation = std::move(discretisation);
  const auto& d = out.discretisation;
  check_size(d);
  const RegionFactors factors = region_factors(*anatomy, scene, d.points);
  if (!factors.stiffness.empty()) ++out.built["regions"];
  out.wall = build_wall(*anatomy, scene, d, factors, out.built);
  ++out.built[d.sparse ? "full order" : "reduction"];
  if (!d.cavities.empty()) ++out.built["cavity"];
  for (const CavitySurface& surface : d.cavities) out.cavities.push_back(cavity_of(*d.basis, surface));
  check_held(*anatomy, scene, d);
  out.supports = supports(*anatomy, scene, d);
  if (scene.tissue.density_mg_per_mm3 > 0 && scene.contraction) {
    ++out.built["inertia"];
    out.states.push_back(inertia(d, scene.tissue.density_mg_per_mm3));
  }
  if (scene.contraction) out.contraction = build_contraction(*anatomy, scene, d.points, factors, out.built);
  if (scene.contraction && scene.contraction->feels_fibre()) {
    out.muscle = build_muscle(*anatomy, scene, d, *out.wall, *out.contraction);
    out.states.push_back([muscle = out.muscle](polyaffine::StateLayout& layout, const scene::Time&) {
      return std::make_shared<MuscleTerm>(muscle, layout);
    });
  }
  out.anatomy = std::move(anatomy);
  return out;
}

polyaffine::System wall_system(const Ventricle& ventricle, polyaffine::PointValues tension,
                               double tolerance_mm) {
  polyaffine::System out = polyaffine::field_system(ventricle.num_coefficients(),
                                                    {polyaffine::solid(ventricle.wall, std::move(tension))},
                                                    ventricle.discretisation.fixed, tolerance_mm);
  out.held = ventricle.discretisation.held;
  if (ventricle.discretisation.sparse) out.linear = polyaffine::sparse_field;
  out.terms.insert(out.terms.end(), ventricle.supports.begin(), ventricle.supports.end());
  return out;
}

void add_states(const Ventricle& ventricle, const scene::Time& time, polyaffine::System& system) {
  for (const StateTerm& make : ventricle.states) system.terms.push_back(make(system.layout, time));
}

void rest_muscle(const polyaffine::System& system, double time_ms, Vector& y) {
  for (const auto& term : system.terms)
    if (const auto* muscle = dynamic_cast<const MuscleTerm*>(term.get())) muscle->rest(time_ms, y);
}

Vector muscle_tension(const polyaffine::System& system, const Vector& y) {
  for (const auto& term : system.terms)
    if (const auto* muscle = dynamic_cast<const MuscleTerm*>(term.get())) return muscle->tension(y);
  return {};
}

polyaffine::System pressed_system(const Ventricle& ventricle, polyaffine::PointValues tension,
                                  const std::vector<polyaffine::FieldTerm::Scale>& pressures_kPa,
                                  double tolerance_mm) {
  polyaffine::System out = wall_system(ventricle, std::move(tension), tolerance_mm);
  for (std::size_t k = 0; k < std::min(pressures_kPa.size(), ventricle.cavities.size()); ++k)
    out.terms.push_back(
        polyaffine::load(ventricle.cavities[k].volume, [p = pressures_kPa[k]](double t) { return -p(t); }));
  return out;
}

polyaffine::System loaded_ventricle(const Ventricle& ventricle, const WallLoad& load) {
  return loaded_ventricle(
      ventricle, {Vector::Zero(load.pressures_kPa.size()), Vector::Zero(load.tension.size()), 0}, load);
}

polyaffine::System loaded_ventricle(const Ventricle& ventricle, const WallLoad& from, const WallLoad& to) {
  std::vector<polyaffine::FieldTerm::Scale> pressures;
  for (Eigen::Index k = 0; k < to.pressures_kPa.size(); ++k)
    pressures.emplace_back(
        [p0 = from.pressures_kPa[k], p1 = to.pressures_kPa[k]](double t) { return (1 - t) * p0 + t * p1; });
  polyaffine::System out = pressed_system(
      ventricle, to.tension.size() > 0 ? polyaffine::ramp(from.tension, to.tension) : nullptr, pressures);
  if (ventricle.muscle && (from.resting > 0 || to.resting > 0))
    out.terms.push_back(std::make_shared<RestingMuscle>(ventricle.muscle, 0, from.resting, to.resting));
  return out;
}

}  // namespace cardiac
