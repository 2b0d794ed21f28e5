#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/scene/scene.hpp>
#include <cardiac/validation/elastodynamics_case.hpp>

namespace cardiac {

/// How a problem of the benchmark is computed.
struct ElastodynamicsMethod {
  scene::Method method = scene::Method::fem;
  scene::Preset preset = scene::Preset::fast;  ///< of a reduced model
  int element_order = 2;                       ///< of full order
  double end_ms = 1000;
  double relative_tolerance = 1e-3, absolute_tolerance_mm = 1e-3;
};

/// The motion of a problem, every millisecond.
struct ElastodynamicsRun {
  polyaffine::Vector times_ms;
  std::vector<polyaffine::Points> displacements;  ///< of each point of the case, 3 × times, mm
  polyaffine::Matrix volumes_mL;                  ///< cavities × times
  int tets = 0, unknowns = 0;
  long steps = 0, newton_iterations = 0, factorisations = 0;
  double wall_s = 0;
  std::string stop_reason;  ///< empty: it came to its end

  bool completed() const { return stop_reason.empty(); }
};

/// The mesh of a problem in a folder with its files, in mm, with its fibres: for the left ventricle −60°
/// inside to +60° outside from circumferential towards the apex (physiologically +60° to −60°) in the
/// ellipsoids of the benchmark, of both ventricles those of the file. Throws InputError naming a file that is
/// not there.
std::shared_ptr<const Anatomy> elastodynamics_anatomy(const ElastodynamicsCase& problem,
                                                      const std::filesystem::path& folder);

/// The same left ventricle on a structured mesh between its ellipsoids, of straight elements too: in the
/// benchmark the springs of the epicardium act along the normals of flat faces, which resist that the wall
/// slides along itself; on curved faces p0 and p1 move by 3 to 7 % more.
std::shared_ptr<const Anatomy> structured_benchmark_ventricle(const StructuredCells& cells);

/// The problem as a scene: Holzapfel–Ogden with the switch of the benchmark, κ = 1000 kPa, S = η Ė with 100
/// kPa·ms, density 1 mg/mm³, tension along the fibres alone, springs and dashpots of the epicardium (100
/// kPa/mm, 5 kPa·ms/mm) along the reference normals and of the base in all directions.
Scene elastodynamics_scene(const ElastodynamicsCase& problem, const ElastodynamicsMethod& method);

/// Computes it from rest. The pressures push the endocardium alone, as in the benchmark, not the rim that
/// closes the cavity: their force has no potential. The sheets lie in the wall (as in the fibre file of both
/// ventricles), full order keeps the volume at every point by the benchmark's κ/4 (J² − 1 − 2 ln J). A run
/// that stops early says why.
ElastodynamicsRun run_elastodynamics(const ElastodynamicsCase& problem,
                                     std::shared_ptr<const Anatomy> anatomy,
                                     const ElastodynamicsMethod& method,
                                     const std::function<void(double fraction)>& progress = {});

}  // namespace cardiac
