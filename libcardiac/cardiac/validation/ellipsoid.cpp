#include "cardiac/validation/ellipsoid.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/report/csv_writer.hpp>
#include <cardiac/report/text.hpp>
#include <cardiac/validation/ellipsoid_figure.hpp>
#include <cardiac/validation/ellipsoid_measure.hpp>
#include <cardiac/validation/ellipsoid_model.hpp>
#include <polyaffine/core/atomic_file.hpp>

namespace cardiac {

using polyaffine::Vector;

namespace {

using Settings = std::vector<std::string>;

constexpr double kSize = 1.69;  // mm; about 6200 tets
// Of the reference; 28 440 and 5064 tets.
constexpr StructuredCells kReference{40, 24, 5}, kQuickReference{24, 24, 2};
constexpr int kRepetitions = 5;
constexpr auto kErrorMeaning = "relative L2, against quadratic elements on a fine structured mesh";
constexpr double kFactor = 100;  // of displacements in the figure

/// Families of reduced models.
const Settings kEnriched{"reduction.preset=accurate", "reduction.pressure_space=segment_linear"};
const Settings kPaper{"reduction.weights=sigmoid", "reduction.enrichment=[]", "reduction.pressure_space=none",
                      "reduction.integration=gauss"};
const Settings kSigmoid{"reduction.weights=sigmoid", "reduction.enrichment=[\"tt\"]",
                        "reduction.pressure_space=segment_depth"};

struct Zones {
  int n_z, n_t;
  std::string key() const {
    std::string rings;
    for (int k = 0; k < n_z; ++k) rings += (k > 0 ? ", " : "") + std::to_string(n_t);
    return "reduction.ring_nodes=[" + rings + "]";
  }
  double spacing() const { return 1 / (n_z + 0.5); }
};

struct Row {
  std::string model;
  double sigmoid_slope = 0;
  Zones zones{0, 0};
  int unknowns = 0, points = 0;
  double error_percent = 0, bump_percent = NAN, solve_s = 0;
  Points profile{};
};

class Case {
 public:
  explicit Case(const ValidationContext& context) : context_(context) {}

  std::vector<Check> run() {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    context_.progress("full order", 0);
    const EllipsoidProblem problem(context_.mesh_ellipsoid(land_ellipsoid(), kSize));
    problem_ = &problem;
    const auto p2 = problem.solve({"reduction.method=fem"}, context_.quick ? 1 : 3);
    const auto p1 = problem.solve({"reduction.method=fem", "reduction.element_order=1"});
    const EllipsoidProblem fine(
        structured_ellipsoid(land_ellipsoid(), context_.quick ? kQuickReference : kReference).mesh);
    const EllipsoidMeasure measure(problem, fine, fine.solve({"reduction.method=fem"}));
    measure_ = &measure;
    full_order_s_ = p2.solve_s;
    add_row("fem_p1", p1, {0, 0}, 0);
    add_row("fem_p2", p2, {0, 0}, 0);
    add("fem_p2", "outer_displacement_mm", "mm", rows_[1].profile.colwise().norm().maxCoeff(), 0.01433,
        0.0141, 0.0146, "independent quadratic code on 6122 tets, within 2 %");
    add("fem_p1", "outer_displacement_mm", "mm", rows_[0].profile.colwise().norm().maxCoeff(), 0.01136,
        0.0102, 0.0125, "independent linear code on 6122 tets, within 10 %: linear elements lock");
    add("fem_p2", "displacement_error_percent", "%", rows_[1].error_percent, 0, 0, 2, kErrorMeaning);
    reduced_models();
    base_models();
    write_files();
    for (Check& check : checks_)
      check.wall_time_s = std::chrono::duration<double>(Clock::now() - start).count();
    return checks_;
  }

 private:
  void add(const std::string& method, const std::string& quantity, const std::string& unit, double value,
           double reference, double low, double high, const std::string& source) {
    checks_.push_back({"ellipsoid", method, quantity, unit, value, reference, low, high, source, 0});
  }

  const Row& add_row(const std::string& model, const EllipsoidProblem::Solution& s, const Zones& zones,
                     double slope) {
    const auto& d = s.ventricle.discretisation;
    Row row{model, slope, zones, d.num_unknowns, static_cast<int>(d.points.tet.size())};
    row.error_percent = s.converged ? measure_->error_percent(s) : NAN;
    row.solve_s = s.solve_s;
    row.profile = measure_->profile(s);
    if (zones.n_z >= 4) row.bump_percent = measure_->bump_percent(row.profile, zones.spacing());
    rows_.push_back(std::move(row));
    return rows_.back();
  }

  Row reduced(const std::string& model, Settings settings, const Zones& zones, double slope = 0) {
    context_.progress(model + " " + std::to_string(zones.n_z) + " × " + std::to_string(zones.n_t),
                      static_cast<double>(rows_.size()) / 18);
    settings.push_back(zones.key());
    if (slope > 0) settings.push_back("reduction.sigmoid_slope=" + number_text(slope));
    return add_row(model, problem_->solve(settings, context_.quick ? 3 : kRepetitions), zones, slope);
  }

  void reduced_models() {
    const std::vector<Zones> zones = context_.quick ? std::vector<Zones>{{2, 3}, {3, 6}, {4, 8}}
                                                    : std::vector<Zones>{{2, 3}, {3, 6}, {4, 8}, {6, 12}};
    double rise = -HUGE_VAL, before = NAN, speedup = 0;
    Row last;
    for (const Zones& z : zones) {
      last = reduced("enriched", kEnriched, z);
      if (std::isfinite(before)) rise = std::max(rise, last.error_percent - before);
      before = last.error_percent;
      if (last.error_percent <= 5) speedup = std::max(speedup, full_order_s_ / last.solve_s);
    }
    const double limit = context_.quick ? 4 : 2;
    const std::string name =
        "enriched, " + std::to_string(last.zones.n_z) + " × " + std::to_string(last.zones.n_t) + " + 1 zones";
    add(name, "displacement_error_percent", "%", last.error_percent, 0, 0, limit, kErrorMeaning);
    add("enriched", "largest_rise_of_error_percent", "%", rise, 0, -HUGE_VAL, 0,
        "the error falls from one division into zones to the next");
    add("enriched", "speedup_at_5_percent", "1", speedup, 10, 10, HUGE_VAL,
        "solve time of quadratic elements on the same mesh over that of a model with at most 5 % error");
    add(name, "bump_percent", "%", last.bump_percent, 0, 0, context_.quick ? 1 : 0.2,
        "wave with the spacing of the rings along the outer meridian of the figure over the mean normal "
        "displacement");
    reduced("paper", kPaper, {2, 3}, 2.25);
    if (context_.quick) return;
    reduced("paper", kPaper, {3, 6}, 2.25);
    for (const double slope : {1.5, 2.25, 4.0, 8.0}) reduced("paper", kPaper, {4, 8}, slope);
    for (const double slope : {1.5, 2.25, 4.0, 8.0}) reduced("sigmoid_pressure", kSigmoid, {4, 8}, slope);
  }

  void base_models() {
    context_.progress("base", 0.9);
    Settings settings = kEnriched;
    const Zones zones{3, 6};
    settings.push_back(zones.key());
    const auto clamped = problem_->solve(settings);
    const auto projected = problem_->solve_held(settings, 0);
    const double low = 1 - zones.spacing() / 2;
    const double slope = problem_->base_slope(projected);
    const double stiff = measure_->basal_displacement(measure_->profile(projected), low);
    const auto row = [&](const std::string& hold, double stiffness, const EllipsoidProblem::Solution& s) {
      const double basal = measure_->basal_displacement(measure_->profile(s), low);
      base_ << hold << stiffness << problem_->base_motion(s) << problem_->base_slope(s)
            << problem_->base_slope(s) / slope << basal << basal / stiff << measure_->error_percent(s);
      base_.end_row();
    };
    row("frames", 0, clamped);
    row("projective", 0, projected);
    for (const double k : {1e5, 1e6, 1e7, 1e8, 1e10}) row("springs", k, problem_->solve_held(settings, k));
    add("projective constraint", "base_motion_mm", "mm", problem_->base_motion(projected), 0, 0, 1e-10,
        "the base is fixed");
    add("projective constraint", "base_slope_over_clamped_frames", "1", slope / problem_->base_slope(clamped),
        1, 0.999, 1.001, "frames whose functions vanish on the base span the same space");
  }

  void write_files() const {
    CsvWriter csv(
        "# relative L2 displacement error against quadratic elements on a fine structured mesh; bump: wave "
        "with the spacing of the rings along an outer meridian over the mean normal displacement\n"
        "model,sigmoid_slope,n_z,n_t,zones,unknowns,integration_points,error_percent,bump_percent,solve_s,"
        "full_order_solve_s");
    for (const Row& r : rows_) {
      csv << r.model << (r.sigmoid_slope > 0 ? r.sigmoid_slope : NAN) << r.zones.n_z << r.zones.n_t
          << (r.zones.n_z > 0 ? r.zones.n_z * r.zones.n_t + 1 : 0) << r.unknowns << r.points
          << r.error_percent << r.bump_percent << r.solve_s << full_order_s_;
      csv.end_row();
    }
    polyaffine::write_atomically(context_.out / "ellipsoid.csv", csv.text());
    polyaffine::write_atomically(context_.out / "ellipsoid_profile.csv", profiles());
    polyaffine::write_atomically(context_.out / "ellipsoid_base.csv", base_.text());
    polyaffine::write_atomically(context_.out / "ellipsoid.svg", figure());
  }

  // Normal displacement along the outer meridian, a column a model.
  std::string profiles() const {
    const Points& X = measure_->meridian();
    std::vector<Vector> columns{normal_part(X, measure_->profile())};
    std::string header = "x_mm,z_mm,reference_mm";
    for (const Row& r : rows_) {
      header +=
          "," + r.model + (r.sigmoid_slope > 0 ? "_a" + number_text(r.sigmoid_slope) : "") +
          (r.zones.n_z > 0 ? "_" + std::to_string(r.zones.n_z) + "x" + std::to_string(r.zones.n_t) : "") +
          "_mm";
      columns.push_back(normal_part(X, r.profile));
    }
    CsvWriter csv(header);
    for (Eigen::Index k = 0; k < X.cols(); ++k) {
      csv << X(0, k) << X(2, k);
      for (const Vector& column : columns) csv << column[k];
      csv.end_row();
    }
    return csv.text();
  }

  std::string figure() const {
    const auto curve = [&](const std::string& model, const std::string& name, const std::string& colour) {
      EllipsoidCurve out{name, colour, {}};
      for (const Row& r : rows_)
        if (r.model == model && (r.sigmoid_slope == 0 || r.sigmoid_slope == 2.25))
          out.points.push_back({r.unknowns, r.error_percent});
      return out;
    };
    const auto last = [&](const std::string& model) {
      const Row* out = nullptr;
      for (const Row& r : rows_)
        if (r.model == model && (r.sigmoid_slope == 0 || r.sigmoid_slope == 2.25)) out = &r;
      return out;
    };
    const auto zones = [](const Row& r) {
      return std::to_string(r.zones.n_z) + " × " + std::to_string(r.zones.n_t) + " + 1 zones";
    };
    const Row &enriched = *last("enriched"), &paper = *last("paper");
    return ellipsoid_svg(
        measure_->meridian(),
        {{"quadratic elements", "#bbbbdd", measure_->profile()},
         {"linear elements", "#e69f00", rows_[0].profile},
         {"enriched, " + zones(enriched), "#0072b2", enriched.profile},
         {"paper, " + zones(paper), "#d55e00", paper.profile}},
        kFactor,
        {curve("enriched", "enriched tents", "#0072b2"), curve("paper", "paper (sigmoid, affine)", "#d55e00"),
         curve("sigmoid_pressure", "sigmoid, pressures", "#009e73")});
  }

  const ValidationContext& context_;
  const EllipsoidProblem* problem_ = nullptr;
  const EllipsoidMeasure* measure_ = nullptr;
  double full_order_s_ = 0;
  std::vector<Row> rows_;
  std::vector<Check> checks_;
  CsvWriter base_{
      "hold,stiffness_kPa_per_mm,base_motion_mm,slope,slope_over_projective,basal_displacement_mm,"
      "basal_over_projective,error_percent"};
};

}  // namespace

std::vector<Check> validate_ellipsoid(const ValidationContext& context) {
  return Case(context).run();
}

}  // namespace cardiac
