#pragma once
// What a user says to the solvers of the linear systems, looked at before PETSc is.

#include <string>

namespace fsi {

/// Looks at what the user says to the solver `prefix` ("p_", "u_"). Its types must exist, the
/// relative tolerance lie between 0 and 1, the absolute one not be negative, and it may take at
/// least one iteration. Errors: Error{input} that names the option, its value and what is valid.
void check_solver_options(const std::string& prefix);

}  // namespace fsi
