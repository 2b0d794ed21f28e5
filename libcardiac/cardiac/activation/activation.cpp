#include "cardiac/activation/activation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/eikonal.hpp>
#include <polyaffine/geometry/locate.hpp>

namespace cardiac {

using polyaffine::InputError;
using polyaffine::Mat3;
using polyaffine::Points;
using polyaffine::TetMesh;
using polyaffine::Vec3;
using polyaffine::Vector;

std::vector<Mat3> conduction_tensors(const Points& fibre, const ConductionVelocity& velocity) {
  constexpr double kUnitLength = 1e-6;
  const double along = velocity.along_fibre * velocity.along_fibre;
  const double across = velocity.across_fibre * velocity.across_fibre;
  if (!(velocity.along_fibre > 0) || !(velocity.across_fibre > 0) || !std::isfinite(along + across)) {
    std::ostringstream out;
    out << "conduction velocity: found " << velocity.along_fibre << " along and " << velocity.across_fibre
        << " across the fibres, expected positive values in mm/ms";
    throw InputError(out.str());
  }
  std::vector<Mat3> tensors(fibre.cols());
  for (Eigen::Index t = 0; t < fibre.cols(); ++t) {
    const Vec3 f = fibre.col(t);
    if (!(std::abs(f.norm() - 1) < kUnitLength))
      throw InputError("fibre of tet " + std::to_string(t) + ": found length " + std::to_string(f.norm()) +
                       ", expected a unit vector");
    tensors[t] = across * Mat3::Identity() + (along - across) * f * f.transpose();
  }
  return tensors;
}

ActivationMap map_of_array(const polyaffine::MeshFile& file, const std::string& name, double ms,
                           const std::string& source) {
  const auto found = file.point_fields.find(name);
  if (found == file.point_fields.end()) {
    std::string known;
    for (const auto& [other, values] : file.point_fields) known += (known.empty() ? "" : ", ") + other;
    throw InputError(source + ": found no point array \"" + name + "\", expected one of activation times; " +
                     (known.empty() ? "the file has none" : "there are " + known));
  }
  const polyaffine::Matrix& values = found->second;
  if (values.rows() != 1)
    throw InputError(source + ": point array \"" + name + "\": found " + std::to_string(values.rows()) +
                     " components, expected one time a point");
  constexpr double kLongest_ms = 1e5;
  for (Eigen::Index i = 0; i < values.cols(); ++i)
    if (!(std::abs(values(0, i) * ms) <= kLongest_ms))
      throw InputError(source + ": point array \"" + name + "\", point " + std::to_string(i) + ": found " +
                       std::to_string(values(0, i)) + ", expected a time of at most 100000 ms");
  return {file.mesh.points(), Vector(ms * values.row(0).transpose())};
}

Vector mapped_times(const TetMesh& mesh, const ActivationMap& map, double largest_gap) {
  constexpr int kNeighbours = 4;
  constexpr double kSamePlace = 1e-6;  // mm
  const auto count = map.points.cols();
  if (count == 0) throw InputError("activation: found no point with a time, expected at least one");
  const int used = static_cast<int>(std::min<Eigen::Index>(kNeighbours, count));
  Vector out(mesh.num_points());
  struct Near {
    double distance;
    Eigen::Index point;
  };
  for (Eigen::Index v = 0; v < mesh.num_points(); ++v) {
    std::array<Near, kNeighbours> nearest;
    nearest.fill({std::numeric_limits<double>::infinity(), 0});
    const Vec3 X = mesh.points().col(v);
    if (v < count && (map.points.col(v) - X).norm() <= kSamePlace) {  // an array of this mesh
      out[v] = map.times_ms[v];
      continue;
    }
    for (Eigen::Index i = 0; i < count; ++i) {
      const double distance = (map.points.col(i) - X).squaredNorm();
      if (distance >= nearest[used - 1].distance) continue;
      int place = used - 1;
      for (; place > 0 && nearest[place - 1].distance > distance; --place)
        nearest[place] = nearest[place - 1];
      nearest[place] = {distance, i};
    }
    if (std::sqrt(nearest[0].distance) > largest_gap) {
      std::ostringstream out_text;
      out_text << "activation: the vertex (" << X.transpose() << ") mm has no point with a time nearer than "
               << std::sqrt(nearest[0].distance) << " mm, expected one within " << largest_gap << " mm";
      throw InputError(out_text.str());
    }
    if (nearest[0].distance <= kSamePlace * kSamePlace) {
      out[v] = map.times_ms[nearest[0].point];
      continue;
    }
    double sum = 0, weights = 0;
    for (int k = 0; k < used; ++k) {
      sum += map.times_ms[nearest[k].point] / nearest[k].distance;
      weights += 1 / nearest[k].distance;
    }
    out[v] = sum / weights;
  }
  return out;
}

Vector activation_times(const TetMesh& mesh, const Points& fibre, const ConductionVelocity& velocity,
                        const std::vector<ActivationSite>& sites, double largest_gap) {
  if (fibre.cols() != mesh.num_tets())
    throw InputError("activation: found " + std::to_string(fibre.cols()) +
                     " fibre directions, expected one a tet, " + std::to_string(mesh.num_tets()));
  if (sites.empty()) throw InputError("activation: found no site, expected at least one");
  std::vector<polyaffine::EikonalSource> sources;
  for (size_t s = 0; s < sites.size(); ++s) {
    const polyaffine::MeshPoint at = locate(mesh, sites[s].position);
    if (at.distance > largest_gap || !std::isfinite(sites[s].onset)) {
      std::ostringstream out;
      out << "activation site " << s + 1 << " at (" << sites[s].position.transpose() << ") mm, onset "
          << sites[s].onset << " ms: found " << at.distance << " mm outside the mesh, expected at most "
          << largest_gap << " mm and a finite onset";
      throw InputError(out.str());
    }
    sources.push_back({at, sites[s].onset});
  }
  return polyaffine::arrival_times(mesh, sources, conduction_tensors(fibre, velocity));
}

}  // namespace cardiac
