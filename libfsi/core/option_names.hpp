#pragma once
// Names of options: their owner, and the nearest valid name.

#include <cstddef>
#include <string>
#include <vector>

namespace fsi {

/// Options that PETSc and MPI read as they start or end: logging, memory, debugging.
bool of_petsc(const std::string& name);

/// Options that a solver may read later: those of the linear systems (p_, u_) and of what they
/// hold.
bool of_solver(const std::string& name);

/// The word nearest to a name, by no more edits than `most`; "" where there is none.
std::string nearest(const std::string& name, const std::vector<std::string>& valid,
                    std::size_t most = std::string::npos);

/// The valid option nearest to a name. A first word that is nearest to that of a block with names
/// of the user's own, as solids, is mended alone: what follows it may be any of these names.
std::string nearest_option(const std::string& name, const std::vector<std::string>& valid);

/// As `nearest`, for what stands before one of the underscores in `name`: the word that is nearest
/// to any.
std::string nearest_before_underscore(const std::string& name,
                                      const std::vector<std::string>& valid, std::size_t most);

/// The words with the separator between them.
std::string joined(const std::vector<std::string>& words, const char* separator = ", ");

}  // namespace fsi
