#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <cardiac/core/units.hpp>
#include <cardiac/protocol/key.hpp>
#include <cardiac/protocol/names.hpp>
#include <cardiac/protocol/nearest_key.hpp>
#include <cardiac/protocol/rules.hpp>
#include <cardiac/scene/contraction_time.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac::protocol {
namespace {

using polyaffine::InputError;

// Contrasts of stiffness between neighbouring segments beyond which the reduced model is not to be trusted
// unseen; `cardiac validate extreme` measures 0.1, 10 and more.
constexpr double kSoftest = 0.2, kStiffest = 30;

[[noreturn]] void fail(const Place& place, const std::string& path, const std::string& text) {
  throw InputError(place(path) + ": " + path + ": " + text);
}

void check_mesh(const Mesh& mesh, const Place& place) {
  if (mesh.file && mesh.shape) fail(place, "mesh.shape", "given beside mesh.file; expected one of the two");
  if (!mesh.file && !mesh.shape) {
    fail(place, "mesh", "neither mesh.file nor mesh.shape is given; expected one of the two");
  }
  if (mesh.shape) return;
  const std::string extension = std::filesystem::path(*mesh.file).extension().string();
  if (!std::set<std::string>{".vtu", ".vtk", ".msh", ".pts", ".elem", ".lon"}.contains(extension)) {
    fail(place, "mesh.file",
         "found \"" + *mesh.file +
             "\", expected a tetrahedral mesh (.vtu, .vtk, .msh or .pts); `cardiac mesh import` makes one of "
             "a "
             "closed surface");
  }
  if (!mesh.length_unit) {
    fail(place, "mesh.length_unit",
         "missing; expected the length unit of " + *mesh.file + ": one of \"mm\", \"cm\", \"m\"");
  }
  if (mesh.surface_file && mesh.surface_files)
    fail(place, "mesh.surface_files", "found beside mesh.surface_file, expected one of them");
  std::set<std::variant<int, std::string>> seen;
  for (const auto& labels : {mesh.endo_label, mesh.epi_label, mesh.base_label, mesh.rv_endo_label})
    for (const auto& label : labels.value_or(Labels{}))
      if (!seen.insert(label).second) {
        fail(place, "mesh.endo_label", "endo_label, epi_label, base_label and rv_endo_label must differ");
      }
}

double norm(const Vector3& v) {
  return std::hypot(v[0], v[1], v[2]);
}

void check_anatomy(const Anatomy& anatomy, const Place& place) {
  const int ways = static_cast<int>(anatomy.anterior_direction.has_value()) +
                   static_cast<int>(anatomy.septum_point.has_value()) +
                   static_cast<int>(anatomy.rv_insertion_point.has_value());
  if (ways > 1)
    fail(place, anatomy.septum_point ? "anatomy.septum_point" : "anatomy.rv_insertion_point",
         "found beside another key that says where anterior is; expected one of anterior_direction, "
         "septum_point and rv_insertion_point");
  const Vector3 a = anatomy.anterior_direction.value_or(Vector3{0, 1, 0});
  if (norm(a) == 0) fail(place, "anatomy.anterior_direction", "found a vector of length 0");
  if (!anatomy.long_axis) return;
  const Vector3& b = *anatomy.long_axis;
  if (norm(b) == 0) fail(place, "anatomy.long_axis", "found a vector of length 0");
  if (!anatomy.anterior_direction && ways > 0) return;
  const Vector3 cross = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const double sine_of_one_degree = 0.01745;
  if (norm(cross) < sine_of_one_degree * norm(a) * norm(b)) {
    fail(place, "anatomy.anterior_direction",
         "parallel to anatomy.long_axis; expected a direction across the long axis");
  }
}

void check_rings(const Reduction& reduction, const Place& place) {
  const std::size_t n = reduction.ring_nodes.size();
  if (n == 0) fail(place, "reduction.ring_nodes", "found an empty list, expected at least one ring");
  const std::string each = std::to_string(n) + (n == 1 ? " ring" : " rings") + " of reduction.ring_nodes";
  if (reduction.ring_positions) {
    const auto& u = *reduction.ring_positions;
    if (u.size() != n || u.front() <= 0 || u.back() >= 1 ||
        std::ranges::adjacent_find(u, std::greater_equal<>()) != u.end())
      fail(place, "reduction.ring_positions",
           "expected positions that rise between apex (0) and base (1), one for each of the " + each);
  }
  if (reduction.ring_angles_deg && reduction.ring_angles_deg->size() != n)
    fail(place, "reduction.ring_angles_deg",
         "found " + std::to_string(reduction.ring_angles_deg->size()) +
             " angles, expected one for each of the " + each);
}

void check_reduction(const Reduction& reduction, const Place& place) {
  std::set<std::string> seen;
  for (const std::string& monomial : reduction.enrichment.value_or(std::vector<std::string>{})) {
    std::string sorted = monomial;
    std::ranges::sort(sorted);
    if (!std::regex_match(monomial, std::regex("[lct]{2,3}")) || !seen.insert(sorted).second) {
      fail(place, "reduction.enrichment",
           "found \"" + monomial +
               "\", expected different products of two or three of the letters l, c, t, such as \"tt\", "
               "\"lt\", \"ctt\"");
    }
  }
  check_rings(reduction, place);
  if (reduction.border_functions.value_or(false) && !aha_tents(reduction))
    fail(place, "reduction.border_functions",
         "found true with other frames, expected ring_nodes [4, 6, 6], no ring_angles_deg and weights "
         "\"tents\"");
}

// The pressures take the rest of the bulk modulus, so there must be one.
void check_local_bulk_modulus(const Protocol& protocol, const Place& place) {
  const Reduction& reduction = protocol.reduction;
  const double local = reduction.local_bulk_modulus_kPa, whole = protocol.tissue.bulk_modulus_kPa;
  if (reduction.method == Method::fem || reduction.pressure_space == PressureSpace::none ||
      protocol.tissue.law == TissueLaw::saint_venant_kirchhoff || local < whole)
    return;
  std::ostringstream text;
  text << "found " << local << " kPa, expected less than tissue.bulk_modulus_kPa, which is " << whole
       << " kPa";
  fail(place, "reduction.local_bulk_modulus_kPa", text.str());
}

void check_activity(const Protocol& protocol, const Place& place) {
  if (protocol.contraction && !protocol.activation) {
    fail(place, "contraction", "needs a table [activation] that says when the muscle is excited");
  }
  if (protocol.activation && protocol.activation->mode == ActivationMode::sites &&
      protocol.activation->site_segments.empty() && protocol.activation->sites_mm.empty()) {
    fail(place, "activation.mode",
         "\"sites\" needs activation.site_segments (AHA segments) or activation.sites_mm (points in mm)");
  }
  if (const auto& a = protocol.activation) {
    if (a->mode == ActivationMode::array && !protocol.mesh.file)
      fail(place, "activation.mode",
           "found \"array\" beside mesh.shape; expected a mesh.file with point data");
    if (a->mode == ActivationMode::array && a->array_ms && a->array_s)
      fail(place, "activation.array_s", "found beside activation.array_ms, expected one of them");
    if (a->mode == ActivationMode::table && !a->file)
      fail(place, "activation.times_file",
           "missing; expected a table (.csv) with x_mm, y_mm, z_mm and activation_ms");
  }
  if (needs_fibres(protocol) && !protocol.fibres) {
    fail(place, "fibres", "missing; expected a table [fibres]: " + why_fibres(protocol));
  }
  if (protocol.fibres && protocol.fibres->source == FibreSource::file && !protocol.mesh.file)
    fail(place, "fibres.source",
         "found \"file\" beside mesh.shape; expected \"rule\" or a mesh.file with fibres");
}

// What does not know a tension that feels the fibre, and numbers that contradict each other.
void check_sarcomeres(const Protocol& protocol, const Place& place) {
  const Contraction& c = *protocol.contraction;
  if (!c.feels_fibre()) return;
  const std::string model = "found contraction.model = " + name_of(c.model);
  if (protocol.reduction.method == Method::polyaffine && protocol.reduction.preset != Preset::tuned &&
      protocol.reduction.integration == Integration::trained)
    fail(place, "reduction.integration",
         "found trained; " + model +
             ", whose tension trained points do not know; expected cells or gauss, or preset = \"tuned\"");
  if (c.model == ContractionModel::bestel_clement_sorine && c.contractility_kPa == 0)
    fail(place, "contraction.contractility_kPa", model + " and 0 kPa, expected more than 0");
  if (c.model != ContractionModel::land_2017 || c.calcium_file) return;
  if (!(c.peak_calcium_uM > c.diastolic_calcium_uM))
    fail(place, "contraction.peak_calcium_uM",
         "found " + number_text(c.peak_calcium_uM) + " uM, expected more than diastolic_calcium_uM, " +
             number_text(c.diastolic_calcium_uM) + " uM");
  const auto [rise, decay] = calcium_times(c, protocol.time);
  if (!(decay > rise))
    fail(place, "contraction.calcium_decay_ms",
         "found " + number_text(decay) + " ms, expected more than the rise, " + number_text(rise) + " ms");
}

// Contraction and relaxation must fit into a beat.
void check_contraction_time(const Protocol& protocol, const Place& place) {
  if (!protocol.contraction || protocol.contraction->model == ContractionModel::table) return;
  const double beat = protocol.time.beat_ms;
  check_sarcomeres(protocol, place);
  if (protocol.contraction->model == ContractionModel::land_2017) return;
  try {
    check_contraction(bestel_parameters(*protocol.contraction, protocol.time), beat);
  } catch (const InputError& error) {
    std::ostringstream text;
    text << "found " << activation_duration_ms(*protocol.contraction, protocol.time)
         << " ms, expected less than fills a beat, which lasts " << beat
         << " ms at time.heart_rate_bpm = " << ms_per_min / protocol.time.beat_ms
         << " (without the key systole follows the rate): " << error.what();
    fail(place, "contraction.activation_duration_ms", text.str());
  }
}

// What can be told without the mesh: that nothing holds a heart whose base moves, and what does not know such
// a base.
void check_boundary(const Protocol& protocol, const Place& place) {
  const Boundary& b = protocol.boundary;
  if (b.epicardial_weight_array && protocol.mesh.shape)
    fail(place, "boundary.epicardial_weight_array",
         "found \"" + *b.epicardial_weight_array +
             "\" beside mesh.shape, expected a mesh.file with such an array");
  if (b.epicardial_weight_array && protocol.reduction.method == Method::polyaffine &&
      protocol.reduction.preset == Preset::tuned)
    fail(place, "boundary.epicardial_weight_array",
         "found with reduction.preset = tuned, whose file does not hold it; expected preset = \"fast\" or "
         "\"accurate\", or weights by height alone");
  if (!b.base_moves()) return;
  const std::string base = "found boundary.base = " + name_of(b.base) + ", expected ";
  if (b.base == Base::elastic && b.base_normal_stiffness_kPa_per_mm == 0 &&
      b.base_inplane_stiffness_kPa_per_mm == 0 && b.epicardial_stiffness_kPa_per_mm == 0)
    fail(place, "boundary.base_normal_stiffness_kPa_per_mm",
         "nothing holds the heart: found 0 kPa/mm, like base_inplane_stiffness_kPa_per_mm and "
         "epicardial_stiffness_kPa_per_mm; expected some of them above 0 kPa/mm");
  const Reduction& reduction = protocol.reduction;
  if (reduction.method == Method::fem) return;
  if (reduction.weights == Weights::sigmoid)
    fail(place, "reduction.weights", base + "weights = \"tents\" with it: the others vanish at the base");
  if (reduction.preset == Preset::tuned)
    fail(place, "reduction.preset",
         base +
             "preset = \"fast\" or \"accurate\" with it: equilibria of a wall whose base is free, which a "
             "tuned model learns from, are not found in useful time");
  if (reduction.integration == Integration::trained)
    fail(place, "reduction.integration", base + "integration = \"cells\" or \"gauss\" with it");
}

void check_load(const Protocol& protocol, const Place& place) {
  if (protocol.cavities && protocol.circulation) {
    fail(place, "cavities",
         "given beside [circulation]; expected either a prescribed pressure or a circulation");
  }
  if (protocol.cavities && protocol.cavities->pressure_file && protocol.cavities->volume_file)
    fail(place, "cavities.volume_file", "found beside cavities.pressure_file, expected one of them");
  if (protocol.circulation && protocol.circulation->loop == Loop::svzerod) {
    if (!protocol.circulation->svzerod_file)
      fail(place, "circulation.svzerod_file", "missing; expected a model of svZeroDSolver (.json)");
    if (!protocol.circulation->svzerod_units)
      fail(place, "circulation.svzerod_units",
           "missing; expected the units of " + *protocol.circulation->svzerod_file +
               ": one of \"mmHg_mL_s\", \"dyn_cm_s\", \"Pa_m_s\"");
  }
  if (protocol.circulation && !protocol.contraction) {
    fail(place, "circulation",
         "needs a table [contraction]; for passive filling expected [cavities] with pressure_mmHg");
  }
  if (!protocol.cavities && !protocol.contraction) {
    fail(place, "cavities",
         "nothing loads the ventricle: expected [cavities] with pressure_mmHg, or [contraction]");
  }
}

void check_segments(const std::vector<int>& segments, Scheme scheme, const std::string& path,
                    const Place& place) {
  const int last = scheme == Scheme::aha29 ? 29 : 17;
  for (const int segment : segments)
    if (segment > last)
      fail(place, path,
           "found segment " + std::to_string(segment) + ", expected at most " + std::to_string(last) +
               " with the anatomy.scheme " + name_of(scheme));
}

void check_regions(const std::vector<RegionOverride>& regions, Scheme scheme, const Place& place) {
  std::map<int, std::size_t> owner;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const std::string path = key_path("region", i, "segments");
    if (regions[i].segments.empty()) fail(place, path, "found an empty list, expected at least one segment");
    check_segments(regions[i].segments, scheme, path, place);
    for (const int segment : regions[i].segments) {
      const auto [found, is_new] = owner.emplace(segment, i);
      if (!is_new) {
        fail(place, path,
             "segment " + std::to_string(segment) + " is named twice (already in region " +
                 std::to_string(found->second + 1) + "); expected each segment in one region at most");
      }
    }
  }
}

}  // namespace

void fill_scheme(Protocol& protocol) {
  std::optional<Scheme>& scheme = protocol.anatomy.scheme;
  protocol.scheme_assumed = !scheme && !protocol.mesh.shape;
  if (!scheme) scheme = protocol.mesh.shape == Shape::human_biventricle ? Scheme::aha29 : Scheme::aha17;
}

void warn_of_limits(Protocol& protocol, const Place& place) {
  if (protocol.reduction.method == Method::fem) return;
  for (std::size_t i = 0; i < protocol.regions.size(); ++i) {
    const double factor = protocol.regions[i].stiffness_factor;
    if (factor >= kSoftest && factor <= kStiffest) continue;
    std::ostringstream text;
    const std::string path = key_path("region", i, "stiffness_factor");
    text << place(path) << ": " << path << ": found " << factor << "; below " << kSoftest << " and above "
         << kStiffest
         << " the reduced model, whose functions reach over the borders of segments, may be too stiff there; "
            "compare with reduction.method = \"fem\"";
    protocol.warnings.push_back(text.str());
  }
}

std::string why_fibres(const Protocol& protocol) {
  const Tissue& tissue = protocol.tissue;
  if (protocol.contraction) return "the muscle contracts along them";
  if (tissue.law == TissueLaw::holzapfel_ogden) return "the law holzapfel_ogden is anisotropic";
  if (tissue.law == TissueLaw::guccione && (tissue.bf != tissue.bt || tissue.bf != tissue.bfs)) {
    return "the law guccione is anisotropic (bf, bt and bfs differ)";
  }
  return "";
}

bool needs_fibres(const Protocol& protocol) {
  return !why_fibres(protocol).empty();
}

void check_rules(const Protocol& protocol, const Place& place) {
  check_mesh(protocol.mesh, place);
  check_anatomy(protocol.anatomy, place);
  check_reduction(protocol.reduction, place);
  check_local_bulk_modulus(protocol, place);
  check_activity(protocol, place);
  check_contraction_time(protocol, place);
  check_load(protocol, place);
  check_boundary(protocol, place);
  check_regions(protocol.regions, protocol.scheme_assumed ? Scheme::aha29 : *protocol.anatomy.scheme, place);
}

}  // namespace cardiac::protocol
