#pragma once
// The multigrid cycle of a LinearSystem: for linear_system.cpp alone.

#include <petscksp.h>

namespace fsi {

/// Collective. Puts a symmetric V(1,1) cycle of PETSc's in the place of BoomerAMG, the solver's
/// preconditioner, on the levels that BoomerAMG makes of the solver's matrix. The cycle is a sweep
/// of Gauss-Seidel forward on the way down and one backward on the way up, in every rank's own
/// part. On the coarsest level it is a factorisation. singular: the constant is the null space of
/// the matrix. Returns whether there is such a cycle; BoomerAMG stays where it makes one level
/// only.
bool cycle_on_levels(KSP solver, bool singular);

/// Makes the preconditioner a factorisation; where ranks are many every one factors the whole,
/// which is small: a parallel factorisation (MUMPS) adds up in an order that differs from run to
/// run.
void factor_whole(PC pc);

}  // namespace fsi
