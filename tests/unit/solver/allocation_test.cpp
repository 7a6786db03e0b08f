// A step allocates nothing. Counted are calls of operator new, which are the library's own: PETSc,
// hypre and MPI take their memory with malloc.

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/backup.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace {

std::int64_t calls = 0;

void* counted(std::size_t size) {
  ++calls;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
// std::stable_sort asks this way; a sanitizer's own would not be freed by the ones below.
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  try {
    return counted(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t /*size*/) noexcept { std::free(memory); }

namespace fsi {
namespace {

/// A soft disc in a cavity whose lid slides.
struct Scene {
  bool simplex = false;
  KinematicsKind kinematics = KinematicsKind::log_conformation;
  Real mu_s = 0.01;
};

/// Calls that the growth of lists may take in the first steps: a few dozen lists, doubled.
constexpr std::int64_t few = 400;

void expect_none(const Scene& scene) {
  const Mesh mesh = test::read_box({.n = {24, 24, 0}, .simplex = scene.simplex});
  Solver solver(
      mesh, {.rho = 1, .mu_f = 0.01},
      {.conditions = {
           {"top", Wall{{1, 0, 0}}}, {"left", Wall{}}, {"right", Wall{}}, {"bottom", Wall{}}}});
  solver.start([](const Vec3&) { return Vec3{}; });
  solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), {0.6, 0.55, 0}),
                    .G = 1,
                    .mu = scene.mu_s,
                    .kinematics = scene.kinematics,
                    .acceleration = {0, -1, 0}});
  io::Snapshot all;
  solver.list(all);
  Backup start(all, mesh);
  start.keep();
  // The lists that follow the solid grow with it; the same steps from the same state again find
  // room for everything.
  constexpr Real dt = 0.01;
  constexpr int steps = 20, passes = 4;
  std::int64_t taken = 0;
  for (int pass = 0; pass < passes; ++pass) {
    const std::int64_t before = calls;
    start.restore();
    solver.resume();
    for (int i = 0; i < steps; ++i) EXPECT_EQ(solver.advance(dt), dt);
    taken = calls - before;
    if (pass == 0) {
      EXPECT_LE(taken, few) << "the first time";
    }
  }
  EXPECT_EQ(taken, 0) << "in " << steps << " steps";
}

TEST(Allocation, CountsWhatIsAllocated) {
  const std::int64_t before = calls;
  std::vector<Real> some(10);
  some.resize(1000);
  EXPECT_EQ(calls, before + 2);
}

TEST(Allocation, IsNoneInAStepOnQuads) {
  for (const auto kind : {KinematicsKind::log_conformation, KinematicsKind::reference_map,
                          KinematicsKind::left_cauchy_green})
    expect_none({.kinematics = kind});
}

TEST(Allocation, IsNoneInAStepOnTriangles) { expect_none({.simplex = true}); }

TEST(Allocation, IsNoneInAStepWithTwoViscosities) { expect_none({.mu_s = 0.1}); }

}  // namespace
}  // namespace fsi
