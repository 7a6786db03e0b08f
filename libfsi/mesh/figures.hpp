#pragma once
// The figures of a mesh in one line, and warnings if they are past the limits of the solver.

#include <string>
#include <vector>

#include "libfsi/mesh/gap.hpp"
#include "libfsi/mesh/quality.hpp"

namespace fsi {

/// Past these a driver warns and fsi-mesh check advises. The shipped geometries in tets that gmsh
/// has optimised reach 70 degrees, 1.4, 7 and 6.3; as they come, slivers among them, 86 degrees,
/// 1.8, 400 and 660. The tested flows complete on those too (doc/verification/tetrahedra.md), but
/// such cells reduce accuracy and the length of the step.
struct MeshLimits {
  /// As in CellQuality, at most.
  Real non_orthogonality = 75, skewness = 2, volume_ratio = 20, aspect_ratio = 25;
  Real gap = 6;  ///< cells across the narrowest passage, at least
};

/// Corners of a box along the axes.
struct Box {
  Vec3 low;   ///< the least coordinates
  Vec3 high;  ///< the largest
};

/// Collective. The least box around the mesh.
Box extent(const Mesh& mesh);
/// Collective. The largest extent of the mesh along the axes other than x (0), y (1) or z (2).
Real width_across(const Mesh& mesh, int axis);

/// The area of a patch.
struct PatchArea {
  Vec3 vector;    ///< sum of the area vectors of its faces
  Real size = 0;  ///< sum of their norms
};

/// Collective. Over all ranks.
PatchArea area_of(const Patch& patch, const Mesh& mesh);

/// Collective. The largest angle, in degrees, by which a patch turns between two of its faces that
/// share a point; angles of more than 30 degrees are edges between planes and do not count.
Real curvature(const Patch& patch, const Mesh& mesh);

/// "from (x, y, z) to (x, y, z)".
std::string text_of(const Box& box);

/// The figures of a mesh as a whole.
struct MeshFigures {
  Quality quality;  ///< of the cells
  Gap gap;          ///< the narrowest passage
  Box box;          ///< that holds all cells
};

/// Collective. walls: between which patches the gap is measured; none: all but the mirrors, which
/// are planes of symmetry (mesh/gap.hpp).
MeshFigures mesh_figures(const Mesh& mesh, const std::vector<std::string>& walls,
                         const std::vector<std::string>& mirrors = {});

/// What is past a limit: figure, limit and place in words, and what to change in gmsh.
struct Finding {
  std::string what, change;  ///< each a sentence
};

/// In the order non-orthogonality, skewness, volume ratio, aspect ratio, gap.
std::vector<Finding> findings(const MeshFigures& figures, const MeshLimits& limits = {});

/// One line: cells, ranks, the figures.
std::string summary(const std::string& file, const Mesh& mesh, const MeshFigures& figures);

/// The findings in one sentence that names fsi-mesh check; "" where there are none.
std::string warning(const std::string& file, const std::vector<Finding>& found);

/// printf into a string.
std::string print(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace fsi
