#pragma once
// Rows of tables at given times, interpolated between the ends of the steps around them.

#include <span>
#include <string>
#include <vector>

#include "libfsi/core/clock.hpp"

namespace fsi {

/// How a column is interpolated between two rows.
enum class Course {
  smooth,     ///< linear in the time of the flow; figures of the solid stay half a step behind
  shape,      ///< linear in the time of the solid, half a step off
  energy,     ///< the same, and never below 0
  pressure,   ///< smooth, but undefined before the first step
  step,       ///< a figure of the step: that of the later row
  half_turn,  ///< smooth, degrees of the direction of a line: the shorter way round
};

/// A number under the name of its column.
struct Entry {
  std::string name;                ///< of the column
  Real value;                      ///< in this row
  Course course = Course::smooth;  ///< how it is interpolated
};

/// A row and the times that its columns are of; the first column is t.
struct Row {
  Real t = 0, t_shape = 0;     ///< time of the flow and of the solid
  std::vector<Entry> entries;  ///< the columns after t
};

/// The row at time t from rows before and after it: an error of second order in their distance. The
/// columns nx, ny, nz and lx, ly, lz stay unit vectors, `angle` and `long_angle` their own. A value
/// of `before` that is not finite counts as unknown: that of `after` is taken.
std::vector<Real> between(const Row& before, const Row& after, Real t);

/// Gives the times at which rows are due, at every multiple of an interval (0: at the end of every
/// step), and makes the rows without a change of the steps. Invariant: it holds the rows of the
/// last state, one for each table, or nothing. These are part of a checkpoint.
class Samples {
 public:
  /// interval: between rows; 0: a row at the end of every step.
  explicit Samples(Real interval) : each_step_(interval <= 0), every_(interval) {
    every_.resume(0);
  }

  /// The times of rows in the step that ends at t, each returned once.
  std::vector<Real> due(Real t);
  /// Whether a row may fall into a next step no longer than `reach`: then hold().
  bool near(Real t, Real reach) const { return each_step_ || every_.next(t) <= t + reach; }
  /// The time that the step from t must not pass: that of the next row if none are held.
  Real not_past(Real t) const;
  /// The row of table `i` at t, a time due in the step that led from the rows held to `now`.
  std::vector<Real> row(std::size_t i, const Row& now, Real t) const;
  /// The rows of all tables at t: that of the flow, then those of the solids; none of one that is
  /// gone. Solids may be of different times. So the flow's `elastic_energy` is the sum of theirs.
  std::vector<std::vector<Real>> rows(const std::vector<Row>& now, Real t) const;
  /// Holds these rows; none: holds nothing.
  void hold(std::vector<Row> rows) { held_ = std::move(rows); }

  /// For a restart at t, with the result of text().
  void resume(Real t, const std::string& text);
  /// Its data for a checkpoint.
  std::string text() const;
  /// Time of the last row due up to t.
  Real last(Real t) const { return each_step_ ? t : every_.last(t); }

 private:
  bool each_step_;
  Schedule every_;
  std::vector<Row> held_;
};

}  // namespace fsi
