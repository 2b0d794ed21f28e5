#pragma once

#include <array>
#include <string>
#include <string_view>

#include <cardiac/protocol/sections.hpp>

/// The words of the protocol file for each enumeration, in the order of its values.
namespace cardiac::protocol {

template <std::size_t count>
using Names = std::array<std::string_view, count>;

constexpr Names<3> names_of(Shape) {
  return {"human_lv", "land_ellipsoid", "human_biventricle"};
}
constexpr Names<4> names_of(LengthUnit) {
  return {"mm", "cm", "m", "um"};
}
constexpr Names<2> names_of(Scheme) {
  return {"aha17", "aha29"};
}
constexpr Names<2> names_of(Method) {
  return {"polyaffine", "fem"};
}
constexpr Names<3> names_of(Preset) {
  return {"fast", "accurate", "tuned"};
}
constexpr Names<2> names_of(Weights) {
  return {"sigmoid", "tents"};
}
constexpr Names<5> names_of(PressureSpace) {
  return {"none", "segment", "segment_depth", "segment_linear", "segment_bilinear"};
}
constexpr Names<3> names_of(Axes) {
  return {"heart", "cartesian", "auto"};
}
constexpr Names<3> names_of(Integration) {
  return {"cells", "gauss", "trained"};
}
constexpr Names<5> names_of(TissueLaw) {
  return {"guccione", "holzapfel_ogden", "neo_hookean", "mooney_rivlin", "saint_venant_kirchhoff"};
}
constexpr Names<2> names_of(FibreSource) {
  return {"rule", "file"};
}
constexpr Names<1> names_of(FibreRule) {
  return {"helix"};
}
constexpr Names<4> names_of(ActivationMode) {
  return {"uniform", "sites", "array", "table"};
}
constexpr Names<4> names_of(ContractionModel) {
  return {"bestel_clement_sorine_simplified", "table", "bestel_clement_sorine", "land_2017"};
}
constexpr Names<3> names_of(Repeats) {
  return {"auto", "yes", "no"};
}
constexpr Names<4> names_of(Loop) {
  return {"windkessel", "closed_2022", "network", "svzerod"};
}
constexpr Names<3> names_of(SvZeroDUnits) {
  return {"mmHg_mL_s", "dyn_cm_s", "Pa_m_s"};
}
constexpr Names<5> names_of(CompartmentType) {
  return {"vessel", "chamber", "ventricle", "pressure", "junction"};
}
constexpr Names<2> names_of(CavityName) {
  return {"lv", "rv"};
}
constexpr Names<3> names_of(ElementType) {
  return {"resistance", "valve", "pump"};
}
constexpr Names<3> names_of(ValveLaw) {
  return {"smooth", "arctan", "tanh"};
}
constexpr Names<3> names_of(Base) {
  return {"clamped", "elastic", "sliding"};
}
constexpr Names<2> names_of(SupportDirections) {
  return {"normal", "all"};
}
constexpr Names<2> names_of(HeightLaw) {
  return {"linear", "smooth"};
}

/// The word of one value, for instance "polyaffine" for Method::polyaffine.
template <class Enum>
std::string name_of(Enum value) {
  return std::string(names_of(value)[static_cast<std::size_t>(value)]);
}

}  // namespace cardiac::protocol
