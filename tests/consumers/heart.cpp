// A heart of cardiac::cardiac, whose coordinates need the sparse solvers.

#include <cardiac/anatomy/coordinates.hpp>
#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <polyaffine/core/parallel.hpp>
#include <polyaffine/core/threads.hpp>

#include "check.hpp"

int main() {
  polyaffine::use_threads();
  if (!polyaffine::parallel_backend()) return 1;
  const cardiac::TruncatedEllipsoid shape = cardiac::human_lv();
  const cardiac::CurvedMesh wall = cardiac::structured_ellipsoid(shape, {8, 12, 2});
  cardiac::AnatomyOptions options;
  options.midpoints = wall.midpoints;
  const cardiac::VentricularCoordinates coordinates(wall.mesh, {}, options);
  check("length of the cavity, mm", coordinates.cavity_length(), shape.endo_long_mm + shape.base_z_mm, 1e-6);
  double error = 0;
  for (int t = 0; t < wall.mesh.num_tets(); ++t) {
    const auto at = coordinates.sample(t, polyaffine::Vec4::Constant(0.25));
    error = std::max(error, (at.Q.transpose() * at.Q - polyaffine::Mat3::Identity()).norm());
    if (at.t < 0 || at.t > 1 || at.u < 0 || at.u > 1) return 1;
  }
  check("error of the axes", error, 0, 1e-12);
}
