#pragma once
// Cells that several bodies share.

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

/// Moves what is too much of several bodies in a cell to where there is room. Every body is carried
/// by planes of its own, so where two surfaces pass through a cell their fractions may add up to
/// more than 1 by the error of the planes.
class Separation {
 public:
  /// bodies: count of solids.
  Separation(const Mesh& mesh, std::size_t bodies);

  /// Collective. In cells where S = sum_i alpha_i > 1 each body gives up the part alpha_i / S of
  /// the excess to the cells across its faces that hold some of this body. It goes in proportion to
  /// their room 1 - S, and no more than fills them, in a few rounds at most. What finds no room
  /// stays, and `overlap` tells how much. The sum of alpha_i V stays to round-off. cells: owned,
  /// with all those in which two bodies meet, none twice. Returns whether anything moved.
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
