#include "libfsi/run/samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace fsi {
namespace {

constexpr Real unknown = std::numeric_limits<Real>::quiet_NaN();

/// A row at t of a flow that runs as sin t, with a solid that stands `behind`.
Row row_at(Real t, Real behind) {
  return {t,
          t - behind,
          {{"t", t},
           {"smooth", std::sin(t)},
           {"shape", std::sin(t - behind), Course::shape},
           {"pressure", t == 0 ? unknown : std::cos(t), Course::pressure},
           {"step", t, Course::step}}};
}

TEST(Samples, RowsBetweenStepsAreOfSecondOrder) {
  for (const std::size_t column : {1, 2, 3}) {
    std::vector<Real> errors;
    for (const Real dt : {0.1, 0.05}) {
      Real most = 0;
      for (const Real part : {0.2, 0.5, 0.9, 1.0}) {
        const Real t = 1 + part * dt;
        const auto values = between(row_at(1, dt / 2), row_at(1 + dt, dt / 2), t);
        EXPECT_EQ(values[0], t);
        EXPECT_EQ(values[4], 1 + dt);
        most = std::max(most, std::abs(values[column] - (column == 3 ? std::cos(t) : std::sin(t))));
      }
      errors.push_back(most);
    }
    EXPECT_GT(errors[0], 1e-4);
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.1) << column;
  }
}

TEST(Samples, AnEnergyIsNeverBelowZero) {
  const auto at = [](Real t, Real energy) {
    return Row{t, t - 0.5, {{"t", t}, {"elastic_energy", energy, Course::energy}}};
  };
  // The solid stands half a step behind: at the end of the step its course is drawn on.
  EXPECT_EQ(between(at(0, 3), at(1, 1), 1)[1], 0);
  EXPECT_EQ(between(at(0, 3), at(1, 2), 1)[1], 1.5);
}

// One solid stands half a step behind the flow, one is of its time, and one is gone.
TEST(Samples, TheFlowHasTheEnergyOfAllSolidsAtTheirTimes) {
  const auto at = [](Real t, Real behind, Real energy) {
    return Row{t, t - behind, {{"t", t}, {"elastic_energy", energy, Course::energy}}};
  };
  for (const bool swapped : {false, true}) {
    const auto rows_at = [&](Real t, Real first, Real second) {
      std::vector<Row> rows{at(t, swapped ? 0 : 0.5, first + second), at(t, 0.5, first),
                            at(t, 0, second), Row{t, t, {}}};
      if (swapped) std::swap(rows[1], rows[2]);
      return rows;
    };
    Samples samples(1);
    samples.hold(rows_at(0, 3, 5));
    const auto rows = samples.rows(rows_at(1, 2, 7), 1);
    ASSERT_EQ(rows.size(), 4);
    EXPECT_EQ(rows[0], (std::vector<Real>{1, 1.5 + 7}));
    EXPECT_EQ(rows[swapped ? 2 : 1], (std::vector<Real>{1, 1.5}));
    EXPECT_EQ(rows[swapped ? 1 : 2], (std::vector<Real>{1, 7}));
    EXPECT_TRUE(rows[3].empty());
  }
}

TEST(Samples, AtItsEndTheRowIsThatOfTheStep) {
  const Row now = row_at(0.3, 0);
  const auto values = between(row_at(0.2, 0), now, 0.3);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], now.entries[i].value);
}

TEST(Samples, WhatIsNotKnownBeforeTheFirstStepIsThatOfTheStep) {
  EXPECT_EQ(between(row_at(0, 0), row_at(0.2, 0.1), 0.1)[3], std::cos(0.2));
  EXPECT_EQ(between({}, row_at(0.2, 0.1), 0.1)[1], std::sin(0.2));
}

TEST(Samples, DirectionsTurnTheShorterWay) {
  const auto turned = [](Real from, Real to, Real part) {
    return between({0, 0, {{"t", 0}, {"a", from}}},
                   {1, 1, {{"t", 1}, {"a", to, Course::half_turn}}}, part)[1];
  };
  EXPECT_NEAR(turned(10, 20, 0.5), 15, 1e-12);
  EXPECT_NEAR(turned(80, -80, 0.25), 85, 1e-12);
  EXPECT_NEAR(turned(80, -80, 0.75), -85, 1e-12);
  EXPECT_NEAR(turned(-80, 80, 0.25), -85, 1e-12);
}

TEST(Samples, TheAxisStaysAUnitVectorAndTheAngleItsOwn) {
  const auto axis = [](Real t, Real degrees) {
    const Real a = degrees / 180 * std::acos(-1.0);
    return Row{t,
               t,
               {{"t", t},
                {"nx", std::cos(a), Course::shape},
                {"ny", std::sin(a), Course::shape},
                {"nz", 0, Course::shape},
                {"angle", std::min(degrees, 180 - degrees), Course::shape}}};
  };
  const auto values = between(axis(0, 84), axis(1, 96), 0.5);
  EXPECT_NEAR(std::hypot(values[1], values[2]), 1, 1e-15);
  EXPECT_NEAR(values[4], 90, 1e-12);
  EXPECT_NEAR(between(axis(0, 40), axis(1, 50), 0.5)[4], 45, 1e-12);
}

TEST(Samples, AStepPassesARowOnlyWhereOneIsHeld) {
  Samples samples(0.25);
  EXPECT_EQ(samples.not_past(0), 0.25);
  EXPECT_FALSE(samples.near(0, 0.2));
  EXPECT_TRUE(samples.near(0, 0.3));
  samples.hold({row_at(0, 0)});
  EXPECT_GT(samples.not_past(0), 1e300);
  EXPECT_EQ(samples.due(0.8), (std::vector<Real>{0.25, 0.5, 0.75}));
  EXPECT_TRUE(samples.due(0.8).empty());
  EXPECT_EQ(samples.last(0.8), 0.75);
  Samples each(0);
  EXPECT_GT(each.not_past(0), 1e300);
  EXPECT_EQ(each.due(0.8), std::vector<Real>{0.8});
}

TEST(Samples, ARestartFindsWhatWasHeld) {
  Samples samples(0.25), again(0.25);
  EXPECT_EQ(samples.text(), "none");
  samples.hold({row_at(0.3, 0.01), row_at(0, 0)});
  samples.due(0.3);
  again.resume(0.3, samples.text());
  EXPECT_EQ(again.text(), samples.text());
  EXPECT_EQ(again.due(0.5), std::vector<Real>{0.5});
  const Row now = row_at(0.6, 0.01);
  for (const std::size_t table : {0, 1})
    EXPECT_EQ(again.row(table, now, 0.5), samples.row(table, now, 0.5));
  // A solid that has left has no row.
  samples.hold({row_at(0.3, 0.01), {}, row_at(0, 0)});
  again.resume(0.3, samples.text());
  EXPECT_EQ(again.row(2, now, 0.5), samples.row(2, now, 0.5));
  again.resume(0.3, "none");
  EXPECT_EQ(again.text(), "none");
}

}  // namespace
}  // namespace fsi
