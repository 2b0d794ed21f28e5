#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include <cardiac/protocol/describe.hpp>
#include <cardiac/training/trained_rule.hpp>
#include <polyaffine/core/cache.hpp>
#include <polyaffine/mesh/digest.hpp>

namespace cardiac {

using polyaffine::CompressedRule;
using polyaffine::Vector;

namespace {

constexpr const char* kKind =
    "cubature-8";  // the number changes when the training or the points it chooses from do

// The mesh and the parts of a protocol that the training reads.
std::string rule_key(const Anatomy& anatomy, const Protocol& protocol) {
  nlohmann::json parts = resolved_json(protocol);
  for (const char* part : {"mesh", "activation", "circulation", "region", "time", "output"})
    parts.erase(part);
  if (protocol.circulation) parts["circulation"] = true;
  if (protocol.contraction)
    parts["contraction"] = {{"cross_fibre_fraction", protocol.contraction->cross_fibre_fraction}};
  return polyaffine::digest(anatomy.mesh) + ' ' + parts.dump();
}

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

TrainedRule cached_rule(const std::shared_ptr<const Anatomy>& anatomy, const Protocol& protocol) {
  // Fibres that are not the protocol's own rule are not part of the key.
  const std::string key = anatomy->fibres ? "" : rule_key(*anatomy, protocol);
  if (const auto stored = key.empty() ? std::nullopt : polyaffine::read_cache(kKind, key)) {
    std::istringstream in(*stored);
    const CompressedRule wall = read_rule(in);
    return {wall, read_rule(in)};
  }
  TrainedRule rule = train_rule(anatomy, protocol);
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

template <class Places>
void keep(const CompressedRule& rule, Places& places) {
  std::vector<int> tet;
  for (const int p : rule.points) tet.push_back(places.tet[p]);
  places.tet = std::move(tet);
  places.barycentric = Eigen::Matrix4Xd(places.barycentric(Eigen::all, rule.points));
  places.weights = Vector(places.weights(rule.points).cwiseProduct(rule.weights));
  places.starts = kept_starts(places.starts, rule.points);
}

}  // namespace

Discretisation with_rule(const Discretisation& all_points, const TrainedRule& rule) {
  Discretisation out = all_points;
  keep(rule.wall, out.points);
  if (out.cavities.empty()) return out;
  auto& surface = out.cavities.front().points;
  keep(rule.cavity, surface);
  for (auto* columns : {&surface.X, &surface.X_xi, &surface.X_eta})
    *columns = polyaffine::Points((*columns)(Eigen::all, rule.cavity.points));
  return out;
}

}  // namespace cardiac
