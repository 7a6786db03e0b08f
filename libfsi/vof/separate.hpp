#pragma once
// Separation of bodies in cells that several of them share.

#include <span>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::vof {

/// The fractions of one body that a separation moves; owned and halo, before and after.
struct Fractions {
  CellField<Real>* alpha = nullptr;  ///< fractions at the end of the step
  CellField<Real>* mid = nullptr;    ///< its mean over the step, which takes half of what is moved
};

/// Moves the excess of several bodies in a cell to cells with room. Each body has planes of its
/// own. If two surfaces pass through a cell, the fractions may add up to more than 1 by the error
/// of the planes.
class Separation {
 public:
  /// bodies: count of solids.
  Separation(const Mesh& mesh, std::size_t bodies);

  /// Collective. In cells where S = sum_i alpha_i > 1, each body gives up the part alpha_i / S of
  /// the excess S - 1. It goes to the cells across the faces that hold some of this body, in
  /// proportion to their room 1 - S. It never fills them beyond 1, and there are a few rounds at
  /// most. The rest stays and is reported by `overlap`. The sum of alpha_i V is kept to rounding.
  /// cells: owned, all those in which two bodies meet among them, none twice. Returns whether
  /// anything moved.
  bool apply(std::span<const Fractions> bodies, std::span<const Index> cells);

  /// max over all cells of S - 1 that the last call left, at least 0.
  Real overlap() const { return overlap_; }

 private:
  struct Move {
    Index cell;
    std::size_t body;
    Real volume;
  };
  void offer(std::span<const Fractions> bodies, Index c);
  void add_from(std::span<const Fractions> bodies, Index giver, Index n);
  void add_from_halo(std::span<const Fractions> bodies, Index giver, Index n);

  const Mesh& mesh_;
  std::vector<CellField<Real>> rate_;  // of each body: volume given per room of a neighbour
  std::vector<Index> rim_;             // internal faces with a halo cell
  std::vector<Index> givers_;          // owned cells with a rate, one after the other
  std::vector<Move> moves_;
  Real overlap_ = 0;
};

}  // namespace fsi::vof
