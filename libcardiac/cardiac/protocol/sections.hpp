#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <cardiac/circulation/network.hpp>
#include <cardiac/scene/scene.hpp>

/// The tables of a protocol that are no part of its scene: where the mesh is and how it lies.
namespace cardiac::protocol {

using namespace cardiac::scene;

using Labels = std::vector<std::variant<int, std::string>>;  ///< numbers or names of surfaces

enum class Shape { human_lv, land_ellipsoid, human_biventricle };
enum class LengthUnit { mm, cm, m, um };
/// Length of a unit, mm.
constexpr double mm_per_unit(LengthUnit unit) {
  constexpr std::array<double, 4> kLength{1, 10, 1000, 1e-3};
  return kLength.at(static_cast<std::size_t>(unit));
}
struct Mesh {
  std::optional<std::string> file;  ///< either file (with its length_unit) or shape
  std::optional<Shape> shape;
  std::optional<double> size_mm;            ///< edge length of a generated mesh; absent: the shape's own
  double cavity_scale = 1, wall_scale = 1;  ///< of Shape::human_lv, see scaled
  std::optional<LengthUnit> length_unit;
  std::optional<std::string> surface_file, label_array, region_array;
  std::optional<std::vector<std::string>> surface_files;  ///< NAME=FILE, one surface each
  std::optional<Labels> endo_label, epi_label, base_label, rv_endo_label, region;
  std::optional<double> pressure_kPa, right_pressure_kPa;  ///< that the shape was imaged under
};

enum class Scheme { aha17, aha29 };
struct Anatomy {
  std::optional<Scheme> scheme;               ///< absent: by the mesh; the parser sets it for a shape
  std::optional<Vector3> long_axis;           ///< apex to base; absent: found on the mesh
  std::optional<Vector3> anterior_direction;  ///< absent: by a point, else +y
  std::optional<Vector3> septum_point, rv_insertion_point, mitral_point;  ///< in the unit of the mesh
};

/// A compartment and an element of a circulation's network as the file tells them, in units of the scene;
/// build_network makes the network.
struct NetworkCompartment {
  std::string name;
  CompartmentType type = CompartmentType::vessel;
  CavityName cavity = CavityName::lv;
  double compliance_mm3_per_kPa = 0, pressure_kPa = 0;
  double active_kPa_per_mm3 = 0, passive_kPa_per_mm3 = 0, unstressed_mm3 = 0, volume_mm3 = 60 * mm3_per_mL;
  double onset_ms = 0, contraction_ms = 170, relaxation_ms = 170;
};
struct NetworkElement {
  std::string name, from, to;
  ElementType type = ElementType::resistance;
  double resistance_kPa_ms_per_mm3 = 0, inertance_kPa_ms2_per_mm3 = 0, stenosis_kPa_ms2_per_mm6 = 0;
  double flow_mm3_per_ms = 0;
  std::optional<double> leak_kPa_ms_per_mm3;
  ValveLaw law = ValveLaw::smooth;
  double smoothing_kPa = Valve{}.smoothing_kPa, sharpness_per_kPa = 200 / kPa_per_mmHg;
  double series_kPa_ms_per_mm3 = 0;
  std::optional<std::string> between;
  double head_kPa = 0;
  std::optional<double> pump_flow_mm3_per_ms;
};

}  // namespace cardiac::protocol
