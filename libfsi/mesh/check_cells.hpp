#pragma once
// Checks of single cells, before anything is known of their neighbours.

#include "libfsi/mesh/raw.hpp"

namespace fsi {

/// Error{input} for a file without cells, a coordinate that is not finite, or a 2-D mesh out of its
/// plane z = const (which becomes z = 0). So it is for a node twice in a cell, and for a cell
/// without volume, turned inside out, tangled, or there twice. An entity whose cells are all turned
/// inside out is turned
/// back: its surface was drawn clockwise.
void check_cells(RawMesh& raw);

}  // namespace fsi
