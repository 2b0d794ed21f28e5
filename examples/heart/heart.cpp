// A beating left ventricle from a scene put together in C++, without a file.
//
// A scene is a heart (a mesh with ventricular coordinates and AHA segments) and plain structs for what drives
// and holds it, in mm, ms, kPa and mg. A part that is absent is not built. simulate computes
//
//     ∂W/∂c(c, ċ, τ(t)) + supports − p ∂V/∂c = 0,  V − V(c) = 0,  [V̇, ṗ_c] = f(V, p_c, p)
//
// over the few hundred coefficients c of the wall, the cavity's volume V and pressure p, and the pressure p_c
// of the arteries, from the filled wall until the pressure-volume loop closes. Here the same heart beats
// freely and with dashpots on its epicardium, as the pericardium holds it.
//
//     $ heart
//     free: 3 beats, EDV 118 mL, EF 58 %, peak pressure 121 mmHg, GLS -14 %
//     held: 2 beats, EDV 114 mL, EF 57 %, peak pressure 116 mmHg, GLS -13 %

#include <cstdio>
#include <cstdlib>
#include <memory>

#include <cardiac/anatomy/anatomy.hpp>
#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/run/simulate.hpp>
#include <cardiac/scene/presets.hpp>

using namespace cardiac;

namespace {

// The idealised human left ventricle: 10 cells from apex to base, 18 around, 2 through the wall, each of six
// curved tetrahedra.
std::shared_ptr<const Anatomy> human_heart() {
  CurvedMesh wall = structured_ellipsoid(human_lv(), {10, 18, 2});
  return std::make_shared<const Anatomy>(
      make_anatomy(std::move(wall.mesh), {.midpoints = std::move(wall.midpoints)}));
}

Scene beating_heart() {
  Scene scene;
  scene.heart = human_heart();
  // What is not set keeps the values of a healthy heart.
  scene.fibres.emplace().endo_angle_deg = 70;
  scene.fibres->epi_angle_deg = -70;
  scene.activation.emplace().onset_ms = 100;
  scene.contraction.emplace();
  scene.circulation.emplace();
  scene.time.beat_ms = 800;
  raise_local_bulk_modulus(/*two_ventricles=*/false, scene);
  return scene;
}

bool tell(const char* name, const Scene& scene) {
  const Outcome outcome = simulate(scene);
  const BeatResult& result = outcome.result;
  if (!result.completed) {
    std::printf("%s: %s\n", name, result.stop_reason.c_str());
    return false;
  }
  const VentricleSummary& lv = result.ventricles.front();
  std::printf("%s: %d beats, EDV %.0f mL, EF %.0f %%, peak pressure %.0f mmHg, GLS %.0f %%\n", name,
              result.beats, lv.edv_mL, lv.ef_percent, lv.peak_pressure_mmHg, result.strain.gls_percent);
  return true;
}

}  // namespace

int main() {
  Scene scene = beating_heart();
  if (!tell("free", scene)) return EXIT_FAILURE;
  scene.boundary.epicardial_stiffness_kPa_per_mm = 0.05;
  scene.boundary.epicardial_damping_kPa_ms_per_mm = 5;
  return tell("held", scene) ? EXIT_SUCCESS : EXIT_FAILURE;
}
