#include "libfsi/mesh/divide.hpp"

#include <metis.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

namespace fsi {
namespace {

static_assert(sizeof(idx_t) == sizeof(std::int32_t));
using Ints = std::vector<std::int32_t>;

/// A graph whose vertices are rows of cells.
struct Rows {
  Graph graph;
  Ints cells;   // [rows] cells of each
  Ints row_of;  // [cells]
};

/// The head of i's class; halves the way to it.
std::int32_t head_of(Ints& above, std::int32_t i) {
  while (above[i] != i) i = above[i] = above[above[i]];
  return i;
}

/// The row of each cell: cells tied along the path rather than across it are one row.
Ints rows_of(const Graph& graph, std::int32_t& count) {
  constexpr int along = slender + 1;  // the way and the path meet at 45 degrees
  Ints above(static_cast<std::size_t>(graph.cells()));
  std::iota(above.begin(), above.end(), 0);
  for (std::int32_t c = 0; c < graph.cells(); ++c) {
    for (std::int32_t i = graph.start[c]; i < graph.start[c + 1]; ++i) {
      if (graph.ties[i] <= along) continue;
      const std::int32_t a = head_of(above, c), b = head_of(above, graph.neighbours[i]);
      above[std::max(a, b)] = std::min(a, b);
    }
  }
  Ints row(above.size(), -1);
  count = 0;
  for (std::int32_t c = 0; c < graph.cells(); ++c) {
    const std::int32_t head = head_of(above, c);
    if (head == c) row[c] = count++;
    row[c] = row[head];
  }
  return row;
}

/// The graph of rows: two are as strongly tied as all their cells together.
Rows gathered(const Graph& graph, Ints row_of, std::int32_t rows) {
  Rows coarse;
  coarse.cells.assign(rows, 0);
  if (!graph.load.empty()) coarse.graph.load.assign(rows, 0);
  std::vector<std::array<std::int32_t, 3>> ties;  // row, other row, weight
  for (std::int32_t c = 0; c < graph.cells(); ++c) {
    const std::int32_t row = row_of[c];
    ++coarse.cells[row];
    if (!graph.load.empty()) coarse.graph.load[row] += graph.load[c];
    for (std::int32_t i = graph.start[c]; i < graph.start[c + 1]; ++i) {
      const std::int32_t other = row_of[graph.neighbours[i]];
      if (other != row) ties.push_back({row, other, 1});
    }
  }
  std::ranges::sort(ties);
  Graph& g = coarse.graph;
  for (std::size_t i = 0; i < ties.size(); ++i) {
    const auto [row, other, weight] = ties[i];
    if (i > 0 && ties[i - 1][0] == row && ties[i - 1][1] == other) {
      g.ties.back() += weight;
      continue;
    }
    while (g.cells() < row) g.start.push_back(static_cast<std::int32_t>(g.neighbours.size()));
    g.neighbours.push_back(other), g.ties.push_back(weight);
  }
  while (g.cells() < rows) g.start.push_back(static_cast<std::int32_t>(g.neighbours.size()));
  coarse.row_of = std::move(row_of);
  return coarse;
}

/// The vertices' parts by METIS: recursive bisection or k-way. cells: how many each vertex stands
/// for; empty: one.
Ints parts_of(const Graph& graph, const Ints& cells, int parts, bool recursive) {
  idx_t options[METIS_NOPTIONS], n = graph.cells(), n_parts = parts, cut = 0;
  idx_t constraints = graph.load.empty() ? 1 : 2;
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;  // the same parts every time
  Ints weights;
  for (std::int32_t v = 0; v < n && (constraints == 2 || !cells.empty()); ++v) {
    weights.push_back(cells.empty() ? 1 : cells[v]);
    if (constraints == 2) weights.push_back(graph.load[v]);
  }
  Ints result(static_cast<std::size_t>(n));
  const auto method = recursive ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  // METIS asks for writable arrays and writes to none of them.
  const auto array = [](const Ints& list) {
    return list.empty() ? nullptr : const_cast<idx_t*>(list.data());
  };
  const int code =
      method(&n, &constraints, array(graph.start), array(graph.neighbours), array(weights), nullptr,
             array(graph.ties), &n_parts, nullptr, nullptr, options, &cut, result.data());
  return code == METIS_OK ? result : Ints{};
}

/// Most over mean of what the parts hold; 1 where there is nothing to hold.
double excess(const Ints& held) {
  const double total = std::accumulate(held.begin(), held.end(), 0.0);
  const double most = *std::ranges::max_element(held);
  return total > 0 ? most * static_cast<double>(held.size()) / total : 1;
}

/// What a division costs in balance: the excess of cells and of load, as far as they matter. Rows
/// may be less even than cells, for their balance lasts.
double cost(const Graph& graph, const Ints& part, int parts, bool in_rows) {
  const double good_cells = in_rows ? 1.05 : 1.03, good_load = in_rows ? 1.2 : 1.1;
  Ints cells(static_cast<std::size_t>(parts), 0), load(cells);
  for (std::int32_t c = 0; c < graph.cells(); ++c) {
    ++cells[part[c]];
    if (!graph.load.empty()) load[part[c]] += graph.load[c];
  }
  return std::max(0.0, excess(cells) - good_cells) + std::max(0.0, excess(load) - good_load) / 4;
}

}  // namespace

std::vector<std::int32_t> divide(const Graph& graph, int parts) {
  const std::int32_t n = graph.cells();
  Ints best(static_cast<std::size_t>(n), 0);
  if (parts == 1) return best;
  if (n <= parts) {  // METIS divides no graph into single vertices
    std::iota(best.begin(), best.end(), 0);
    return best;
  }
  best.clear();
  double least = 0;
  const auto attempt = [&](const Graph& form, const Ints& cells, const Ints& row_of) {
    const bool few = parts <= 8;  // recursive bisection is the better one for few parts
    for (const bool recursive : {few, !few}) {
      if (!best.empty() && least == 0) return;
      Ints part = parts_of(form, cells, parts, recursive);
      if (part.empty()) continue;
      if (!row_of.empty()) {
        Ints of_cells(row_of);
        for (std::int32_t& p : of_cells) p = part[p];
        part = std::move(of_cells);
      }
      const double now = cost(graph, part, parts, !row_of.empty());
      if (best.empty() || now < least) least = now, best = std::move(part);
    }
  };
  if (!graph.ties.empty()) {
    constexpr std::int32_t cells_a_row = 4, rows_a_part = 8;  // fewer: no rows, or too coarse
    std::int32_t count = 0;
    Ints row_of = rows_of(graph, count);
    if (count <= n / cells_a_row && count >= rows_a_part * parts) {
      const Rows rows = gathered(graph, std::move(row_of), count);
      attempt(rows.graph, rows.cells, rows.row_of);
    }
  }
  attempt(graph, {}, {});
  return best;
}

}  // namespace fsi
