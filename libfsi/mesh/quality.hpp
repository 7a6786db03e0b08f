#pragma once
// The quality of the cells of a mesh, and the worst cells.

#include <span>
#include <string>
#include <vector>

#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// The figures of a cell; each is that of a regular cell (0, 0, 1, 1) or larger.
///   non_orthogonality  degrees between d and Sf, the largest of its internal faces
///   skewness           |Cf - crossing of PN with the face's plane| / |d|, the same
///   volume_ratio       the larger volume of the two cells of a face over the smaller, the same
///   aspect_ratio       longest edge over least thickness, in that of the regular cell of its type
struct CellQuality {
  std::vector<Real> non_orthogonality, skewness, volume_ratio, aspect_ratio;  ///< [n_owned]
};

/// The figures of the owned cells.
CellQuality cell_quality(const Mesh& mesh);

/// Longest edge over thickness, divided by the same of the cell with equal edges: 1 for that one,
/// 10 for a brick of 10 x 1 x 1. The thickness is the least over the faces of the distance of the
/// farthest corner from the face's plane: of a tet its least height.
Real aspect_ratio(CellType type, std::span<const Vec3> corners);
/// That of cell c.
Real aspect_ratio(const Mesh& mesh, Index c);

/// A figure and the cell that has it: its centre, number in the mesh as read (from 0) and type.
struct Worst {
  Real value = 0;                 ///< the figure
  Vec3 x{};                       ///< centre of the cell
  GlobalIndex cell = -1;          ///< its number in the mesh as read
  CellType type = CellType::tet;  ///< its kind
};

/// Collective. The `most` largest of the values of owned cells, the largest first, of equal ones
/// that with the lower number: the same on any number of ranks.
std::vector<Worst> worst(std::span<const Real> values, const Mesh& mesh, std::size_t most);

/// Collective. On every rank the value, 0 or more, of the owned cell of that number.
Real value_at(std::span<const Real> values, GlobalIndex cell, const Mesh& mesh);

/// A summary of the quality of a mesh.
struct Quality {
  Worst non_orthogonality, skewness, volume_ratio, aspect_ratio;  ///< the worst of each
  Real non_orthogonality_mean = 0;                                ///< over the internal faces
  Real volume_min = 0, volume_max = 0;                            ///< smallest and largest cell
  Real closure_max = 0;  ///< max over cells of |sum Sf| / sum |Sf|
};

/// Collective.
Quality quality(const Mesh& mesh);
/// The same from figures that are there already.
Quality quality(const Mesh& mesh, const CellQuality& cells);

/// Collective. Centroid of a patch, weighted with area. Errors: Error{input} for an unknown name.
Vec3 centre(const Mesh& mesh, const std::string& patch);

}  // namespace fsi
