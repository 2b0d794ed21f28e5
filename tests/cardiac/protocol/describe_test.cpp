#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include <cardiac/protocol/describe.hpp>
#include <cardiac/protocol/key.hpp>
#include <cardiac/protocol/nearest_key.hpp>

#include "texts.hpp"

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

namespace {

/// The object schema of a table; of an entry for a list of tables.
json object_schema(const json& table) {
  return table.at("type") == "array" ? table.at("items") : table;
}

std::string toml_of(const json& resolved) {
  std::string text;
  for (const auto& [name, table] : resolved.items()) {
    const json entries = table.is_array() ? table : json::array({table});
    for (const auto& entry : entries) {
      text += table.is_array() ? "[[" + name + "]]\n" : '[' + name + "]\n";
      for (const auto& [key, value] : entry.items()) text += key + " = " + value.dump() + '\n';
    }
  }
  return text;
}

/// A value that the key accepts and that differs from its default.
json other_value(const cardiac::protocol::Key& key, const json& standard) {
  using cardiac::protocol::Kind;
  const auto& range = key.facts.range;
  const double low = std::max(range.low, -100.0), high = std::min(range.high, 100.0);
  switch (key.kind) {
    case Kind::number:
      return low + 0.25 * (high - low);
    case Kind::whole:
      return standard == 2 ? 1 : 2;
    case Kind::flag:
      return !(standard.is_boolean() && standard.get<bool>());
    case Kind::text:
      return "other";
    case Kind::choice:
      return key.choices.back() == standard ? key.choices.front() : key.choices.back();
    case Kind::numbers:
      return json::array({0.25});
    case Kind::wholes:
      return json::array({3, 4});
    case Kind::texts:
      return json::array({"lt"});
    case Kind::labels:
      return json::array({7, "outer"});
    case Kind::vector:
      return json::array({1.5, 2.5, 3.5});
    case Kind::vectors:
      return json::array({json::array({1.5, 2.5, 3.5})});
  }
  return {};
}

TEST(KeyTable, EachKeyFillsItsOwnMember) {
  using namespace cardiac::protocol;
  const auto values = [](const cardiac::Protocol& protocol) {
    std::vector<json> all;
    for (const Table& table : tables()) {
      for (const Key& key : table.keys) all.push_back(key.get(protocol, 0));
    }
    return all;
  };
  const auto standard = values(default_protocol());
  std::size_t row = 0;
  for (const Table& table : tables()) {
    for (const Key& key : table.keys) {
      auto protocol = default_protocol();
      const json value = other_value(key, standard[row]);
      if (value != standard[row]) {
        ASSERT_TRUE(acceptable(key, value)) << key.name << ' ' << value;
        key.set(protocol, 0, value);
      }
      const auto changed = values(protocol);
      for (std::size_t i = 0; i < changed.size(); ++i) {
        EXPECT_EQ(changed[i], i == row ? value : standard[i]) << "changed by " << key.name;
      }
      ++row;
    }
  }
  EXPECT_GT(row, 80u);
}

TEST(KeyTable, DefaultsAreAcceptable) {
  using namespace cardiac::protocol;
  for (const Table& table : tables()) {
    for (const Key& key : table.keys) {
      const json value = key.get(default_protocol(), 0);
      EXPECT_TRUE(value.is_null() || acceptable(key, value)) << table.name << '.' << key.name << ' ' << value;
    }
  }
}

TEST(KeyTable, UnitsInNamesAreStated) {
  const std::regex unit(
      "(_(mm|ms|kPa|mmHg|mL|deg|percent|bpm|uM)|(budget|array)_s|_per_(mm|ms|s|mL|mL2|mmHg))$");
  for (const auto& path : cardiac::key_paths()) {
    const auto text = cardiac::explain(path);
    EXPECT_EQ(std::regex_search(path, unit), text.find("\n  unit      ") != std::string::npos &&
                                                 text.find("dimensionless") == std::string::npos)
        << text;
  }
}

/// The schema of every table by its name, those within a table by both names.
std::vector<std::pair<std::string, json>> table_schemas(const json& schema) {
  std::vector<std::pair<std::string, json>> out;
  for (const auto& [name, table] : schema.at("properties").items()) {
    out.emplace_back(name, table);
    const json properties = object_schema(table).at("properties");
    for (const auto& [key, property] : properties.items())
      if (property.value("type", "") == "array" && property.at("items").contains("properties"))
        out.emplace_back(name + '.' + key, property);
  }
  return out;
}

TEST(Schema, IsStrictAndListsTheKeysThatParse) {
  const json schema = json::parse(cardiac::protocol_schema().dump());
  EXPECT_EQ(schema.at("additionalProperties"), false);
  EXPECT_EQ(schema.at("type"), "object");
  std::set<std::string> paths;
  for (const auto& [name, table] : table_schemas(schema)) {
    const json object = object_schema(table);
    EXPECT_EQ(object.at("additionalProperties"), false) << name;
    for (const auto& [key, value_schema] : object.at("properties").items()) {
      const json& property = value_schema;  // which lambdas may take, a binding not
      if (property.value("type", "") == "array" && property.at("items").contains("properties")) continue;
      paths.insert(name + '.' + key);
      // A date is of no key's type: the parser knows the key when it complains of the type.
      const std::string text = table.at("type") == "array" ? "[[" + name + "]]\n" : '[' + name + "]\n";
      EXPECT_THAT(refusal(text + key + " = 2020-01-01\n"),
                  AllOf(HasSubstr('.' + key + ": found a date"), HasSubstr("expected")));
      EXPECT_FALSE(property.at("description").get<std::string>().empty());
    }
  }
  const auto table_paths = cardiac::key_paths();
  EXPECT_EQ(paths, std::set<std::string>(table_paths.begin(), table_paths.end()));
  EXPECT_EQ(paths.size(), table_paths.size());
}

TEST(Schema, RangesAreThoseOfTheParser) {
  const json schema = cardiac::protocol_schema();
  int checked = 0;
  for (const auto& [name, table] : table_schemas(schema)) {
    const json object = object_schema(table);
    for (const auto& [key, value_schema] : object.at("properties").items()) {
      const json& property = value_schema;       // which lambdas may take, a binding not
      if (!property.contains("type")) continue;  // labels: a number or a name
      if (property.at("type") != "number" && property.at("type") != "integer") continue;
      const std::string head =
          (table.at("type") == "array" ? "[[" + name + "]]\n" : '[' + name + "]\n") + key + " = ";
      const auto literal = [&](double value) {
        return property.at("type") == "integer" ? std::to_string(static_cast<long>(value))
                                                : json(value).dump();
      };
      const double step = property.at("type") == "integer" ? 1 : 1e-6;
      ASSERT_TRUE(property.contains("maximum")) << key;
      const double high = property.at("maximum").get<double>();
      EXPECT_THAT(refusal(head + literal(high + step * std::max(1.0, high))), HasSubstr("at most")) << key;
      const bool open = property.contains("exclusiveMinimum");
      const double low = property.at(open ? "exclusiveMinimum" : "minimum").get<double>();
      EXPECT_THAT(refusal(head + literal(open ? low : low - step)), HasSubstr("expected a")) << key;
      ++checked;
    }
  }
  EXPECT_GT(checked, 50);
}

TEST(Explain, TellsEveryKey) {
  for (const auto& path : cardiac::key_paths()) {
    EXPECT_THAT(cardiac::explain(path), AllOf(testing::StartsWith(path + '\n'), HasSubstr("  meaning   "),
                                              HasSubstr("  expected  "), HasSubstr("  default   ")));
  }
  EXPECT_THAT(
      cardiac::explain("tissue.C_kPa"),
      AllOf(HasSubstr("unit      kPa"), HasSubstr("default   2 kPa"), HasSubstr("above 0, at most 1000 kPa"),
            HasSubstr("tissue.law = guccione"), HasSubstr("Guccione 1991")));
  EXPECT_EQ(cardiac::explain("heart_rate_bpm"), cardiac::explain("time.heart_rate_bpm"));
  EXPECT_THAT(cardiac::explain("circulation"),
              AllOf(HasSubstr("compliance_mL_per_mmHg"), HasSubstr("not built")));
}

TEST(Explain, UnknownKeyNamesTheNearest) {
  const auto message = [](const std::string& path) -> std::string {
    try {
      return cardiac::explain(path);
    } catch (const polyaffine::InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message("tissue.C_kpa"), "tissue.C_kpa: unknown key; the nearest known key is tissue.C_kPa");
  EXPECT_THAT(message("fibers"), HasSubstr("nearest known key is fibres"));
  EXPECT_THAT(message("heartrate_bpm"), HasSubstr("time.heart_rate_bpm"));
}

TEST(Explain, EveryDefaultNamesItsSource) {
  using namespace cardiac::protocol;
  for (const Table& table : tables())
    for (const Key& key : table.keys) {
      const bool standard = !key.facts.required && !key.get(default_protocol(), 0).is_null();
      if (standard) {
        EXPECT_FALSE(key.facts.source.empty()) << table.name << '.' << key.name;
        EXPECT_THAT(cardiac::explain(table.name + '.' + key.name), HasSubstr("\n  source    "));
      } else {
        EXPECT_TRUE(key.facts.required || !key.facts.absent.empty()) << table.name << '.' << key.name;
      }
    }
  const json schema = cardiac::protocol_schema();
  EXPECT_EQ(schema.at("properties").at("tissue").at("properties").at("viscosity_kPa_ms").at("source"),
            "Aróstica 2025: 100 Pa·s");
}

TEST(EditDistance, CountsChanges) {
  using cardiac::protocol::edit_distance;
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);  // the textbook pair
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("abc", ""), 3);
  EXPECT_EQ(edit_distance("C_kpa", "c_kPa"), 0);  // case does not count
}

TEST(Resolved, ReadsBackAsTheSameProtocol) {
  const std::vector<cardiac::Protocol> protocols = {
      parsed(kPassive), parsed(kBeat),
      parsed(kBeat, {"boundary.epicardial_stiffness_kPa_per_mm=0.1", "activation.mode=sites",
                     "activation.site_segments=[2]"}),
      cardiac::load_protocol(PROJECT_DIR "/protocols/infarct_lv.toml", {"reduction.preset=accurate"})};
  for (const auto& protocol : protocols) {
    const json resolved = cardiac::resolved_json(protocol);
    const auto again = parsed(toml_of(resolved));
    EXPECT_EQ(cardiac::resolved_json(again), resolved);
    EXPECT_TRUE(again.warnings.empty()) << again.warnings.front();
  }
}

TEST(Resolved, TheShippedHealthyHeartsAreTheDefaults) {
  for (const auto& [name, shape] :
       {std::pair{"healthy_lv", "human_lv"}, {"healthy_biv", "human_biventricle"}}) {
    json shipped = cardiac::resolved_json(
        cardiac::load_protocol(PROJECT_DIR "/protocols/" + std::string(name) + ".toml"));
    json standard = cardiac::resolved_json(parsed(kBeat, {"mesh.shape=" + std::string(shape)}));
    shipped.erase("mesh");
    standard.erase("mesh");
    EXPECT_EQ(shipped, standard) << name;
  }
}

TEST(Resolved, HoldsDefaultsAndLeavesOutWhatPlaysNoPart) {
  const json passive = cardiac::resolved_json(parsed(kPassive));
  EXPECT_EQ(passive.at("time").at("load_steps"), 10);
  EXPECT_FALSE(passive.at("time").contains("heart_rate_bpm"));
  EXPECT_EQ(cardiac::resolved_json(parsed(kBeat)).at("time").at("heart_rate_bpm"), 75);
  EXPECT_EQ(passive.at("reduction").at("enrichment"), json({"tt", "lt"}));
  EXPECT_TRUE(passive.at("tissue").contains("mu_kPa"));
  EXPECT_FALSE(passive.at("tissue").contains("C_kPa"));
  EXPECT_FALSE(passive.contains("circulation"));
  EXPECT_FALSE(passive.contains("region"));
  const json infarct =
      cardiac::resolved_json(cardiac::load_protocol(PROJECT_DIR "/protocols/infarct_lv.toml"));
  EXPECT_EQ(infarct.at("region").at(0).at("segments"), json({1, 2, 7, 8, 13, 14}));
}

}  // namespace
