#include "cardiac/training/tuned_archive.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include <cardiac/fibres/anatomy_archive.hpp>
#include <cardiac/scene/given_key.hpp>
#include <cardiac/training/trained_rule.hpp>
#include <polyaffine/core/archive_eigen.hpp>
#include <polyaffine/core/archive_file.hpp>
#include <polyaffine/core/archive_types.hpp>
#include <polyaffine/core/cache.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/digest.hpp>

namespace polyaffine {

template <class Archive>
void archive(Archive& a, WallPoints& x) {
  a(x.tet, x.barycentric, x.weights, x.starts);
}

template <class Archive>
void archive(Archive& a, SurfacePoints& x) {
  a(x.tet, x.barycentric, x.weights, x.X, x.X_xi, x.X_eta, x.starts);
}

}  // namespace polyaffine

namespace cardiac {

using polyaffine::ArchiveReader;
using polyaffine::ArchiveWriter;

template <class Archive>
void archive(Archive& a, CavitySurface& x) {
  a(x.name, x.points, x.base_centre);
}

template <class Archive>
void archive(Archive& a, WorstLoad& x) {
  a(x.displacement_percent, x.volume_percent, x.best_percent, x.load);
}

template <class Archive>
void archive(Archive& a, TuningRound& x) {
  a(x.full_order_solves, x.modes, x.pressures, x.unknowns, x.points, x.seconds, x.protocol, x.segments);
}

namespace {

const polyaffine::ArchiveFormat kModel{"cardiac heart model", 2}, kCached{"cardiac tuned model", 2};
constexpr const char* kKind = "tuned-6";  // the number changes when the training does

// Numbers that are of single precision already.
template <class Archive>
void single(Archive& a, polyaffine::Matrix& x) {
  Eigen::MatrixXf numbers;
  if constexpr (!Archive::kReading) numbers = x.cast<float>();
  a(numbers);
  if constexpr (Archive::kReading) x = numbers.cast<double>();
}

// The modes and pressures of the model are the first of those of its check.
template <class Archive>
void spaces(Archive& a, TunedModel& x) {
  auto pressures = static_cast<std::uint64_t>(x.space.pressures.rows());
  a(x.space.num_modes, pressures, x.check.space.num_modes);
  single(a, x.check.space.modes);
  single(a, x.check.space.pressures);
  if constexpr (Archive::kReading) {
    const NestedSpace& all = x.check.space;
    if (x.space.num_modes < 0 || x.space.num_modes > all.num_modes || all.modes.cols() % 3 != 0 ||
        all.num_modes > all.modes.cols() || all.modes.cols() >= all.num_modes + 3 ||
        pressures > static_cast<std::uint64_t>(all.pressures.rows()))
      a.refuse("found modes that are not those of a model and its check");
    x.space.modes = polyaffine::Matrix::Zero(all.modes.rows(), (x.space.num_modes + 2) / 3 * 3);
    x.space.modes.leftCols(x.space.num_modes) = all.modes.leftCols(x.space.num_modes);
    x.space.pressures = all.pressures.topRows(static_cast<Eigen::Index>(pressures));
  }
}

template <class Archive>
void members(Archive& a, TunedModel& x) {
  a.section("space", [&] { spaces(a, x); });
  a.section("check", [&] { a(x.check.pressure_mass, x.check.factor); });
  a.section("points", [&] { a(x.wall, x.cavities, x.epicardium, x.pressure_mass); });
  a.section("training", [&] { a(x.rounds, x.reached); });
}

template <class Archive>
void members(Archive& a, HeartModel& x) {
  a(x.protocol, x.source, x.overrides, x.structure);
  Anatomy heart;
  TunedModel tuned;
  if constexpr (!Archive::kReading) {
    heart = *x.heart;
    tuned = *x.tuned;
  }
  a.section("heart", [&] { archive(a, heart); });
  a.section("model", [&] { archive(a, tuned); });
  if constexpr (Archive::kReading) {
    x.heart = std::make_shared<const Anatomy>(std::move(heart));
    x.tuned = std::make_shared<const TunedModel>(std::move(tuned));
  }
}

// Points that would be looked up outside the mesh, and sizes that do not belong together, would crash.
void check(ArchiveReader& a, const TunedModel& x) {
  const auto tets = x.space.pressures.cols();
  const auto inside = [tets](const auto& points) {
    const auto n = static_cast<Eigen::Index>(points.tet.size());
    bool good = points.barycentric.cols() == n && points.weights.size() == n && !points.starts.empty() &&
                points.starts.front() == 0 && points.starts.back() == n;
    for (std::size_t k = 1; k < points.starts.size(); ++k)
      good = good && points.starts[k - 1] <= points.starts[k];
    for (const int t : points.tet) good = good && t >= 0 && t < tets;
    return good;
  };
  bool good = inside(x.wall) && !x.rounds.empty() && x.pressure_mass.rows() == x.space.pressures.rows() &&
              x.pressure_mass.cols() == x.space.pressures.rows();
  for (const CavitySurface& cavity : x.cavities) good = good && inside(cavity.points);
  good = good && x.check.pressure_mass.rows() == x.check.space.pressures.rows() &&
         x.check.pressure_mass.cols() == x.check.space.pressures.rows();
  if (!good) a.refuse("found parts of a tuned model that do not fit each other, expected those of one model");
}

}  // namespace

void archive(ArchiveWriter& a, TunedModel& x) {
  members(a, x);
}

void archive(ArchiveReader& a, TunedModel& x) {
  members(a, x);
  check(a, x);
}

void archive(ArchiveWriter& a, HeartModel& x) {
  members(a, x);
}

void archive(ArchiveReader& a, HeartModel& x) {
  members(a, x);
  if (x.tuned->space.pressures.cols() != x.heart->mesh.num_tets() ||
      x.tuned->space.modes.rows() != 3 * x.heart->coordinates->space().num_functions())
    a.refuse("found a tuned model of another mesh, expected one of the heart in the file");
}

void write_heart_model(const std::filesystem::path& file, const HeartModel& model) {
  polyaffine::write_archive(file, kModel, model);
}

HeartModel read_heart_model(const std::filesystem::path& file) {
  return polyaffine::read_archive<HeartModel>(file, kModel);
}

std::string structure_key(const Anatomy& anatomy, const Scene& scene) {
  nlohmann::json key;
  key["mesh"] = polyaffine::digest(anatomy.mesh);
  key["law"] = scene.tissue.law;
  if (const auto& f = scene.fibres)
    key["fibres"] = {f->source,          f->endo_angle_deg,    f->epi_angle_deg,
                     f->sheet_angle_deg, f->rv_endo_angle_deg, f->rv_epi_angle_deg};
  key["affine_frames"] = scene.reduction.affine_frames;
  key["contraction"] = scene.contraction.has_value();
  const scene::Boundary& b = scene.boundary;
  key["boundary"] = {b.base, b.epicardial_stiffness_kPa_per_mm > 0 || b.epicardial_damping_kPa_ms_per_mm > 0};
  return key.dump();
}

std::string tuned_key(const Anatomy& anatomy, const Scene& scene) {
  nlohmann::json key;
  if (const auto& a = scene.activation)
    key["activation"] = {a->mode,
                         a->onset_ms,
                         a->site_segments,
                         a->sites_mm,
                         a->conduction_along_fibre_mm_per_ms,
                         a->conduction_across_fibre_mm_per_ms};
  if (const auto& c = scene.contraction)
    key["contraction"] = {c->contractility_kPa, c->activation_rate_per_ms, c->relaxation_rate_per_ms,
                          c->activation_duration_ms.value_or(0), c->switch_width_ms};
  if (const auto& c = scene.circulation)
    key["circulation"] = {c->filling_pressure_kPa,
                          c->right_filling_pressure_kPa,
                          c->initial_aortic_pressure_kPa,
                          c->initial_pulmonary_pressure_kPa,
                          c->peripheral_resistance_kPa_ms_per_mm3,
                          c->compliance_mm3_per_kPa,
                          c->pulmonary_peripheral_resistance_kPa_ms_per_mm3};
  if (const auto& c = scene.cavities) key["cavities"] = {c->pressure_kPa, c->right_pressure_kPa};
  if (const std::string given = given_key(scene); !given.empty()) key["given"] = given;
  for (const auto& r : scene.regions)
    key["regions"].push_back(
        {r.segments, r.stiffness_factor, r.tension_factor, r.activation_delay_ms, r.border_width_percent});
  key["time"] = {scene.time.beat_ms, scene.time.duration_ms};
  key["tuning"] = {scene.reduction.accuracy_percent, scene.reduction.affine_frames};
  return structure_key(anatomy, scene) + ' ' + rule_key(anatomy, scene) + ' ' + key.dump();
}

namespace {

// One that did not reach its accuracy serves those who give it no more time.
std::string unreached_key(const Anatomy& anatomy, const Scene& scene) {
  return tuned_key(anatomy, scene) + " in " + std::to_string(scene.reduction.budget_s) + " s";
}

}  // namespace

std::optional<TunedModel> cached_model(const Anatomy& anatomy, const Scene& scene) {
  if (anatomy.fibres) return std::nullopt;
  auto stored = polyaffine::read_cache(kKind, tuned_key(anatomy, scene));
  if (!stored) stored = polyaffine::read_cache(kKind, unreached_key(anatomy, scene));
  if (!stored) return std::nullopt;
  try {
    TunedModel out = polyaffine::value_of_archive<TunedModel>(*stored, kCached, "cache");
    complete(anatomy, scene, out);
    return out;
  } catch (const polyaffine::InputError&) {
    return std::nullopt;  // damaged: learned anew
  }
}

void keep_model(const Anatomy& anatomy, const Scene& scene, const TunedModel& model) {
  if (anatomy.fibres) return;
  ArchiveWriter writer;
  TunedModel copy = model;
  archive(writer, copy);
  polyaffine::write_cache(kKind, model.reached ? tuned_key(anatomy, scene) : unreached_key(anatomy, scene),
                          writer.file(kCached));
}

void complete(const Anatomy& anatomy, const Scene& scene, TunedModel& model) {
  const NestedSpace affine = affine_space(anatomy, scene);
  for (NestedSpace* space : {&model.space, &model.check.space}) {
    space->frame_basis = affine.frame_basis;
    space->frames = affine.frames;
  }
}

}  // namespace cardiac
