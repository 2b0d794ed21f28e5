#include "cardiac/anatomy/surface_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include <cardiac/anatomy/idealised.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

using polyaffine::InputError;

struct Role {
  int label;
  const char* name;
  std::vector<SurfaceLabel> SurfaceLabelMap::*member;
};

constexpr std::array<Role, 4> kRoles{{{kEndocardium, "endo", &SurfaceLabelMap::endo},
                                      {kEpicardium, "epi", &SurfaceLabelMap::epi},
                                      {kBase, "base", &SurfaceLabelMap::base},
                                      {kRvEndocardium, "rv_endo", &SurfaceLabelMap::rv_endo}}};

/// Lower-case words: "ENDO_LV" and "endo lv" are "endo" and "lv".
std::vector<std::string> words(const std::string& name) {
  std::vector<std::string> out(1);
  for (const unsigned char c : name) {
    if (std::isalnum(c) != 0)
      out.back() += static_cast<char>(std::tolower(c));
    else if (!out.back().empty())
      out.emplace_back();
  }
  return out;
}

std::string listed(const std::set<int>& numbers, const std::map<int, std::string>& names) {
  std::string out;
  for (const int n : numbers) {
    out += (out.empty() ? "" : ", ") + std::to_string(n);
    if (const auto name = names.find(n); name != names.end()) out += " \"" + name->second + '"';
  }
  return out.empty() ? "none" : out;
}

[[noreturn]] void fail_missing(const SurfaceLabel& label, const Role& role, const std::string& found) {
  throw InputError("mesh: found no triangle with the label " + label_text(label) + " of the surface \"" +
                   role.name + "\" (labels found: " + found + "), expected one; " + role.name +
                   "_label must be a label of the mesh");
}

}  // namespace

std::vector<int> matching_labels(const SurfaceLabel& label, const std::set<int>& numbers,
                                 const std::map<int, std::string>& names) {
  std::vector<int> out;
  for (const int n : numbers) {
    const auto name = names.find(n);
    const auto* wanted = std::get_if<std::string>(&label);
    if (wanted == nullptr ? std::get<int>(label) == n : name != names.end() && name->second == *wanted)
      out.push_back(n);
  }
  return out;
}

const char* surface_title(int label) {
  constexpr std::array titles{"none", "endocardium", "epicardium", "base", "right endocardium"};
  return titles.at(label);
}

std::string label_text(const SurfaceLabel& label) {
  const auto* name = std::get_if<std::string>(&label);
  return name == nullptr ? std::to_string(std::get<int>(label)) : '"' + *name + '"';
}

std::optional<int> surface_of_name(const std::string& name) {
  const std::vector<std::string> parts = words(name);
  const auto contains = [&](const char* text) {
    return std::ranges::any_of(parts, [&](const auto& part) { return part.find(text) != std::string::npos; });
  };
  const auto any_word = [&](std::initializer_list<const char*> texts) {
    return std::ranges::any_of(texts, [&](const char* t) { return std::ranges::count(parts, t) > 0; });
  };
  const bool right = contains("rv") || contains("right");
  if (contains("epi") || any_word({"outer", "outside", "pericardium"})) return kEpicardium;
  if (contains("endo")) return right ? kRvEndocardium : kEndocardium;
  if (contains("valve") || contains("mitral") || contains("aortic") || contains("tricuspid") ||
      contains("pulmonary") || any_word({"base", "basal", "top", "mv", "av", "tv", "pv"}))
    return kBase;
  if (any_word({"rv", "right"})) return kRvEndocardium;
  if (any_word({"lv", "left", "inner", "inside", "cavity"})) return kEndocardium;
  return std::nullopt;
}

std::map<int, int> heart_labels(const std::set<int>& numbers, const std::map<int, std::string>& names,
                                const SurfaceLabelMap& map) {
  std::map<int, int> out;
  const std::string found = listed(numbers, names);
  const auto claim = [&](int number, const Role& role) {
    const auto [at, added] = out.emplace(number, role.label);
    if (!added && at->second != role.label)
      throw InputError("mesh: found the label " + std::to_string(number) + " for two surfaces, \"" +
                       role.name + "\" and another (labels found: " + found +
                       "), expected labels that differ");
  };
  bool said = false;
  for (const Role& role : kRoles)
    for (const SurfaceLabel& label : map.*role.member) {
      said = true;
      const std::vector<int> chosen = matching_labels(label, numbers, names);
      if (chosen.empty()) fail_missing(label, role, found);
      for (const int n : chosen) claim(n, role);
    }
  for (const Role& role : kRoles) {
    if (!(map.*role.member).empty()) continue;
    for (const int n : numbers) {
      if (out.contains(n)) continue;
      const auto name = names.find(n);
      if (name == names.end() ? n == role.label : surface_of_name(name->second) == role.label) claim(n, role);
    }
  }
  if (out.empty() && !said) return out;
  for (const Role& role : kRoles) {
    const bool there =
        std::ranges::any_of(out, [&](const auto& entry) { return entry.second == role.label; });
    if (!there && role.label != kRvEndocardium && !(role.label == kBase && map.rest_is_base))
      fail_missing(role.label, role, found);
  }
  return out;
}

}  // namespace cardiac
