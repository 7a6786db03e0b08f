#pragma once
// What a user says to the solvers of the linear systems, looked at before PETSc is.

#include <string>

namespace fsi {

/// Looks at what the user says to the solver `prefix` ("p_", "u_"): whether its types exist, the
/// relative tolerance lies between 0 and 1, the absolute one is not negative and it may take at
/// least one iteration. Errors: Error{input} that names the option, its value and what is valid.
void check_solver_options(const std::string& prefix);

}  // namespace fsi
