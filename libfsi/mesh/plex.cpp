#include "libfsi/mesh/plex.hpp"

#include <petscdmplex.h>
#include <petscsf.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/memory.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/plex_cells.hpp"
#include "libfsi/mesh/plex_partition.hpp"

namespace fsi {
namespace {

/// The plex divided, with its overlap, and for each of its points the one it comes from.
std::pair<Plex, StarForest> migrate(Plex before, const Parts& parts) {
  PetscPartitioner part = nullptr;
  FSI_PETSC(DMPlexGetPartitioner(before, &part));
  FSI_PETSC(PetscPartitionerSetType(part, PETSCPARTITIONERSHELL));
  FSI_PETSC(
      PetscPartitionerShellSetPartition(part, ranks(), parts.sizes.data(), parts.cells.data()));
  // Cells are neighbours where they share a vertex.
  FSI_PETSC(DMSetBasicAdjacency(before, PETSC_TRUE, PETSC_TRUE));
  Plex own, overlapped;
  StarForest first, second, both;
  FSI_PETSC(DMPlexDistribute(before, 0, first.out(), own.out()));
  before = Plex{};
  FSI_PETSC(DMSetBasicAdjacency(own, PETSC_TRUE, PETSC_TRUE));
  FSI_PETSC(DMPlexDistributeOverlap(own, 1, second.out(), overlapped.out()));
  FSI_PETSC(PetscSFCompose(first, second, both.out()));
  return {std::move(overlapped), std::move(both)};
}

/// A rank's cells after the division.
struct Share {
  std::vector<Index> file_cell;  // number in the mesh as read; owned first, both parts ascending
  Index n_owned = 0;
  std::vector<int> halo_owner;
  std::vector<Index> halo_owner_cell;
};

Share share_of(DM plex, PetscSF origin, const Stretches& cells) {
  PetscInt begin = 0, end = 0, n_leaves = 0, n_points = 0;
  const PetscInt* leaf = nullptr;
  const PetscSFNode* root = nullptr;
  FSI_PETSC(DMPlexGetHeightStratum(plex, 0, &begin, &end));
  FSI_PETSC(DMPlexGetChart(plex, nullptr, &n_points));
  std::vector<Index> from(end, -1), owner(end, -1);
  FSI_PETSC(PetscSFGetGraph(origin, nullptr, &n_leaves, &leaf, &root));
  for (PetscInt i = 0; i < n_leaves; ++i) {
    const PetscInt p = leaf != nullptr ? leaf[i] : i;
    if (p >= begin && p < end) from[p] = cells.begin[root[i].rank] + root[i].index;
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

/// The data that move with a cell and with a point.
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

std::vector<CellRecord> cell_records(const CellList& slab) {
  std::vector<CellRecord> records(slab.types.size());
  for (std::size_t c = 0; c < records.size(); ++c) {
    records[c] = {{}, slab.face_patch[c], slab.types[c]};
    std::ranges::copy(slab.corners[static_cast<Index>(c)], records[c].corner.begin());
  }
  return records;
}

std::vector<PointRecord> point_records(const CellList& slab) {
  std::vector<PointRecord> records(slab.points.size());
  for (std::size_t p = 0; p < records.size(); ++p) {
    records[p] = {slab.points[p], slab.vertex[p], slab.offset[p]};
  }
  return records;
}

/// The cells with the numbers `wanted` and their points, from those who hold them.
void pull_cells(const CellList& slab, std::span<const Index> wanted, CellList& mine) {
  const Stretches cells = Stretches::of(slab.n_cells());
  for (const CellRecord& cell : pull(cell_records(slab), cells, wanted)) {
    mine.types.push_back(cell.type), mine.face_patch.push_back(cell.face_patch);
    const auto n = shape_of(cell.type).corners;
    mine.corners.index.insert(mine.corners.index.end(), cell.corner.begin(),
                              cell.corner.begin() + n);
    mine.corners.offset.push_back(static_cast<Index>(mine.corners.index.size()));
  }
  mine.point_id = compress(mine.corners.index);
  const Stretches points = Stretches::of(static_cast<Index>(slab.points.size()));
  for (const PointRecord& point : pull(point_records(slab), points, mine.point_id)) {
    mine.points.push_back(point.x), mine.vertex_id.push_back(point.vertex);
    mine.offset.push_back(point.offset);
  }
  mine.vertex = mine.vertex_id;
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

/// The slab's cells with the points they need, as build_mesh and the graph want them; corners and
/// vertices are counted here, vertex_id in the mesh as read.
CellList with_points(const CellList& slab) {
  CellList here;
  here.dim = slab.dim;
  std::vector<Index> all(slab.types.size());
  std::iota(all.begin(), all.end(), Stretches::of(slab.n_cells()).first());
  pull_cells(slab, all, here);
  return here;
}

}  // namespace

CellList distribute(CellList slab, const Division& how) {
  require(
      how.partitioner == "metis" || how.partitioner == "ptscotch" || how.partitioner == "simple",
      "partitioner \"" + how.partitioner + "\" unknown; there are: metis, ptscotch, simple");
  if (ranks() == 1) {
    slab.point_id.resize(slab.points.size());
    std::iota(slab.point_id.begin(), slab.point_id.end(), 0);
    slab.vertex_id = slab.vertex;
    slab.n_owned = slab.n_cells();
    slab.global_id.resize(slab.types.size());
    std::iota(slab.global_id.begin(), slab.global_id.end(), 0);
    return slab;
  }
  CellList mine;
  broadcast_common(slab, mine);
  slab.dim = mine.dim;
  const Stretches cells = Stretches::of(slab.n_cells());
  const Stretches points = Stretches::of(static_cast<Index>(slab.points.size()));
  Share share;
  {
    NumberedCells numbered{mine.dim, slab.types, {}};
    Parts parts;
    {
      const CellList here = with_points(slab);
      parts = partition_cells(here, cells, points.size(), how);
      numbered.vertices = here.corners;
      for (Index& p : numbered.vertices.index) p = here.vertex_id[p];
    }
    release_freed_memory();
    std::vector<Index> vertices;
    const auto [plex, origin] = migrate(plex_of(numbered, points.size(), vertices), parts);
    share = share_of(plex, origin, cells);
  }
  release_freed_memory();
  pull_cells(slab, share.file_cell, mine);
  slab = CellList{};
  mine.global_id.assign(share.file_cell.begin(), share.file_cell.end());
  mine.n_owned = share.n_owned;
  mine.halo_owner = std::move(share.halo_owner);
  mine.halo_owner_cell = std::move(share.halo_owner_cell);
  return mine;
}

}  // namespace fsi
