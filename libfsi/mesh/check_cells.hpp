#pragma once
// Checks of single cells, before anything is known of their neighbours.

#include "libfsi/mesh/raw.hpp"

namespace fsi {

/// Error{input} for a file without cells, a coordinate that is not finite, or a 2-D mesh out of its
/// plane z = const (which becomes z = 0). Also for a node twice in a cell, and for a cell without
/// volume, turned inside out, tangled, or there twice. If all cells of an entity are turned inside
/// out, they are turned back: its surface is clockwise in the geometry.
void check_cells(RawMesh& raw);

}  // namespace fsi
