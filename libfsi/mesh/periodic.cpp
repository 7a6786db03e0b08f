#include "libfsi/mesh/periodic.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/option_names.hpp"
#include "libfsi/mesh/messages.hpp"

namespace fsi {
namespace {

using Pairs = std::vector<std::pair<Index, Index>>;  // (node, its image)

/// Images farther off than that fraction of the patch's extent are no images.
constexpr Real pairing_tolerance = 1e-6;

/// Classes of nodes, each node with its offset from the head of the class.
class Classes {
 public:
  explicit Classes(std::size_t n) : head_(n), offset_(n, Offset{}) {
    std::iota(head_.begin(), head_.end(), 0);
  }
  /// The head of i's class; afterwards offset(i) counts from it.
  Index find(Index i) {
    if (head_[i] == i) return i;
    const Index above = head_[i];
    const Index top = find(above);
    if (above != top) add(offset_[i], offset_[above], 1);
    return head_[i] = top;
  }
  const Offset& offset(Index i) const { return offset_[i]; }
  /// Puts b one period k (times sign) from a. False where they are joined otherwise already.
  bool join(Index a, Index b, std::size_t k, int sign) {
    const Index head_a = find(a), head_b = find(b);
    Offset step = offset_[a];
    step[k] = static_cast<std::int8_t>(step[k] + sign);
    if (head_a == head_b) return step == offset_[b];
    // b - head_a = step, so head_b - head_a = step - (b - head_b)
    add(step, offset_[b], -1);
    const auto [low, high] = std::minmax(head_a, head_b);
    if (low == head_b) {
      for (std::int8_t& s : step) s = static_cast<std::int8_t>(-s);
    }
    head_[high] = low, offset_[high] = step;
    return true;
  }

 private:
  static void add(Offset& a, const Offset& b, int sign) {
    for (std::size_t k = 0; k < a.size(); ++k) a[k] = static_cast<std::int8_t>(a[k] + sign * b[k]);
  }
  std::vector<Index> head_;
  std::vector<Offset> offset_;
};

std::vector<Index> nodes_of(const RawMesh& raw, const std::string& name) {
  const auto found = std::ranges::find(raw.names, name);
  if (found == raw.names.end()) {
    const std::string near = nearest(name, raw.names, name.size() / 2);
    throw Error(ErrorKind::input, raw.file + ": periodic patch \"" + name +
                                      "\" unknown; mesh has: " + text_of(raw.names) +
                                      (near.empty() ? "" : "; did you mean \"" + near + "\"?"));
  }
  const auto number = static_cast<Index>(found - raw.names.begin());
  std::set<Index> nodes;
  for (const RawMesh::Side& side : raw.sides) {
    if (side.name == number) nodes.insert(side.corner.begin(), side.corner.end());
  }
  nodes.erase(-1);
  return {nodes.begin(), nodes.end()};
}

Vec3 mean(const RawMesh& raw, const std::vector<Index>& nodes) {
  Vec3 sum;
  for (const Index i : nodes) sum += raw.points[i];
  return sum / static_cast<Real>(nodes.size());
}

Real extent(const RawMesh& raw, const std::vector<Index>& nodes) {
  Vec3 low = raw.points[nodes.front()], high = low;
  for (const Index i : nodes) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], raw.points[i][k]), high[k] = std::max(high[k], raw.points[i][k]);
    }
  }
  return norm(high - low);
}

/// Each node of a with the node of b at its image.
Pairs pair_by_translation(const RawMesh& raw, const std::string& name_a,
                          const std::string& name_b) {
  const std::vector<Index> a = nodes_of(raw, name_a), b = nodes_of(raw, name_b);
  const std::string who = raw.file + ": periodic pair \"" + name_a + "\", \"" + name_b + "\": ";
  require(a.size() == b.size(), who + std::to_string(a.size()) + " nodes against " +
                                    std::to_string(b.size()) + "; the two meshes must match");
  const Vec3 step = mean(raw, b) - mean(raw, a);
  const Real tolerance = pairing_tolerance * extent(raw, a);
  // Sorted along a direction in which no two nodes of a regular mesh coincide.
  constexpr Vec3 along{0.5377, 0.6217, 0.5694};
  std::vector<std::pair<Real, Index>> sorted;
  for (const Index i : b) sorted.emplace_back(dot(along, raw.points[i]), i);
  std::ranges::sort(sorted);
  Pairs pairs;
  for (const Index i : a) {
    const Vec3 image = raw.points[i] + step;
    const Real place = dot(along, image);
    auto at = std::ranges::lower_bound(sorted, std::pair(place - tolerance, Index{0}));
    while (at != sorted.end() && at->first <= place + tolerance &&
           norm(raw.points[at->second] - image) > tolerance) {
      ++at;
    }
    if (at == sorted.end() || at->first > place + tolerance) {
      refuse(who + "no node of \"" + name_b + "\" at " + text_of(image) + ", the image of " +
             text_of(raw.points[i]) + " by the translation " + text_of(step));
    }
    pairs.emplace_back(i, at->second);
  }
  return pairs;
}

/// The median of the steps of all pairs, component by component: exact where the file is.
Vec3 step_of(const RawMesh& raw, const Pairs& pairs) {
  Vec3 step;
  std::vector<Real> steps(pairs.size());
  for (int k = 0; k < 3; ++k) {
    std::ranges::transform(pairs, steps.begin(), [&](const auto& pair) {
      return raw.points[pair.second][k] - raw.points[pair.first][k];
    });
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::ranges::nth_element(steps, middle);
    step[k] = *middle;
  }
  for (int k = 0; k < 3; ++k) {
    if (std::abs(step[k]) < 1e-12 * norm(step)) step[k] = 0;  // round-off of the file
  }
  return step;
}

/// The period `step` is, with its sign; a new one where `may_add`. {3, 0} where it is none.
std::pair<std::size_t, int> period_of(const Vec3& step, std::vector<Vec3>& periods, bool may_add) {
  const Real tolerance = pairing_tolerance * norm(step);
  for (std::size_t k = 0; k < periods.size(); ++k) {
    if (norm(periods[k] - step) <= tolerance) return {k, 1};
    if (norm(periods[k] + step) <= tolerance) return {k, -1};
  }
  if (!may_add) return {3, 0};
  periods.push_back(step);
  return {periods.size() - 1, 1};
}

void join(const RawMesh& raw, const Pairs& pairs, const std::string& who, bool may_add,
          Classes& classes, std::vector<Vec3>& periods) {
  if (pairs.empty()) return;
  const Vec3 step = step_of(raw, pairs);
  require(norm(step) > 0, who + "the two sides lie on each other");
  for (const auto& [a, b] : pairs) {
    if (norm(raw.points[b] - raw.points[a] - step) <= 1e2 * pairing_tolerance * norm(step))
      continue;
    refuse(who + "the node at " + text_of(raw.points[b]) + " is not the image of " +
           text_of(raw.points[a]) + " by the translation " + text_of(step) +
           "; only translations are known");
  }
  const auto [k, sign] = period_of(step, periods, may_add);
  if (k == 3) return;
  require(periods.size() <= static_cast<std::size_t>(raw.dim),
          who + "more than " + std::to_string(raw.dim) + " different periods");
  for (const auto& [a, b] : pairs) {
    if (classes.join(a, b, k, sign)) continue;
    refuse(who + "the node at " + text_of(raw.points[b]) +
           " is joined to another one by the same period");
  }
}

}  // namespace

PeriodicPairs join_periodic(RawMesh& raw, const std::vector<std::string>& names) {
  require(names.size() % 2 == 0, "periodic patches come in pairs; given are " +
                                     std::to_string(names.size()) + ": " + text_of(names));
  const std::size_t n = raw.points.size();
  Classes classes(n);
  PeriodicPairs seams;
  // Links of the boundary define the periods; those of its edges and corners follow.
  for (const bool boundary : {true, false}) {
    for (const RawMesh::Link& link : raw.links) {
      if ((link.dim == raw.dim - 1) != boundary || link.dim >= raw.dim) continue;
      Pairs pairs;
      for (const auto& [node, master] : link.nodes) pairs.emplace_back(master, node);
      join(raw, pairs, raw.file + ": $Periodic: ", boundary, classes, seams.periods);
    }
  }
  for (std::size_t i = 0; i + 1 < names.size(); i += 2) {
    require(names[i] != names[i + 1], "periodic pair \"" + names[i] + "\" with itself");
    join(raw, pair_by_translation(raw, names[i], names[i + 1]),
         raw.file + ": periodic pair \"" + names[i] + "\", \"" + names[i + 1] + "\": ", true,
         classes, seams.periods);
  }
  seams.vertex.resize(n), seams.offset.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto p = static_cast<Index>(i);
    seams.vertex[i] = classes.find(p), seams.offset[i] = classes.offset(p);
    if (seams.vertex[i] == p) continue;
    Vec3 x = raw.points[seams.vertex[i]];
    for (std::size_t k = 0; k < seams.periods.size(); ++k) {
      x += static_cast<Real>(seams.offset[i][k]) * seams.periods[k];
    }
    raw.points[i] = x;
  }
  return seams;
}

void check_periods(const CellList& list, const std::string& file) {
  if (list.periods.empty()) return;
  std::vector<char> on_seam(list.points.size(), 0);
  for (std::size_t i = 0; i < on_seam.size(); ++i) {
    if (list.vertex[i] != static_cast<Index>(i)) on_seam[list.vertex[i]] = 1;
  }
  const Csr touching = cells_of_vertices(list);
  std::vector<std::pair<Index, Offset>> seen;
  for (Index c = 0; c < list.n_cells(); ++c) {
    const auto corners = list.corners[c];
    if (std::ranges::none_of(corners, [&](Index p) { return on_seam[list.vertex[p]] != 0; }))
      continue;
    seen.assign(1, {c, Offset{}});
    for (const Index p : corners) {
      for (const Index cell : touching[list.vertex[p]]) {
        for (const Index q : list.corners[cell]) {
          if (list.vertex[q] != list.vertex[p]) continue;
          Offset shift = list.offset[p];
          for (std::size_t k = 0; k < 3; ++k) {
            shift[k] = static_cast<std::int8_t>(shift[k] - list.offset[q][k]);
          }
          seen.emplace_back(cell, shift);
        }
      }
    }
    std::ranges::sort(seen);
    const auto twice = std::ranges::unique(seen);
    seen.erase(twice.begin(), twice.end());
    const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
    if (std::ranges::adjacent_find(seen, same) == seen.end()) continue;
    refuse(file + ": fewer than 3 cells across a period, at the cell with a corner at " +
           text_of(list.points[corners[0]]));
  }
}

}  // namespace fsi
