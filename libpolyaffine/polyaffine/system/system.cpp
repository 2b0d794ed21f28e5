#include "polyaffine/system/system.hpp"

#include <utility>

namespace polyaffine {
namespace {

// Keeps of coefficients or forces what the held directions leave free.
void slide(const HeldDirections& held, Eigen::Ref<Vector> field) {
  for (const HeldDirection& h : held) {
    auto v = field.segment<3>(3 * static_cast<Eigen::Index>(h.function));
    v -= h.direction * h.direction.dot(v);
  }
}

}  // namespace

Residual System::residual(const At& at) const {
  Residual out;
  out.values = Vector::Zero(size());
  for (const auto& term : terms) term->add_residual(at, out);
  const Unknowns c = layout.field();
  if (projection) {
    restrict(c.of(out.values));
    return out;
  }
  for (const HeldDirection& h : held) {
    auto r = out.values.segment<3>(3 * static_cast<Eigen::Index>(h.function));
    const auto moved = at.y.segment<3>(3 * static_cast<Eigen::Index>(h.function));
    r += h.direction * h.direction.dot(moved - r);
  }
  for (Eigen::Index i = 0; i < std::ssize(fixed); ++i)
    if (fixed[static_cast<std::size_t>(i)])
      out.values[i] = at.y[i] - (prescribed.size() > 0 ? at.t * prescribed[i] : 0.0);
  return out;
}

void System::prescribe(double t, Vector& y) const {
  const Unknowns c = layout.field();
  if (projection) c.of(y) = (t * projection->c0 + projection->Z * projection->reduce(c.of(y))).eval();
  slide(held, c.of(y));
  for (Eigen::Index i = 0; i < std::ssize(fixed); ++i)
    if (fixed[static_cast<std::size_t>(i)]) y[i] = prescribed.size() > 0 ? t * prescribed[i] : 0.0;
}

void System::restrict(Eigen::Ref<Vector> force) const {
  if (projection) force = (projection->Z * projection->reduce(force)).eval();
  slide(held, force);
  for (Eigen::Index i = 0; i < std::ssize(fixed); ++i)
    if (fixed[static_cast<std::size_t>(i)]) force[i] = 0;
}

std::unique_ptr<LinearSystem> System::make_linear() const {
  if (linear) return linear(*this);
  return projection ? projected_system(projection) : dense_system(layout.field().size, fixed, held);
}

System field_system(int num_unknowns, Terms terms, std::vector<char> fixed, double tolerance_mm) {
  System out;
  out.layout.add(
      {.name = "displacement", .unit = "mm", .solved = Solved::field, .absolute_tolerance = tolerance_mm},
      num_unknowns);
  out.terms = std::move(terms);
  out.fixed = std::move(fixed);
  return out;
}

System mixed_form(const System& system) {
  System out = system;
  for (auto& term : out.terms)
    if (auto mixed = term->mixed(out.layout)) term = std::move(mixed);
  return out;
}

}  // namespace polyaffine
