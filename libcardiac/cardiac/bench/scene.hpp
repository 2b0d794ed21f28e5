#pragma once

#include <functional>
#include <string>
#include <vector>

#include <cardiac/anatomy/idealised.hpp>

namespace cardiac {

/// Loads of one equilibrium, kPa.
struct SceneLoad {
  double pressure_kPa = 0;
  std::function<double(const Vec3& X)> tension_kPa{};  ///< along the fibres; empty: none
};

/// A static problem on an idealised ventricle whose base is clamped, known without any mesh.
struct BenchScene {
  std::string group, name, title;  ///< the group is what a user asks for; most have one scene, of its name
  TruncatedEllipsoid shape;
  std::string protocol;  ///< TOML: law, fibres and which loads act
  std::vector<SceneLoad>
      path;  ///< loads in numbers: equilibria reached one after the other from the unloaded wall at rest
  /// From a place of the ellipsoid to that of the wall and back; empty: the wall is the ellipsoid.
  std::function<Vec3(const Vec3&X)> to_wall{}, to_ellipsoid{};
  bool other_heart = false;  ///< the presets alone are shown on it
};

inline constexpr auto kCompliance = "compliance";

/// The static scenes of the bench, group by group:
/// - ellipsoid_passive: isochoric neo-Hookean wall with κ/2 (J − 1)², E = 10 kPa, ν = 0.49, pressure 1 kPa;
/// - end_systole: isochoric Guccione 2/8/2/4 with 300/2 (J − 1)², fibres +60° to −60° linear in the depth of
///   Land's family of ellipsoids, tension 75 f⊗f (second Piola–Kirchhoff) and pressure 13.5 kPa together;
/// - end_systole_scar: from there, the tension in segments 7 and 8 falls to a fifth, with a smooth border of
///   a tenth of a segment;
/// - end_systole_human: end_systole on the human ventricle of idealised.hpp;
/// - end_systole_asymmetric: end_systole where thickness and tension vary by 40 % around the circumference:
///   the depth of Land's wall is stretched by 1 + w cos ψ / 5 (anterior, ψ = 0, thickest), w a smooth step
///   from 0 at the apex to 1 at the base, the tension by 1 − cos ψ / 5;
/// - compliance: ellipsoid_passive at 0.02 kPa and ν = 0.3 … 0.4999, to see whether a model locks.
const std::vector<BenchScene>& bench_scenes();

/// Share (0 to 1) of some AHA segments in a place of an idealised ventricle, anterior being +y: the exact
/// counterpart of segment_shares on a mesh.
double ellipsoid_segment_share(const TruncatedEllipsoid& shape, const std::vector<int>& segments,
                               double border, const Vec3& X);

}  // namespace cardiac
