#pragma once
// The cells and faces around a marked set: where the work on a small body is done.

#include <cstdint>
#include <vector>

#include "libfsi/field/field.hpp"

namespace fsi {

/// Row i: owned cells that share a vertex with halo cell n_owned + i, ascending.
Csr cells_around_halo(const Mesh& mesh);

/// Internal faces with a halo cell, ascending.
std::vector<Index> faces_between_ranks(const Mesh& mesh);

/// Owned cells of a set, and those that share a vertex with one; the faces of both. Rebuilt each
/// step from lists that keep their memory.
class Band {
 public:
  /// An empty band; mesh must outlive it.
  explicit Band(const Mesh& mesh);

  /// Collective. The set {c : q[c] >= threshold}. q: owned and halo.
  void rebuild(const CellField<Real>& q, Real threshold);

  /// Owned cells of the set.
  const std::vector<Index>& core() const { return core_; }
  /// Those of the call before.
  const std::vector<Index>& last_core() const { return last_core_; }
  /// Owned cells of the set, in the order of core(), then those around it.
  const std::vector<Index>& cells() const { return cells_; }
  /// 1 in `cells`, also in those of other ranks; 0 elsewhere. The cells in which a field of the
  /// band needs its halo.
  const CellField<Real>& listed() const { return listed_; }
  /// Faces of `cells`, and all faces between ranks next to them: both ranks list the same.
  const std::vector<Index>& faces() const { return faces_; }
  /// Row i: owned cells that share a vertex with halo cell n_owned + i.
  const Csr& around_halo() const { return halo_neighbours_; }

 private:
  const Mesh& mesh_;
  Csr halo_neighbours_;
  std::vector<Index> between_ranks_, core_, last_core_, cells_, faces_;
  std::vector<std::int32_t> cell_stamp_, face_stamp_;
  CellField<Real> listed_;
  std::int32_t calls_ = 0;
};

}  // namespace fsi
