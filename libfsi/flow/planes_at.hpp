#pragma once
// The planes of symmetry that meet an opening.

#include <vector>

#include "libfsi/geometry/mirror.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::flow {

/// Collective. The planes of `mirrors`, patches of symmetry, that have an edge in common with the
/// opening. At most two, at right angles to each other and to the opening: the whole opening then
/// is two or four times as large. None where there are others, since no part of a vessel is the
/// half of it then.
std::vector<geometry::Mirror> planes_at(const Patch& opening, const std::vector<Patch>& mirrors,
                                        const Mesh& mesh);

/// Collective. D = (4 A / pi)^(1/2), in 2-D the width, of the whole opening with its images in
/// these planes.
Real whole_diameter(const Patch& opening, const std::vector<Patch>& mirrors, const Mesh& mesh);

}  // namespace fsi::flow
