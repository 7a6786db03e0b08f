#include "libfsi/mesh/cell_list.hpp"

#include <algorithm>
#include <utility>

#include "libfsi/core/error.hpp"

namespace fsi {

std::array<Index, max_face_corners> face_key(const CellList& list, Half half) {
  std::array<Index, max_face_corners> key{-1, -1, -1, -1};
  const auto corners = list.corners[half.cell];
  std::size_t n = 0;
  for (const std::int8_t i : shape_of(list.types[half.cell]).face_corners(half.face)) {
    key[n++] = list.vertex[corners[i]];
  }
  std::ranges::sort(key);
  return key;
}

std::vector<Index> match_faces(const CellList& list) {
  // Halves in buckets by their highest vertex, then matched within each bucket.
  const Index n = list.n_cells();
  std::vector<Index> begin(list.points.size() + 2, 0);
  const auto each_half = [&](auto&& visit) {
    for (Index c = 0; c < n; ++c) {
      for (int f = 0; f < shape_of(list.types[c]).faces; ++f) {
        visit(face_key(list, Half(half_of(c, f))).back(), half_of(c, f));
      }
    }
  };
  each_half([&](Index v, Index) { ++begin[v + 2]; });
  for (std::size_t v = 2; v < begin.size(); ++v) begin[v] += begin[v - 1];
  std::vector<Index> halves(static_cast<std::size_t>(begin.back()));
  each_half([&](Index v, Index half) { halves[begin[v + 1]++] = half; });

  std::vector<Index> mate(static_cast<std::size_t>(max_faces) * n, no_mate);
  std::vector<std::pair<std::array<Index, max_face_corners>, Index>> bucket;
  for (std::size_t v = 0; v + 2 < begin.size(); ++v) {
    bucket.clear();
    for (Index i = begin[v]; i < begin[v + 1]; ++i) {
      bucket.emplace_back(face_key(list, Half(halves[i])), halves[i]);
    }
    std::ranges::sort(bucket);
    for (std::size_t i = 0, end = 0; i < bucket.size(); i = end) {
      for (end = i; end < bucket.size() && bucket[end].first == bucket[i].first;) ++end;
      if (end == i + 2) {
        mate[bucket[i].second] = bucket[i + 1].second;
        mate[bucket[i + 1].second] = bucket[i].second;
      }
      for (std::size_t k = i; end > i + 2 && k < end; ++k) mate[bucket[k].second] = many_mates;
    }
  }
  return mate;
}

Csr cells_of_vertices(const CellList& list) {
  Csr cells;
  cells.offset.assign(list.points.size() + 1, 0);
  for (const Index p : list.corners.index) ++cells.offset[list.vertex[p] + 1];
  for (std::size_t v = 1; v < cells.offset.size(); ++v) cells.offset[v] += cells.offset[v - 1];
  cells.index.resize(list.corners.index.size());
  std::vector<Index> next(cells.offset.begin(), cells.offset.end() - 1);
  for (Index c = 0; c < list.n_cells(); ++c) {
    for (const Index p : list.corners[c]) cells.index[next[list.vertex[p]]++] = c;
  }
  return cells;
}

const Offset& offset_in(const CellList& list, Index cell, Index v) {
  for (const Index p : list.corners[cell]) {
    if (list.vertex[p] == v) return list.offset[p];
  }
  throw Error(ErrorKind::internal, "mesh: a cell does not have a vertex it was listed for");
}

std::int8_t shift_of(const Offset& a, const Offset& b) {
  int row = 0, base = 1;
  for (std::size_t k = 0; k < a.size(); ++k, base *= 3) {
    const int difference = a[k] - b[k];
    if (difference < -1 || difference > 1) {
      throw Error(ErrorKind::internal, "mesh: a cell is more than one period from its neighbour");
    }
    row += base * (difference == -1 ? 2 : difference);
  }
  return static_cast<std::int8_t>(row);
}

std::vector<Vec3> translations(const std::vector<Vec3>& periods) {
  std::vector<Vec3> rows{Vec3{}};
  for (const Vec3& period : periods) {
    const std::size_t n = rows.size();
    for (std::size_t i = 0; i < n; ++i) rows.push_back(rows[i] + period);
    for (std::size_t i = 0; i < n; ++i) rows.push_back(rows[i] - period);
  }
  return rows;
}

}  // namespace fsi
