#pragma once
// Gradients at faces, from those in cells by way of the vertices.

#include <cstdint>
#include <vector>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/operators/gradient.hpp"
#include "libfsi/operators/symmetry_faces.hpp"

namespace fsi {

/// The gradient at irregular faces, in the order of FaceWeights::irregular. Between quadrilaterals
/// or hexahedra it is linear between the cells. On all other faces it is the mean over the vertices
/// v of the face, of means over the cells c that touch v,
///
///   G_v = sum w_c G_c / sum w_c,   w_c = 1 / sum_f |g_cf|^2,
///
/// with g_cf the weights of the cell's gradient. So w_c is the inverse of the variance that
/// uncorrelated errors of q cause. A flat cell has little weight, and so has a cell with few
/// neighbours at a boundary without values. A cell with too few neighbours for a fit counts only if
/// there is no other. The mean is exact for linear fields. Images of the cells complete the mean
/// at a vertex on planes of symmetry that are at right angles to each other.
///
/// The gradient of a hexahedron does not respond to a field that alternates from cell to cell. That
/// of a tetrahedron, from four neighbours, does so strongly, and second-order convection with it
/// grows [Haider09]. The mean of two dozen cells about a vertex hardly responds.
template <class Gradient>
class VertexMean {
 public:
  /// Collective. stencil: that of the cells' gradients.
  VertexMean(const Mesh& mesh, const GradientStencil& stencil);

  /// g: [irregular faces]. of_cells: owned and halo.
  void set(std::vector<Gradient>& g, const CellField<Gradient>& of_cells);
  /// The same at the irregular faces of a band alone, of a field that is zero in cells outside the
  /// band.
  void set(std::vector<Gradient>& g, const CellField<Gradient>& of_cells, const Band& band);

 private:
  /// Numbers the vertices of irregular faces. Returns their numbers by vertex, -1 of others.
  std::vector<Index> number_vertices();
  void list_cells(const std::vector<Index>& row);
  void set_weights(const GradientStencil& stencil);
  void list_planes(const GradientStencil& stencil, const std::vector<Index>& row);
  void set_row(Index r, const CellField<Gradient>& of_cells);
  Gradient at_face(Index i, const CellField<Gradient>& of_cells) const;

  const Mesh& mesh_;
  const FaceWeights& weights_;
  CellField<Real> weight_;  // w
  Csr face_rows_;           // [irregular faces] its vertices, numbered from 0; none between bricks
  // by row:
  Csr row_cells_;              // in the order of their global id: the same sum on every rank
  std::vector<Real> share_;    // 1 / sum w
  std::vector<Index> planes_;  // its place in reflections_; -1: on no plane of symmetry
  std::vector<Gradient> mean_;
  std::vector<std::int32_t> stamp_;
  std::vector<Reflection> reflections_;  // the planes of symmetry through a vertex
  std::int32_t calls_ = 0;
};

/// The stencils of the gradient of a pressure (operators/gradient.hpp).
struct PressureStencil {
  /// Collective. given[i]: whether the pressure is given on mesh.patches[i]; mirrors[i]: whether
  /// these are planes of symmetry (empty: false).
  PressureStencil(const Mesh& mesh, const FaceWeights& weights, const std::vector<bool>& given,
                  const std::vector<bool>& mirrors = {})
      : cells(mesh, weights, given, mirrors), at_faces(mesh, cells) {}

  GradientStencil cells;      ///< gradient in the cells
  VertexMean<Vec3> at_faces;  ///< and at irregular faces
};

}  // namespace fsi
