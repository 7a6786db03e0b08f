#pragma once
// The velocity gradients of several solids, each one-sided at its own surface.

#include <deque>

#include "libfsi/solver/body.hpp"

namespace fsi {

/// Each solid makes its one-sided velocity gradient from that of the flow, in its known cells and
/// those around them (solid::InterfaceGradient). Where these cells are those of several solids, the
/// result must not depend on the order of the solids. In a cell that is at least half of one solid,
/// the gradient of this solid stays, or the mean of such solids where they overlap. In any other
/// cell the mean of those of all solids that set it counts.
class SideGradients {
 public:
  /// Zero fields; mesh must outlive them.
  explicit SideGradients(const Mesh& mesh) : of_flow_(mesh), of_all_(mesh), sides_(mesh) {}

  /// L: the gradient of the flow.
  void begin(const CellField<Tensor>& L);
  /// Collective. Keeps what the body made of L, and makes L that of the flow again.
  void keep(CellField<Tensor>& L, const Body& body);
  /// Collective. Adds to L what was kept of the bodies.
  void merge(CellField<Tensor>& L, const std::deque<Body>& bodies);

 private:
  CellField<Tensor> of_flow_, of_all_;
  CellField<Real> sides_;  // number of gradients in of_all_; < 0: of the cell's own solids
};

}  // namespace fsi
