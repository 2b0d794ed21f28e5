#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/run/beat.hpp>
#include <cardiac/validation/check.hpp>

namespace cardiac {

/// A run of an extreme scene: a path that completed, or as far as it came and why it stopped.
struct ExtremeOutcome {
  std::string scene, method;
  HeartPath path;
  std::string reason;  ///< why it stopped or was refused; empty when it completed
  bool told = true;    ///< the reason is one for a user: neither cut off after too long nor unforeseen
  bool finite = true;  ///< no state holds a number that is none
  double cavity_at_rest_mm3 = 0;
  int smallest_region_tets = 0;  ///< of the regions of the control nodes; 0 in full order
  double wall_s = 0;

  bool completed() const { return reason.empty() && finite; }
  double cavity_ratio() const;    ///< last state over unloaded
  double smallest_ratio() const;  ///< smallest cavity over unloaded
  double inflation() const { return cavity_ratio() - 1; }
  double ef_percent() const;          ///< of the last beat, from the largest to the smallest volume
  double peak_pressure_mmHg() const;  ///< of the last beat
};

/// A wall in tets, with the midpoints of its curved edges where they are known.
struct ExtremeMesh {
  polyaffine::TetMesh mesh;
  std::optional<polyaffine::EdgeMidpoints> midpoints{};
};

/// The ventricle of human_lv as structured_ellipsoid makes it.
ExtremeMesh extreme_mesh(const StructuredCells& cells);

/// A number as a protocol says it.
std::string as_text(double value);

/// A range with what it rests on.
struct ExtremeBound {
  double reference, low, high;
  std::string source;
};

/// The checks of the extreme scenes as they are computed.
class ExtremeChecks {
 public:
  explicit ExtremeChecks(const ValidationContext& context);

  bool quick() const { return context_.quick; }
  /// The ventricle of human_lv in 396 tets, and in 168 for full-order beats.
  const ExtremeMesh& wall() const { return wall_; }
  const ExtremeMesh& coarse_wall() const { return coarse_wall_; }

  /// Runs a protocol with settings key=value on a mesh; refusals and failures are part of the outcome. A run
  /// of more than two minutes is stopped, which no check accepts.
  ExtremeOutcome run(const std::string& scene, const ExtremeMesh& mesh, const std::string& protocol,
                     const std::vector<std::string>& settings) const;

  /// A number of an outcome that must complete.
  void expect(const ExtremeOutcome& outcome, const std::string& quantity, const std::string& unit,
              double value, const ExtremeBound& bound);
  /// The same for a scene that has no solution, or may have none: completed within the bound, or stopped as
  /// expect_refusal asks.
  void expect_or_stop(const ExtremeOutcome& outcome, const std::string& quantity, const std::string& unit,
                      double value, const ExtremeBound& bound, const std::string& words);
  /// The inflation of a cavity within some percent of that of another run, which must have completed too.
  void expect_inflation_of(const ExtremeOutcome& outcome, const ExtremeOutcome& reference, double percent,
                           const std::string& source);
  /// Must be refused or stop, with finite states and a reason that holds some words.
  void expect_refusal(const ExtremeOutcome& outcome, const std::string& words);
  void add(Check check) { checks_.push_back(std::move(check)); }

  const std::vector<Check>& checks() const { return checks_; }

 private:
  const ValidationContext& context_;
  ExtremeMesh wall_, coarse_wall_;
  std::vector<Check> checks_;
};

/// What a load stepping says that finds no further equilibrium.
extern const char* const kNoEquilibrium;

/// Passive inflation of a neo-Hookean wall, and a beat: the protocols that the scenes change.
extern const char* const kExtremePassive;
extern const char* const kExtremeBeat;

/// "reduction.method=fem" in front of settings.
std::vector<std::string> full_order(std::vector<std::string> settings);

/// work(0), …, work(count − 1), begun in this order, as many at once as there are processors, each on a
/// thread that does nothing else: times of scenes do not hold work of others. Then throws what the first of
/// them threw.
void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work);

/// The groups of scenes.
void extreme_materials(ExtremeChecks& checks);
void extreme_loads(ExtremeChecks& checks);
void extreme_beats(ExtremeChecks& checks);
void extreme_meshes(ExtremeChecks& checks);
void extreme_models(ExtremeChecks& checks);
void extreme_tolerances(ExtremeChecks& checks);
void extreme_random(ExtremeChecks& checks);

}  // namespace cardiac
