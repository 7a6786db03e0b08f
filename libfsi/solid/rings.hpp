#pragma once
// The cells around the solid, ring by ring.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "libfsi/field/field.hpp"

namespace fsi::solid {

/// Known cells and three rings around them. A ring is the set of vertex neighbours of the cells
/// before it.
class Rings {
 public:
  static constexpr int count = 3;  ///< of rings

  /// mesh must outlive it.
  explicit Rings(const Mesh& mesh)
      : mesh_(mesh), number_(mesh), stamp_(static_cast<std::size_t>(mesh.n_owned), 0) {}

  /// Collective. known: owned cells. around_halo: that of a Band.
  void list(std::span<const Index> known, const Csr& around_halo);

  /// 1: a known cell, 1 + i: one of ring i, 0: neither; owned and halo.
  const CellField<Real>& number() const { return number_; }
  /// Whether cell c is a known one or of a ring up to i.
  bool within(int i, Index c) const { return number_[c] > 0 && number_[c] <= 1 + i; }

  /// Owned cells: the known ones for 0, else those of ring i.
  std::span<const Index> ring(int i) const {
    const std::size_t begin = i == 0 ? 0 : end_[i - 1];
    return all().subspan(begin, end_[i] - begin);
  }
  /// Owned cells: the known ones and all rings.
  std::span<const Index> all() const { return cells_; }
  /// The same without the last ring.
  std::span<const Index> inside() const { return all().first(end_[count - 1]); }
  /// Owned cells of the last ring.
  std::span<const Index> last_ring() const { return ring(count); }
  /// `all` of the call before the last.
  std::span<const Index> before() const { return before_; }

 private:
  void list_ring(int i, const Csr& around_halo);

  const Mesh& mesh_;
  CellField<Real> number_;
  std::vector<Index> cells_, before_;
  std::array<std::size_t, count + 1> end_{};  // in cells_, of the known cells and of each ring
  std::vector<std::int32_t> stamp_;
  std::int32_t calls_ = 0;
};

}  // namespace fsi::solid
