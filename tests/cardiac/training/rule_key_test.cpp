#include <gtest/gtest.h>

#include <memory>
#include <set>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/protocol/build_anatomy.hpp>
#include <cardiac/protocol/key.hpp>
#include <cardiac/training/trained_rule.hpp>

namespace cardiac {
namespace {

using protocol::Json;
using protocol::Kind;

// Another value that the key accepts; null where there is none.
Json another(const protocol::Key& key, const Json& value) {
  std::vector<Json> candidates;
  if (key.kind == Kind::number || key.kind == Kind::whole)
    for (const double x : {1.0, 2.0, 3.0, 0.25, 30.0})
      candidates.emplace_back(key.kind == Kind::whole ? Json(int(x)) : Json(x));
  if (key.kind == Kind::flag) candidates = {true, false};
  if (key.kind == Kind::choice) candidates.assign(key.choices.begin(), key.choices.end());
  if (key.kind == Kind::texts) candidates = {Json::array({"ll"}), Json::array({"tt"})};
  if (key.kind == Kind::wholes) candidates = {Json::array({4, 6}), Json::array({5, 7})};
  if (key.kind == Kind::numbers) candidates = {Json::array({0.3, 0.6, 0.9}), Json::array({0.2, 0.6, 0.9})};
  for (const Json& candidate : candidates)
    if (candidate != value && protocol::acceptable(key, candidate)) return candidate;
  return {};
}

// A rule serves every scene that training does not tell apart, and no other: each key of the tables is
// changed alone, and the key of the rule must follow just where training reads it.
TEST(RuleKey, ChangesWithAllThatTrainingReadsAndNothingElse) {
  Protocol base = parse_protocol(
      "[mesh]\nshape = \"land_ellipsoid\"\n[contraction]\n[activation]\n[fibres]\n[circulation]\n", "rule");
  auto mesh = structured_ellipsoid(land_ellipsoid(), {4, 8, 1});
  const Anatomy anatomy = build_anatomy(std::move(mesh.mesh), base, {mesh.midpoints, {}});
  const std::string before = rule_key(anatomy, base);
  const std::set<std::string> read{"reduction", "tissue", "fibres", "boundary"};
  const std::set<std::string> without{
      "reduction.method", "reduction.preset", "reduction.integration", "reduction.element_order",
      "reduction.accuracy_percent", "reduction.budget_s", "reduction.affine_frames",
      "tissue.density_g_per_mL", "fibres.source", "fibres.rule",
      // rules are not trained where the base moves
      "boundary.base_normal_stiffness_kPa_per_mm", "boundary.base_normal_damping_kPa_ms_per_mm",
      "boundary.base_inplane_stiffness_kPa_per_mm", "boundary.base_inplane_damping_kPa_ms_per_mm",
      // plays a part with another weight alone
      "boundary.epicardial_weight_law", "boundary.epicardial_damping_kPa_ms_per_mm",
      "contraction.cross_fibre_fraction"};
  int changed = 0;
  for (const protocol::Table& table : protocol::tables()) {
    if (table.list || table.count(base) == 0) continue;
    for (const protocol::Key& key : table.keys) {
      const std::string name = table.name + '.' + key.name;
      const Json other = another(key, key.get(base, 0));
      if (other.is_null()) continue;
      Protocol moved = base;
      key.set(moved, 0, other);
      const bool expected = (read.contains(table.name) && !without.contains(name)) ||
                            name == "contraction.cross_fibre_fraction";
      EXPECT_EQ(rule_key(anatomy, moved) != before, expected) << name;
      changed += expected;
    }
  }
  EXPECT_GT(changed, 30);
  Protocol pressed = base;
  pressed.circulation.reset();
  pressed.cavities.emplace().pressure_kPa = 2;
  EXPECT_NE(rule_key(anatomy, pressed), before);
}

}  // namespace
}  // namespace cardiac
