#include "libfsi/flow/viscous_pressure.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

// p -= chi mu_c div u*, mu_c the least of the faces; chi is 1/2 on quads, less where a cell answers
// itself more strongly: flat triangles.
TEST(ViscousPressure, TakesALesserShareInPoorCells) {
  for (const bool flat : {false, true}) {
    const Mesh mesh =
        test::read_box({.n = {8, 8, 0}, .length = {flat ? 8.0 : 1.0, 1, 1}, .simplex = flat});
    const FaceWeights weights(mesh);
    CellField<Real> p(mesh), div(mesh, 3);
    FaceField<Real> mu(mesh, 2), kappa(mesh, 1), theta(mesh, 0.5);
    const Index inner = mesh.n_cells / 2;
    mu[mesh.cell_faces[inner][0]] = 0.5;
    flow::ViscousPressure(mesh, weights).add(p, div, mu, kappa, theta);
    const Real whole = -0.5 * (0.5 * 0.5 + 1) * 3;
    if (flat) {
      EXPECT_GT(p[inner], 0.8 * whole);
      EXPECT_LT(p[inner], 0);
    } else {
      EXPECT_NEAR(p[inner], whole, 1e-13);
    }
  }
}

}  // namespace
}  // namespace fsi
