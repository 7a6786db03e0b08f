#pragma once
// From the gradients in cells to those at faces, by way of the vertices.

#include <cstdint>
#include <vector>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/operators/gradient.hpp"

namespace fsi {

/// The gradient at irregular faces, beside FaceWeights::irregular. Between quadrilaterals or
/// hexahedra it is linear between the cells; on other faces the mean over the vertices v of those
/// over the cells c that touch them,
///
///   G_v = sum w_c G_c / sum w_c,   w_c = 1 / sum_f |g_cf|^2,
///
/// g_cf the weights of the cell's gradient, so that w_c is the inverse of the variance that
/// uncorrelated errors of q give it. A flat cell, or one that a boundary without values leaves with
/// few neighbours, hardly counts. One with too few for a fit counts where there is no other. Exact
/// for linear fields. A hexahedron's gradient does not see a
/// field that alternates from cell to cell. That of a tetrahedron from its four neighbours does, so
/// much that second-order convection with it grows [Haider09]; two dozen cells about a vertex
/// hardly do.
///
/// Gradient: Vec3 or Tensor.
template <class Gradient>
class VertexMean {
 public:
  /// Collective. stencil: that of the cells' gradients.
  VertexMean(const Mesh& mesh, const GradientStencil& stencil);

  /// g: [irregular faces]. of_cells: owned and halo.
  void set(std::vector<Gradient>& g, const CellField<Gradient>& of_cells);
  /// The same at the irregular faces of a band alone, of a field that is zero in cells that are not
  /// listed there.
  void set(std::vector<Gradient>& g, const CellField<Gradient>& of_cells, const Band& band);

 private:
  void number_vertices();
  void list_cells();
  void set_weights(const GradientStencil& stencil);
  void set_row(Index r, const CellField<Gradient>& of_cells);
  Gradient at_face(Index i, const CellField<Gradient>& of_cells) const;

  const Mesh& mesh_;
  const FaceWeights& weights_;
  CellField<Real> weight_;  // w
  Csr face_rows_;           // [irregular faces] its vertices, numbered from 0; none between bricks
  // by row:
  Csr row_cells_;            // in the order of their global id: the same sum on every rank
  std::vector<Real> share_;  // 1 / sum w
  std::vector<Gradient> mean_;
  std::vector<std::int32_t> stamp_;
  std::int32_t calls_ = 0;
};

/// What the gradient of a pressure is made with (operators/gradient.hpp).
struct PressureStencil {
  /// Collective. given[i]: whether the pressure is given on mesh.patches[i].
  PressureStencil(const Mesh& mesh, const FaceWeights& weights, const std::vector<bool>& given)
      : cells(mesh, weights, given), at_faces(mesh, cells) {}

  GradientStencil cells;      ///< gradient in the cells
  VertexMean<Vec3> at_faces;  ///< and at irregular faces
};

}  // namespace fsi
