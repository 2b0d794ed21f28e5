#include <algorithm>
#include <utility>

#include <cardiac/validation/extreme_checks.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/quality.hpp>

namespace cardiac {
namespace {

using polyaffine::Points;
using polyaffine::TetMesh;
using polyaffine::Vec3;

ExtremeMesh with_points(const TetMesh& mesh, Points points) {
  return {TetMesh(std::move(points), mesh.tets(), mesh.regions(), {mesh.boundary(), mesh.boundary_labels()})};
}

// A wall of two layers whose middle one is moved to the endocardium until the smallest dihedral angle is
// reached, by bisection.
ExtremeMesh slivers(double angle_deg) {
  const TetMesh mesh = extreme_mesh({6, 12, 2}).mesh;
  const auto endo = mesh.surface_points({kEndocardium});
  Points target = mesh.points();
  std::vector<char> outside(mesh.num_points(), 0);
  for (const int p : mesh.surface_points({kEndocardium, kEpicardium})) outside[p] = 1;
  for (int p = 0; p < mesh.num_points(); ++p) {
    if (outside[p]) continue;
    const Vec3 X = mesh.points().col(p);
    const int nearest =
        *std::ranges::min_element(endo, {}, [&](int q) { return (mesh.points().col(q) - X).squaredNorm(); });
    target.col(p) = mesh.points().col(nearest);
  }
  const auto at = [&](double s) { return with_points(mesh, (1 - s) * mesh.points() + s * target); };
  double low = 0, high = 1;
  for (int k = 0; k < 20; ++k) {
    const double middle = (low + high) / 2;
    double angle = 0;
    try {
      angle = polyaffine::mesh_quality(at(middle).mesh).min_dihedral_deg;
    } catch (const polyaffine::InputError&) {
      angle = 0;
    }
    (angle > angle_deg ? low : high) = middle;
  }
  return at(low);
}

}  // namespace

void extreme_meshes(ExtremeChecks& checks) {
  const auto full = checks.run("meshes/full_order", checks.wall(), kExtremePassive, full_order({}));
  const auto inflate = [&](const std::string& name, const ExtremeMesh& mesh, bool fem, double percent) {
    const auto outcome =
        checks.run("meshes/" + name, mesh, kExtremePassive,
                   fem ? full_order({}) : std::vector<std::string>{"reduction.preset=accurate"});
    checks.expect_inflation_of(outcome, full, percent, "full order on 396 tets");
  };
  const ExtremeMesh sharp = slivers(2), flat = extreme_mesh({4, 8, 30});
  checks.expect(full, "min_dihedral_deg", "deg", polyaffine::mesh_quality(sharp.mesh).min_dihedral_deg,
                {2, 1.99, 2.01, "the mesh of dihedral_2_deg"});
  checks.expect(full, "max_aspect_ratio", "1", polyaffine::mesh_quality(flat.mesh).max_aspect_ratio,
                {50, 50, 1000, "the mesh of aspect_ratio_50"});
  for (const bool fem : {false, true}) {
    inflate("324_tets", extreme_mesh({5, 12, 1}), fem, 10);
    inflate("dihedral_2_deg", sharp, fem, 15);
    inflate("aspect_ratio_50", flat, fem && !checks.quick(), 15);
    if (!checks.quick()) inflate("one_element_thick", extreme_mesh({12, 24, 1}), fem, 10);
  }
  if (!checks.quick()) inflate("208_560_tets", extreme_mesh({40, 80, 11}), false, 10);

  // The same shape of another size under the same pressure takes the same form.
  const TetMesh& mesh = checks.wall().mesh;
  const ExtremeMesh plain = with_points(mesh, mesh.points());
  for (const bool fem : {false, true}) {
    const auto settings = fem ? full_order({}) : std::vector<std::string>{};
    const auto same = checks.run("meshes/plain", plain, kExtremePassive, settings);
    for (const auto& [name, factor] :
         {std::pair{"ten_times_larger", 10.0}, std::pair{"hundred_times_smaller", 0.01}}) {
      const auto outcome = checks.run(std::string("meshes/") + name,
                                      with_points(mesh, factor * mesh.points()), kExtremePassive, settings);
      checks.expect_inflation_of(outcome, same, 1e-4, "similarity: the same wall in its own size");
    }
  }
}

}  // namespace cardiac
