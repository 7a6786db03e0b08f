#pragma once
// A number that is given over time.

#include <array>
#include <functional>
#include <type_traits>
#include <utility>

#include "libfsi/core/types.hpp"

namespace fsi {

/// A number that may depend on time.
class OfTime {
 public:
  /// The least and the largest value between two times.
  using Range = std::array<Real, 2>;
  /// A constant.
  OfTime(Real constant = 0)
      : at_([constant](Real) { return constant; }), range_([constant](Real, Real) {
          return Range{constant, constant};
        }) {}
  template <class Function>
  /// Any function of time. Its range is that of samples.
  requires std::is_invocable_r_v<Real, Function, Real> OfTime(Function function)
      : at_(std::move(function)) {}
  /// A function of time and its range between two times.
  OfTime(std::function<Real(Real)> function, std::function<Range(Real, Real)> range)
      : at_(std::move(function)), range_(std::move(range)) {}
  /// No value given.
  static OfTime nothing() {
    OfTime none;
    none.at_ = nullptr;
    return none;
  }
  /// Whether a value is given.
  bool any() const { return static_cast<bool>(at_); }
  /// Its value at time t.
  Real operator()(Real t) const { return at_(t); }
  /// Its range from time a to time b.
  Range range(Real a, Real b) const;

 private:
  std::function<Real(Real)> at_;
  std::function<Range(Real, Real)> range_;
};

/// A step from t in which `given` changes by no more than 1/20 of its range in [0, end]. In each of
/// the eight intervals before t that lead up to it and grow by a quarter each it changes by half of
/// that at most. So steps grow slowly after a steep part: of the lengths end 0.75^k the next is
/// equal or longer by a third. Never less than a part in 1e5 of end, in which it may jump; end if
/// it is constant.
Real step_of(const OfTime& given, Real t, Real end);
/// The same for parts of `most`, 0 or more, in place of its own range.
Real step_of(const OfTime& given, Real most, Real t, Real end);

/// The k-th number of a sequence that fills [0, 1) evenly and has no period: the fractions of
/// multiples of the golden ratio.
Real golden(int k);

}  // namespace fsi
