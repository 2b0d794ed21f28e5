#include "load_mesh.hpp"

#include <cmath>
#include <memory>

#include <cardiac/activation/activation.hpp>
#include <cardiac/anatomy/orientation.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/fibres/file_fibres.hpp>
#include <cardiac/protocol/build_anatomy.hpp>
#include <cardiac/protocol/names.hpp>
#include <cardiac/reduction/axes_check.hpp>
#include <cardiac/scene/presets.hpp>
#include <polyaffine/core/error.hpp>

#include "biventricle_mesh.hpp"
#include "ellipsoid_mesh.hpp"
#include "read_heart.hpp"

namespace cardiac::app {
namespace {

// Share of tets in which fibres may be far apart without a word: about the apex all directions meet.
constexpr double kAmbiguous = 0.05;

HeartMeshOptions options_of(const Protocol& protocol, const WallSizeRule& size) {
  const protocol::Mesh& mesh = protocol.mesh;
  HeartMeshOptions options;
  options.mm_per_unit = mm_per_unit(*mesh.length_unit);
  options.size = size;
  options.label_array = mesh.label_array.value_or("");
  options.labels = {mesh.endo_label.value_or(protocol::Labels{}), mesh.epi_label.value_or(protocol::Labels{}),
                    mesh.base_label.value_or(protocol::Labels{}),
                    mesh.rv_endo_label.value_or(protocol::Labels{})};
  options.regions = {mesh.region.value_or(protocol::Labels{}), mesh.region_array.value_or("")};
  if (protocol.fibres && protocol.fibres->source == protocol::FibreSource::file) {
    options.fibre_arrays = {protocol.fibres->fibre_array.value_or(""),
                            protocol.fibres->sheet_array.value_or("")};
    options.all_fields = true;  // what there is, a message about missing fibres names
  }
  if (protocol.activation && protocol.activation->mode == protocol::ActivationMode::array)
    options.all_fields = true;
  if (protocol.boundary.epicardial_weight_array) options.all_fields = true;
  return options;
}

SurfaceFiles surfaces_of(const Protocol& protocol) {
  SurfaceFiles out;
  if (protocol.mesh.surface_file) out.labelled = surface_path(protocol);
  if (!protocol.mesh.surface_files) return out;
  out = surface_files(*protocol.mesh.surface_files);
  const auto from_protocol = [&](std::filesystem::path& file) {
    if (!file.empty()) file = (protocol.directory / file).lexically_normal();
  };
  from_protocol(out.labelled);
  for (auto& [surface, file] : out.of_surface) from_protocol(file);
  return out;
}

HeartMesh read(const Protocol& protocol, std::vector<std::string>& warnings, const WallSizeRule& size) {
  HeartMesh heart =
      read_heart(read_any_mesh(mesh_path(protocol)), surfaces_of(protocol), options_of(protocol, size));
  for (const auto& list : {heart.warnings, heart.file.notes})
    for (const std::string& text : list) warnings.push_back(mesh_path(protocol).string() + ": " + text);
  return heart;
}

polyaffine::TetMesh generate(const Protocol& protocol) {
  if (*protocol.mesh.shape == protocol::Shape::human_biventricle) {
    const IdealisedBiventricle shape = human_biventricle();
    return mesh_biventricle(shape, protocol.mesh.size_mm.value_or(default_mesh_size_mm(shape)));
  }
  const TruncatedEllipsoid shape = ellipsoid_of(protocol.mesh);
  return mesh_truncated_ellipsoid(shape, protocol.mesh.size_mm.value_or(default_mesh_size_mm(shape)));
}

}  // namespace

HeartMesh load_heart(const Protocol& protocol, std::vector<std::string>& warnings, const WallSizeRule& size) {
  if (!protocol.mesh.shape) return read(protocol, warnings, size);
  HeartMesh heart;
  heart.file.mesh = generate(protocol);
  return heart;
}

Anatomy anatomy_of(const HeartMesh& heart, const Protocol& protocol, std::vector<std::string>& warnings) {
  if (protocol.mesh.shape) return build_anatomy(heart.file.mesh, protocol);
  try {
    Anatomy out = build_anatomy(heart.file.mesh, protocol);
    for (const std::string& text : orientation_warnings(out.mesh, out.labels, *out.coordinates))
      warnings.push_back(mesh_path(protocol).string() + ": " + text);
    return out;
  } catch (const polyaffine::InputError& error) {
    throw polyaffine::InputError(mesh_path(protocol).string() + ": " + error.what());
  }
}

namespace {

// How firmly the epicardium is held at each vertex, by an array of the mesh file.
polyaffine::Vector epicardial_weight(const HeartMesh& heart, const Protocol& protocol) {
  const std::string& name = *protocol.boundary.epicardial_weight_array;
  const std::string where = mesh_path(protocol).string() + ": boundary.epicardial_weight_array: found ";
  const auto& fields = heart.file.point_fields;
  const auto field = fields.find(name);
  if (field == fields.end()) {
    std::string there;
    for (const auto& [other, values] : fields) there += (there.empty() ? "" : ", ") + other;
    throw polyaffine::InputError(where + "no array \"" + name + "\" of points, expected one of: " +
                                 (there.empty() ? "(the file has none)" : there));
  }
  const polyaffine::Matrix& values = field->second;
  if (values.rows() != 1)
    throw polyaffine::InputError(where + std::to_string(values.rows()) + " numbers a point in \"" + name +
                                 "\", expected one");
  if (Eigen::Index at = 0; values.row(0).minCoeff(&at) < 0)
    throw polyaffine::InputError(where + std::to_string(values(0, at)) + " in \"" + name + "\" at point " +
                                 std::to_string(at) + ", expected factors of at least 0");
  return values.row(0).transpose();
}

Anatomy with_fibres(const HeartMesh& heart, const Protocol& protocol, std::vector<std::string>& warnings) {
  Anatomy anatomy = anatomy_of(heart, protocol, warnings);
  if (protocol.boundary.epicardial_weight_array)
    anatomy.epicardial_weight = epicardial_weight(heart, protocol);
  if (!protocol.fibres) return anatomy;
  if (protocol.fibres->source == protocol::FibreSource::file) {
    const auto fibres = std::make_shared<const FileFibres>(heart.file, mesh_path(protocol).string());
    if (const double share = fibres->ambiguous_share(); share > kAmbiguous)
      warnings.push_back(
          mesh_path(protocol).string() + ": in " + std::to_string(std::lround(100 * share)) +
          " % of the tets its fibres of points are more than 40° apart: taken to turn by way of "
          "the circumferential direction; a finer mesh or fibres of tets say for sure");
    anatomy.fibres = FileFibreFunction{fibres};
  } else if (has_fibres(heart.file)) {
    warnings.push_back(mesh_path(protocol).string() +
                       ": its fibres are not used: fibres.source is rule, expected file for them");
  }
  return anatomy;
}

}  // namespace

Anatomy load_anatomy(const Protocol& protocol, std::vector<std::string>& warnings) {
  return with_fibres(load_heart(protocol, warnings), protocol, warnings);
}

namespace {

// The activation times of the mesh file's point array.
std::shared_ptr<const ActivationMap> activation_map(const HeartMesh& heart, const Protocol& protocol) {
  const auto& a = *protocol.activation;
  const std::string name = a.array_ms ? *a.array_ms : a.array_s.value_or("activation_ms");
  return std::make_shared<const ActivationMap>(
      map_of_array(heart.file, name, a.array_s ? ms_per_s : 1, mesh_path(protocol).string()));
}

// Whether one ventricle leaves its reduced model no choice but Cartesian axes, for which the untrained
// presets have functions of their own.
bool turns_to_cartesian(const Anatomy& anatomy, const Protocol& protocol,
                        std::vector<std::string>& warnings) {
  const auto& reduction = protocol.reduction;
  return reduction.method == protocol::Method::polyaffine && !is_tuned(protocol) &&
         reduction.weights == protocol::Weights::tents && reduction.axes == protocol::Axes::automatic &&
         anatomy.coordinates->right() == nullptr &&
         axes_of(anatomy, protocol, warnings) == protocol::Axes::cartesian;
}

}  // namespace

Protocol load_input(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                    const WallSizeRule& size) {
  Protocol out = load_protocol(file, overrides);
  check_mesh_file(out);
  std::vector<std::string> warnings, all = overrides;
  const HeartMesh heart = load_heart(out, warnings, size);
  if (out.scheme_assumed) {
    const bool two = heart.file.mesh.surface({kRvEndocardium}).cols() > 0;
    all.push_back("anatomy.scheme=" +
                  protocol::name_of(two ? protocol::Scheme::aha29 : protocol::Scheme::aha17));
    out = load_protocol(file, all);
  }
  const auto anatomy = std::make_shared<const Anatomy>(with_fibres(heart, out, warnings));
  if (turns_to_cartesian(*anatomy, out, warnings)) {
    all.emplace_back("reduction.axes=cartesian");
    out = load_protocol(file, all);
  }
  out.heart = anatomy;
  if (out.activation && out.activation->mode == protocol::ActivationMode::array)
    out.activation->map = activation_map(heart, out);
  out.warnings.insert(out.warnings.end(), warnings.begin(), warnings.end());
  return out;
}

}  // namespace cardiac::app
