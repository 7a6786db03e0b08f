#pragma once
// Our own reader of gmsh files. Needs no PETSc; one rank calls it.

#include <string>

#include "libfsi/mesh/raw.hpp"

namespace fsi {

/// Reads gmsh 2.2, 4.0 or 4.1, ascii or binary, lines ending in LF or CRLF. Cells are the elements
/// of the highest dimension, 3 or 2; sides are those one below that carry a physical group (its
/// number serves as name where the file gives none). Errors: Error{input} naming file, line (ascii)
/// or byte (binary) and what was expected there; Error{io} where the file cannot be read.
RawMesh read_gmsh(const std::string& file);

/// The same for a file that is in memory; `file` is its name in messages.
RawMesh parse_gmsh(const std::string& file, std::string text);

}  // namespace fsi
