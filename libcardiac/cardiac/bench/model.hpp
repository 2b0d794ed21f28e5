#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/bench/scene.hpp>
#include <cardiac/model/ventricle.hpp>
#include <cardiac/protocol/protocol.hpp>
#include <polyaffine/kinematics/lagrange.hpp>

namespace cardiac {

/// A scene on a mesh, by one method, ready to be solved. Scene and mesh must outlive it.
class BenchModel {
 public:
  /// `settings` are texts key=value on top of the scene's protocol (reduction.method, reduction.preset, …).
  /// Throws InputError as the protocol, the anatomy and the model do.
  BenchModel(const BenchScene& scene, const CurvedMesh& mesh, const std::vector<std::string>& settings);

  const Ventricle& ventricle() const { return ventricle_; }
  const Anatomy& anatomy() const { return *ventricle_.anatomy; }
  bool reduced() const { return ventricle_.discretisation.frame_basis != nullptr; }
  std::string preset() const;       ///< as in the protocol; empty for full order
  std::string integration() const;  ///< as in the protocol; empty for full order
  int control_nodes() const;
  double cavity_at_rest() const;
  /// Deformed over reference volume of the cavity.
  double cavity_ratio(const polyaffine::Vector& c) const {
    return ventricle_.cavity_volume(c) / cavity_at_rest();
  }
  /// Processor time from mesh to this object, without the making of the mesh.
  double setup_s() const { return setup_s_; }

  struct Solution {
    polyaffine::Vector c;
    bool converged = false;
    double reached = 0;  ///< equilibria of the path reached, the last one in part
    int load_steps = 0, newton_iterations = 0;
    double solve_s = 0;  ///< processor time
  };
  /// Follows the scene's path from zero.
  Solution solve() const;
  /// Follows any path of loads from zero, with the options of all scenes.
  static Solution solve(const Ventricle& ventricle, const std::vector<WallLoad>& path,
                        polyaffine::LinearSystem& linear);
  /// A solution with the median time of some, where one takes no half second.
  static Solution timed(const std::function<Solution()>& solve);

 private:
  protocol::Reduction reduction_;
  Ventricle ventricle_;
  std::vector<WallLoad> path_;
  std::unique_ptr<polyaffine::LinearSystem> linear_;
  double setup_s_ = 0;
};

}  // namespace cardiac
