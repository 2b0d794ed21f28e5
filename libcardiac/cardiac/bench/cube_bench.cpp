#include <cardiac/bench/cube_bench.hpp>

#include <cmath>
#include <limits>

#include <cardiac/validation/cube_platens.hpp>
#include <polyaffine/core/single_thread.hpp>
#include <polyaffine/kinematics/element_locator.hpp>

namespace cardiac {

using polyaffine::Points;
using polyaffine::Vec3;

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr int kIntegrationPoints = 1400;

// Everything is compared at the centroids of the reference's elements.
class Reference {
 public:
  explicit Reference(const CubeScene& scene) : scene_(scene), truth_(solve_platens_quadratic(scene)) {}

  const PlatenSolution& truth() const { return truth_; }
  double error_percent(const CubeScene& scene, const PlatenSolution& found) const {
    const Points X = polyaffine::positions(scene_.mesh, polyaffine::gauss_points(scene_.mesh, 1));
    const polyaffine::ElementLocator locator(*scene.quadratic);
    std::vector<int> tet;
    Eigen::Matrix4Xd barycentric(4, X.cols());
    for (Eigen::Index q = 0; q < X.cols(); ++q) {
      const auto place = locator.locate(X.col(q));
      tet.push_back(place.tet);
      barycentric.col(q) = place.barycentric;
    }
    return platen_error_percent(scene_, truth_,
                                polyaffine::DisplacementMap(*found.basis, tet, barycentric).apply(found.c));
  }
  double compliance(const PlatenSolution& found) const {
    return found.thickness_change_mm / truth_.thickness_change_mm;
  }

 private:
  const CubeScene& scene_;
  PlatenSolution truth_;
};

BenchRow make_row(const std::string& method, const CubeScene& scene, const PlatenSolution& found,
                  const Reference& reference) {
  BenchRow row;
  row.scene = kCubeBench;
  row.method = method;
  row.mesh_tets = scene.mesh.num_tets();
  row.dofs = static_cast<int>(found.c.size());
  row.integration_points = found.integration_points;
  row.setup_s = found.setup_s;
  row.solve_s = found.solve_s;
  row.cavity_ratio = kNone;
  row.errors = {reference.error_percent(scene, found), kNone, kNone, kNone, reference.compliance(found)};
  row.load_steps = 1;
  row.newton_iterations = found.newton_iterations;
  row.converged = true;
  return row;
}

}  // namespace

SceneResult run_cube_scene(const BenchContext& context) {
  const polyaffine::SingleThread single_thread;
  const std::vector<double> edges =
      context.quick ? std::vector<double>{150, 300} : std::vector<double>{100, 145, 200, 300, 450};
  const std::vector<int> zones = context.quick ? std::vector<int>{1, 5} : std::vector<int>{1, 5, 9, 17, 33};
  SceneResult out{kCubeBench, "The cube between platens", "", {}};
  const double steps = 2.0 * static_cast<double>(edges.size()) + static_cast<double>(zones.size());
  const auto tell = [&](const std::string& what) {
    context.progress(std::string(kCubeBench) + ": " + what, static_cast<double>(out.rows.size()) / steps);
  };
  const auto add = [&](BenchRow row, double full_order_s) {
    row.speedup_over_fem = full_order_s / row.solve_s;
    out.rows.push_back(std::move(row));
    context.on_row(out.rows.back());
  };
  tell("fem_p2");
  const CubeScene fine(context.mesh_box(Vec3::Constant(kCubeSize), edges[0]));
  const Reference reference(fine);
  const double reference_s = reference.truth().solve_s;
  add(make_row("fem_p2", fine, reference.truth(), reference), reference_s);
  add(make_row("fem_p1", fine, solve_platens_linear(fine), reference), reference_s);
  out.reference = "fem_p2 on " + std::to_string(fine.mesh.num_tets()) + " tets, " +
                  std::to_string(out.rows[0].dofs) + " unknowns";
  for (std::size_t k = 1; k < edges.size(); ++k) {
    tell("full order");
    const CubeScene coarse(context.mesh_box(Vec3::Constant(kCubeSize), edges[k]));
    const PlatenSolution quadratic = solve_platens_quadratic(coarse);
    add(make_row("fem_p2", coarse, quadratic, reference), quadratic.solve_s);
    add(make_row("fem_p1", coarse, solve_platens_linear(coarse), reference), quadratic.solve_s);
  }
  for (const int count : zones) {
    tell(std::to_string(count) + " zones");
    std::mt19937_64 random(static_cast<unsigned>(count));
    const CubePlacement placement = place_cube(fine, count, kIntegrationPoints, random);
    BenchRow row = make_row("polyaffine", fine, solve_platens_reduced(fine, placement), reference);
    row.control_nodes = count;
    add(std::move(row), reference_s);
  }
  return out;
}

}  // namespace cardiac
