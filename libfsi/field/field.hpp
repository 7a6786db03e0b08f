#pragma once
// Fields: one value a cell, a face or a boundary face, in flat arrays.

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "libfsi/core/types.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// Where the values of a field live.
enum class Location {
  cells,  ///< [n_cells]: the owned part first (it can be the storage of a PETSc Vec), then the halo
  faces,  ///< [n_faces]: internal faces, then the boundary
  boundary,  ///< [n_boundary]: item f - n_internal belongs to face f
};

/// A flat array with a value per mesh entity; moved, never copied by accident (copy with assign).
/// Invariant: its size is the count of those entities.
template <class T, Location on>
class Field {
 public:
  /// Real, Vec3, SymTensor or Tensor.
  using value_type = T;

  /// `value` everywhere, halo and boundary included.
  explicit Field(const Mesh& mesh, const T& value = {})
      : values_(static_cast<std::size_t>(count(mesh)), value), n_owned_(mesh.n_owned) {}
  ///@{
  /// Moves the values.
  Field(Field&&) noexcept = default;
  Field& operator=(Field&&) noexcept = default;
  ///@}
  Field(const Field&) = delete;
  Field& operator=(const Field&) = delete;
  ~Field() = default;

  ///@{
  /// The value of cell, face or boundary item i.
  T& operator[](Index i) { return values_[static_cast<std::size_t>(i)]; }
  const T& operator[](Index i) const { return values_[static_cast<std::size_t>(i)]; }
  ///@}
  ///@{
  /// The first value.
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  ///@}
  /// Count of values.
  Index size() const { return static_cast<Index>(values_.size()); }
  ///@{
  /// All values, halo included.
  std::span<T> all() { return values_; }
  std::span<const T> all() const { return values_; }
  ///@}
  /// The values of this rank's own cells.
  std::span<T> owned() requires(on == Location::cells) { return all().first(n_owned_); }
  /// The same, to read.
  std::span<const T> owned() const requires(on == Location::cells) { return all().first(n_owned_); }

  /// Sets all values.
  void fill(const T& value) { std::fill(values_.begin(), values_.end(), value); }
  /// Copies the values of a field of the same mesh.
  void assign(const Field& other) { std::ranges::copy(other.values_, values_.begin()); }
  /// Exchanges the values with another field of the same mesh.
  void swap(Field& other) noexcept { values_.swap(other.values_); }

 private:
  static Index count(const Mesh& mesh) {
    return on == Location::cells   ? mesh.n_cells
           : on == Location::faces ? mesh.n_faces
                                   : mesh.n_boundary();
  }
  std::vector<T> values_;
  std::size_t n_owned_;
};

/// A value a cell, halo included.
template <class T>
using CellField = Field<T, Location::cells>;
/// A value a face.
template <class T>
using FaceField = Field<T, Location::faces>;
/// A value a boundary face.
template <class T>
using BoundaryField = Field<T, Location::boundary>;

}  // namespace fsi
