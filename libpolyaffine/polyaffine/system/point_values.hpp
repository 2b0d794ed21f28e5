#pragma once

#include <functional>
#include <memory>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// Numbers of integration points at a time (an active tension, kPa), shared with whoever computed them.
using PointValues = std::function<std::shared_ptr<const Vector>(double t)>;

/// The values of a function of time; those of the last time asked for are kept, since a system is looked at
/// several times at each. May be called from several threads.
PointValues remembered(std::function<Vector(double t)> values);

/// The same values at all times.
PointValues constant_values(Vector values);

/// On the straight way from some values (t = 0) to others (t = 1).
PointValues ramp(Vector from, Vector to);

}  // namespace polyaffine
