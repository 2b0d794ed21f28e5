#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include <cardiac/reduction/nested_space.hpp>
#include <cardiac/training/trained_rule.hpp>
#include <polyaffine/core/cache.hpp>
#include <polyaffine/mesh/digest.hpp>

namespace cardiac {

using polyaffine::CompressedRule;
using polyaffine::Vector;

namespace {

constexpr const char* kKind =
    "cubature-9";  // the number changes when the training or the points it chooses from do

void write_rule(const CompressedRule& rule, std::ostream& out) {
  out << rule.points.size() << ' ' << std::hexfloat << rule.residual << '\n';
  for (std::size_t i = 0; i < rule.points.size(); ++i)
    out << rule.points[i] << ' ' << rule.weights[static_cast<Eigen::Index>(i)] << '\n';
}

// strtod reads the hexadecimal numbers, streams do not.
double read_number(std::istream& in) {
  std::string text;
  in >> text;
  return std::strtod(text.c_str(), nullptr);
}

CompressedRule read_rule(std::istream& in) {
  std::size_t count = 0;
  in >> count;
  CompressedRule rule;
  rule.residual = read_number(in);
  rule.weights.resize(static_cast<Eigen::Index>(count));
  for (double& weight : rule.weights) {
    int point = 0;
    in >> point;
    rule.points.push_back(point);
    weight = read_number(in);
  }
  return rule;
}

}  // namespace

// All members of the parts that training reads, each behind its name; a new one has a place here.
std::string rule_key(const Anatomy& anatomy, const Scene& scene) {
  nlohmann::json key;
  const scene::Reduction& r = scene.reduction;
  key["reduction"] = {{"weights", r.weights},
                      {"sigmoid_slope", r.sigmoid_slope},
                      {"enrichment", r.enrichment.value()},
                      {"pressure_space", r.pressure_space.value()},
                      {"border_functions", r.border_functions.value()},
                      {"local_bulk_modulus_kPa", r.local_bulk_modulus_kPa},
                      {"axes", r.axes},
                      {"ring_nodes", r.ring_nodes},
                      {"ring_positions", r.ring_positions.value_or(std::vector<double>{})},
                      {"ring_angles_deg", r.ring_angles_deg.value_or(std::vector<double>{})}};
  const scene::Tissue& t = scene.tissue;
  key["tissue"] = {
      {"law", t.law},
      {"guccione", {t.C_kPa, t.bf, t.bt, t.bfs}},
      {"holzapfel_ogden", {t.a_kPa, t.b, t.a_f_kPa, t.b_f, t.a_s_kPa, t.b_s, t.a_fs_kPa, t.b_fs}},
      {"neo_hookean", t.mu_kPa},
      {"mooney_rivlin", {t.c1_kPa, t.c2_kPa}},
      {"saint_venant_kirchhoff", {t.youngs_modulus_kPa, t.poisson_ratio}},
      {"bulk_modulus_kPa", t.bulk_modulus_kPa},
      {"viscosity_kPa_ms", t.viscosity_kPa_ms}};
  if (const auto& f = scene.fibres)
    key["fibres"] = {f->endo_angle_deg, f->epi_angle_deg, f->sheet_angle_deg, f->rv_endo_angle_deg,
                     f->rv_epi_angle_deg};
  if (scene.contraction) key["cross_fibre_fraction"] = scene.contraction->cross_fibre_fraction;
  if (scene.cavities) key["cavities"] = scene.cavities->pressure_kPa;
  key["circulation"] = scene.circulation.has_value();
  const scene::Boundary& b = scene.boundary;
  key["boundary"] = {b.base, b.epicardial_stiffness_kPa_per_mm, b.epicardial_directions};
  if (b.epicardial_apex_weight != 1 || b.epicardial_base_weight != 1)
    key["epicardial_weight"] = {b.epicardial_apex_weight, b.epicardial_base_weight, b.epicardial_weight_law};
  if (b.epicardial_weight_array) key["epicardial_weight_array"] = *b.epicardial_weight_array;
  return polyaffine::digest(anatomy.mesh) + ' ' + key.dump();
}

TrainedRule cached_rule(const std::shared_ptr<const Anatomy>& anatomy, const Scene& scene) {
  // Fibres that are not the scene's own rule are not part of the key.
  const std::string key = anatomy->fibres ? "" : rule_key(*anatomy, scene);
  if (const auto stored = key.empty() ? std::nullopt : polyaffine::read_cache(kKind, key)) {
    std::istringstream in(*stored);
    const CompressedRule wall = read_rule(in);
    return {wall, read_rule(in)};
  }
  TrainedRule rule = train_rule(anatomy, scene);
  if (key.empty()) return rule;
  std::ostringstream out;
  write_rule(rule.wall, out);
  write_rule(rule.cavity, out);
  polyaffine::write_cache(kKind, key, out.str());
  return rule;
}

namespace {

// Starts of the blocks that still have points.
std::vector<int> kept_starts(const std::vector<int>& starts, const std::vector<int>& points) {
  std::vector<int> out{0};
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
    const auto end =
        static_cast<int>(std::lower_bound(points.begin(), points.end(), starts[k + 1]) - points.begin());
    if (end > out.back()) out.push_back(end);
  }
  return out;
}

KeptPoints which(const CompressedRule& rule, const std::vector<int>& starts, const Vector& weights) {
  return {rule.points, weights(rule.points).cwiseProduct(rule.weights), kept_starts(starts, rule.points)};
}

}  // namespace

Discretisation with_rule(const Discretisation& all_points, const TrainedRule& rule) {
  Discretisation out = all_points;
  const auto& points = all_points.points;
  out.points = kept(points, which(rule.wall, points.starts, points.weights));
  if (out.cavities.empty()) return out;
  const auto& surface = all_points.cavities.front().points;
  out.cavities.front().points = kept(surface, which(rule.cavity, surface.starts, surface.weights));
  return out;
}

}  // namespace cardiac
