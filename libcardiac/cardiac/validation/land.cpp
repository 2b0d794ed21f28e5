#include <cardiac/validation/land.hpp>

#include <array>
#include <cmath>

#include <cardiac/report/csv_writer.hpp>
#include <cardiac/validation/land_model.hpp>
#include <cardiac/validation/land_reduced.hpp>
#include <polyaffine/core/atomic_file.hpp>

namespace cardiac {
namespace {

using polyaffine::TetMesh;

constexpr auto kSource = "Land et al. 2015, Proc. R. Soc. A 471:20150641";
constexpr int kMostIterations = 40;
constexpr double kVolumeChange = 1e-8;  // twice what is reached

struct Quantity {
  std::string name, unit;
  double reference, low, high;  // range on the finer mesh; on the coarser one it is twice as wide
};

struct Problem {
  std::string name;
  std::function<TetMesh(const ValidationContext&, double edge_mm)> mesh;
  std::array<double, 2> edge_mm;  // coarser, finer
  std::function<LandSolution(const TetMesh&)> solve;
  std::vector<Quantity> quantities;
  double cpu_s[2];            // most CPU time on the two meshes in total, 0: any
  double iteration_cpu_s[2];  // and of one Newton iteration
};

TetMesh ellipsoid(const ValidationContext& context, double edge_mm) {
  return context.mesh_ellipsoid(land_ellipsoid(), edge_mm);
}

const std::vector<Problem>& problems() {
  static const std::vector<Problem> list{
      {"land1",
       [](const ValidationContext& context, double edge) {
         return context.mesh_box({10, 1, 1}, edge);
       },
       {0.7, 0.3},
       solve_land_beam,
       {{"z_mm", "mm", 4.170, 4.16, 4.18}},
       {0, 0},
       {0, 0}},
      {"land2",
       ellipsoid,
       {2.7, 1.7},
       [](const TetMesh& mesh) { return solve_land_ellipsoid(mesh, false); },
       {{"endo_apex_z_mm", "mm", -26.612, -26.7, -26.5},
        {"epi_apex_z_mm", "mm", -28.279, -28.38, -28.2},
        {"cavity_mm3", "mm3", 10734, 0.99 * 10734, 1.01 * 10734}},
       {3, 0},
       {0, 0.5}},
      {"land3",
       ellipsoid,
       {1.7, 1.15},
       [](const TetMesh& mesh) { return solve_land_ellipsoid(mesh, true); },
       {{"endo_apex_z_mm", "mm", -12.347, -12.7, -12.0},
        {"epi_apex_z_mm", "mm", -15.452, -15.8, -15.2},
        {"cavity_mm3", "mm3", 1795.9, 0.98 * 1795.9, 1.02 * 1795.9}},
       {0, 0},
       {0, 0}},
  };
  return list;
}

void add_checks(const Problem& problem, int level, const LandSolution& solution, std::vector<Check>& checks) {
  Check check;
  check.case_name = problem.name;
  check.method = "fem_p2 " + std::to_string(solution.tets) + " tets";
  check.wall_time_s = solution.wall_s;
  check.source = kSource;
  const double widening = level == 0 ? 2 : 1;
  for (std::size_t k = 0; k < problem.quantities.size(); ++k) {
    const Quantity& q = problem.quantities[k];
    check.quantity = q.name;
    check.unit = q.unit;
    check.value = solution.values[k];
    check.reference = q.reference;
    check.low = q.reference - widening * (q.reference - q.low);
    check.high = q.reference + widening * (q.high - q.reference);
    checks.push_back(check);
  }
  const auto at_most = [&](const char* quantity, const char* unit, double value, double most,
                           const char* source) {
    if (most <= 0) return;
    check.quantity = quantity;
    check.unit = unit;
    check.value = value;
    check.reference = check.high = most;
    check.low = 0;
    check.source = source;
    checks.push_back(check);
  };
  check.quantity = "wall_volume_change";
  check.unit = "1";
  check.value = solution.wall_volume_change;
  check.reference = 0;
  check.low = -kVolumeChange;
  check.high = kVolumeChange;
  check.source = "the wall is incompressible; from its deformed surface";
  checks.push_back(check);
  at_most("newton_iterations", "1", solution.newton_iterations, kMostIterations, "bound on a load path");
  at_most("total_cpu_s", "s", solution.cpu_s, problem.cpu_s[level], "bound for about 1900 quadratic tets");
  at_most("iteration_cpu_s", "s", solution.cpu_s / solution.newton_iterations, problem.iteration_cpu_s[level],
          "bound for about 6100 quadratic tets");
}

// Errors of the reduced model in per cent of the reference, about twice those that are reached.
struct ReducedBounds {
  std::string preset;
  bool contracting;
  double endo_apex, epi_apex, cavity;
};
const std::vector<ReducedBounds>& reduced_bounds() {
  static const std::vector<ReducedBounds> list{{"fast", false, 5.2, 1.6, 1.2},
                                               {"accurate", false, 1.1, 3.2, 3.7},
                                               {"fast", true, 5.8, 1.8, 1},
                                               {"accurate", true, 9.7, 2.4, 3.1}};
  return list;
}

void add_reduced_checks(const TetMesh& mesh, std::vector<Check>& checks) {
  for (const ReducedBounds& bounds : reduced_bounds()) {
    const auto& full = problems()[bounds.contracting ? 2 : 1];
    const LandSolution solution =
        solve_land_reduced(mesh, bounds.contracting, {"reduction.preset=" + bounds.preset});
    const double percent[] = {bounds.endo_apex, bounds.epi_apex, bounds.cavity};
    for (std::size_t k = 0; k < full.quantities.size(); ++k) {
      const Quantity& q = full.quantities[k];
      const double part = percent[k] / 100 * std::abs(q.reference);
      checks.push_back({full.name, "polyaffine " + bounds.preset, q.name, q.unit, solution.values[k],
                        q.reference, q.reference - part, q.reference + part, kSource, solution.wall_s});
    }
  }
}

void add_rows(const Problem& problem, const LandSolution& s, CsvWriter& table) {
  for (std::size_t k = 0; k < problem.quantities.size(); ++k) {
    const Quantity& q = problem.quantities[k];
    table << problem.name << q.name << s.tets << s.unknowns << s.values[k] << q.reference << s.load_steps
          << s.newton_iterations << s.wall_volume_change << s.cpu_s;
    table.end_row();
  }
}

}  // namespace

std::vector<Check> validate_land(const ValidationContext& context) {
  std::vector<Check> checks;
  CsvWriter table(
      "case,quantity,mesh_tets,unknowns,value,reference,load_steps,newton_iterations,wall_volume_change,cpu_"
      "s",
      8);
  const int levels = context.quick ? 1 : 2;
  const double all = static_cast<double>(problems().size()) * levels;
  double done = 0;
  for (const Problem& problem : problems())
    for (int level = 0; level < levels; ++level) {
      const TetMesh mesh = problem.mesh(context, problem.edge_mm[level]);
      context.progress(problem.name + ", " + std::to_string(mesh.num_tets()) + " tets", done++ / all);
      const LandSolution solution = problem.solve(mesh);
      add_checks(problem, level, solution, checks);
      add_rows(problem, solution, table);
    }
  context.progress("reduced", done / all);
  add_reduced_checks(ellipsoid(context, problems()[1].edge_mm[0]), checks);
  polyaffine::write_atomically(context.out / "land.csv", table.text());
  return checks;
}

}  // namespace cardiac
