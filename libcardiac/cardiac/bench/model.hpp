#pragma once

#include <memory>
#include <string>
#include <vector>

#include <cardiac/bench/scene.hpp>
#include <cardiac/heart/ventricle.hpp>
#include <polyaffine/kinematics/lagrange.hpp>

namespace cardiac {

/// A mesh of a scene's shape, and the midpoints that put its quadratic edges where they belong.
struct BenchMesh {
  polyaffine::TetMesh mesh;
  polyaffine::EdgeMidpoints midpoints;
};

/// A scene on a mesh, by one method, ready to be solved. Scene and mesh must outlive it.
class BenchModel {
 public:
  /// `settings` are texts key=value on top of the scene's protocol (reduction.method, reduction.preset, …).
  /// Throws InputError as the protocol, the anatomy and the model do.
  BenchModel(const BenchScene& scene, const BenchMesh& mesh, const std::vector<std::string>& settings);

  const Ventricle& ventricle() const { return ventricle_; }
  const Anatomy& anatomy() const { return *ventricle_.anatomy; }
  /// The elements that hold the model's material points.
  const polyaffine::LagrangeBasis& elements() const;
  bool reduced() const { return ventricle_.discretisation.frame_basis != nullptr; }
  int control_nodes() const;
  double cavity_at_rest() const;
  /// Deformed over reference volume of the cavity.
  double cavity_ratio(const polyaffine::Vector& c) const {
    return ventricle_.cavity_volume(c) / cavity_at_rest();
  }
  /// From mesh to this object, without the making of the mesh.
  double setup_s() const { return setup_s_; }

  struct Solution {
    polyaffine::Vector c;
    bool converged = false;
    double reached = 0;  ///< equilibria of the path reached, the last one in part
    int load_steps = 0, newton_iterations = 0;
    double solve_s = 0;
  };
  /// Follows the scene's path from zero, on the thread that calls.
  Solution solve() const;

 private:
  const BenchScene& scene_;
  Ventricle ventricle_;
  std::vector<WallLoad> path_;
  std::unique_ptr<polyaffine::LinearSystem> system_;
  double setup_s_ = 0;
};

}  // namespace cardiac
