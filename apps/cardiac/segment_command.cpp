#include "segment_command.hpp"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <cardiac/anatomy/orientation.hpp>
#include <cardiac/anatomy/right_ventricle.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/fibres/fibre_difference.hpp>
#include <cardiac/fibres/helix.hpp>
#include <cardiac/model/wall.hpp>
#include <cardiac/reduction/control_nodes.hpp>
#include <cardiac/reduction/discretisation.hpp>
#include <cardiac/report/segment_picture.hpp>
#include <polyaffine/core/atomic_file.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>

#include "example_data.hpp"
#include "label_options.hpp"
#include "load_mesh.hpp"
#include "output_file.hpp"
#include "read_heart.hpp"
#include "warnings.hpp"

#ifdef CARDIAC_WITH_VTK
#include <polyaffine/vtk/write.hpp>
#endif

namespace cardiac::app {
namespace {

using polyaffine::InputError;
using polyaffine::Matrix;
using polyaffine::TetMesh;

struct SegmentOptions {
  std::filesystem::path mesh, out, picture;
  std::string scheme, length_unit;
  LabelOptions labels;
  FibreArrays arrays;
  std::vector<double> anterior, long_axis, septum_point, rv_insertion_point, mitral_point;
  HelixAngles angles = helix_angles(protocol::Fibres());  // those of a run
  bool force = false;
};

std::optional<protocol::Labels> given_labels(const std::vector<std::string>& words) {
  if (words.empty()) return std::nullopt;
  return surface_labels(words);
}

/// The three numbers of an option, where it was given.
std::optional<protocol::Vector3> point(const char* option, const std::vector<double>& v) {
  if (v.empty()) return std::nullopt;
  const Eigen::Map<const polyaffine::Vec3> x(v.data());
  if (!x.allFinite())
    throw InputError(std::string(option) + ": found a number that is none, expected a point of the mesh");
  return protocol::Vector3{x.x(), x.y(), x.z()};
}

protocol::Vector3 direction(const char* option, const std::vector<double>& v) {
  const Eigen::Map<const polyaffine::Vec3> d(v.data());
  if (!d.allFinite() || d.norm() == 0)
    throw InputError(std::string(option) +
                     ": found a vector without a direction, expected three finite numbers, not all zero");
  return {d.x(), d.y(), d.z()};
}

protocol::Scheme scheme(const std::string& word) {
  if (word == "aha17") return protocol::Scheme::aha17;
  if (word == "aha29") return protocol::Scheme::aha29;
  throw InputError("--scheme: found \"" + word + "\", expected aha17 or aha29");
}

// The tables [mesh], [anatomy] and [fibres] of a protocol, from the options.
Protocol as_protocol(const SegmentOptions& o) {
  Protocol protocol;
  protocol.mesh.file = o.mesh.string();
  protocol.mesh.length_unit = length_unit(o.length_unit);
  if (!o.labels.surface_files.empty()) protocol.mesh.surface_files = o.labels.surface_files;
  protocol.mesh.region = given_labels(o.labels.region);
  if (!o.labels.region_array.empty()) protocol.mesh.region_array = o.labels.region_array;
  if (!o.labels.label_array.empty()) protocol.mesh.label_array = o.labels.label_array;
  protocol.mesh.endo_label = given_labels(o.labels.endo);
  protocol.mesh.epi_label = given_labels(o.labels.epi);
  protocol.mesh.base_label = given_labels(o.labels.base);
  protocol.mesh.rv_endo_label = given_labels(o.labels.rv_endo);
  protocol.anatomy.scheme = scheme(o.scheme);
  if (!o.anterior.empty()) protocol.anatomy.anterior_direction = direction("--anterior", o.anterior);
  protocol.anatomy.septum_point = point("--septum-point", o.septum_point);
  protocol.anatomy.rv_insertion_point = point("--rv-insertion-point", o.rv_insertion_point);
  protocol.anatomy.mitral_point = point("--mitral-point", o.mitral_point);
  auto& fibres = protocol.fibres.emplace();
  fibres.source = protocol::FibreSource::file;
  if (!o.arrays.fibre.empty()) fibres.fibre_array = o.arrays.fibre;
  if (!o.arrays.sheet.empty()) fibres.sheet_array = o.arrays.sheet;
  if (!o.long_axis.empty()) protocol.anatomy.long_axis = direction("--long-axis", o.long_axis);
  return protocol;
}

#ifdef CARDIAC_WITH_VTK
polyaffine::WriteFields fields(const Anatomy& anatomy, const std::vector<ControlNode>& nodes,
                               const HelixAngles& angles, const std::optional<FibreComparison>& given) {
  const TetMesh& mesh = anatomy.mesh;
  const VentricularCoordinates& coordinates = *anatomy.coordinates;
  polyaffine::WriteFields out;
  const int tets = mesh.num_tets();
  std::vector<int> all(tets);
  for (int t = 0; t < tets; ++t) all[t] = t;
  const FibreAxes fibres = helix_fibres(coordinates, all, Eigen::Matrix4Xd::Constant(4, tets, 0.25), angles);
  out.cell_fields["segment"] =
      Eigen::Map<const Eigen::RowVectorXi>(anatomy.segment.data(), tets).cast<double>();
  out.cell_fields["fibre"] = fibres.topRows(3);
  out.cell_fields["sheet"] = fibres.middleRows(3, 3);
  out.cell_fields["normal"] = fibres.bottomRows(3);
  if (given) {
    out.cell_fields["file_fibre"] = given->fibre;
    out.cell_fields["fibre_angle_deg"] = Eigen::Map<const Eigen::RowVectorXd>(given->angle_deg.data(), tets);
  }
  Matrix& node = out.cell_fields["control_node"] = Matrix::Zero(1, tets);
  for (std::size_t i = 0; i < nodes.size(); ++i) node(0, nodes[i].tet) = static_cast<double>(i + 1);

  const int points = mesh.num_points();
  for (const char* name : {"apicobasal", "transmural", "rotational_rad", "transventricular"})
    out.point_fields[name] = Matrix(1, points);
  for (const char* name : {"e_l", "e_c", "e_r", "fibre"}) out.point_fields[name] = Matrix(3, points);
  std::vector<char> done(points, 0);
  for (int t = 0; t < tets; ++t)
    for (int k = 0; k < 4; ++k) {
      const int p = mesh.tets()(k, t);
      if (done[p]) continue;
      done[p] = 1;
      const polyaffine::Vec4 corner = polyaffine::Vec4::Unit(k);
      const CoordinateSample at = coordinates.wall_sample(t, corner);
      const polyaffine::Mat3 axes = orthonormal_axes(at);
      out.point_fields["apicobasal"](0, p) = at.u;
      out.point_fields["transmural"](0, p) = at.t;
      out.point_fields["rotational_rad"](0, p) = at.psi;
      out.point_fields["transventricular"](0, p) = at.w;
      out.point_fields["e_l"].col(p) = axes.col(0);
      out.point_fields["e_c"].col(p) = axes.col(1);
      out.point_fields["e_r"].col(p) = axes.col(2);
      out.point_fields["fibre"].col(p) = wall_fibres(coordinates, t, corner, angles).col(0);
    }
  return out;
}

void write_fields(const SegmentOptions& o, const Anatomy& anatomy, const std::vector<ControlNode>& nodes,
                  const std::optional<FibreComparison>& given) {
  polyaffine::write_vtu(o.out, anatomy.mesh, fields(anatomy, nodes, o.angles, given));
}
#else
void write_fields(const SegmentOptions&, const Anatomy&, const std::vector<ControlNode>&,
                  const std::optional<FibreComparison>&) {
  throw InputError("cardiac segment: this build was made without VTK (CMake option POLYAFFINE_WITH_VTK)");
}
#endif

void print_orientation(const Anatomy& anatomy) {
  for (const std::string& note : orientation_notes(*anatomy.coordinates)) std::cout << note << '\n';
}

void print_segments(const Anatomy& anatomy, const std::vector<ControlNode>& nodes) {
  const int count = num_segments(*anatomy.coordinates);
  const auto volumes = segment_volumes(anatomy.mesh, anatomy.segment, count);
  std::cout << "segment  name                     volume_mL   tets  node_x_mm  node_y_mm  node_z_mm\n"
            << std::fixed;
  for (int s = 1; s <= count; ++s) {
    const polyaffine::Vec3& X = nodes[s - 1].position;
    std::cout << std::setw(7) << s << "  " << std::left << std::setw(23) << aha_name(s) << std::right
              << std::setprecision(4) << std::setw(11) << volumes[s - 1] / mm3_per_mL << std::setw(7)
              << std::count(anatomy.segment.begin(), anatomy.segment.end(), s) << std::setprecision(2)
              << std::setw(11) << X.x() << std::setw(11) << X.y() << std::setw(11) << X.z() << '\n';
  }
  const auto cavity_mL = [&](int label) {
    return polyaffine::EnclosedVolume(anatomy.mesh, {label}).value(anatomy.mesh.points()) / mm3_per_mL;
  };
  std::cout << std::setprecision(4) << "wall    " << anatomy.mesh.volume() / mm3_per_mL << " mL in "
            << anatomy.mesh.num_tets() << " tets\ncavity  " << cavity_mL(anatomy.labels.endo) << " mL\n";
  if (anatomy.labels.rv_endo) std::cout << "right cavity  " << cavity_mL(*anatomy.labels.rv_endo) << " mL\n";
}

// Which of the segments between the ventricles reach from one cavity to the other.
void print_septal(const Anatomy& anatomy) {
  const auto touched_by = [&](int label) {
    std::set<int> out;
    for (std::size_t f = 0; f < anatomy.mesh.boundary_labels().size(); ++f)
      if (anatomy.mesh.boundary_labels()[f] == label)
        out.insert(anatomy.segment[anatomy.mesh.boundary_tets()[f]]);
    return out;
  };
  const std::set<int> left = touched_by(anatomy.labels.endo), right = touched_by(*anatomy.labels.rv_endo);
  std::cout << "touching both endocardia  segments";
  for (const int s : left)
    if (right.contains(s)) std::cout << ' ' << s;
  std::cout << '\n';
}

void print_comparison(const Anatomy& anatomy, const FibreComparison& given) {
  std::cout << "angle between the file's fibres (" << given.description << ") and the rule's, deg\n"
            << "region           volume_mL     mean   median     95 %\n"
            << std::setprecision(1);
  for (const AngleDistribution& d : angle_distribution(anatomy.mesh, *anatomy.coordinates, given.angle_deg))
    std::cout << std::left << std::setw(16) << d.region << std::right << std::setw(10)
              << d.volume_mm3 / mm3_per_mL << std::setw(9) << d.mean_deg << std::setw(9) << d.median_deg
              << std::setw(9) << d.p95_deg << '\n';
}

void segment(const SegmentOptions& o) {
  const Protocol protocol = as_protocol(o);
  check_output_file(o.out, ".vtu", "--out", o.mesh);
  if (!o.picture.empty()) check_output_file(o.picture, ".svg", "--picture");
  const HelixAngles& a = o.angles;
  if (!Eigen::Vector4d(a.endo_deg, a.epi_deg, a.rv_endo_deg, a.rv_epi_deg).allFinite())
    throw InputError(
        "--endo-angle, --epi-angle, --rv-endo-angle, --rv-epi-angle: found a number that is none, "
        "expected degrees");
  std::vector<std::string> warnings;
  const HeartMesh heart = load_heart(protocol, warnings, {"--length-unit", o.force});
  const Anatomy anatomy = anatomy_of(heart, protocol, warnings);
  print_warnings(warnings);
  const auto nodes =
      control_nodes(anatomy.mesh, *anatomy.coordinates, frame_layout(anatomy.mesh, *anatomy.coordinates));
  std::optional<FibreComparison> given;
  if (has_fibres(heart.file))
    given =
        compare_fibres(anatomy.mesh, *anatomy.coordinates, FileFibres(heart.file, o.mesh.string()), o.angles);
  write_fields(o, anatomy, nodes, given);
  print_segments(anatomy, nodes);
  print_orientation(anatomy);
  if (anatomy.labels.rv_endo) print_septal(anatomy);
  if (given) print_comparison(anatomy, *given);
  std::cout << "written " << o.out.string() << " (lengths in mm)\n";
  if (o.picture.empty()) return;
  polyaffine::write_atomically(o.picture,
                               segment_picture_svg(anatomy.mesh, *anatomy.coordinates, anatomy.segment));
  std::cout << "written " << o.picture.string() << '\n';
}

}  // namespace

void add_segment_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "segment", "Divide a ventricle mesh: coordinates, AHA segments, control nodes and fibres as fields");
  const auto o = std::make_shared<SegmentOptions>();
  command->add_option("MESH", o->mesh, "tetrahedral mesh (.vtu, .vtk, .msh, .pts)")->required();
  command->add_option("--scheme", o->scheme, "aha17 (left ventricle) or aha29 (two ventricles)")->required();
  command->add_option("--length-unit", o->length_unit, "length unit of the mesh: mm, cm, m or um")
      ->required();
  command->add_option("--out", o->out, "file to write, .vtu, lengths in mm")->required();
  command->add_option("--picture", o->picture, "also draw the segments from three sides, .svg");
  add_label_options(*command, o->labels);
  add_region_options(*command, o->labels);
  add_fibre_options(*command, o->arrays);
  CLI::App* anterior = command->add_option_group("anterior", "Where anterior is without a right ventricle");
  anterior
      ->add_option("--anterior", o->anterior,
                   "direction from the long axis to the anterior wall (default: +y, with a warning)")
      ->expected(3);
  anterior
      ->add_option("--septum-point", o->septum_point,
                   "point in the middle of the septum, in the unit of the mesh")
      ->expected(3);
  anterior
      ->add_option("--rv-insertion-point", o->rv_insertion_point,
                   "point of the anterior insertion of the right ventricle, in the unit of the mesh")
      ->expected(3);
  anterior->require_option(0, 1);
  command
      ->add_option("--mitral-point", o->mitral_point,
                   "point near the mitral opening, in the unit of the mesh (default: the largest opening)")
      ->expected(3);
  command
      ->add_option("--long-axis", o->long_axis,
                   "direction from apex to base (default: apex of the cavity to the base centre)")
      ->expected(3);
  const CLI::Range angle(-90.0, 90.0);
  command->add_option("--endo-angle", o->angles.endo_deg, "helix angle at the endocardium, deg")
      ->check(angle)
      ->capture_default_str();
  command->add_option("--epi-angle", o->angles.epi_deg, "helix angle at the epicardium, deg")
      ->check(angle)
      ->capture_default_str();
  const CLI::Range turn(-180.0, 180.0);
  command->add_option("--rv-endo-angle", o->angles.rv_endo_deg, "the same of the right free wall, deg")
      ->check(turn)
      ->capture_default_str();
  command->add_option("--rv-epi-angle", o->angles.rv_epi_deg, "the same of the right free wall, deg")
      ->check(turn)
      ->capture_default_str();
  command->add_flag("--force", o->force, "take a wall of any size");
  command->callback([o] {
    o->mesh = given_or_example(o->mesh);
    segment(*o);
  });
}

}  // namespace cardiac::app
