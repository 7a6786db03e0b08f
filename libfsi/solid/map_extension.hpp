#pragma once
// Extrapolation of a reference map from the solid into the fluid.

#include <utility>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/symmetry_faces.hpp"
#include "libfsi/solid/rings.hpp"

namespace fsi::solid {

/// Extrapolates xihat (`d`) linearly from the known cells into three rings of vertex neighbours.
/// The gradient of a map must not change on the way ([Kamrin12], [Rycroft20]: regression from cells
/// that are already set). With r_k from the cell's centre to that of its vertex neighbour k, and
/// w_k = 1 / |r_k|^2:
///   known cells    Gamma_c = arg min sum_k w_k |xihat_c + Gamma_c . r_k - xihat_k|^2, k known,
///                  or a held face, with xihat_k = 0 at its centre
///   rings 1 to 3   (xihat_c, Gamma_c) = arg min sum_k w_k (|xihat_c + Gamma_c . r_k - xihat_k|^2
///                  + |r_k|^2 |Gamma_c - Gamma_k|^2), k known or in a ring before; a held face
///                  counts with its value alone
/// Rings need the second term, since their neighbours are on one side. The fit is exact
/// for a linear xihat on any mesh. xihat is periodic where the mesh is. Beyond a plane of
/// symmetry the images of cells count, with R xihat_k and R Gamma_k R (symmetry_faces.hpp).
class MapExtension {
 public:
  /// symmetry: faces beyond which the images of the cells count as neighbours. mesh must outlive
  /// it.
  MapExtension(const Mesh& mesh, SymmetryFaces symmetry)
      : mesh_(mesh), symmetry_(std::move(symmetry)), item_(mesh), rings_(mesh) {}

  /// [n_boundary] 1 on faces where xihat is 0: the solid is bonded to a wall that stands still.
  void hold(std::vector<char> faces) { held_ = std::move(faces); }
  /// Whether f is one of them.
  bool held(Index f) const {
    return !held_.empty() && f >= mesh_.n_internal && held_[f - mesh_.n_internal] != 0;
  }

  /// Collective. d: owned cells known on entry; on return owned and halo set on known cells and
  /// rings, zero beyond. is_set: 1 where d is set, else 0; owned and halo.
  void apply(CellField<Vec3>& d, CellField<Real>& is_set, const Band& known);

  const SymmetryFaces& symmetry() const { return symmetry_; }  ///< as given
  /// The cells that the last call set.
  const Rings& rings() const { return rings_; }
  /// Gradient Gamma of the fit in a cell that the last call set.
  const Tensor& slope(Index c) const { return item_[c].g; }
  /// Gradient by the fit of known cells, over all vertex neighbours that are set.
  Tensor regression(Index c) const { return regression(c, Rings::count); }

 private:
  struct Item {  ///< the value and its gradient
    Vec3 d;
    Tensor g;
  };
  Tensor regression(Index c, int up_to_ring) const;
  Item fit(Index c, int ring) const;

  const Mesh& mesh_;
  SymmetryFaces symmetry_;
  CellField<Item> item_;
  Rings rings_;
  std::vector<char> held_;  // empty: none
};

}  // namespace fsi::solid
