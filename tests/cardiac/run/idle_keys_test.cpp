#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

#include <cardiac/protocol/key.hpp>
#include <cardiac/protocol/names.hpp>

#include "support/heart_run.hpp"

// Every key that is given changes what is computed, or is warned of: in each kind of run.
namespace cardiac {
namespace {

using namespace protocol;
using Settings = std::vector<std::string>;

// Whether numbers change shows in the first steps, some of them after the onset of contraction.
constexpr int kSteps = 40;

/// What a run computes in its first steps, to be compared bit by bit.
std::vector<double> computed(const Protocol& protocol, const std::shared_ptr<const cardiac::Anatomy>& anatomy,
                             const Discretisation& discretisation) {
  const Ventricle ventricle = assemble_ventricle(anatomy, protocol, discretisation);
  int steps = 0;
  RunControl control;
  control.stop_reason = [&] { return ++steps > kSteps ? "enough" : ""; };
  const HeartPath path = protocol.circulation ? run_beats(ventricle, protocol, control)
                                              : run_prescribed(ventricle, protocol, control);
  EXPECT_TRUE(path.completed || path.stop_reason.ends_with("enough")) << path.stop_reason;
  std::vector<double> out;
  for (const auto* states : {&path.steps, &path.outputs})
    for (const HeartState& s : *states) {
      out.insert(out.end(), {s.time_ms, s.volumes_mm3[0], s.pressures_kPa[0], s.vessels_kPa.sum()});
      out.insert(out.end(), s.c.begin(), s.c.end());
    }
  const BeatResult result = describe_path(ventricle, segment_nodes(*anatomy, protocol), protocol, path);
  for (const Instant& instant : result.instants)
    for (const SegmentStrain& s : instant.strain) out.insert(out.end(), {s.longitudinal, s.circumferential});
  return out;
}

/// The same with everything built anew.
std::vector<double> computed(const Protocol& protocol) {
  const auto anatomy = testing::read_anatomy(protocol);
  return computed(protocol, anatomy, discretise(anatomy, protocol, protocol.reduction.method));
}

// Less is rounding: sheets that turn in a plane without a direction of its own change the last digits.
bool differ(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return true;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > 1e-8 * std::max(1.0, std::abs(a[i]))) return true;
  return false;
}

/// Tables that the functions and integration points do not depend on.
bool keeps_discretisation(const std::string& table) {
  static const std::set<std::string> tables{"tissue",   "fibres",      "activation", "contraction",
                                            "cavities", "circulation", "time",       "output"};
  return tables.contains(table);
}

struct RunKind {
  std::string name, tables;
  std::set<std::string> tried = {};  ///< tables whose keys are tried; empty: all
};

void PrintTo(const RunKind& kind, std::ostream* out) {
  *out << kind.name;
}

/// On the small ventricle of Land et al. Where there are beats, the outlet is open and the muscle relaxes
/// within the first steps.
std::vector<RunKind> kinds() {
  const std::string affine = "[reduction]\nenrichment = []\n";
  const std::string region = "[[region]]\nsegments = [7]\ntension_factor = 0.5\n";
  const std::string contraction = "[contraction]\nactivation_duration_ms = 6\nswitch_width_ms = 2\n";
  const std::string active = "[fibres]\n[activation]\nonset_ms = 4\n" + contraction;
  const std::string circulation =
      "[circulation]\nfilling_pressure_mmHg = 5\ninitial_aortic_pressure_mmHg = 4\n";
  const std::string output = "[output]\ninterval_ms = 1\n";
  return {
      {"beat", affine + active + region + circulation + output},
      {"sarcomeres",
       affine + "[fibres]\n[activation]\nonset_ms = 0\n[contraction]\nmodel = \"land_2017\"\n" + circulation,
       {"contraction"}},
      {"bridges", affine + active + "model = \"bestel_clement_sorine\"\n" + circulation, {"contraction"}},
      {"wave",
       "[reduction]\nenrichment = []\n[tissue]\nlaw = \"holzapfel_ogden\"\n"
       "[fibres]\n[activation]\nmode = \"sites\"\nonset_ms = 0\nsite_segments = "
       "[8]\n[time]\nrelative_tolerance = 0.1\nabsolute_tolerance_mm = 1\n" +
           contraction + circulation,
       {"tissue", "fibres", "activation"}},
      {"sigmoid",
       "[reduction]\nenrichment = []\nweights = \"sigmoid\"\n[tissue]\nlaw = \"neo_hookean\"\n[cavities]\n"
       "pressure_mmHg = 1\n[time]\nload_steps = 1\n",
       {"reduction"}},
      {"passive",
       affine + "[tissue]\nlaw = \"neo_hookean\"\n[cavities]\npressure_mmHg = 4\n[time]\n"
                "load_steps = 2\n",
       {"anatomy", "tissue", "fibres", "cavities", "boundary", "time", "output"}},
      {"held",
       affine + "[tissue]\nlaw = \"neo_hookean\"\n[cavities]\npressure_mmHg = 4\n[boundary]\n"
                "epicardial_stiffness_kPa_per_mm = 0.5\n[time]\nload_steps = 1\n",
       {"boundary"}},
      {"weighed",
       affine +
           "[tissue]\nlaw = \"neo_hookean\"\n[cavities]\npressure_mmHg = 4\n[boundary]\n"
           "epicardial_stiffness_kPa_per_mm = 0.5\nepicardial_base_weight = 0.5\n[time]\nload_steps = 1\n",
       {"boundary"}},
      {"linear",
       "[tissue]\nlaw = \"saint_venant_kirchhoff\"\n[cavities]\npressure_mmHg = 1\n[time]\nload_steps = 2\n",
       {"reduction", "tissue"}},
      {"full_order",
       "[reduction]\nmethod = \"fem\"\nelement_order = 1\n[tissue]\nlaw = \"neo_hookean\"\n[cavities]\n"
       "pressure_mmHg = 4\n[time]\nload_steps = 1\n",
       {"reduction"}}};
}

/// Not tried: what is read before or written after what is computed here, what must fit the mesh (or needs
/// several openings of it), what is a kind of its own, and what tells how many beats there are.
bool elsewhere(const std::string& path) {
  static const std::set<std::string> paths{"anatomy.scheme",
                                           "anatomy.mitral_point",
                                           "output.frames",
                                           "output.mechanics",
                                           "reduction.method",
                                           "fibres.source",
                                           "activation.mode",
                                           "output.tables",
                                           "output.figures",
                                           "output.mesh_series",
                                           "region.name",
                                           "time.max_beats",
                                           "time.limit_cycle_tolerance_percent",
                                           "contraction.model",
                                           "contraction.calcium_file",
                                           "circulation.loop",
                                           "cavities.pressure_file",
                                           "cavities.volume_file",
                                           "boundary.epicardial_weight_array"};
  return path.starts_with("mesh.") || paths.contains(path);
}

/// Another value of a key; empty where it has but one.
std::string other_value(const std::string& path, const Key& key, const Json& value, const Protocol& base) {
  static const std::map<std::string, std::string> chosen{{"anatomy.long_axis", "[0.05, 0.0, 1.0]"},
                                                         {"anatomy.anterior_direction", "[1.0, 0.0, 0.0]"},
                                                         {"anatomy.septum_point", "[0.0, 8.0, 0.0]"},
                                                         {"anatomy.rv_insertion_point", "[8.0, 0.0, 0.0]"},
                                                         {"reduction.axes", "cartesian"},
                                                         {"reduction.enrichment", "[\"ll\"]"},
                                                         {"reduction.ring_nodes", "[4, 6, 8]"},
                                                         {"reduction.ring_positions", "[0.25, 0.5, 0.8]"},
                                                         {"reduction.ring_angles_deg", "[10.0, 10.0, 10.0]"},
                                                         {"reduction.integration", "gauss"},
                                                         {"tissue.law", "mooney_rivlin"},
                                                         {"activation.site_segments", "[9]"},
                                                         {"activation.sites_mm", "[[7.0, 0.0, 0.0]]"},
                                                         {"contraction.calcium_decay_ms", "60.0"},
                                                         {"contraction.calcium_rise_ms", "15.0"},
                                                         {"time.max_step_ms", "0.1"},
                                                         {"time.heart_rate_bpm", "240.0"},
                                                         {"region.segments", "[8]"}};
  // They are there where regions differ; elsewhere other keys that play no part may forbid them.
  if (path == "reduction.border_functions") {
    const bool frames =
        base.reduction.method == scene::Method::polyaffine && base.reduction.weights == scene::Weights::tents;
    return frames && !base.reduction.border_functions.value() ? "true" : "false";
  }
  // Of one ventricle it chooses functions alone, and the bases name theirs.
  if (path == "reduction.preset") return "";
  if (const auto found = chosen.find(path); found != chosen.end()) return found->second;
  switch (key.kind) {
    case Kind::number: {
      const double now = value.is_null() || value == 0 ? 0.1 : 1.1 * value.get<double>();
      return Json(std::min(now, key.facts.range.high)).dump();
    }
    case Kind::whole:
      return value == key.facts.range.high ? "1" : std::to_string(value.get<int>() + 1);
    case Kind::flag:
      return value == true ? "false" : "true";
    case Kind::choice:
      if (key.choices.size() == 1) return "";
      return value == key.choices[0] ? key.choices[1] : key.choices[0];
    default:
      return "other";
  }
}

Protocol protocol_of(const RunKind& kind, const Settings& settings = {}) {
  return parse_protocol("[mesh]\nfile = \"land_ellipsoid_coarse.vtu\"\nlength_unit = \"mm\"\n" + kind.tables,
                        PROJECT_DIR "/meshes/idle.toml", settings);
}

bool warned_of(const Protocol& protocol, const std::string& path) {
  return std::ranges::any_of(protocol.warnings, [&](const std::string& text) {
    return text.find(path + " plays no part") != std::string::npos;
  });
}

class IdleKeys : public ::testing::TestWithParam<RunKind> {};

TEST_P(IdleKeys, EachKeyActsOrIsWarnedOf) {
  const RunKind& kind = GetParam();
  const Protocol base = protocol_of(kind);
  const auto anatomy = testing::read_anatomy(base);
  const Discretisation discretisation = discretise(anatomy, base, base.reduction.method);
  const auto standard = computed(base, anatomy, discretisation);
  Settings idle;
  int acting = 0;
  for (const Table& table : tables()) {
    if (table.count(base) == 0 || !(kind.tried.empty() || kind.tried.contains(table.name))) continue;
    for (const Key& key : table.keys) {
      const std::string name = table.name + '.' + key.name;
      if (elsewhere(name)) continue;
      const std::string path = table.name + (table.list ? ".1." : ".") + key.name;
      const std::string value = other_value(name, key, key.get(base, 0), base);
      if (value.empty()) continue;
      const std::string setting = path + '=' + value;
      const Protocol changed = protocol_of(kind, {setting});
      if (warned_of(changed, path)) {
        idle.push_back(setting);
        continue;
      }
      ++acting;
      const auto now =
          keeps_discretisation(table.name) ? computed(changed, anatomy, discretisation) : computed(changed);
      EXPECT_TRUE(differ(now, standard)) << setting << " changes nothing";
    }
  }
  EXPECT_GT(acting, 0);
  EXPECT_GT(idle.size(), 0U);
  EXPECT_FALSE(differ(computed(protocol_of(kind, idle)), standard))
      << "among the keys that are said to play no part, one does";
}

INSTANTIATE_TEST_SUITE_P(Runs, IdleKeys, ::testing::ValuesIn(kinds()),
                         [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace cardiac
