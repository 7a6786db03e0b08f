#pragma once
// Simulated time, events at fixed intervals, and wall time.

#include <chrono>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"

namespace fsi {

/// A limit on the time step and what sets it.
struct Limit {
  Real dt = std::numeric_limits<Real>::max();  ///< the longest step that it allows
  std::string name = "none";                   ///< what sets it, one word
};

/// After a first or a rejected step the next ones grow by a tenth each.
inline constexpr Real step_growth = 1.1;

/// The smaller of two limits.
inline Limit tighter(const Limit& a, const Limit& b) { return b.dt < a.dt ? b : a; }

/// An event at every multiple of an interval of simulated time; interval <= 0: never.
class Schedule {
 public:
  /// interval: of simulated time; 0 or less: never.
  explicit Schedule(Real interval) : interval_(interval) {}
  /// Whether a multiple was reached since the last time this was true. At t = 0: true.
  bool due(Real t);
  /// The multiples reached since the last time this or due() was asked.
  std::vector<Real> reached(Real t);
  /// The last multiple up to t.
  Real last(Real t) const { return static_cast<Real>(index(t)) * interval_; }
  /// Time of the next event after t.
  Real next(Real t) const;
  /// Whether t is a multiple.
  bool at(Real t) const;
  /// For a restart at t: all events before it are done.
  void resume(Real t);

 private:
  std::int64_t index(Real t) const;
  Real interval_;
  std::int64_t done_ = -1;
};

/// What lies ahead of a step.
struct Events {
  Real hit;                                          ///< a step ends at this time
  Real not_past = std::numeric_limits<Real>::max();  ///< no step ends after this time
};

/// Time runs from 0 to end; the last step lands on it.
class Clock {
 public:
  /// t: where it begins, the time of a checkpoint in a restart.
  explicit Clock(Real end, Real t = 0) : end_(end), t_(t) {}
  /// Whether the end is not reached yet.
  bool running() const { return t_ < end_ * (1 - 1e-14); }
  /// The time reached.
  Real t() const { return t_; }
  /// The end of the run.
  Real end() const { return end_; }
  /// The step from t that hits the event (or the end) when it lies within reach of `limit`. A rest
  /// of less than two steps is split in two so that no tiny step is left. It does not pass the time
  /// `not_past`, where that is nearer.
  Real step(Real limit, const Events& ahead) const;
  /// The same where a step may pass any other time.
  Real step(Real limit, Real event) const { return step(limit, Events{event}); }
  /// Sets the time reached.
  void set(Real t) { t_ = t; }

 private:
  Real end_, t_;
};

/// Seconds since construction.
class Stopwatch {
 public:
  /// Seconds since construction.
  Real seconds() const {
    return std::chrono::duration<Real>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// A forecast of the end of a run, from the recent speed of simulated time, not from the last step
/// alone.
class Forecast {
 public:
  /// t: the simulated time at the start.
  explicit Forecast(Real t = 0) : t_(t) {}
  /// Seconds from now to `end`, at simulated time t after `wall` seconds: by the mean of the speed
  /// since the last call and the speed used then; infinite if time does not advance.
  Real seconds_left(Real wall, Real t, Real end);
  /// "120 s"; "more than 10 days" from there on.
  static std::string text(Real seconds);

 private:
  Real wall_ = 0, t_, speed_ = -1;
};

}  // namespace fsi
