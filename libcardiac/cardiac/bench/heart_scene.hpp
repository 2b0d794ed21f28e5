#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <cardiac/bench/bench.hpp>
#include <cardiac/protocol/protocol.hpp>

namespace cardiac {

/// One equilibrium of a heart with the tissue of its protocol, base clamped: pressures of the cavities, mmHg,
/// and active tension along the fibres, kPa, times the tension factors of regions.
struct HeartScene {
  std::string group, name, title;  ///< the group is what a user asks for
  std::string heart;               ///< name of its mesh
  double left_mmHg = 0, right_mmHg = 0, tension_kPa = 0;
  std::vector<std::string> settings{};  ///< key=value on top of the protocol
};

/// - biv_passive, biv_systole, biv_scar: the coarse mesh of two idealised ventricles, filled (10 and 5 mmHg),
///   at end systole (90 and 20 mmHg, 90 kPa) and there with a fifth of the tension in segments 7 and 8;
/// - lv_real, lv_arostica, biv_arostica, papillary: hearts that other programs made and a wall with two
///   muscles that stand into the cavity, each filled and at end systole.
const std::vector<HeartScene>& heart_scenes();

/// Where hearts come from: nothing where a mesh is absent or cannot be made.
struct HeartSource {
  using Input = std::function<std::optional<Protocol>(const std::string& heart,
                                                      const std::vector<std::string>& settings)>;
  Input input;   ///< the heart on its mesh
  Input coarse;  ///< on the coarsest mesh that the mesher makes inside its surface
};

/// Solves a scene by quadratic elements on the heart's mesh, the reference, and on a coarse one, and by the
/// presets of the context on the heart's mesh, all on one thread; no result without the heart. Throws
/// ComputationError when the reference does not converge.
std::optional<SceneResult> run_heart_scene(const HeartScene& scene, const HeartSource& source,
                                           const BenchContext& context);

}  // namespace cardiac
