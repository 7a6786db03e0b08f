// The surface held to where a map to the undeformed solid puts it.

#include "libfsi/vof/held_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "libfsi/core/parallel.hpp"
#include "libfsi/vof/fill.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

const Vec3 middle{0.5, 0.5, 0.5};

/// A mesh full of a map: xi = x + d, with a constant d.
struct Mapped {
  Mapped(Mesh mesh_, const Vec3& shift)
      : mesh(std::move(mesh_)),
        d(mesh, shift),
        gradient(mesh),
        cells(static_cast<std::size_t>(mesh.n_owned)),
        weight(cells.size(), 1),
        scratch(mesh) {
    std::iota(cells.begin(), cells.end(), 0);
  }
  Real hold(CellField<Real>& alpha, const shapes::Shape& shape) {
    return hold(alpha, shape, {}).moved;
  }
  vof::Held hold(CellField<Real>& alpha, const shapes::Shape& shape,
                 std::span<const Index> strays) {
    return vof::hold_shape(alpha,
                           {.shape = shape,
                            .d = d,
                            .gradient = gradient,
                            .cells = cells,
                            .weight = weight,
                            .strays = strays},
                           mesh, scratch);
  }

  Mesh mesh;
  CellField<Vec3> d;
  CellField<Tensor> gradient;
  std::vector<Index> cells;
  std::vector<Real> weight;
  vof::HoldScratch scratch;
};

Mesh box(int n, int dim, bool simplex) {
  return test::read_box({.n = {n, n, dim == 3 ? n : 0}, .simplex = simplex});
}

shapes::Shape round_solid(const Vec3& at) { return shapes::translate(shapes::sphere(0.3), at); }

/// The same volume, drawn out along x by a.
shapes::Shape drawn_out(int dim, Real a = 1.03) {
  const Real b = dim == 2 ? 1 / a : 1 / std::sqrt(a);
  const auto sphere = shapes::sphere(0.3);
  return [=](const Vec3& x) {
    const Vec3 r = x - middle;
    return sphere({r.x / a, r.y / b, dim == 2 ? 0 : r.z / b});
  };
}

struct Apart {
  Real shape, volume;
};
/// Of the fractions of two solids: sum |difference| V over the volume, difference of the volumes.
Apart apart(const CellField<Real>& a, const CellField<Real>& b, const Mesh& mesh) {
  std::array<Sum, 3> sums;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    sums[0].add(mesh.V[c] * std::abs(a[c] - b[c]));
    sums[1].add(mesh.V[c] * a[c]);
    sums[2].add(mesh.V[c] * b[c]);
  }
  std::array<Real, 3> total{};
  Sum::totals(total, sums);
  return {total[0] / total[2], total[1] / total[2] - 1};
}

// A solid drawn out by three per cent, whose map says that it is round, becomes round again: the
// fractions those of the exact fill to second order, the volume to round-off.
TEST(HeldShape, BringsASolidBackToItsShape) {
  for (const int dim : {2, 3})
    for (const bool simplex : {false, true}) {
      Real last = 0;
      for (const int n : {12, 24}) {
        Mapped map(box(n, dim, simplex), {});
        const Vec3 at{0.5, 0.5, dim == 2 ? 0 : 0.5};
        CellField<Real> alpha(map.mesh), exact(map.mesh);
        vof::fill(exact, map.mesh, round_solid(at));
        vof::fill(alpha, map.mesh, drawn_out(dim));
        const Real volume = apart(alpha, exact, map.mesh).volume;
        for (int i = 0; i < 12; ++i) map.hold(alpha, round_solid(at));
        const Apart end = apart(alpha, exact, map.mesh);
        EXPECT_NEAR(end.volume, volume, 1e-13);
        EXPECT_LT(end.shape, n == 12 ? 8e-3 : 2e-3);
        if (n == 24) {
          EXPECT_GT(std::log2(last / end.shape), 1.7);
        }
        last = end.shape;
      }
    }
}

// Two cells that came off a disc, a full one and one with a little, go back to its surface.
TEST(HeldShape, TakesBackWhatCameOff) {
  for (const bool simplex : {false, true}) {
    Mapped map(box(24, 2, simplex), {});
    const auto shape = round_solid({0.5, 0.5, 0});
    CellField<Real> alpha(map.mesh), start(map.mesh);
    vof::fill(alpha, map.mesh, shape);
    start.assign(alpha);
    Sum off;
    std::vector<Index> strays;
    for (Index c = 0; c < map.mesh.n_cells; ++c) {
      const bool full = norm(map.mesh.C[c] - Vec3{0.1, 0.1, 0}) < 0.02;
      if (!full && norm(map.mesh.C[c] - Vec3{0.9, 0.8, 0}) > 0.02) continue;
      alpha[c] = full ? 1 : 1e-4;
      if (c >= map.mesh.n_owned) continue;
      strays.push_back(c), map.weight[c] = 0;
      off.add(alpha[c] * map.mesh.V[c]);
    }
    const Real volume = apart(alpha, start, map.mesh).volume;
    Real returned = 0;
    for (int i = 0; i < 30; ++i) returned += map.hold(alpha, shape, strays).returned;
    for (const Index c : strays) EXPECT_EQ(alpha[c], 0);
    const Real all = off.total();
    EXPECT_GT(all, 0);
    EXPECT_NEAR(returned, all, 1e-12 * all);
    const Apart end = apart(alpha, start, map.mesh);
    EXPECT_NEAR(end.volume, volume, 1e-13);
    EXPECT_LT(end.shape, 2 * volume);  // all around the disc
  }
}

// A solid far from its shape, most of whose cells ask for more than a step gives them, comes back
// too.
TEST(HeldShape, BringsASolidBackFromFar) {
  for (const bool simplex : {false, true})
    for (const Real by : {1.05, 1.1, 1.15}) {
      Mapped map(box(24, 2, simplex), {});
      const Vec3 at{0.5, 0.5, 0};
      CellField<Real> alpha(map.mesh), exact(map.mesh);
      vof::fill(exact, map.mesh, round_solid(at));
      vof::fill(alpha, map.mesh, drawn_out(2, by));
      const Real volume = apart(alpha, exact, map.mesh).volume;
      for (int i = 0; i < 80; ++i) {
        EXPECT_GT(map.hold(alpha, round_solid(at)), 0) << simplex << by << i;
      }
      const Apart end = apart(alpha, exact, map.mesh);
      EXPECT_NEAR(end.volume, volume, 1e-13);
      EXPECT_LT(end.shape, 2e-3);
    }
}

// The map of a solid that went through a period of the mesh is a period off.
TEST(HeldShape, KnowsThePeriodsThatTheSolidWentThrough) {
  const auto held = [](const Vec3& shift) {
    Mapped map(test::read_box({.n = {16, 16, 0}, .periodic = {"left", "right"}}), shift);
    CellField<Real> alpha(map.mesh), start(map.mesh);
    vof::fill(alpha, map.mesh, round_solid({0, 0.5, 0}));
    start.assign(alpha);
    map.hold(alpha, round_solid({0, 0.5, 0}));
    return apart(alpha, start, map.mesh).shape;
  };
  EXPECT_LT(held({}), 3e-3);
  EXPECT_NEAR(held({-3, 0, 0}), held({}), 1e-12);
}

// The search for the nearest image begins with that of the last cell. A restart forgets it, and it
// is another one on other ranks. The fractions must be the same, bit for bit.
TEST(HeldShape, DoesNotDependOnTheImageOfTheLastCell) {
  const Vec3 at{0, 0.5, 0};
  Mapped map(test::read_box({.n = {16, 16, 0}, .simplex = true, .periodic = {"left", "right"}}),
             {1e-3, 2e-3, 0});
  CellField<Real> start(map.mesh), alpha(map.mesh), other(map.mesh);
  vof::fill(start, map.mesh, round_solid(at));
  const auto hold = [&](CellField<Real>& held, const Vec3& laps) {
    held.assign(start);
    map.scratch.laps = laps;
    map.hold(held, round_solid(at));
  };
  for (std::size_t i = 0; i < 128; ++i) {  // as often on all ranks
    std::swap(map.cells[0], map.cells[i]);
    hold(alpha, {}), hold(other, 3 * map.mesh.translation[1]);
    for (Index c = 0; c < map.mesh.n_owned; ++c) EXPECT_EQ(alpha[c], other[c]);
  }
}

// A layer that is bonded to the floor, with a map that is wrong there: no fluid gets to the wall.
TEST(HeldShape, HasNoSurfaceAtABondedWall) {
  for (const bool bonded : {false, true}) {
    Mapped map(box(8, 2, true), {0, -0.02, 0});
    const auto layer = shapes::translate(shapes::box({9, 0.5, 9}), {0.5, 0.25, 0});
    CellField<Real> alpha(map.mesh);
    vof::fill(alpha, map.mesh, layer);
    std::vector<Index> floor;
    for (Index f = map.mesh.n_internal; f < map.mesh.n_faces; ++f)
      if (map.mesh.owner[f] < map.mesh.n_owned && map.mesh.Cf[f].y < 1e-9) floor.push_back(f);
    const vof::BondPlanes bond(map.mesh, floor, 3);
    vof::hold_shape(alpha,
                    {.shape = layer,
                     .d = map.d,
                     .gradient = map.gradient,
                     .cells = map.cells,
                     .weight = map.weight,
                     .bond = bonded ? &bond : nullptr},
                    map.mesh, map.scratch);
    Real least = 1;
    for (Index c = 0; c < map.mesh.n_owned; ++c)
      if (map.mesh.C[c].y < 0.25) least = std::min(least, alpha[c]);
    EXPECT_EQ(global_min(least) > 1 - 1e-12, bonded);
  }
}

// Where the map is not to be relied on nothing moves.
TEST(HeldShape, LeavesAloneWhereTheMapTellsNothing) {
  Mapped map(box(16, 2, false), {});
  map.weight.assign(map.weight.size(), 0);
  CellField<Real> alpha(map.mesh), start(map.mesh);
  vof::fill(alpha, map.mesh, drawn_out(2));
  start.assign(alpha);
  EXPECT_EQ(map.hold(alpha, round_solid({0.5, 0.5, 0})), 0);
  EXPECT_EQ(apart(alpha, start, map.mesh).shape, 0);
}

}  // namespace
}  // namespace fsi
