// Pieces of a solid, on any number of ranks: what hangs together, also by a way that leads through
// several ranks and back, or across a period.

#include "libfsi/operators/pieces.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libfsi/shapes/shapes.hpp"
#include "libfsi/vof/fill.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

using namespace shapes;

int count(const CellField<Real>& alpha, Real least, const Mesh& mesh) {
  Pieces pieces(mesh);
  pieces.find(alpha);
  return pieces.count(alpha, least);
}

int pieces_of(const Mesh& mesh, const Shape& shape, Real least) {
  CellField<Real> alpha(mesh);
  vof::fill(alpha, mesh, shape);
  return count(alpha, least, mesh);
}

TEST(Pieces, OfTwoBallsAndACrumb) {
  for (const bool tets : {false, true}) {
    const Mesh mesh = test::read_box({.n = {16, 16, 16}, .simplex = tets});
    const Shape ball = translate(sphere(0.2), {0.25, 0.3, 0.4});
    const Shape other = translate(sphere(0.15), {0.75, 0.7, 0.6});
    const Shape crumb = translate(sphere(0.08), {0.75, 0.2, 0.5});
    const Real volume = 4.0 / 3 * 3.141592653589793 * std::pow(0.2, 3);
    EXPECT_EQ(pieces_of(mesh, ball, 0.01 * volume), 1);
    EXPECT_EQ(pieces_of(mesh, unite({ball, other}), 0.01 * volume), 2);
    EXPECT_EQ(pieces_of(mesh, unite({ball, other, crumb}), 0.01 * volume), 3);
    EXPECT_EQ(pieces_of(mesh, unite({ball, other, crumb}), 0.1 * volume), 2);
    EXPECT_EQ(pieces_of(mesh, translate(sphere(0.01), {0.53, 0.53, 0.53}), 0), 0);
  }
}

// A band that winds to and fro through the mesh, whatever way ranks divide it: three columns of
// solid, three of fluid, joined at the top and at the bottom by turns.
TEST(Pieces, OfASerpent) {
  const Mesh mesh = test::read_box({.n = {48, 48, 0}});
  CellField<Real> alpha(mesh);
  const auto set = [&](Real cut) {
    for (Index c = 0; c < mesh.n_cells; ++c) {
      const Vec3 x = mesh.C[c];
      const auto column = static_cast<int>(x.x * 16);
      const bool joint = column % 4 == 1 ? x.y > 15.0 / 16 : column % 4 == 3 && x.y < 1.0 / 16;
      alpha[c] = (column % 2 == 0 || joint) && std::abs(x.x - cut) > 0.02 ? 1 : 0;
    }
  };
  set(-1);
  EXPECT_EQ(count(alpha, 0.01, mesh), 1);
  set(0.594);  // the joint between columns 8 and 10
  EXPECT_EQ(count(alpha, 0.01, mesh), 2);
}

// A single cell beside a bar: it and three rings around it are marked, but not the bar. A second
// bar is no crumb.
TEST(Pieces, MarksTheCrumbs) {
  const Mesh mesh = test::read_box({.n = {40, 40, 0}});
  CellField<Real> alpha(mesh), near(mesh, -1);
  for (Index c = 0; c < mesh.n_cells; ++c) {
    const Vec3 x = 40 * mesh.C[c];
    const bool crumb = std::abs(x.x - 12.5) < 0.1 && std::abs(x.y - 20.5) < 0.1;
    alpha[c] = x.x < 10 || x.x > 35 || crumb ? 1 : 0;
  }
  Pieces pieces(mesh);
  pieces.find(alpha);
  EXPECT_TRUE(pieces.several());
  pieces.mark_crumbs(near, alpha, 3);
  for (Index c = 0; c < mesh.n_cells; ++c) {
    const Vec3 x = 40 * mesh.C[c];
    const bool around = std::abs(x.x - 12.5) < 3.1 && std::abs(x.y - 20.5) < 3.1;
    EXPECT_EQ(near[c], around && x.x > 10 ? 1 : 0);
  }
}

TEST(Pieces, AcrossAPeriod) {
  const Mesh closed = test::read_box({.n = {20, 20, 0}});
  const Mesh mesh = test::read_box({.n = {20, 20, 0}, .periodic = {"left", "right"}});
  const auto rim = [](const Mesh& where) {
    CellField<Real> alpha(where);
    for (Index c = 0; c < where.n_cells; ++c) alpha[c] = std::abs(where.C[c].x - 0.5) > 0.3 ? 1 : 0;
    return count(alpha, 0.01, where);
  };
  EXPECT_EQ(rim(closed), 2);
  EXPECT_EQ(rim(mesh), 1);
}

}  // namespace
}  // namespace fsi
