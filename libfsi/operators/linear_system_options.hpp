#pragma once
// What a user says to the solvers of the linear systems, looked at before PETSc is.

#include <string>

namespace fsi {

/// Whether the options of the solver `prefix` ("p_", "u_") are ones it can work with: its types
/// exist, tolerances lie between 0 and 1, it may take at least one iteration. Errors: Error{input}
/// that names the option, its value and what is valid.
void check_solver_options(const std::string& prefix);

}  // namespace fsi
