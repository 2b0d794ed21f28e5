#pragma once

#include <memory>

#include <cardiac/circulation/circulation_model.hpp>
#include <polyaffine/system/term.hpp>

namespace cardiac {

/// A circulation ż = f(t, z, p) of the cavities' volumes and its own states z under the cavities'
/// pressures p. Newton's method meets it as it is: stiff valves bend sharply.
class CirculationTerm : public polyaffine::Term {
 public:
  CirculationTerm(std::shared_ptr<const CirculationModel> model, polyaffine::Unknowns volumes,
                  polyaffine::Unknowns vessels, polyaffine::Unknowns pressures);

  void add_residual(const polyaffine::At& at, polyaffine::Residual& out) const override;
  void add_tangent(const polyaffine::At& at, double alpha, polyaffine::Tangent& out) const override;
  bool is_met_exactly() const override { return true; }

 private:
  polyaffine::Vector states(const polyaffine::Vector& y) const;

  std::shared_ptr<const CirculationModel> model_;
  polyaffine::Unknowns volumes_, vessels_, pressures_;
};

}  // namespace cardiac
