#pragma once
// A velocity or a force that a function gives over place and time, for the length of steps.

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "libfsi/core/types.hpp"
#include "libfsi/field/of_time.hpp"

namespace fsi {

/// Samples a function u(x, t) at up to eight points, to limit steps by its change in time. The
/// first point is that where a component differs most from its value at t = 0, in 64 samples of the
/// run. Each next point is chosen likewise, from those samples in which no earlier point differs
/// from its value at t = 0 by a tenth of the largest range.
class OfPlaceAndTime {
 public:
  /// A vector at a place and a time.
  using Function = std::function<Vec3(const Vec3& x, Real t)>;
  /// points: of this rank, where the function is used. They must outlive it.
  OfPlaceAndTime(Function given, std::span<const Vec3> points)
      : given_(std::move(given)), points_(points) {}
  /// Collective. The shortest `fsi::step_of` of these, by the largest range in [0, end]; end if the
  /// function is constant in time. A change that lasts for less than a part in 64 of the run may be
  /// missed.
  Real step_of(Real t, Real end) const;

 private:
  /// Collective. Finds the points for a run to `end`.
  void choose(Real end) const;

  Function given_;
  std::span<const Vec3> points_;
  // of the last `end` that was asked for, alike on all ranks:
  mutable Real end_ = -1;
  mutable Real whole_ = 0;                // largest range
  mutable std::vector<OfTime> followed_;  // a component at a point each
};

}  // namespace fsi
