#include "cardiac/activation/activation.hpp"

#include <cmath>
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
