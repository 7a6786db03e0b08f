// The band against its definition, on any number of ranks.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "libfsi/field/band.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// Marks by the definition: 2 in the set, 1 around it. One ring by the neighbours of owned cells.
CellField<Real> marks(const Mesh& mesh, const CellField<Real>& q, Real threshold) {
  CellField<Real> mark(mesh);
  for (Index c = 0; c < mesh.n_owned; ++c) {
    for (const Index n : mesh.cell_neighbours[c])
      if (q[n] >= threshold) mark[c] = 1;
    if (q[c] >= threshold) mark[c] = 2;
  }
  mesh.halo.update(mark);
  return mark;
}

void check(const Mesh& mesh, const Vec3& centre) {
  CellField<Real> q(mesh);
  for (Index c = 0; c < mesh.n_cells; ++c) q[c] = norm(mesh.C[c] - centre) < 0.25 ? 1 : 0;
  Band band(mesh);
  band.rebuild(q, 0.5);
  const CellField<Real> mark = marks(mesh, q, 0.5);
  std::set<Index> core, cells;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (mark[c] == 2) core.insert(c);
    if (mark[c] > 0) cells.insert(c);
  }
  EXPECT_EQ(std::set<Index>(band.core().begin(), band.core().end()), core);
  EXPECT_EQ(std::set<Index>(band.cells().begin(), band.cells().end()), cells);
  EXPECT_EQ(band.cells().size(), cells.size());
  // Every face with a band cell of any rank on either side, none twice.
  const std::set<Index> faces(band.faces().begin(), band.faces().end());
  EXPECT_EQ(faces.size(), band.faces().size());
  for (Index f = 0; f < mesh.n_faces; ++f) {
    const bool beside =
        mark[mesh.owner[f]] > 0 || (f < mesh.n_internal && mark[mesh.neighbour[f]] > 0);
    EXPECT_TRUE(!beside || faces.contains(f)) << f;
  }
}

TEST(Band, IsTheSetAndItsRing) {
  for (const bool simplex : {false, true}) {
    check(test::read_box({.n = {16, 16, 0}, .simplex = simplex}), {0.5, 0.5, 0});
    check(test::read_box({.n = {8, 8, 8}, .simplex = simplex}), {0.5, 0.5, 0.4});
    check(test::read_box({.n = {16, 16, 0}, .simplex = simplex, .periodic = {"left", "right"}}),
          {0.05, 0.5, 0});
  }
}

TEST(Band, KeepsOnlyTheCoreOfTheLastCall) {
  const Mesh mesh = test::read_box({.n = {8, 8, 0}});
  Band band(mesh);
  CellField<Real> q(mesh, 1);
  band.rebuild(q, 0.5);
  EXPECT_EQ(static_cast<Index>(band.core().size()), mesh.n_owned);
  q.fill(0);
  band.rebuild(q, 0.5);
  EXPECT_TRUE(band.core().empty());
  EXPECT_EQ(static_cast<Index>(band.last_core().size()), mesh.n_owned);
  EXPECT_TRUE(band.cells().empty());
}

}  // namespace
}  // namespace fsi
