#include "libfsi/mesh/divide.hpp"

#include <metis.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace fsi {
namespace {

static_assert(sizeof(idx_t) == sizeof(std::int32_t));
using Ints = std::vector<std::int32_t>;

/// A graph whose vertices are columns of cells.
struct Columns {
  Graph graph;
  Ints ties;   // beside neighbours: faces on the way across
  Ints cells;  // [columns] cells of each
};

/// Numbers the columns from zero in the order of their first cells; how many there are.
std::int32_t number(Ints& column_of) {
  Ints distinct(column_of);
  std::ranges::sort(distinct);
  const auto twice = std::ranges::unique(distinct);
  distinct.erase(twice.begin(), twice.end());
  Ints place(distinct.size(), -1);
  std::int32_t count = 0;
  for (std::int32_t& column : column_of) {
    const auto at = std::ranges::lower_bound(distinct, column) - distinct.begin();
    if (place[at] < 0) place[at] = count++;
    column = place[at];
  }
  return count;
}

/// The cells of each column: order[begin[k]] .. order[begin[k + 1]].
struct Members {
  Ints begin, order;
};

Members members_of(const Ints& column_of, std::int32_t columns) {
  Members members{Ints(static_cast<std::size_t>(columns) + 1, 0), Ints(column_of.size())};
  for (const std::int32_t k : column_of) ++members.begin[k + 1];
  std::partial_sum(members.begin.begin(), members.begin.end(), members.begin.begin());
  Ints next(members.begin.begin(), members.begin.end() - 1);
  for (std::size_t c = 0; c < column_of.size(); ++c) {
    members.order[next[column_of[c]]++] = static_cast<std::int32_t>(c);
  }
  return members;
}

/// The graph of columns: two are as strongly tied as they have faces in common.
Columns gathered(const Graph& graph, const Ints& column_of, std::int32_t columns) {
  const auto [begin, order] = members_of(column_of, columns);
  Columns all;
  Ints beyond;  // the column across each face of this one
  for (std::int32_t k = 0; k < columns; ++k) {
    beyond.clear();
    std::int32_t load = 0;
    for (std::int32_t m = begin[k]; m < begin[k + 1]; ++m) {
      const std::int32_t c = order[m];
      if (!graph.load.empty()) load += graph.load[c];
      for (std::int32_t i = graph.start[c]; i < graph.start[c + 1]; ++i) {
        const std::int32_t other = column_of[graph.neighbours[i]];
        if (other != k) beyond.push_back(other);
      }
    }
    std::ranges::sort(beyond);
    for (std::size_t i = 0; i < beyond.size(); ++i) {
      if (i > 0 && beyond[i] == beyond[i - 1]) {
        ++all.ties.back();
        continue;
      }
      all.graph.neighbours.push_back(beyond[i]), all.ties.push_back(1);
    }
    all.graph.start.push_back(static_cast<std::int32_t>(all.graph.neighbours.size()));
    if (!graph.load.empty()) all.graph.load.push_back(load);
    all.cells.push_back(begin[k + 1] - begin[k]);
  }
  return all;
}

/// The options of METIS.
struct Method {
  bool recursive = false;  // bisection, or k-way
  int tries = 1;           // divisions of which the one with the least cut counts
  int passes = 10;         // of the refinement
  int excess = 0;          // of a part over its share that is allowed, 1 / 1000; 0: METIS decides
  bool load = true;        // whether the load is balanced too, where there is one
};

/// The vertices' parts by METIS. cells: how many each vertex stands for; ties: weights beside
/// neighbours; empty: one each.
Ints parts_of(const Graph& graph, const Ints& cells, const Ints& ties, int parts,
              const Method& method) {
  idx_t options[METIS_NOPTIONS], n = graph.cells(), n_parts = parts, cut = 0;
  idx_t constraints = graph.load.empty() || !method.load ? 1 : 2;
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;  // the same parts every time
  options[METIS_OPTION_NCUTS] = method.tries, options[METIS_OPTION_NITER] = method.passes;
  if (method.excess > 0) options[METIS_OPTION_UFACTOR] = method.excess;
  Ints weights;
  for (std::int32_t v = 0; v < n && (constraints == 2 || !cells.empty()); ++v) {
    weights.push_back(cells.empty() ? 1 : cells[v]);
    if (constraints == 2) weights.push_back(graph.load[v]);
  }
  Ints result(static_cast<std::size_t>(n));
  const auto call = method.recursive ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  // METIS asks for writable arrays and writes to none of them.
  const auto array = [](const Ints& list) {
    return list.empty() ? nullptr : const_cast<idx_t*>(list.data());
  };
  const int code =
      call(&n, &constraints, array(graph.start), array(graph.neighbours), array(weights), nullptr,
           array(ties), &n_parts, nullptr, nullptr, options, &cut, result.data());
  return code == METIS_OK ? result : Ints{};
}

/// Most over mean of what the parts hold; 1 where there is nothing to hold.
double excess(const Ints& held) {
  const double total = std::accumulate(held.begin(), held.end(), 0.0);
  const double most = *std::ranges::max_element(held);
  return total > 0 ? most * static_cast<double>(held.size()) / total : 1;
}

/// The excess of the parts' cells and of their load.
struct Excess {
  double cells, load;
};

Excess excess_of(const Graph& graph, const Ints& part, int parts) {
  Ints cells(static_cast<std::size_t>(parts), 0), load(cells);
  for (std::int32_t c = 0; c < graph.cells(); ++c) {
    ++cells[part[c]];
    if (!graph.load.empty()) load[part[c]] += graph.load[c];
  }
  return {excess(cells), excess(load)};
}

/// Division by whole columns; empty where they are too short or too few for even parts.
Ints divide_columns(const Graph& graph, int parts) {
  constexpr std::int32_t cells_a_column = 4, columns_a_part = 8;
  constexpr double even = 1.1;
  Ints part(graph.column);
  const std::int32_t columns = number(part);
  if (columns > graph.cells() / cells_a_column || columns < columns_a_part * parts) return {};
  const Columns all = gathered(graph, part, columns);
  // The graph is small: METIS can take its time for a small halo.
  const Ints of_columns = parts_of(all.graph, all.cells, all.ties, parts, {true, 20, 20, 5});
  if (of_columns.empty()) return {};
  for (std::int32_t& p : part) p = of_columns[p];
  return excess_of(graph, part, parts).cells < even ? part : Ints{};
}

/// Division cell by cell, by the most even of METIS's methods. Where the load stands in too few
/// cells for the parts, METIS may give up the balance of the cells for it: the last one leaves it
/// out.
Ints divide_cells(const Graph& graph, int parts) {
  constexpr double good_cells = 1.03, good_load = 1.1;
  Ints best;
  double least = 0;
  const bool few = parts <= 8;  // recursive bisection is the better one for few parts
  for (const Method& method : {Method{.recursive = few}, Method{.recursive = !few},
                               Method{.recursive = few, .load = false}}) {
    if (!best.empty() && least == 0) break;
    Ints part = parts_of(graph, {}, {}, parts, method);
    if (part.empty()) continue;
    const auto [cells, load] = excess_of(graph, part, parts);
    const double cost = std::max(0.0, cells - good_cells) + std::max(0.0, load - good_load) / 4;
    if (best.empty() || cost < least) least = cost, best = std::move(part);
  }
  return best;
}

}  // namespace

std::vector<std::int32_t> divide(const Graph& graph, int parts) {
  const std::int32_t n = graph.cells();
  Ints part(static_cast<std::size_t>(n), 0);
  if (parts == 1) return part;
  if (n <= parts) {  // METIS divides no graph into single vertices
    std::iota(part.begin(), part.end(), 0);
    return part;
  }
  part = graph.column.empty() ? Ints{} : divide_columns(graph, parts);
  return part.empty() ? divide_cells(graph, parts) : part;
}

}  // namespace fsi
