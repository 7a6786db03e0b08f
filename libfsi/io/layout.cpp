#include "libfsi/io/layout.hpp"

#include <petscsf.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/cells.hpp"
#include "libfsi/mesh/exchange.hpp"

namespace fsi::io {
namespace {

/// `width` Reals side by side. One is MPI_DOUBLE itself, see Halo.
class Unit {
 public:
  explicit Unit(int width) {
    if (width == 1) return;
    MPI_Type_contiguous(width, MPI_DOUBLE, &type_);
    MPI_Type_commit(&type_);
  }
  ~Unit() {
    if (type_ != MPI_DOUBLE) MPI_Type_free(&type_);
  }
  Unit(const Unit&) = delete;
  Unit& operator=(const Unit&) = delete;
  operator MPI_Datatype() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DOUBLE;
};

/// Where the faces of each owned cell begin in the file order, [cells][kinds]: kind 0 internal,
/// then the patches. cells: the layout of cells.
std::vector<Real> beginnings(const Mesh& mesh, const Layout& cells, bool boundary_only) {
  const std::size_t kinds = mesh.patches.size() + 1;
  std::vector<Real> count(kinds * static_cast<std::size_t>(mesh.n_cells), 0), room;
  for (Index f = boundary_only ? mesh.n_internal : 0; f < mesh.n_internal; ++f)
    count[kinds * static_cast<std::size_t>(mesh.owner[f])] += 1;
  for (std::size_t p = 0; p + 1 < kinds; ++p)
    for (Index f = mesh.patches[p].begin; f < mesh.patches[p].end; ++f)
      count[kinds * static_cast<std::size_t>(mesh.owner[f]) + p + 1] += 1;
  const int width = static_cast<int>(kinds);
  const std::span<const Real> found = cells.gather(count.data(), width, room);
  std::vector<Real> stretch(found.begin(), found.end()), sum(kinds, 0), before(kinds, 0);
  for (std::size_t i = 0; i < stretch.size(); ++i)
    stretch[i] = std::exchange(sum[i % kinds], sum[i % kinds] + stretch[i]);
  MPI_Exscan(sum.data(), before.data(), width, MPI_DOUBLE, MPI_SUM, comm());
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), width, MPI_DOUBLE, MPI_SUM, comm());
  Real base = 0;
  for (std::size_t k = 0; k < kinds; ++k) before[k] += std::exchange(base, base + sum[k]);
  for (std::size_t i = 0; i < stretch.size(); ++i) stretch[i] += before[i % kinds];
  cells.scatter(stretch, width, count.data());
  mesh.halo.update(count.data(), width);
  return count;
}

/// The cells beyond each owned and halo cell's own internal faces by global_id, [cells][max_faces],
/// in the order of the faces; -1 fills.
std::vector<Real> beyond(const Mesh& mesh) {
  std::vector<Real> others(max_faces * static_cast<std::size_t>(mesh.n_cells), -1);
  std::vector<std::int8_t> n(static_cast<std::size_t>(mesh.n_cells), 0);
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const auto P = static_cast<std::size_t>(mesh.owner[f]);
    others[max_faces * P + static_cast<std::size_t>(n[P]++)] =
        static_cast<Real>(mesh.global_id[mesh.neighbour[f]]);
  }
  mesh.halo.update(others.data(), max_faces);
  return others;
}

}  // namespace

/// The items' roots are the places of the stretches.
struct Layout::Exchange {
  PetscSF owned = nullptr;  ///< of the items that this rank owns
  PetscSF all = nullptr;    ///< of all its items

  Exchange() = default;
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;
  ~Exchange() {
    PetscSFDestroy(&owned);  // NOLINT: a destructor has nobody to tell
    PetscSFDestroy(&all);    // NOLINT: a destructor has nobody to tell
  }
};

Layout::~Layout() = default;
Layout::Layout(Layout&&) noexcept = default;
Layout& Layout::operator=(Layout&&) noexcept = default;

Layout::Layout(const Mesh& mesh, Location on) {
  if (on == Location::cells) {
    size_ = mesh.n_global, n_local_ = mesh.n_owned;
  } else {
    const Index first = on == Location::boundary ? mesh.n_internal : 0;
    n_local_ = mesh.n_faces - first;
    GlobalIndex owned = 0;
    for (Index f = first; f < mesh.n_faces; ++f) owned += mesh.owner[f] < mesh.n_owned ? 1 : 0;
    size_ = global_sum(owned);
  }
  const Stretches stretches = Stretches::even(static_cast<Index>(size_));
  first_ = stretches.first(), mine_ = stretches.mine();
  if (ranks() == 1) return;
  if (on == Location::cells)
    connect({mesh.global_id.begin(), mesh.global_id.begin() + mesh.n_owned});
  else
    connect(places_of_faces(mesh, on == Location::boundary));
}

/// The complement ~place where another rank owns the face.
std::vector<GlobalIndex> Layout::places_of_faces(const Mesh& mesh, bool boundary_only) {
  const std::vector<Real> begin = beginnings(mesh, Layout(mesh, Location::cells), boundary_only);
  const std::size_t kinds = mesh.patches.size() + 1;
  std::vector<GlobalIndex> places;
  places.reserve(static_cast<std::size_t>(n_local_));
  const auto start = [&](Index P, std::size_t kind) {
    return static_cast<GlobalIndex>(begin[kinds * static_cast<std::size_t>(P) + kind]);
  };
  if (!boundary_only) {
    const std::vector<Real> others = beyond(mesh);
    Index twin = 0;  // faces before this one with the same two cells
    for (Index f = 0; f < mesh.n_internal; ++f) {
      const Index P = mesh.owner[f], N = mesh.neighbour[f];
      twin = f > 0 && mesh.owner[f - 1] == P && mesh.neighbour[f - 1] == N ? twin + 1 : 0;
      const auto row = others.begin() + static_cast<std::ptrdiff_t>(max_faces) * P;
      const auto at = std::find(row, row + max_faces, static_cast<Real>(mesh.global_id[N]));
      const GlobalIndex place = start(P, 0) + (at - row) + twin;
      places.push_back(P < mesh.n_owned ? place : ~place);
    }
  }
  for (std::size_t p = 0; p + 1 < kinds; ++p) {
    Index before = -1, k = 0;
    for (Index f = mesh.patches[p].begin; f < mesh.patches[p].end; ++f) {
      k = mesh.owner[f] == before ? k + 1 : 0;
      before = mesh.owner[f];
      places.push_back(start(before, p + 1) + k);
    }
  }
  return places;
}

void Layout::connect(const std::vector<GlobalIndex>& places) {
  exchange_ = std::make_unique<Exchange>();
  const Stretches stretches = Stretches::even(static_cast<Index>(size_));
  for (const bool owned : {true, false}) {
    std::vector<PetscInt> leaf;
    std::vector<PetscSFNode> root;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (owned && places[i] < 0) continue;
      const auto place = static_cast<Index>(places[i] < 0 ? ~places[i] : places[i]);
      const int holder = stretches.holder(place);
      leaf.push_back(static_cast<PetscInt>(i));
      root.push_back({holder, place - stretches.begin[static_cast<std::size_t>(holder)]});
    }
    PetscSF& sf = owned ? exchange_->owned : exchange_->all;
    FSI_PETSC(PetscSFCreate(comm(), &sf));
    FSI_PETSC(PetscSFSetGraph(sf, static_cast<PetscInt>(mine_), static_cast<PetscInt>(leaf.size()),
                              leaf.data(), PETSC_COPY_VALUES, root.data(), PETSC_COPY_VALUES));
    FSI_PETSC(PetscSFSetUp(sf));
  }
}

std::span<const Real> Layout::gather(const Real* values, int width, std::vector<Real>& room) const {
  const auto n = static_cast<std::size_t>(mine_) * static_cast<std::size_t>(width);
  if (exchange_ == nullptr) return {values, n};
  room.resize(n);
  const Unit unit(width);
  FSI_PETSC(PetscSFReduceBegin(exchange_->owned, unit, values, room.data(), MPI_REPLACE));
  FSI_PETSC(PetscSFReduceEnd(exchange_->owned, unit, values, room.data(), MPI_REPLACE));
  return room;
}

void Layout::scatter(std::span<const Real> stretch, int width, Real* values) const {
  if (exchange_ == nullptr) {
    std::copy(stretch.begin(), stretch.end(), values);
    return;
  }
  const Unit unit(width);
  FSI_PETSC(PetscSFBcastBegin(exchange_->all, unit, stretch.data(), values, MPI_REPLACE));
  FSI_PETSC(PetscSFBcastEnd(exchange_->all, unit, stretch.data(), values, MPI_REPLACE));
}

void require_finite(const std::string& name, const Real* values, int width, Location on,
                    const Mesh& mesh) {
  constexpr GlobalIndex none = std::numeric_limits<GlobalIndex>::max();
  const Index first = on == Location::boundary ? mesh.n_internal : 0;
  const Index n = on == Location::cells ? mesh.n_owned : mesh.n_faces - first;
  const auto finite = [&](Index i) {
    const Real* item = values + static_cast<std::ptrdiff_t>(i) * width;
    return std::all_of(item, item + width, [](Real value) { return std::isfinite(value); });
  };
  Index i = 0;
  while (i < n && finite(i)) ++i;
  const auto cell_of = [&](Index item) {
    return on == Location::cells ? item : mesh.owner[static_cast<std::size_t>(first + item)];
  };
  const GlobalIndex mine = i < n ? mesh.global_id[static_cast<std::size_t>(cell_of(i))] : none;
  GlobalIndex lowest = none;
  MPI_Allreduce(&mine, &lowest, 1, MPI_INT64_T, MPI_MIN, comm());
  if (lowest == none) return;
  int holder = lowest == mine ? rank() : -1;
  MPI_Allreduce(MPI_IN_PLACE, &holder, 1, MPI_INT, MPI_MAX, comm());
  char place[128] = "";
  if (rank() == holder) {
    const Vec3& x = on == Location::cells ? mesh.C[i] : mesh.Cf[first + i];
    std::snprintf(place, sizeof place, "%s cell %lld at (%.6g, %.6g, %.6g)",
                  on == Location::cells ? "in" : "on a face of", static_cast<long long>(lowest),
                  x.x, x.y, x.z);
  }
  throw Error(ErrorKind::numerics,
              "field \"" + name + "\" is not finite " + broadcast(place, holder));
}

}  // namespace fsi::io
