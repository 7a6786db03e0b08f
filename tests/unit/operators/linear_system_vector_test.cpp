// A system with a stiff block: its known solution, iterations by preconditioner, the options.

#include "libfsi/operators/linear_system_vector.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <cmath>
#include <string>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stiff_sweep.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// One of each component's mass, slip planes tell the components apart; couplings of `stiff`
/// between cells within 0.25 of the centre, of 0.01 elsewhere.
void fill(VectorMatrix& A, const Mesh& mesh, Real stiff) {
  const auto inside = [&](Index c) { return norm(mesh.C[c] - Vec3{0.5, 0.5, 0}) < 0.25; };
  for (Index c = 0; c < mesh.n_owned; ++c)
    for (Index k = 0; k < mesh.dim; ++k)
      A.diagonal[c * mesh.dim + k] = 1 + 0.1 * static_cast<Real>(k);
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    const Real a = inside(P) && inside(N) ? stiff : 0.01;
    A.off_diagonal[f] = -a;
    for (const Index c : {P, N})
      if (c < mesh.n_owned)
        for (Index k = 0; k < mesh.dim; ++k) A.diagonal[c * mesh.dim + k] += a;
  }
}

/// y = A x of owned cells; x: owned and halo.
std::vector<Real> product(const VectorMatrix& A, const std::vector<Real>& x, const Mesh& mesh) {
  std::vector<Real> y(A.diagonal.size());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = A.diagonal[i] * x[i];
  const auto add = [&](Index to, Index from, Real a) {
    if (to >= mesh.n_owned) return;
    for (Index k = 0; k < mesh.dim; ++k) y[to * mesh.dim + k] += a * x[from * mesh.dim + k];
  };
  for (Index f = 0; f < mesh.n_internal; ++f) {
    add(mesh.owner[f], mesh.neighbour[f], A.off_diagonal[f]);
    add(mesh.neighbour[f], mesh.owner[f], A.off_diagonal[f]);
  }
  return y;
}

/// A field that no symmetry of the mesh hides, owned and halo.
std::vector<Real> wave(const Mesh& mesh, Real number) {
  std::vector<Real> x;
  for (Index c = 0; c < mesh.n_cells; ++c)
    for (Index k = 0; k < mesh.dim; ++k)
      x.push_back(std::sin(number * mesh.C[c].x + static_cast<Real>(k)) *
                  std::cos((number + 7) * mesh.C[c].y));
  return x;
}

/// Iterations for a right-hand side whose solution is known, which is found to 1e-8.
int iterations(const Mesh& mesh, const std::string& name, Real stiff) {
  VectorSystem system(mesh, name, 1e-10);
  int taken = 0;
  for (const Real factor : {0.001, 1.0}) {  // the second one has other stiff cells
    fill(system.matrix(), mesh, factor * stiff);
    system.renewed();
    const std::vector<Real> exact = wave(mesh, 23);
    std::vector<Real> x(exact.size()), b = product(system.matrix(), exact, mesh);
    taken = system.solve(x, b).iterations;
    Real worst = 0;
    for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, std::abs(x[i] - exact[i]));
    EXPECT_LT(global_max(worst), 1e-8) << name << " " << factor;
  }
  return taken;
}

/// An option while this lives.
struct Given {
  std::string name;
  Given(const std::string& n, const std::string& value) : name(n) {
    PetscOptionsSetValue(nullptr, name.c_str(), value.c_str());
  }
  Given(const Given&) = delete;
  Given& operator=(const Given&) = delete;
  ~Given() { PetscOptionsClearValue(nullptr, name.c_str()); }
};

TEST(VectorSystem, TakesTwoThirdsOfJacobisIterationsAtAStiffBlock) {
  const Given jacobi("-jacobi_pc_type", "jacobi"), none("-none_pc_type", "none");
  for (const bool simplex : {false, true}) {
    const Mesh mesh = test::read_box({.n = {24, 24, 0}, .simplex = simplex});
    const int own = iterations(mesh, "own", 10), other = iterations(mesh, "jacobi", 10);
    EXPECT_LE(3 * own, 2 * other);
    EXPECT_GT(iterations(mesh, "none", 10), other);
    EXPECT_EQ(iterations(mesh, "own", 0.01), iterations(mesh, "jacobi", 0.01)) << "none stiff";
  }
}

TEST(VectorSystem, RefusesWhatNeedsAnAssembledMatrix) {
  const Given sor("-sor_pc_type", "sor"), shell("-shell_pc_type", "shell");
  const Mesh mesh = test::read_box({.n = {4, 4, 0}});
  EXPECT_NO_THROW(VectorSystem(mesh, "shell", 1e-5));
  try {
    const VectorSystem system(mesh, "sor", 1e-5);
    ADD_FAILURE() << "sor has no rows to sweep over";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::input);
    for (const char* part : {"-sor_pc_type", "\"sor\"", "shell", "jacobi", "none"})
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << part << ": " << e.what();
  }
}

TEST(StiffSweep, IsSymmetricAndPositiveAndDividesElsewhere) {
  const Mesh mesh = test::read_box({.n = {16, 16, 0}});
  VectorMatrix A(mesh);
  fill(A, mesh, 10);
  StiffSweep sweep(mesh);
  sweep.renew(A);
  const auto applied = [&](const std::vector<Real>& r) {
    std::vector<Real> z(A.diagonal.size());
    sweep.apply(z.data(), r.data());
    return z;
  };
  const std::vector<Real> x = wave(mesh, 5), y = wave(mesh, 31), Mx = applied(x), My = applied(y);
  Real xMy = 0, yMx = 0, xMx = 0, yMy = 0;
  Index divided = 0;
  for (std::size_t i = 0; i < Mx.size(); ++i) {
    xMy += x[i] * My[i], yMx += y[i] * Mx[i], xMx += x[i] * Mx[i], yMy += y[i] * My[i];
    divided += Mx[i] == 1 / A.diagonal[i] * x[i] ? 1 : 0;
  }
  EXPECT_GT(xMx, 0);
  EXPECT_GT(yMy, 0);
  EXPECT_NEAR(xMy, yMx, 1e-14 * std::sqrt(xMx * yMy));
  EXPECT_EQ(divided, (mesh.n_owned - sweep.stiff()) * mesh.dim);
  EXPECT_GT(global_sum(static_cast<std::int64_t>(sweep.stiff())), 0);
  fill(A, mesh, 0);
  sweep.renew(A);
  EXPECT_EQ(sweep.stiff(), 0);
}

}  // namespace
}  // namespace fsi
