#include "libfsi/io/layout.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdio>
#include <limits>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/io/collect.hpp"

namespace fsi::io {
namespace {

constexpr int tag = 71;

/// What makes a face the same on every rank: patch (-1: internal), owner, neighbour, and its place
/// among the faces for which these three agree.
struct Key {
  std::int64_t patch, P, N, k;
  auto operator<=>(const Key&) const = default;
};

std::vector<Key> keys_of_faces(const Mesh& mesh, Index first) {
  std::vector<Key> keys;
  keys.reserve(static_cast<std::size_t>(mesh.n_faces - first));
  const auto add = [&](std::int64_t patch, GlobalIndex P, GlobalIndex N) {
    Key key{patch, P, N, 0};
    if (!keys.empty()) {
      const Key& last = keys.back();
      if (last.patch == patch && last.P == P && last.N == N) key.k = last.k + 1;
    }
    keys.push_back(key);
  };
  for (Index f = first; f < mesh.n_internal; ++f)
    add(-1, mesh.global_id[mesh.owner[f]], mesh.global_id[mesh.neighbour[f]]);
  for (std::size_t p = 0; p < mesh.patches.size(); ++p)
    for (Index f = mesh.patches[p].begin; f < mesh.patches[p].end; ++f)
      add(static_cast<std::int64_t>(p), mesh.global_id[mesh.owner[f]], 0);
  return keys;
}

}  // namespace

Layout::Layout(const Mesh& mesh, On on) {
  if (on == On::cells)
    place_cells(mesh);
  else
    place_faces(mesh, on == On::boundary);
}

void Layout::place_cells(const Mesh& mesh) {
  size_ = mesh.n_global;
  n_local_ = mesh.n_owned;
  if (ranks() > 1)
    places_ = collect(std::vector(mesh.global_id.begin(), mesh.global_id.begin() + mesh.n_owned));
}

void Layout::place_faces(const Mesh& mesh, bool boundary_only) {
  const Index first = boundary_only ? mesh.n_internal : 0;
  n_local_ = size_ = mesh.n_faces - first;
  if (ranks() == 1) return;
  const std::vector<std::vector<Key>> keys = collect(keys_of_faces(mesh, first));
  std::vector<std::int8_t> mine(static_cast<std::size_t>(n_local_));
  for (Index i = 0; i < n_local_; ++i)
    mine[static_cast<std::size_t>(i)] = mesh.owner[first + i] < mesh.n_owned ? 1 : 0;
  const std::vector<std::vector<std::int8_t>> owned = collect(mine);

  struct Entry {
    Key key;
    std::size_t rank, item;
  };
  std::vector<Entry> entries;
  places_.resize(keys.size());
  for (std::size_t r = 0; r < keys.size(); ++r) {
    places_[r].resize(keys[r].size());
    for (std::size_t i = 0; i < keys[r].size(); ++i) entries.push_back({keys[r][i], r, i});
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.key < b.key; });
  GlobalIndex place = -1;
  const Key* last = nullptr;
  for (const Entry& e : entries) {
    if (last == nullptr || e.key != *last) ++place;
    last = &e.key;
    places_[e.rank][e.item] = owned[e.rank][e.item] != 0 ? place : ~place;
  }
  size_ = place + 1;
  MPI_Bcast(&size_, 1, MPI_INT64_T, 0, comm());
}

std::span<const Real> Layout::gather(const Real* values, int width, std::vector<Real>& room) const {
  const auto w = static_cast<std::size_t>(width);
  if (ranks() == 1) return {values, static_cast<std::size_t>(size_) * w};
  if (rank() != 0) {
    MPI_Send(values, n_local_ * width, MPI_DOUBLE, 0, tag, comm());
    return {};
  }
  std::vector<Real> other;
  room.resize(static_cast<std::size_t>(size_) * w);
  for (std::size_t r = 0; r < places_.size(); ++r) {
    const std::vector<GlobalIndex>& places = places_[r];
    const Real* from = values;
    if (r > 0) {
      other.resize(places.size() * w);
      MPI_Recv(other.data(), static_cast<int>(other.size()), MPI_DOUBLE, static_cast<int>(r), tag,
               comm(), MPI_STATUS_IGNORE);
      from = other.data();
    }
    for (std::size_t i = 0; i < places.size(); ++i)
      if (places[i] >= 0)
        std::copy_n(from + i * w, w, room.begin() + static_cast<std::ptrdiff_t>(w) * places[i]);
  }
  return room;
}

void Layout::scatter(std::span<const Real> all, int width, Real* values) const {
  const auto w = static_cast<std::size_t>(width);
  if (ranks() == 1) {
    std::copy(all.begin(), all.end(), values);
    return;
  }
  if (rank() != 0) {
    MPI_Recv(values, n_local_ * width, MPI_DOUBLE, 0, tag, comm(), MPI_STATUS_IGNORE);
    return;
  }
  std::vector<Real> other;
  for (std::size_t r = 0; r < places_.size(); ++r) {
    const std::vector<GlobalIndex>& places = places_[r];
    if (r > 0) other.resize(places.size() * w);
    Real* to = r > 0 ? other.data() : values;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const GlobalIndex place = places[i] >= 0 ? places[i] : ~places[i];
      std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(w) * place, w, to + i * w);
    }
    if (r > 0)
      MPI_Send(to, static_cast<int>(other.size()), MPI_DOUBLE, static_cast<int>(r), tag, comm());
  }
}

void require_finite(const std::string& name, const Real* values, int width, On on,
                    const Mesh& mesh) {
  constexpr GlobalIndex none = std::numeric_limits<GlobalIndex>::max();
  const Index first = on == On::boundary ? mesh.n_internal : 0;
  const Index n = on == On::cells ? mesh.n_owned : mesh.n_faces - first;
  const auto finite = [&](Index i) {
    const Real* item = values + static_cast<std::ptrdiff_t>(i) * width;
    return std::all_of(item, item + width, [](Real value) { return std::isfinite(value); });
  };
  Index i = 0;
  while (i < n && finite(i)) ++i;
  const auto cell_of = [&](Index item) {
    return on == On::cells ? item : mesh.owner[static_cast<std::size_t>(first + item)];
  };
  const GlobalIndex mine = i < n ? mesh.global_id[static_cast<std::size_t>(cell_of(i))] : none;
  GlobalIndex lowest = none;
  MPI_Allreduce(&mine, &lowest, 1, MPI_INT64_T, MPI_MIN, comm());
  if (lowest == none) return;
  int holder = lowest == mine ? rank() : -1;
  MPI_Allreduce(MPI_IN_PLACE, &holder, 1, MPI_INT, MPI_MAX, comm());
  char place[128] = "";
  if (rank() == holder) {
    const Vec3& x = on == On::cells ? mesh.C[i] : mesh.Cf[first + i];
    std::snprintf(place, sizeof place, "%s cell %lld at (%.6g, %.6g, %.6g)",
                  on == On::cells ? "in" : "on a face of", static_cast<long long>(lowest), x.x, x.y,
                  x.z);
  }
  throw Error(Kind::numerics, "field \"" + name + "\" is not finite " + broadcast(place, holder));
}

}  // namespace fsi::io
