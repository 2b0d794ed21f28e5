#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace cardiac {

/// A surface in a file: its number or its name.
using SurfaceLabel = std::variant<int, std::string>;

/// Which surfaces of a file are what, as the user says; empty: by their names, or by the numbers 1
/// (endocardium), 2 (epicardium), 3 (base), 4 (endocardium of the right ventricle).
struct SurfaceLabelMap {
  std::vector<SurfaceLabel> endo{}, epi{}, base{}, rv_endo{};
  bool rest_is_base = false;  ///< boundary without a label is base; no label need say so
};

/// The numbers that a label stands for; `names` are the file's names of some of them.
std::vector<int> matching_labels(const SurfaceLabel& label, const std::set<int>& numbers,
                                 const std::map<int, std::string>& names);

/// A label as a message tells it: 7, "endo".
std::string label_text(const SurfaceLabel& label);

/// The surface with a label (kEndocardium, …) in words: "right endocardium".
const char* surface_title(int label);

/// The label (kEndocardium, kEpicardium, kBase, kRvEndocardium) behind a name in common use: lv_endo,
/// ENDO_LV, endocardium, Epicardium, base, top, mitral valve, RV, …; none for other names.
std::optional<int> surface_of_name(const std::string& name);

/// The labels behind the numbers of a file; `names` are the file's names of some of them. Empty when nothing
/// is said and no number or name is known. Throws InputError naming the numbers of the file when a surface
/// that the user names is not there, one of endocardium, epicardium and base is missing, or a number is
/// claimed twice.
std::map<int, int> heart_labels(const std::set<int>& numbers, const std::map<int, std::string>& names,
                                const SurfaceLabelMap& map);

}  // namespace cardiac
