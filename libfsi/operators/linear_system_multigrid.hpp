#pragma once
// The multigrid cycle of a LinearSystem: for linear_system.cpp alone.

#include <petscksp.h>

namespace fsi {

/// Collective. Replaces BoomerAMG, the solver's preconditioner, by a symmetric V(1,1) cycle of
/// PETSc on the levels that BoomerAMG makes of the solver's matrix. The cycle is one forward
/// Gauss-Seidel sweep on the way down and one backward sweep on the way up, in each rank's own
/// part. On the coarsest level it is a factorisation. singular: the constant is the null space of
/// the matrix. Returns whether there is such a cycle; BoomerAMG stays if it makes only one level.
bool cycle_on_levels(KSP solver, bool singular);

/// Makes the preconditioner a factorisation. With several ranks each of them factors the whole
/// matrix, which is small. A parallel factorisation (MUMPS) adds in an order that differs from run
/// to run.
void factor_whole(PC pc);

}  // namespace fsi
