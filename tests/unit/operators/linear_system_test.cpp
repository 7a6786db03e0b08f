// Systems with a known solution; options by their prefix; what does not converge throws.

#include "libfsi/operators/linear_system.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <cmath>

#include "libfsi/core/error.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// Minus the Laplacian of squares plus `shift`: without a shift the constant is its null space.
FaceMatrix matrix(const Mesh& mesh, Real shift) {
  FaceMatrix A(mesh);
  for (Real& diagonal : A.diagonal) diagonal = shift;
  for (Index f = 0; f < mesh.n_internal; ++f) {
    A.off_diagonal[f] = -1;
    for (const Index c : {mesh.owner[f], mesh.neighbour[f]})
      if (c < mesh.n_owned) A.diagonal[c] += 1;
  }
  return A;
}

/// Solves for sin(3 x) cos(5 y); the largest error, of the differences where the system is
/// singular.
Real error(const std::string& name, Method method, Real shift) {
  const Mesh mesh = test::read_box({.n = {16, 16, 0}});
  const FaceMatrix A = matrix(mesh, shift);
  CellField<Real> exact(mesh), x(mesh);
  for (Index c = 0; c < mesh.n_cells; ++c)
    exact[c] = std::sin(3 * mesh.C[c].x) * std::cos(5 * mesh.C[c].y);
  std::vector<Real> b(static_cast<std::size_t>(mesh.n_owned));
  for (Index c = 0; c < mesh.n_owned; ++c) b[c] = A.diagonal[c] * exact[c];
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    if (P < mesh.n_owned) b[P] += A.off_diagonal[f] * exact[N];
    if (N < mesh.n_owned) b[N] += A.off_diagonal[f] * exact[P];
  }
  LinearSystem system(mesh, name, method, shift == 0, 1e-12);
  system.assemble(A);
  system.solve(x, b);
  Sum mean;
  for (Index c = 0; c < mesh.n_owned; ++c) mean.add(mesh.V[c] * (x[c] - exact[c]));
  const Real level = shift == 0 ? mean.total() : 0;
  Real worst = 0;
  for (Index c = 0; c < mesh.n_cells; ++c)  // the halo is set too
    worst = std::max(worst, std::abs(x[c] - exact[c] - level));
  return global_max(worst);
}

TEST(LinearSystem, FindsTheKnownSolution) {
  for (const Method method : {Method::multigrid, Method::direct})
    for (const Real shift : {0.0, 0.1}) EXPECT_LT(error("known", method, shift), 1e-9) << shift;
}

TEST(LinearSystem, ReadsTheOptionsOfItsPrefixAndThrowsWhereItDoesNotConverge) {
  PetscOptionsSetValue(nullptr, "-few_ksp_max_it", "1");
  PetscOptionsSetValue(nullptr, "-few_pc_type", "none");
  EXPECT_LT(error("other", Method::multigrid, 0.1), 1e-9);
  try {
    error("few", Method::multigrid, 0.1);
    ADD_FAILURE() << "one iteration cannot do";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::numerics);
    EXPECT_NE(std::string(e.what()).find("\"few\""), std::string::npos) << e.what();
  }
  PetscOptionsClearValue(nullptr, "-few_ksp_max_it");
  PetscOptionsClearValue(nullptr, "-few_pc_type");
}

}  // namespace
}  // namespace fsi
