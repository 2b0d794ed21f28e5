// A ball meshed by polyaffine::meshing, written and read by polyaffine::vtk.

#include <cstdio>
#include <filesystem>
#include <string>

#include <polyaffine/meshing/implicit_domain.hpp>
#include <polyaffine/vtk/read.hpp>
#include <polyaffine/vtk/write.hpp>

#include "check.hpp"

int main() {
  polyaffine::ImplicitDomain ball;
  ball.value = [](const polyaffine::Vec3& x) { return x.norm() - 10; };
  ball.radius_mm = 12;
  ball.project = [](const polyaffine::Vec3& x) -> polyaffine::Vec3 { return 10 * x.normalized(); };
  const polyaffine::TetMesh mesh = polyaffine::mesh_implicit_domain(ball, polyaffine::sizes_for_edge(4));
  const double exact = 4.0 / 3 * polyaffine::kPi * 1000;
  check("volume of the ball, mm3", mesh.volume() / exact, 1, 0.06);
  polyaffine::write_vtu("ball.vtu", mesh);
  const polyaffine::TetMesh again = polyaffine::read_vtu("ball.vtu", 1);
  check("volume that is read", again.volume() / mesh.volume(), 1, 1e-12);
}
