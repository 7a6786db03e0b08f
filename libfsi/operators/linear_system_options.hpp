#pragma once
// Checks of the user's options for the linear solvers, before PETSc reads them.

#include <string>

namespace fsi {

/// Checks the user's options of the solver `prefix` ("p_", "u_"). Its types must exist, the
/// relative tolerance lie between 0 and 1, the absolute one not be negative, and the number of
/// iterations be at least one. Errors: Error{input} that names the option, its value and what is
/// valid.
void check_solver_options(const std::string& prefix);

}  // namespace fsi
