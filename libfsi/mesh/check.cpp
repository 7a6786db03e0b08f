#include "libfsi/mesh/check.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <numeric>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/mesh/check_cells.hpp"
#include "libfsi/mesh/messages.hpp"
#include "libfsi/mesh/metrics.hpp"
#include "libfsi/mesh/numbering.hpp"
#include "libfsi/mesh/periodic.hpp"

namespace fsi {
namespace {

using Key = std::array<Index, max_face_corners>;

/// The points of a face in ascending order, joined ones apart: what a boundary element names.
Key point_key(const CellList& list, Half half) {
  Key key{-1, -1, -1, -1};
  const auto corners = list.corners[half.cell];
  std::size_t n = 0;
  for (const std::int8_t i : shape_of(list.types[half.cell]).face_corners(half.face)) {
    key[n++] = corners[i];
  }
  std::ranges::sort(key);
  return key;
}

Vec3 centre_of(const CellList& list, Half half) {
  Vec3 sum;
  const auto corners = shape_of(list.types[half.cell]).face_corners(half.face);
  for (const std::int8_t i : corners) sum += list.points[list.corners[half.cell][i]];
  return sum / static_cast<Real>(corners.size());
}

template <class Visit>
void each_half(const CellList& list, const Visit& visit) {
  for (Index c = 0; c < list.n_cells(); ++c) {
    for (int f = 0; f < shape_of(list.types[c]).faces; ++f) visit(half_of(c, f));
  }
}

void check_manifold(const CellList& list, const RawMesh& raw, const std::vector<Index>& mate) {
  each_half(list, [&](Index half) {
    if (mate[half] != many_mates) return;
    refuse(raw.file + ": the face at " + text_of(centre_of(list, Half(half))) + " of element " +
           std::to_string(raw.tags[Half(half).cell]) + " belongs to more than two cells");
  });
}

/// The vertices of a face in order, right-handed about the normal that leaves the cell.
std::size_t loop_of(const CellList& list, Half half, std::array<Index, max_face_corners>& loop) {
  const auto corners = list.corners[half.cell];
  std::size_t n = 0;
  for (const std::int8_t i : shape_of(list.types[half.cell]).face_corners(half.face))
    loop[n++] = list.vertex[corners[i]];
  return n;
}

/// Two sound cells on either side of a face go round it in opposite ways.
void check_folded(const CellList& list, const RawMesh& raw, const std::vector<Index>& mate) {
  std::array<Index, max_face_corners> mine{}, other{};
  each_half(list, [&](Index half) {
    if (mate[half] <= half) return;
    const std::size_t n = loop_of(list, Half(half), mine);
    loop_of(list, Half(mate[half]), other);
    std::reverse(other.begin(), other.begin() + static_cast<std::ptrdiff_t>(n));
    // An edge of a 2-D cell has a beginning, a face of a 3-D one has none.
    const auto start = n == 2 ? other.begin() : std::ranges::find(other, mine[0]);
    std::rotate(other.begin(), start, other.begin() + static_cast<std::ptrdiff_t>(n));
    if (std::equal(mine.begin(), mine.begin() + static_cast<std::ptrdiff_t>(n), other.begin()))
      return;
    refuse(raw.file + ": elements " + std::to_string(raw.tags[Half(half).cell]) + " and " +
           std::to_string(raw.tags[Half(mate[half]).cell]) + " share the face at " +
           text_of(centre_of(list, Half(half))) +
           " and lie on the same side of it: the mesh is folded on itself there");
  });
}

void check_connected(const CellList& list, const std::string& file,
                     const std::vector<Index>& mate) {
  std::vector<Index> part(list.types.size(), -1), queue, sizes, firsts;
  for (Index seed = 0; seed < list.n_cells(); ++seed) {
    if (part[seed] >= 0) continue;
    const auto number = static_cast<Index>(sizes.size());
    queue.assign(1, seed);
    part[seed] = number;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (int f = 0; f < max_faces; ++f) {
        const Index other = mate[half_of(queue[i], f)];
        if (other < 0 || part[Half(other).cell] >= 0) continue;
        part[Half(other).cell] = number;
        queue.push_back(Half(other).cell);
      }
    }
    sizes.push_back(static_cast<Index>(queue.size())), firsts.push_back(seed);
  }
  if (sizes.size() < 2) return;
  const auto smallest = std::ranges::min_element(sizes) - sizes.begin();
  refuse(file + " falls into " + std::to_string(sizes.size()) +
         " parts that share no face; the smallest has " + std::to_string(sizes[smallest]) +
         " cells, one with a corner at " + text_of(list.points[list.corners[firsts[smallest]][0]]));
}

/// The boundary elements with a name, findable by their points.
class NamedSides {
 public:
  NamedSides(const RawMesh& raw, std::size_t n_points) : raw_(raw), touched_(n_points, 0) {
    for (const RawMesh::Side& side : raw.sides) {
      if (side.name < 0) continue;
      Key key = side.corner;
      for (const Index p : key) {
        if (p >= 0) touched_[p] = 1;
      }
      std::ranges::sort(key);
      sides_.push_back({key, &side, false});
    }
    std::ranges::stable_sort(sides_, {}, &Entry::key);
  }
  /// The number of the face's name, or -1. A face of the boundary has one name.
  Index name_of(const Key& key, bool boundary) {
    for (const Index p : key) {
      if (p >= 0 && touched_[p] == 0) return -1;
    }
    auto found = std::ranges::lower_bound(sides_, key, {}, &Entry::key);
    if (found == sides_.end() || found->key != key) return -1;
    const Index name = found->side->name;
    for (; found != sides_.end() && found->key == key; ++found) {
      found->used = true;
      if (!boundary || found->side->name == name) continue;
      refuse(raw_.file + ": boundary element " + std::to_string(found->side->tag) +
             " carries two names: " + raw_.names[name] + ", " + raw_.names[found->side->name] +
             "; take it out of one of these physical groups");
    }
    return name;
  }
  void check_used() const {
    for (const Entry& entry : sides_) {
      if (entry.used) continue;
      refuse(raw_.file + ": boundary element " + std::to_string(entry.side->tag) + " of \"" +
             raw_.names[entry.side->name] + "\" at " + text_of(raw_.points[entry.side->corner[0]]) +
             " is not a face of any cell");
    }
  }

 private:
  struct Entry {
    Key key;
    const RawMesh::Side* side;
    bool used;
  };
  const RawMesh& raw_;
  std::vector<Entry> sides_;
  std::vector<char> touched_;
};

/// inside: halves of faces between two cells, by name.
void tell_of_inside(const RawMesh& raw, const std::vector<Index>& inside) {
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (inside[i] == 0) continue;
    std::fprintf(stderr,
                 "fsi: warning: %s: of \"%s\" so many faces lie between two cells: %lld; the flow "
                 "passes through them, they are no part of the patch\n",
                 raw.file.c_str(), raw.names[i].c_str(), static_cast<long long>(inside[i] / 2));
  }
}

/// Fills face_patch with the numbers of the names in the file, and patches.
void name_faces(const RawMesh& raw, const std::vector<std::string>& periodic,
                const std::vector<Index>& mate, CellList& list) {
  NamedSides sides(raw, list.points.size());
  list.face_patch.assign(list.types.size(), {-1, -1, -1, -1, -1, -1});
  require(raw.names.size() < 128, raw.file + " has more than 127 physical names on its boundary");
  std::vector<Index> faces(raw.names.size(), 0), inside = faces;
  GlobalIndex uncovered = 0;
  std::string places;
  each_half(list, [&](Index half) {
    const Half h(half);
    const Index name = sides.name_of(point_key(list, h), mate[half] < 0);
    if (mate[half] >= 0) {
      // The two sides of a periodic seam have corners of their own.
      const bool seam = point_key(list, h) != point_key(list, Half(mate[half]));
      if (name >= 0 && !seam) ++inside[name];
      return;
    }
    if (name < 0) {
      if (++uncovered <= 5) places += (places.empty() ? "" : ", ") + text_of(centre_of(list, h));
      return;
    }
    if (std::ranges::find(periodic, raw.names[name]) != periodic.end()) {
      refuse(raw.file + ": the face at " + text_of(centre_of(list, h)) + " of periodic patch \"" +
             raw.names[name] + "\" has no counterpart");
    }
    list.face_patch[h.cell][h.face] = static_cast<std::int8_t>(name);
    ++faces[name];
  });
  require(uncovered == 0, raw.file + ": " + std::to_string(uncovered) +
                              " boundary faces carry no physical name, the first at " + places +
                              "; names are: " + (raw.names.empty() ? "none" : text_of(raw.names)));
  sides.check_used();
  tell_of_inside(raw, inside);
  // Names without boundary faces (periodic ones, surfaces inside) are no patches.
  std::vector<std::int8_t> patch(raw.names.size(), -1);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i] == 0) continue;
    patch[i] = static_cast<std::int8_t>(list.patches.size());
    list.patches.push_back(raw.names[i]);
  }
  for (auto& cell : list.face_patch) {
    for (std::int8_t& p : cell) p = p < 0 ? p : patch[p];
  }
}

/// A number that differs where the cells, their places or the names of the boundary differ.
std::uint64_t hash_of(const CellList& list) {
  std::uint64_t h = 0xCBF29CE484222325u;  // [FNV] offset, then by words with its prime
  const auto mix = [&](std::uint64_t word) {
    h = (h ^ word) * 0x100000001B3u;
    h ^= h >> 29;
  };
  for (const Vec3& x : list.points) {
    for (int k = 0; k < 3; ++k) mix(std::bit_cast<std::uint64_t>(x[k] + 0.0));  // -0 is 0
  }
  for (const Index p : list.corners.index) mix(static_cast<std::uint64_t>(p));
  for (const Index v : list.vertex) mix(static_cast<std::uint64_t>(v));
  for (const CellType type : list.types) mix(static_cast<std::uint64_t>(type));
  for (const auto& cell : list.face_patch) {
    for (const std::int8_t p : cell) mix(static_cast<std::uint64_t>(p + 1));
  }
  for (const std::string& name : list.patches) {
    for (const char c : name) mix(static_cast<unsigned char>(c));
  }
  return h;
}

}  // namespace

CellList check_mesh(RawMesh raw, const std::vector<std::string>& periodic) {
  check_cells(raw);
  require(raw.n_cells() > 1, raw.file + " has only one cell, element " +
                                 std::to_string(raw.tags[0]) +
                                 ": a flow needs cells beside each other; make the mesh finer");
  PeriodicPairs seams = join_periodic(raw, periodic);
  CellList list;
  list.dim = raw.dim;
  list.points = raw.points;
  list.types = std::move(raw.types), list.corners = std::move(raw.corners);
  list.vertex = std::move(seams.vertex), list.offset = std::move(seams.offset);
  list.periods = std::move(seams.periods);
  list.n_owned = list.n_cells(), list.n_global = list.n_cells();
  list.global_id.resize(list.types.size());
  std::iota(list.global_id.begin(), list.global_id.end(), 0);
  check_periods(list, raw.file);
  const std::vector<Index> mate = match_faces(list);
  check_manifold(list, raw, mate);
  check_folded(list, raw, mate);
  check_connected(list, raw.file, mate);
  name_faces(raw, periodic, mate, list);
  number_for_memory(list, mate);
  list.hash = hash_of(list);
  return list;
}

}  // namespace fsi
