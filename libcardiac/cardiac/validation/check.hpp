#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <cardiac/anatomy/idealised_biventricle.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac {

/// What a computation behind a check took, and how it ended.
struct CheckRecord {
  int steps = 0, newton_iterations = 0, cuts = 0;
  double simulated_ms = 0;  ///< how far it came
  bool completed = false;
  std::string outcome;  ///< "completed", or why it stopped
  std::vector<std::string> warnings{};
};

/// One number of a validation case against its reference.
struct Check {
  std::string case_name;  ///< "land2"
  std::string method;     ///< "fem_p2", "polyaffine", with what distinguishes it (mesh, nodes, points)
  std::string quantity;   ///< with its unit as suffix, "endo_apex_z_mm"
  std::string unit;       ///< "mm", "1" for none
  double value = 0;
  double reference = 0;
  double low = -std::numeric_limits<double>::infinity();  ///< range accepted, ends included
  double high = std::numeric_limits<double>::infinity();
  std::string source;  ///< where reference and range come from
  double wall_time_s = 0;
  std::optional<CheckRecord> record{};

  bool passed() const { return low <= value && value <= high; }
};

/// What a case needs from outside and what it is asked for.
struct ValidationContext {
  bool quick = false;         ///< a smaller set that tells whether something broke
  std::filesystem::path out;  ///< existing folder for figures and tables beside validation.json
  std::function<polyaffine::TetMesh(const TruncatedEllipsoid& shape, double size_mm)> mesh_ellipsoid;
  /// Unstructured tets of the box [0, size], the six faces labelled 1 to 6: x = 0, x = size, y = 0, …
  std::function<polyaffine::TetMesh(const polyaffine::Vec3& size_mm, double edge_mm)> mesh_box;
  std::function<polyaffine::TetMesh(const IdealisedBiventricle& shape, double size_mm)> mesh_biventricle;
  std::filesystem::path hearts;  ///< folder with the meshes of other origin that some cases compute
  bool named = false;            ///< the case was asked for by its name
  /// Told why a case was left out, whose files are absent, unless it is named.
  std::function<void(const std::string& why)> left_out = [](const auto&) {};
  /// May be called from several threads at once.
  std::function<void(const std::string& what, double fraction)> progress = [](const auto&, double) {};
};

/// A case computes and returns its checks; it throws only when it cannot be carried out at all.
struct ValidationCase {
  std::string name;
  std::string what;  ///< one line for the help
  std::function<std::vector<Check>(const ValidationContext&)> run;
};

/// All cases, in the order of `cardiac validate all`.
const std::vector<ValidationCase>& validation_cases();

/// Another accepted range of a number, for every method of its case.
struct Expectation {
  std::string name;  ///< "case/quantity"
  double low = 0, high = 0;
};

/// From "case/quantity=low:high"; throws InputError when the text has another form.
Expectation parse_expectation(const std::string& text);

/// Throws InputError when no check has the name.
void apply_expectation(const Expectation& expectation, std::vector<Check>& checks);

/// The text of validation.json: {"checks": [...], "passed": ...}; a number that is not finite becomes null
/// and fails.
std::string validation_text(const std::vector<Check>& checks);

bool all_passed(const std::vector<Check>& checks);

}  // namespace cardiac
