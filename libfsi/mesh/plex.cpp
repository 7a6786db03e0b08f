#include "libfsi/mesh/plex.hpp"

#include <petscdmplex.h>
#include <petscsf.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/plex_partition.hpp"

namespace fsi {
namespace {

/// Owns one PETSc object.
template <class T, PetscErrorCode (*destroy)(T*)>
class Handle {
 public:
  Handle() = default;
  ~Handle() { destroy(&object_); }  // NOLINT: a destructor has nobody to tell
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator T() const { return object_; }
  T* out() { return &object_; }

 private:
  T object_ = nullptr;
};
using Plex = Handle<DM, DMDestroy>;
using StarForest = Handle<PetscSF, PetscSFDestroy>;

/// items[wanted[i]] of rank 0, on every rank.
template <class T>
std::vector<T> pull(const std::vector<T>& items, std::span<const Index> wanted) {
  std::vector<T> result(wanted.size());
  std::vector<PetscSFNode> root(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) root[i] = {0, wanted[i]};
  const auto n_roots = static_cast<PetscInt>(rank() == 0 ? items.size() : 0);
  StarForest sf;
  FSI_PETSC(PetscSFCreate(comm(), sf.out()));
  FSI_PETSC(PetscSFSetGraph(sf, n_roots, static_cast<PetscInt>(root.size()), nullptr,
                            PETSC_COPY_VALUES, root.data(), PETSC_COPY_VALUES));
  MPI_Datatype unit = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(sizeof(T), MPI_BYTE, &unit);
  MPI_Type_commit(&unit);
  FSI_PETSC(PetscSFBcastBegin(sf, unit, items.data(), result.data(), MPI_REPLACE));
  FSI_PETSC(PetscSFBcastEnd(sf, unit, items.data(), result.data(), MPI_REPLACE));
  MPI_Type_free(&unit);
  return result;
}

DMPolytopeType polytope(CellType type) {
  constexpr DMPolytopeType of[] = {DM_POLYTOPE_TRIANGLE,    DM_POLYTOPE_QUADRILATERAL,
                                   DM_POLYTOPE_TETRAHEDRON, DM_POLYTOPE_HEXAHEDRON,
                                   DM_POLYTOPE_TRI_PRISM,   DM_POLYTOPE_PYRAMID};
  return of[static_cast<std::size_t>(type)];
}

/// All cells on rank 0 by their vertices, joined ones taken as one. Without coordinates, faces and
/// edges: the division needs none, and making them takes four fifths of the time.
Plex serial_plex(const CellList& whole) {
  const PetscInt n_cells = rank() == 0 ? whole.n_cells() : 0;
  std::vector<PetscInt> number(rank() == 0 ? whole.points.size() : 0, -1);
  PetscInt n = n_cells;
  if (rank() == 0) {
    for (const Index p : whole.corners.index) number[whole.vertex[p]] = 0;
    for (PetscInt& i : number) i = i < 0 ? i : n++;
  }
  Plex plex;
  FSI_PETSC(DMPlexCreate(comm(), plex.out()));
  FSI_PETSC(DMSetDimension(plex, whole.dim));
  FSI_PETSC(DMPlexDistributeSetDefault(plex, PETSC_FALSE));
  FSI_PETSC(DMPlexSetChart(plex, 0, n));
  FSI_PETSC(DMCreateLabel(plex, "celltype"));  // else PETSc guesses the types, too early
  for (PetscInt c = 0; c < n_cells; ++c) {
    FSI_PETSC(DMPlexSetConeSize(plex, c, shape_of(whole.types[c]).corners));
    FSI_PETSC(DMPlexSetCellType(plex, c, polytope(whole.types[c])));
  }
  for (PetscInt v = n_cells; v < n; ++v) FSI_PETSC(DMPlexSetCellType(plex, v, DM_POLYTOPE_POINT));
  FSI_PETSC(DMSetUp(plex));
  for (PetscInt c = 0; c < n_cells; ++c) {
    PetscInt cone[max_corners];
    int i = 0;
    for (const Index p : whole.corners[c]) cone[i++] = number[whole.vertex[p]];
    FSI_PETSC(DMPlexReorderCell(plex, c, cone));
    FSI_PETSC(DMPlexSetCone(plex, c, cone));
  }
  FSI_PETSC(DMPlexSymmetrize(plex));
  FSI_PETSC(DMPlexStratify(plex));
  return plex;
}

/// The plex divided, with its overlap, and for each of its points the one of rank 0 it comes from.
std::pair<Plex, StarForest> migrate(Plex serial, const Parts& parts) {
  PetscPartitioner part = nullptr;
  FSI_PETSC(DMPlexGetPartitioner(serial, &part));
  FSI_PETSC(PetscPartitionerSetType(part, PETSCPARTITIONERSHELL));
  FSI_PETSC(
      PetscPartitionerShellSetPartition(part, ranks(), parts.sizes.data(), parts.cells.data()));
  // Cells are neighbours where they share a vertex.
  FSI_PETSC(DMSetBasicAdjacency(serial, PETSC_TRUE, PETSC_TRUE));
  Plex own, overlapped;
  StarForest first, second, both;
  FSI_PETSC(DMPlexDistribute(serial, 0, first.out(), own.out()));
  serial = Plex{};
  FSI_PETSC(DMSetBasicAdjacency(own, PETSC_TRUE, PETSC_TRUE));
  FSI_PETSC(DMPlexDistributeOverlap(own, 1, second.out(), overlapped.out()));
  FSI_PETSC(PetscSFCompose(first, second, both.out()));
  return {std::move(overlapped), std::move(both)};
}

/// A rank's cells after the division.
struct Share {
  std::vector<Index> file_cell;  // position in the file; owned first, both parts ascending
  Index n_owned = 0;
  std::vector<int> halo_owner;
  std::vector<Index> halo_owner_cell;
};

Share share_of(DM plex, PetscSF origin) {
  PetscInt begin = 0, end = 0, n_leaves = 0, n_points = 0;
  const PetscInt* leaf = nullptr;
  const PetscSFNode* root = nullptr;
  FSI_PETSC(DMPlexGetHeightStratum(plex, 0, &begin, &end));
  FSI_PETSC(DMPlexGetChart(plex, nullptr, &n_points));
  std::vector<Index> from(end, -1), owner(end, -1);
  FSI_PETSC(PetscSFGetGraph(origin, nullptr, &n_leaves, &leaf, &root));
  for (PetscInt i = 0; i < n_leaves; ++i) {
    const PetscInt p = leaf != nullptr ? leaf[i] : i;
    if (p >= begin && p < end) from[p] = static_cast<Index>(root[i].index);
  }
  PetscSF shared = nullptr;
  FSI_PETSC(DMGetPointSF(plex, &shared));
  FSI_PETSC(PetscSFGetGraph(shared, nullptr, &n_leaves, &leaf, &root));
  for (PetscInt i = 0; i < n_leaves; ++i) {
    const PetscInt p = leaf != nullptr ? leaf[i] : i;
    if (p >= begin && p < end) owner[p] = static_cast<Index>(root[i].rank);
  }

  std::vector<Index> order(end - begin);
  std::iota(order.begin(), order.end(), static_cast<Index>(begin));
  std::ranges::sort(order, {}, [&](Index p) { return std::pair(owner[p] >= 0, from[p]); });
  Share share;
  std::vector<PetscInt> place(n_points, -1);  // of each cell in `order`, here and at its owner
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = static_cast<PetscInt>(i);
    share.file_cell.push_back(from[order[i]]);
    if (owner[order[i]] < 0) ++share.n_owned;
  }
  FSI_PETSC(PetscSFBcastBegin(shared, MPIU_INT, place.data(), place.data(), MPI_REPLACE));
  FSI_PETSC(PetscSFBcastEnd(shared, MPIU_INT, place.data(), place.data(), MPI_REPLACE));
  for (std::size_t i = share.n_owned; i < order.size(); ++i) {
    share.halo_owner.push_back(owner[order[i]]);
    share.halo_owner_cell.push_back(static_cast<Index>(place[order[i]]));
  }
  return share;
}

/// What travels with a cell and with a point.
struct CellRecord {
  std::array<Index, max_corners> corner;
  std::array<std::int8_t, max_faces> face_patch;
  CellType type;
};
struct PointRecord {
  Vec3 x;
  Index vertex;
  Offset offset;
};

std::vector<CellRecord> cell_records(const CellList& whole) {
  std::vector<CellRecord> records(rank() == 0 ? whole.types.size() : 0);
  for (std::size_t c = 0; c < records.size(); ++c) {
    records[c] = {{}, whole.face_patch[c], whole.types[c]};
    std::ranges::copy(whole.corners[static_cast<Index>(c)], records[c].corner.begin());
  }
  return records;
}

std::vector<PointRecord> point_records(const CellList& whole) {
  std::vector<PointRecord> records(rank() == 0 ? whole.points.size() : 0);
  for (std::size_t p = 0; p < records.size(); ++p) {
    records[p] = {whole.points[p], whole.vertex[p], whole.offset[p]};
  }
  return records;
}

/// Replaces each number by its rank among those that occur; returns these, ascending.
std::vector<Index> compress(std::vector<Index>& numbers) {
  std::vector<Index> distinct(numbers);
  std::ranges::sort(distinct);
  const auto twice = std::ranges::unique(distinct);
  distinct.erase(twice.begin(), twice.end());
  for (Index& number : numbers) {
    number = static_cast<Index>(std::ranges::lower_bound(distinct, number) - distinct.begin());
  }
  return distinct;
}

void pull_cells(const CellList& whole, std::span<const Index> wanted, CellList& mine) {
  for (const CellRecord& cell : pull(cell_records(whole), wanted)) {
    mine.types.push_back(cell.type), mine.face_patch.push_back(cell.face_patch);
    const auto n = shape_of(cell.type).corners;
    mine.corners.index.insert(mine.corners.index.end(), cell.corner.begin(),
                              cell.corner.begin() + n);
    mine.corners.offset.push_back(static_cast<Index>(mine.corners.index.size()));
  }
  const std::vector<Index> points = compress(mine.corners.index);
  for (const PointRecord& point : pull(point_records(whole), points)) {
    mine.points.push_back(point.x), mine.vertex.push_back(point.vertex);
    mine.offset.push_back(point.offset);
  }
  compress(mine.vertex);
}

void broadcast_common(const CellList& whole, CellList& mine) {
  struct {
    int dim;
    std::size_t periods;
    GlobalIndex n_global;
    std::uint64_t hash;
  } head{whole.dim, whole.periods.size(), whole.n_global, whole.hash};
  MPI_Bcast(&head, sizeof head, MPI_BYTE, 0, comm());
  mine.dim = head.dim, mine.n_global = head.n_global, mine.hash = head.hash;
  mine.periods = whole.periods;
  mine.periods.resize(head.periods);
  MPI_Bcast(mine.periods.data(), static_cast<int>(sizeof(Vec3) * head.periods), MPI_BYTE, 0,
            comm());
  std::string names;
  if (rank() == 0) {
    for (const std::string& name : whole.patches) names += name + '\n';
  }
  names = broadcast(names);
  for (std::size_t at = 0, end; (end = names.find('\n', at)) != std::string::npos; at = end + 1) {
    mine.patches.push_back(names.substr(at, end - at));
  }
}

}  // namespace

CellList distribute(CellList whole, const Division& how) {
  const std::string& partitioner = how.partitioner;
  require(partitioner == "metis" || partitioner == "ptscotch" || partitioner == "simple",
          "partitioner \"" + partitioner + "\" unknown; there are: metis, ptscotch, simple");
  if (ranks() == 1) return whole;
  CellList mine;
  broadcast_common(whole, mine);
  whole.dim = mine.dim;
  Share share;
  {
    const auto [plex, origin] = migrate(serial_plex(whole), partition_cells(whole, how));
    share = share_of(plex, origin);
  }
  pull_cells(whole, share.file_cell, mine);
  mine.global_id.assign(share.file_cell.begin(), share.file_cell.end());
  mine.n_owned = share.n_owned;
  mine.halo_owner = std::move(share.halo_owner);
  mine.halo_owner_cell = std::move(share.halo_owner_cell);
  return mine;
}

}  // namespace fsi
