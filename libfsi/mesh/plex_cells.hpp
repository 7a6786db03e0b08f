#pragma once
// A DMPlex from each rank's cells.

#include <petscdmplex.h>
#include <petscsf.h>

#include <span>
#include <utility>
#include <vector>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/cell_list.hpp"
#include "libfsi/mesh/exchange.hpp"

namespace fsi {

/// Owns one PETSc object.
template <class T, PetscErrorCode (*destroy)(T*)>
class Handle {
 public:
  Handle() = default;
  ~Handle() { destroy(&object_); }  // NOLINT: a destructor has nobody to tell
  ///@{
  /// Moves the object.
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    ///@}
    std::swap(object_, other.object_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  /// The object itself.
  operator T() const { return object_; }
  /// Where PETSc is to put a new one.
  T* out() { return &object_; }
  /// Gives the object away.
  T release() { return std::exchange(object_, nullptr); }

 private:
  T object_ = nullptr;
};
/// A DMPlex.
using Plex = Handle<DM, DMDestroy>;
/// A star forest.
using StarForest = Handle<PetscSF, PetscSFDestroy>;

/// This rank's cells by numbers of vertices that all ranks share.
struct NumberedCells {
  int dim = 3;                      ///< 2 or 3
  std::span<const CellType> types;  ///< [cells]
  Csr vertices;                     ///< [cells] in the order of Shape
};

/// Collective. The cells and their vertices, without coordinates, faces and edges; a vertex of
/// several ranks' cells is one. Points: the cells in their order, then the vertices by number,
/// which `vertices` lists. n_vertices: the numbers are below it.
Plex plex_of(const NumberedCells& cells, Index n_vertices, std::vector<Index>& vertices);

/// Replaces each number by its rank among those that occur; returns these, ascending.
std::vector<Index> compress(std::vector<Index>& numbers);

/// Collective. The items with the numbers `wanted`, of which every rank holds the stretch `mine`.
template <class T>
std::vector<T> pull(const std::vector<T>& mine, const Stretches& where,
                    std::span<const Index> wanted) {
  std::vector<T> result(wanted.size());
  std::vector<PetscSFNode> root(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const int holder = where.holder(wanted[i]);
    root[i] = {holder, wanted[i] - where.begin[static_cast<std::size_t>(holder)]};
  }
  StarForest sf;
  FSI_PETSC(PetscSFCreate(comm(), sf.out()));
  FSI_PETSC(PetscSFSetGraph(sf, static_cast<PetscInt>(mine.size()),
                            static_cast<PetscInt>(root.size()), nullptr, PETSC_COPY_VALUES,
                            root.data(), PETSC_COPY_VALUES));
  MPI_Datatype unit = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(sizeof(T), MPI_BYTE, &unit);
  MPI_Type_commit(&unit);
  FSI_PETSC(PetscSFBcastBegin(sf, unit, mine.data(), result.data(), MPI_REPLACE));
  FSI_PETSC(PetscSFBcastEnd(sf, unit, mine.data(), result.data(), MPI_REPLACE));
  MPI_Type_free(&unit);
  return result;
}

}  // namespace fsi
