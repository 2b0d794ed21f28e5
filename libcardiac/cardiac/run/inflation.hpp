#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <cardiac/run/beat.hpp>

namespace cardiac {

/// A shape under load.
struct Inflated {
  polyaffine::Points points;                    ///< its vertices, mm
  polyaffine::Vector free_mm3{}, loaded_mm3{};  ///< volumes of the cavities without and with the load
  double reached = 0;                           ///< share of the load in equilibrium
  std::string why{};                            ///< why it stopped before the whole load; empty: it was wide

  bool whole() const { return reached == 1; }
};

/// Passive inflation of shapes of one heart, one after the other, under the same pressures: each from the
/// last equilibrium on, by Newton's method, or raised from zero where that fails.
class Inflation {
 public:
  /// The scene (without contraction at work) and the control must outlive it; pressures in kPa, one a cavity.
  Inflation(const Scene& scene, polyaffine::Vector pressures_kPa, const RunControl& control)
      : scene_(scene), pressures_kPa_(std::move(pressures_kPa)), control_(control) {}

  /// A shape under the pressures; raised from zero, it is followed no further than to `wide` times
  /// `volume_mm3` (0: of its own) of the cavities that have a pressure. Throws InputError as build_ventricle.
  Inflated inflate(const std::shared_ptr<const Anatomy>& shape, double wide, double volume_mm3 = 0);

  /// The filling of a shape from no pressure to `factor` times the pressures, as far as there are equilibria:
  /// of every step (`steps` at least) the share of the pressures and the volumes, mm³.
  std::vector<std::pair<double, polyaffine::Vector>> fill(const std::shared_ptr<const Anatomy>& shape,
                                                          double factor, int steps) const;

  /// Of the cavities that have a pressure.
  double loaded_sum(const polyaffine::Vector& volumes_mm3) const;

 private:
  bool from_the_last(const Ventricle& model, const WallLoad& load, polyaffine::Vector& c) const;

  const Scene& scene_;
  polyaffine::Vector pressures_kPa_;
  const RunControl& control_;
  polyaffine::Vector last_;  // coefficients of the last equilibrium
};

}  // namespace cardiac
