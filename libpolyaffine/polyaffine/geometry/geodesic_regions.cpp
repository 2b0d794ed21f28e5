#include "polyaffine/geometry/geodesic_regions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool is_allowed(const std::vector<char>& allowed, int t) {
  return allowed.empty() || allowed[t];
}

void check_labels(const TetMesh& mesh, const std::vector<int>& label) {
  if (static_cast<int>(label.size()) != mesh.num_tets())
    throw std::invalid_argument("region labels: found " + std::to_string(label.size()) +
                                ", expected one a tet, " + std::to_string(mesh.num_tets()));
}

double face_area(const TetMesh& mesh, int t, int k) {
  const Eigen::Vector4i v = mesh.tets().col(t);
  const Vec3 a = mesh.points().col(v[(k + 1) % 4]), b = mesh.points().col(v[(k + 2) % 4]),
             c = mesh.points().col(v[(k + 3) % 4]);
  return (b - a).cross(c - a).norm() / 2;
}

// Parts that are connected through faces and have one label.
std::vector<std::vector<int>> connected_parts(const TetMesh& mesh, const std::vector<int>& label) {
  std::vector<std::vector<int>> parts;
  std::vector<char> seen(label.size(), 0);
  for (int start = 0; start < mesh.num_tets(); ++start) {
    if (seen[start] || label[start] < 0) continue;
    std::vector<int> part{start};
    seen[start] = 1;
    for (size_t next = 0; next < part.size(); ++next)
      for (int k = 0; k < 4; ++k) {
        const int n = mesh.neighbours()(k, part[next]);
        if (n < 0 || seen[n] || label[n] != label[start]) continue;
        seen[n] = 1;
        part.push_back(n);
      }
    parts.push_back(std::move(part));
  }
  return parts;
}

double part_volume(const TetMesh& mesh, const std::vector<int>& part) {
  double volume = 0;
  for (const int t : part) volume += mesh.tet_volume(t);
  return volume;
}

// The label that shares most area with a part, −1 when there is none.
int largest_neighbour(const TetMesh& mesh, const std::vector<int>& label, const std::vector<int>& part) {
  std::map<int, double> area;
  for (const int t : part)
    for (int k = 0; k < 4; ++k) {
      const int n = mesh.neighbours()(k, t);
      if (n >= 0 && label[n] >= 0 && label[n] != label[t]) area[label[n]] += face_area(mesh, t, k);
    }
  const auto most = std::max_element(area.begin(), area.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == area.end() ? -1 : most->first;
}

bool touches(const TetMesh& mesh, const std::vector<int>& part, const std::vector<char>& marked) {
  return std::any_of(part.begin(), part.end(), [&](int t) {
    const Eigen::Vector4i next = mesh.neighbours().col(t);
    return std::any_of(next.begin(), next.end(), [&](int n) { return n >= 0 && marked[n] != 0; });
  });
}

}  // namespace

std::vector<MeshPoint> random_seeds(const TetMesh& mesh, int count, std::mt19937_64& random,
                                    const std::vector<char>& allowed) {
  std::vector<double> volume(mesh.num_tets());
  for (int t = 0; t < mesh.num_tets(); ++t) volume[t] = is_allowed(allowed, t) ? mesh.tet_volume(t) : 0;
  const auto available = std::count_if(volume.begin(), volume.end(), [](double v) { return v > 0; });
  if (count > available)
    throw InputError("random seeds: found " + std::to_string(available) + " tets, expected at least " +
                     std::to_string(count));
  // The `count` smallest of exponential variates with the volumes as rates are a draw without replacement
  // (Efraimidis and Spirakis 2006).
  std::vector<std::pair<double, int>> order;
  std::exponential_distribution<double> exponential;
  for (int t = 0; t < mesh.num_tets(); ++t)
    if (volume[t] > 0) order.emplace_back(exponential(random) / volume[t], t);
  std::sort(order.begin(), order.end());
  std::vector<MeshPoint> seeds(count);
  for (int i = 0; i < count; ++i) seeds[i].tet = order[i].second;
  return seeds;
}

std::vector<int> voronoi_labels(const EikonalSolver& solver, const std::vector<MeshPoint>& seeds,
                                const std::vector<char>& allowed) {
  const TetMesh& mesh = solver.mesh();
  std::vector<EikonalSource> sources(seeds.size());
  for (size_t s = 0; s < seeds.size(); ++s) sources[s].at = seeds[s];
  const Arrival arrival = solver.march(sources, allowed);
  std::vector<int> label(mesh.num_tets(), -1);
  for (int t = 0; t < mesh.num_tets(); ++t) {
    if (!is_allowed(allowed, t)) continue;
    const Vec3 centroid = mesh.tet_centroid(t);
    double least = kInfinity;
    for (const int v : mesh.tets().col(t)) {
      const double time = arrival.time[v] + solver.travel_time(t, centroid - mesh.points().col(v));
      if (time >= least) continue;
      least = time;
      label[t] = arrival.label[v];
    }
  }
  for (size_t s = 0; s < seeds.size(); ++s) label[seeds[s].tet] = static_cast<int>(s);
  return label;
}

GeodesicRegions lloyd_regions(const EikonalSolver& solver, std::vector<MeshPoint> seeds, int max_iterations,
                              const std::vector<char>& allowed) {
  const TetMesh& mesh = solver.mesh();
  const int count = static_cast<int>(seeds.size());
  GeodesicRegions regions;
  while (true) {
    regions.label = connect_regions(mesh, voronoi_labels(solver, seeds, allowed));
    if (regions.iterations == max_iterations) break;
    std::vector<MeshPoint> centres = region_centres(mesh, regions.label, count);
    bool moved = false;
    for (int s = 0; s < count; ++s) moved = moved || centres[s].tet != seeds[s].tet;
    if (!moved) break;
    seeds = std::move(centres);
    ++regions.iterations;
  }
  regions.seeds = std::move(seeds);
  return regions;
}

std::vector<int> connect_regions(const TetMesh& mesh, std::vector<int> label) {
  check_labels(mesh, label);
  while (true) {
    const std::vector<std::vector<int>> parts = connected_parts(mesh, label);
    std::map<int, std::pair<double, size_t>> largest;
    for (size_t p = 0; p < parts.size(); ++p) {
      const double volume = part_volume(mesh, parts[p]);
      auto [it, added] = largest.try_emplace(label[parts[p][0]], volume, p);
      if (!added && volume > it->second.first) it->second = {volume, p};
    }
    std::vector<size_t> islands;
    for (size_t p = 0; p < parts.size(); ++p)
      if (largest[label[parts[p][0]]].second != p) islands.push_back(p);
    // Islands next to one that has just changed wait for the next round, so every change unites two parts.
    std::vector<char> changed(label.size(), 0);
    bool any = false;
    for (const size_t p : islands) {
      const int to = largest_neighbour(mesh, label, parts[p]);
      if (to < 0 || touches(mesh, parts[p], changed)) continue;
      for (const int t : parts[p]) {
        label[t] = to;
        changed[t] = 1;
      }
      any = true;
    }
    if (!any) return label;
  }
}

Vector region_volumes(const TetMesh& mesh, const std::vector<int>& label, int count) {
  check_labels(mesh, label);
  Vector volume = Vector::Zero(count);
  for (int t = 0; t < mesh.num_tets(); ++t)
    if (label[t] >= 0 && label[t] < count) volume[label[t]] += mesh.tet_volume(t);
  return volume;
}

std::vector<MeshPoint> region_centres(const TetMesh& mesh, const std::vector<int>& label, int count) {
  const Vector volume = region_volumes(mesh, label, count);
  Points centre = Points::Zero(3, count);
  for (int t = 0; t < mesh.num_tets(); ++t)
    if (label[t] >= 0 && label[t] < count)
      centre.col(label[t]) += mesh.tet_volume(t) / volume[label[t]] * mesh.tet_centroid(t);
  std::vector<MeshPoint> nearest(count);
  Vector least = Vector::Constant(count, kInfinity);
  for (int t = 0; t < mesh.num_tets(); ++t) {
    const int r = label[t];
    if (r < 0 || r >= count) continue;
    const double distance = (mesh.tet_centroid(t) - centre.col(r)).norm();
    if (distance >= least[r]) continue;
    least[r] = distance;
    nearest[r].tet = t;
  }
  for (int r = 0; r < count; ++r)
    if (nearest[r].tet < 0)
      throw InputError("region " + std::to_string(r) + ": found no tet, expected at least one");
  return nearest;
}

Vector normalised_border_distance(const EikonalSolver& solver, const std::vector<int>& label, int region) {
  const TetMesh& mesh = solver.mesh();
  check_labels(mesh, label);
  if (std::find(label.begin(), label.end(), region) == label.end())
    throw InputError("region " + std::to_string(region) + ": found no tet, expected at least one");
  const int n = mesh.num_points();
  Arrival border{Vector::Constant(n, kInfinity), std::vector<int>(n, -1)};
  std::vector<char> inside(n, 0);
  for (int t = 0; t < mesh.num_tets(); ++t) {
    if (label[t] != region) continue;
    for (int k = 0; k < 4; ++k) {
      inside[mesh.tets()(k, t)] = 1;
      const int neighbour = mesh.neighbours()(k, t);
      if (neighbour < 0 || label[neighbour] == region) continue;
      for (int i = 0; i < 4; ++i)
        if (i != k) border.time[mesh.tets()(i, t)] = 0;
    }
  }
  if (border.time.minCoeff() > 0) return Vector::Constant(n, -1);
  Vector distance = solver.march_from(std::move(border)).time;
  for (int v = 0; v < n; ++v)
    if (inside[v]) distance[v] = -distance[v];
  const double depth = -distance.minCoeff();
  if (!(depth > 0))
    throw InputError(
        "region " + std::to_string(region) +
        ": found no vertex in its interior, expected a region at least two tets wide (refine the "
        "mesh or use fewer regions)");
  return distance / depth;
}

Matrix normalised_border_distances(const EikonalSolver& solver, const std::vector<int>& label, int count) {
  Matrix distance(count, solver.mesh().num_points());
  for (int r = 0; r < count; ++r) distance.row(r) = normalised_border_distance(solver, label, r).transpose();
  return distance;
}

}  // namespace polyaffine
