#include "cardiac/model/wall.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <cardiac/fibres/helix.hpp>
#include <cardiac/tissue/active_stress.hpp>
#include <cardiac/tissue/guccione.hpp>
#include <cardiac/tissue/holzapfel_ogden.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/core/threads.hpp>
#include <polyaffine/material/mooney_rivlin.hpp>
#include <polyaffine/material/neo_hookean.hpp>
#include <polyaffine/material/saint_venant_kirchhoff.hpp>
#include <polyaffine/material/viscosity.hpp>
#include <polyaffine/material/volumetric.hpp>

namespace cardiac {

using polyaffine::Law;

namespace {

using LawPointer = std::shared_ptr<const Law>;

LawPointer passive_law(const scene::Tissue& t, const FibreAxes& fibres, const std::vector<double>& factor) {
  using scene::TissueLaw;
  switch (t.law) {
    case TissueLaw::guccione:
      return std::make_shared<Guccione>(GuccioneParameters{t.C_kPa, t.bf, t.bt, t.bfs}, fibres, factor);
    case TissueLaw::holzapfel_ogden:
      return std::make_shared<HolzapfelOgden>(
          HolzapfelOgdenParameters{t.a_kPa, t.b, t.a_f_kPa, t.b_f, t.a_s_kPa, t.b_s, t.a_fs_kPa, t.b_fs},
          fibres, factor);
    case TissueLaw::neo_hookean:
      return std::make_shared<polyaffine::IsochoricNeoHookean>(t.mu_kPa, factor);
    case TissueLaw::mooney_rivlin:
      return std::make_shared<polyaffine::MooneyRivlin>(
          polyaffine::MooneyRivlinParameters{t.c1_kPa, t.c2_kPa}, factor);
    case TissueLaw::saint_venant_kirchhoff:
      return std::make_shared<polyaffine::SaintVenantKirchhoff>(
          polyaffine::Elasticity{t.youngs_modulus_kPa, t.poisson_ratio}, factor);
  }
  throw polyaffine::InputError("tissue.law: unknown law");
}

// From `at_apex` on the axis to 1 within half a wall thickness: in this core, where fibres of all directions
// meet, the bulk modulus acts at every point; a wider one stiffens the cap.
std::vector<double> apical_factor(const Anatomy& anatomy, const Discretisation& discretisation,
                                  double at_apex) {
  const auto& points = discretisation.points;
  const double reach = 0.5 * discretisation.layout.cap_thickness / anatomy.coordinates->arc_length();
  std::vector<double> factor;
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const double s =
        anatomy.coordinates->place(points.tet[q], points.barycentric.col(static_cast<Eigen::Index>(q))).u /
        reach;
    factor.push_back(1 + (at_apex - 1) * std::exp(-s * s));
  }
  return factor;
}

}  // namespace

HelixAngles helix_angles(const scene::Fibres& f) {
  return {f.endo_angle_deg, f.epi_angle_deg, f.sheet_angle_deg, f.rv_endo_angle_deg, f.rv_epi_angle_deg};
}

FibreAxes fibres_at(const Anatomy& anatomy, const scene::Fibres& fibres, const std::vector<int>& tet,
                    const Eigen::Matrix4Xd& barycentric) {
  if (anatomy.fibres) return anatomy.fibres(*anatomy.coordinates, tet, barycentric);
  if (fibres.source == scene::FibreSource::file)
    throw polyaffine::InputError("fibres.source: found file, but the anatomy was built without its fibres");
  return helix_fibres(*anatomy.coordinates, tet, barycentric, helix_angles(fibres));
}

polyaffine::Points tet_fibres(const Anatomy& anatomy, const scene::Fibres& fibres) {
  const int tets = anatomy.mesh.num_tets();
  std::vector<int> all(tets);
  std::iota(all.begin(), all.end(), 0);
  return fibres_at(anatomy, fibres, all, Eigen::Matrix4Xd::Constant(4, tets, 0.25)).topRows<3>();
}

RegionFactors region_factors(const Anatomy& anatomy, const Scene& scene,
                             const polyaffine::WallPoints& points) {
  RegionFactors out;
  if (scene.regions.empty()) return out;
  const std::size_t n = points.tet.size();
  out.stiffness.assign(n, 1.0);
  out.tension.assign(n, 1.0);
  out.delay_ms.assign(n, 0.0);
  for (std::size_t q = 0; q < n; ++q) {
    for (const auto& region : scene.regions) {
      const auto shares =
          shares_at(*anatomy.coordinates, points.tet[q], points.barycentric.col(static_cast<Eigen::Index>(q)),
                    region.border_width_percent / 100);
      double share = 0;
      for (const int s : region.segments) share += shares[s - 1];
      out.stiffness[q] *= 1 + share * (region.stiffness_factor - 1);
      out.tension[q] *= 1 + share * (region.tension_factor - 1);
      out.delay_ms[q] += share * region.activation_delay_ms;
    }
  }
  return out;
}

std::shared_ptr<const polyaffine::FieldEnergy> build_wall(const Anatomy& anatomy, const Scene& scene,
                                                          const Discretisation& discretisation,
                                                          const RegionFactors& factors, BuildCount& built) {
  polyaffine::use_threads();
  auto table = polyaffine::deformation_table(*discretisation.basis, discretisation.points);
  FibreAxes fibres;
  if (scene.fibres) {
    ++built["fibres"];
    const auto& points = discretisation.points;
    fibres = fibres_at(anatomy, *scene.fibres, points.tet, points.barycentric);
  }
  const scene::Tissue& tissue = scene.tissue;
  std::vector<LawPointer> laws{passive_law(tissue, fibres, factors.stiffness)};
  if (scene.contraction && !scene.contraction->feels_fibre())
    laws.push_back(std::make_shared<ActiveStress>(fibres, scene.contraction->cross_fibre_fraction));

  std::optional<polyaffine::PressureSpace> pressure;
  if (tissue.law != scene::TissueLaw::saint_venant_kirchhoff) {
    if (discretisation.blends_frames() && *scene.reduction.pressure_space == scene::PressureSpace::none)
      laws.push_back(std::make_shared<polyaffine::QuadraticVolumetric>(tissue.bulk_modulus_kPa));
    else
      pressure = pressure_space(discretisation, table, scene);
    // What few pressures do not see, local changes of volume, a small part of the bulk modulus keeps in
    // check; less where the wall is softer, which that part would hold back.
    if (const double local = scene.reduction.local_bulk_modulus_kPa;
        pressure && discretisation.blends_frames() && local > 0) {
      auto factor = apical_factor(anatomy, discretisation, tissue.bulk_modulus_kPa / local);
      for (std::size_t q = 0; q < factors.stiffness.size(); ++q)
        factor[q] *= std::min(1.0, factors.stiffness[q]);
      laws.push_back(std::make_shared<polyaffine::QuadraticVolumetric>(local, std::move(factor)));
      pressure->bulk_modulus -= local;
    }
  }
  if (tissue.viscosity_kPa_ms > 0 && scene.contraction)
    laws.push_back(std::make_shared<polyaffine::KelvinVoigt>(tissue.viscosity_kPa_ms));
  return std::make_shared<polyaffine::FieldEnergy>(std::move(table), std::move(laws), std::move(pressure));
}

}  // namespace cardiac
