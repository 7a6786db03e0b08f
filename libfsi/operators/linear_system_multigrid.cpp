#include "libfsi/operators/linear_system_multigrid.hpp"

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"

namespace fsi {
namespace {

/// The levels of a hierarchy, the coarsest first; owned.
struct Levels {
  PetscInt n = 0;
  Mat* matrix = nullptr;  // [n - 1] all but the finest
  Mat* raise = nullptr;   // [n - 1] interpolation from a level to the next

  explicit Levels(PC amg) {
    FSI_PETSC(PCGetCoarseOperators(amg, &n, &matrix));
    FSI_PETSC(PCGetInterpolations(amg, &n, &raise));
  }
  Levels(const Levels&) = delete;
  Levels& operator=(const Levels&) = delete;
  ~Levels() {
    // A destructor has nobody to tell of a code.
    for (PetscInt l = 0; l + 1 < n; ++l) {
      static_cast<void>(MatDestroy(&matrix[l]));  // layers: destructor
      static_cast<void>(MatDestroy(&raise[l]));   // layers: destructor
    }
    static_cast<void>(PetscFree(matrix));  // layers: destructor
    static_cast<void>(PetscFree(raise));   // layers: destructor
  }
};

/// Doubles the first diagonal entry: with a right-hand side of zero sum the solution is the one
/// that vanishes there, since summing all rows leaves a_00 x_0 = 0.
void pin(Mat matrix) {
  PetscInt first = 0, last = 0;
  FSI_PETSC(MatGetOwnershipRange(matrix, &first, &last));
  if (first == 0 && last > 0) {
    PetscScalar a = 0;
    FSI_PETSC(MatGetValue(matrix, 0, 0, &a));
    FSI_PETSC(MatSetValue(matrix, 0, 0, 2 * a, INSERT_VALUES));
  }
  FSI_PETSC(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  FSI_PETSC(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
}

/// One sweep of Gauss-Seidel, each rank with its neighbours' values of before.
void set_sweep(KSP smoother, Mat matrix, MatSORType direction) {
  PC pc = nullptr;
  FSI_PETSC(KSPSetOperators(smoother, matrix, matrix));
  FSI_PETSC(KSPSetType(smoother, KSPRICHARDSON));
  FSI_PETSC(KSPSetNormType(smoother, KSP_NORM_NONE));
  FSI_PETSC(KSPSetTolerances(smoother, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, 1));
  FSI_PETSC(KSPGetPC(smoother, &pc));
  FSI_PETSC(PCSetType(pc, PCSOR));
  FSI_PETSC(PCSORSetSymmetric(pc, direction));
}

void set_levels(PC cycle, const Levels& levels, Mat finest, bool singular) {
  FSI_PETSC(PCMGSetLevels(cycle, levels.n, nullptr));
  FSI_PETSC(PCMGSetGalerkin(cycle, PC_MG_GALERKIN_EXTERNAL));
  FSI_PETSC(PCMGSetDistinctSmoothUp(cycle));
  for (PetscInt l = 1; l < levels.n; ++l) {
    const Mat matrix = l + 1 < levels.n ? levels.matrix[l] : finest;
    KSP down = nullptr, up = nullptr;
    FSI_PETSC(PCMGGetSmootherDown(cycle, l, &down));
    FSI_PETSC(PCMGGetSmootherUp(cycle, l, &up));
    set_sweep(down, matrix, SOR_LOCAL_FORWARD_SWEEP);
    set_sweep(up, matrix, SOR_LOCAL_BACKWARD_SWEEP);
    FSI_PETSC(PCMGSetInterpolation(cycle, l, levels.raise[l - 1]));
  }
  if (singular) pin(levels.matrix[0]);
  KSP coarse = nullptr;
  PC pc = nullptr;
  FSI_PETSC(PCMGGetCoarseSolve(cycle, &coarse));
  FSI_PETSC(KSPSetOperators(coarse, levels.matrix[0], levels.matrix[0]));
  FSI_PETSC(KSPSetType(coarse, KSPPREONLY));
  FSI_PETSC(KSPGetPC(coarse, &pc));
  factor_whole(pc);
}

}  // namespace

void factor_whole(PC pc) {
  if (ranks() > 1) {
    KSP inner = nullptr;
    FSI_PETSC(PCSetType(pc, PCREDUNDANT));
    FSI_PETSC(PCRedundantGetKSP(pc, &inner));
    FSI_PETSC(KSPGetPC(inner, &pc));
  }
  FSI_PETSC(PCSetType(pc, PCCHOLESKY));
  FSI_PETSC(PCFactorSetMatOrderingType(pc, MATORDERINGND));
}

bool cycle_on_levels(KSP solver, bool singular) {
  PC amg = nullptr, cycle = nullptr;
  Mat finest = nullptr;
  const char* prefix = nullptr;
  FSI_PETSC(KSPGetPC(solver, &amg));
  FSI_PETSC(PCSetUp(amg));
  FSI_PETSC(PCGetOperators(amg, &finest, nullptr));
  const Levels levels(amg);
  if (levels.n < 2) return false;
  FSI_PETSC(KSPGetOptionsPrefix(solver, &prefix));
  FSI_PETSC(PCCreate(comm(), &cycle));
  FSI_PETSC(PCSetOptionsPrefix(cycle, prefix));
  FSI_PETSC(PCSetOperators(cycle, finest, finest));
  FSI_PETSC(PCSetType(cycle, PCMG));
  set_levels(cycle, levels, finest, singular);
  FSI_PETSC(KSPSetPC(solver, cycle));
  FSI_PETSC(PCDestroy(&cycle));
  FSI_PETSC(KSPSetFromOptions(solver));
  return true;
}

}  // namespace fsi
