#pragma once

#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/material/neo_hookean.hpp>
#include <polyaffine/material/signed_volume.hpp>
#include <polyaffine/material/viscosity.hpp>
#include <polyaffine/system/field_term.hpp>
#include <polyaffine/system/inertia.hpp>
#include <polyaffine/system/support.hpp>
#include <polyaffine/system/system.hpp>

#include "support/labelled_box.hpp"

namespace polyaffine::testing {

/// A block of 2 × 1 × 1 mm in linear elements, held at x = 0, with terms of every kind: a viscous solid with
/// a pressure space, inertia, and a support at its free end.
struct BlockBody {
  TetMesh mesh = labelled_box(Vec3::Zero(), Vec3(2, 1, 1), {2, 1, 1}, 0.1);
  LagrangeBasis basis{mesh, 1};

  using Laws = std::vector<std::shared_ptr<const Law>>;

  std::shared_ptr<const FieldEnergy> wall(double viscosity, double kappa) const {
    FieldTable table = deformation_table(basis, basis.wall_points(1));
    std::optional<PressureSpace> space;
    if (kappa > 0) space = block_pressure(table, kappa);
    return std::make_shared<FieldEnergy>(
        std::move(table),
        Laws{std::make_shared<NeoHookean>(Lame{20, 10}), std::make_shared<KelvinVoigt>(viscosity)}, space);
  }
  FieldTable end() const { return displacement_table(basis, basis.surface_points(mesh, {kXHigh}, 2)); }
  Points end_normals() const {
    return Vec3::UnitX().replicate(1, basis.surface_points(mesh, {kXHigh}, 2).X.cols());
  }
  std::shared_ptr<const Term> support(SupportParameters parameters) const {
    return std::make_shared<Support>(end(), std::move(parameters));
  }
  /// Adds inertia (1.06 mg/mm³) and its velocity to a system of this body.
  void add_inertia(System& system) const {
    system.terms.push_back(std::make_shared<Inertia>(displacement_table(basis, basis.wall_points(2)), 1.06,
                                                     1e-3, system.layout));
  }
  System system(Terms terms) const {
    System out = field_system(3 * basis.num_functions(), std::move(terms));
    out.fixed.assign(3 * basis.num_functions(), 0);
    for (const int node : basis.surface_nodes(mesh, {kXLow}))
      for (int k = 0; k < 3; ++k) out.fixed[3 * node + k] = 1;
    return out;
  }
};

}  // namespace polyaffine::testing
