#include "libfsi/run/patches.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "libfsi/core/error.hpp"
#include "libfsi/flow/centre_line.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// A file of that text, gone at the end of its scope.
struct File {
  explicit File(const std::string& text)
      : path(std::filesystem::temp_directory_path() /
             ("fsi_rows_" + std::to_string(getpid()) + ".csv")) {
    std::ofstream(path) << text;
  }
  ~File() { std::filesystem::remove(path); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  std::filesystem::path path;
};

TEST(Series, JoinsItsRowsByLinesAndComesAgain) {
  const File file("time,flow_rate\n0,1\n0.5,3\n0.75,2\n");
  const OfTime once = series(file.path), again = series(file.path, 1);
  for (const auto& [t, value] :
       {std::pair{-1.0, 1.0}, {0.25, 2.0}, {0.5, 3.0}, {0.7, 2.2}, {9.0, 2.0}})
    EXPECT_NEAR(once(t), value, 1e-14) << t;
  for (const auto& [t, value] :
       {std::pair{0.25, 2.0}, {3.25, 2.0}, {0.875, 1.5}, {7.875, 1.5}, {2.0, 1.0}, {-0.125, 1.5}})
    EXPECT_NEAR(again(t), value, 1e-13) << t;
}

TEST(Series, WhatIsNoTableIsRefused) {
  EXPECT_THROW(series("there is no such file.csv"), Error);
  EXPECT_THROW(series(File("0,1\n0.5\n").path), Error);
  EXPECT_THROW(series(File("0,1\n0,2\n").path), Error);
  EXPECT_THROW(series(File("time,value\n").path), Error);
  EXPECT_THROW(series(File("0,1\n2,2\n").path, 1), Error);
}

// A vessel bent to a quarter of a circle of radius 3.
TEST(CentreLine, FollowsTheVessel) {
  test::BoxFile box{.n = {40, 6, 6}, .length = {1, 1, 1}};
  box.moved = [](const Vec3& x) {
    const Real r = 2.5 + x.y, angle = x.x * std::acos(0.0);
    return Vec3{r * std::sin(angle), r * std::cos(angle), x.z};
  };
  const Mesh mesh = test::read_box(box);
  const flow::CentreLine line(mesh, "left", "right");
  const Real length = 3 * std::acos(0.0);
  EXPECT_NEAR(line.length(), length, 0.02 * length);
  for (const Real part : {0.2, 0.5, 0.7}) {
    const auto [x, along] = line.at(part * line.length());
    const Real angle = part * std::acos(0.0);
    EXPECT_NEAR(norm(x - Vec3{3 * std::sin(angle), 3 * std::cos(angle), 0.5}), 0, 0.06) << part;
    EXPECT_NEAR(dot(along, Vec3{std::cos(angle), -std::sin(angle), 0}), 1, 0.01) << part;
  }
  EXPECT_THROW(flow::CentreLine(mesh, "left", "nowhere"), Error);
}

}  // namespace
}  // namespace fsi
