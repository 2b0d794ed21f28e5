#include <cardiac/protocol/conditions.hpp>
#include <cardiac/protocol/rules.hpp>

namespace cardiac::protocol {

Condition contracts() {
  return {"[contraction]", [](const Protocol& p, std::size_t) { return p.contraction.has_value(); }};
}

Condition beats() {
  return {"[circulation]", [](const Protocol& p, std::size_t) { return p.circulation.has_value(); }};
}

Condition in_time() {
  return {"[contraction] or a file of [cavities]", [](const Protocol& p, std::size_t) {
            return p.contraction || (p.cavities && (p.cavities->pressure_file || p.cavities->volume_file));
          }};
}

Condition one_pressure() {
  return {"no file of [cavities]", [](const Protocol& p, std::size_t) {
            return !(p.cavities && (p.cavities->pressure_file || p.cavities->volume_file));
          }};
}

Condition calcium_formula() {
  return {"no contraction.calcium_file",
          [](const Protocol& p, std::size_t) { return !(p.contraction && p.contraction->calcium_file); }};
}

Condition files() {
  return {"pressure_file or volume_file", [](const Protocol& p, std::size_t) {
            return p.cavities && (p.cavities->pressure_file || p.cavities->volume_file);
          }};
}

Condition windkessels() {
  return {"circulation.loop = windkessel", [](const Protocol& p, std::size_t) {
            return p.circulation && p.circulation->loop == Loop::windkessel;
          }};
}

Condition networks() {
  return {"circulation.loop = network", [](const Protocol& p, std::size_t) {
            return p.circulation && p.circulation->loop == Loop::network;
          }};
}

Condition prescribed() {
  return {"a run without [circulation]",
          [](const Protocol& p, std::size_t) { return !p.circulation.has_value(); }};
}

Condition reduced() {
  return {"reduction.method = polyaffine",
          [](const Protocol& p, std::size_t) { return p.reduction.method == Method::polyaffine; }};
}

Condition untrained() {
  return {"reduction.preset = fast or accurate",
          [](const Protocol& p, std::size_t) { return p.reduction.preset != Preset::tuned; }};
}

Condition separate_volume() {
  return {"a tissue.law other than saint_venant_kirchhoff",
          [](const Protocol& p, std::size_t) { return p.tissue.law != TissueLaw::saint_venant_kirchhoff; }};
}

Condition mixed() {
  return {"a reduction.pressure_space other than none",
          [](const Protocol& p, std::size_t) { return p.reduction.pressure_space != PressureSpace::none; }};
}

Condition tents() {
  return {"reduction.weights = tents",
          [](const Protocol& p, std::size_t) { return p.reduction.weights == Weights::tents; }};
}

Condition one_ventricle() {
  return {"anatomy.scheme = aha17",
          [](const Protocol& p, std::size_t) { return p.anatomy.scheme != Scheme::aha29; }};
}

Condition two_ventricles() {
  return {"anatomy.scheme = aha29",
          [](const Protocol& p, std::size_t) { return p.anatomy.scheme == Scheme::aha29; }};
}

Condition along_fibres() {
  return {"[contraction] or an anisotropic tissue.law",
          [](const Protocol& p, std::size_t) { return needs_fibres(p); }};
}

Condition along_sheets() {
  return {"tissue.law = holzapfel_ogden",
          [](const Protocol& p, std::size_t) { return p.tissue.law == TissueLaw::holzapfel_ogden; }};
}

Condition held() {
  return {"a stiffness or damping of the epicardium",
          [](const Protocol& p, std::size_t) { return p.boundary.holds_epicardium(); }};
}

Condition differs() {
  return {"a factor or delay of its [[region]] that differs from the rest",
          [](const Protocol& p, std::size_t entry) { return region_differs(p, p.regions.at(entry)); }};
}

Condition some_differ() {
  return {"a [[region]] that differs from the rest",
          [](const Protocol& p, std::size_t) { return regions_differ(p); }};
}

}  // namespace cardiac::protocol
