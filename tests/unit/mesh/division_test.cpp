// A divided mesh has, bit for bit, the cells, faces and neighbours of the whole one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>

#include "libfsi/mesh/columns.hpp"
#include "libfsi/mesh/divide.hpp"
#include "tests/unit/mesh/block.hpp"

namespace fsi::test {
namespace {

const std::vector<std::string> box_sides{"left", "right", "bottom", "top", "back", "front"};

/// (owner, neighbour or -1 - patch, shift, corners): what identifies a face on any rank.
using FaceKey = std::tuple<GlobalIndex, GlobalIndex, Index, std::vector<Real>>;

FaceKey key_of(const Mesh& mesh, Index f) {
  std::vector<Real> corners;
  for (const Index p : mesh.face_points[f]) {
    for (int k = 0; k < 3; ++k) corners.push_back(mesh.points[p][k]);
  }
  GlobalIndex beyond = -1;
  for (std::size_t i = 0; i < mesh.patches.size(); ++i) {
    if (f >= mesh.patches[i].begin && f < mesh.patches[i].end) beyond = -1 - static_cast<int>(i);
  }
  if (f < mesh.n_internal) beyond = mesh.global_id[mesh.neighbour[f]];
  const Index shift = f < mesh.n_internal ? mesh.shift[f] : 0;
  return {mesh.global_id[mesh.owner[f]], beyond, shift, corners};
}

using Seen = std::vector<std::pair<GlobalIndex, int>>;

Seen neighbours_of(const Mesh& mesh, Index c) {
  Seen seen;
  for (Index i = mesh.cell_neighbours.offset[c]; i < mesh.cell_neighbours.offset[c + 1]; ++i) {
    seen.emplace_back(mesh.global_id[mesh.cell_neighbours.index[i]], mesh.cell_neighbour_shift[i]);
  }
  return seen;
}

void expect_same_cells(const Mesh& part, const Mesh& all) {
  for (Index c = 0; c < part.n_cells; ++c) {
    const auto id = static_cast<Index>(part.global_id[c]);
    ASSERT_EQ(all.global_id[id], id);
    EXPECT_EQ(part.V[c], all.V[id]);
    EXPECT_EQ(part.C[c], all.C[id]);
    if (c + 1 < part.n_cells && c + 1 != part.n_owned) {
      EXPECT_LT(part.global_id[c], part.global_id[c + 1]);
    }
    if (c < part.n_owned) {
      EXPECT_EQ(neighbours_of(part, c), neighbours_of(all, id));
      EXPECT_EQ(part.cell_faces[c].size(), all.cell_faces[id].size());
    }
  }
  const auto owned = static_cast<GlobalIndex>(part.n_owned);
  EXPECT_EQ(global_sum(owned), all.n_global);
}

void expect_same_faces(const Mesh& part, const Mesh& all) {
  std::map<FaceKey, Index> index;
  for (Index f = 0; f < all.n_faces; ++f) index[key_of(all, f)] = f;
  ASSERT_EQ(index.size(), static_cast<std::size_t>(all.n_faces));
  Index previous = -1;
  GlobalIndex mine = 0;
  for (Index f = 0; f < part.n_faces; ++f) {
    const auto found = index.find(key_of(part, f));
    ASSERT_NE(found, index.end());
    EXPECT_LT(previous, found->second) << "faces are in the order of the whole mesh";
    previous = found->second;
    EXPECT_EQ(part.Sf[f], all.Sf[found->second]);
    EXPECT_EQ(part.Cf[f], all.Cf[found->second]);
    EXPECT_EQ(part.d[f], all.d[found->second]);
    EXPECT_TRUE(part.owner[f] < part.n_owned ||
                (f < part.n_internal && part.neighbour[f] < part.n_owned));
    if (part.owner[f] < part.n_owned) ++mine;
  }
  EXPECT_EQ(global_sum(mine), all.n_faces);
}

void compare(const Block& block, int axes, const std::string& partitioner = "metis") {
  SCOPED_TRACE(testing::Message() << "type " << static_cast<int>(block.type) << ", links "
                                  << block.links << ", named axes " << axes << ", " << partitioner);
  const std::vector<std::string> periodic(box_sides.begin(), box_sides.begin() + 2 * axes);
  const TextFile file(BlockText(block).text());
  const Mesh part = divided(file.path(), periodic, partitioner);
  const Mesh all = whole(file.path(), periodic);
  EXPECT_EQ(part.translation, all.translation);
  EXPECT_EQ(part.hash, all.hash);
  EXPECT_EQ(part.patches.size(), all.patches.size());
  expect_same_cells(part, all);
  expect_same_faces(part, all);
}

TEST(Division, EveryCellType) {
  for (const CellType type : all_types) compare(block_of(type), 0);
}

TEST(Division, OneToThreePeriods) {
  for (const CellType type : all_types) {
    for (int axes = 1; axes <= shape_of(type).dim; ++axes) compare(block_of(type), axes);
  }
}

TEST(Division, PeriodsOfTheFile) {
  for (const CellType type : all_types) {
    for (int links = 1; links <= shape_of(type).dim; ++links) compare(block_of(type, links), 0);
  }
  compare(block_of(CellType::hex, 2), 3);  // the file's, and the same and one more by name
}

TEST(Division, OtherPartitioners) {
  compare(block_of(CellType::tet), 1, "ptscotch");
  compare(block_of(CellType::hex), 1, "simple");
}

/// The least share of a layer of cells across x that a rank owns, in parts of an even share.
Real least_share(const Mesh& mesh, int layers) {
  std::vector<Real> mine(static_cast<std::size_t>(layers), 0);
  for (Index c = 0; c < mesh.n_owned; ++c) mine[static_cast<int>(mesh.C[c].x * layers)] += 1;
  const Real even = static_cast<Real>(mesh.n_global) / (layers * ranks());
  return global_min(*std::ranges::min_element(mine) / even);
}

TEST(Division, LengthwiseEveryRankHasCellsAllAlong) {
  Block block;
  block.n = {24, 6, 6};
  const TextFile file(BlockText(block).text());
  for (const auto& periodic : {std::vector<std::string>{}, {"left", "right"}}) {
    const Mesh lengthwise = read_mesh({file.path(), periodic, "metis", {2, 0, 0}});
    EXPECT_GT(least_share(lengthwise, 24), 0.8);
    if (ranks() > 1) {
      EXPECT_EQ(least_share(divided(file.path(), periodic), 24), 0);
    }
  }
}

/// Cells within a ball at x, the most a rank owns over the mean.
Real share_of_ball(const Mesh& mesh, Real x) {
  const auto centres = std::span(mesh.C).first(static_cast<std::size_t>(mesh.n_owned));
  const auto mine = std::ranges::count_if(centres, [&](const Vec3& c) {
    return norm(c - Vec3{x, 0.5, 0.5}) < 0.3;
  });
  const GlobalIndex all = global_sum(static_cast<GlobalIndex>(mine));
  return global_max(static_cast<Real>(mine)) * ranks() / static_cast<Real>(all);
}

TEST(Division, EveryRankHasItsShareOfALoadWhereverItGoes) {
  Block block;
  block.n = {24, 16, 16};
  MeshOptions options;
  options.along = {1, 0, 0};
  options.load = [](const Vec3& c, int /*dim*/) {
    return norm(c - Vec3{0.3, 0.5, 0.5}) < 0.3 ? 1.0 : 0.0;
  };
  for (const CellType type : {CellType::hex, CellType::tet}) {
    block.type = type;
    const TextFile file(BlockText(block).text());
    options.file = file.path();
    const Mesh mesh = read_mesh(options);
    const Real cells = global_max(static_cast<Real>(mesh.n_owned)) * ranks();
    EXPECT_LT(cells, 1.06 * static_cast<Real>(mesh.n_global));
    for (const Real x : {0.3, 0.5, 0.7}) EXPECT_LT(share_of_ball(mesh, x), 1.15);
  }
}

/// A block of tets whose points lie in no rows.
Block block_without_rows() {
  Block block;
  block.type = CellType::tet, block.n = {32, 20, 20};
  block.moved = [](const Vec3& x) {
    const auto shake = [&](Real seed) {
      const Real r = 1e4 * std::sin(seed + 12.9898 * x.x + 78.233 * x.y + 37.719 * x.z);
      return 0.4 * (r - std::floor(r) - 0.5);
    };
    return x + Vec3{shake(1) / 32, shake(2) / 20, shake(3) / 20};
  };
  return block;
}

/// Cells that share a face.
Graph faces_of(const CellList& list) {
  Graph graph;
  const std::vector<Index> mate = match_faces(list);
  for (Index c = 0; c < list.n_cells(); ++c) {
    for (int f = 0; f < shape_of(list.types[c]).faces; ++f) {
      if (mate[half_of(c, f)] >= 0) graph.neighbours.push_back(Half(mate[half_of(c, f)]).cell);
    }
    graph.start.push_back(static_cast<std::int32_t>(graph.neighbours.size()));
  }
  return graph;
}

/// Most over mean of the cells of this kind that a part has.
template <class Kind>
Real excess(const std::vector<std::int32_t>& part, int parts, const Kind& counts) {
  std::vector<Real> held(static_cast<std::size_t>(parts), 0);
  for (std::size_t c = 0; c < part.size(); ++c) held[part[c]] += counts(static_cast<Index>(c));
  const Real total = std::accumulate(held.begin(), held.end(), 0.0);
  return *std::ranges::max_element(held) * parts / total;
}

TEST(Division, ManyPartsOfTetsShareATorusWhereverItGoes) {
  const TextFile file(BlockText(block_without_rows()).text());
  const CellList list = check_mesh(read_gmsh(file.path()), {});
  const auto torus_at = [&](Real x) {  // tilted by 45 degrees
    return [&list, x](Index c) {
      const Vec3 way = middle(list, c) - Vec3{x, 0.5, 0.5};
      const Real height = (way.x + way.y) / std::numbers::sqrt2;
      return std::hypot(std::sqrt(dot(way, way) - height * height) - 0.25, height) < 0.09;
    };
  };
  Graph graph = faces_of(list);
  graph.column = columns_of(list, {1, 0, 0});
  for (Index c = 0; c < list.n_cells(); ++c) graph.load.push_back(torus_at(0.35)(c) ? 8 : 0);
  for (const int parts : {8, 16}) {
    const std::vector<std::int32_t> part = divide(graph, parts);
    EXPECT_LT(excess(part, parts, [](Index) { return 1; }), 1.05);
    for (const Real x : {0.35, 0.45, 0.55, 0.65}) {
      EXPECT_LT(excess(part, parts, torus_at(x)), 1.3) << parts << " parts, torus at " << x;
    }
  }
}

TEST(Division, ColumnsDoNotDependOnTheAxisLengthAndHoldCellsInLine) {
  Block block;
  block.n = {8, 4, 4};
  const TextFile file(BlockText(block).text());
  const CellList list = check_mesh(read_gmsh(file.path()), {});
  const auto columns = columns_of(list, {1, 0, 0});
  EXPECT_EQ(columns, columns_of(list, {5, 0, 0}));
  std::map<std::int32_t, std::vector<Vec3>> cells;
  for (Index c = 0; c < list.n_cells(); ++c) cells[columns[c]].push_back(middle(list, c));
  EXPECT_EQ(cells.size(), 16U);
  for (const auto& [column, centres] : cells) {
    EXPECT_EQ(centres.size(), 8U);
    for (const Vec3& x : centres) EXPECT_LT(norm(cross(x - centres[0], {1, 0, 0})), 1e-12);
  }
}

// No division shares a load that stands in one cell. The cells are shared nevertheless.
TEST(Division, ALoadInOneCellDoesNotSpoilTheBalanceOfTheCells) {
  const TextFile file(BlockText(block_without_rows()).text());
  Graph graph = faces_of(check_mesh(read_gmsh(file.path()), {}));
  graph.load.assign(static_cast<std::size_t>(graph.cells()), 0);
  graph.load[0] = 8;
  for (const int parts : {2, 4, 8})
    EXPECT_LT(excess(divide(graph, parts), parts, [](Index) { return 1; }), 1.05) << parts;
}

TEST(Division, FewerCellsThanRanks) {
  Block block;
  block.n = {2, 1, 1};
  compare(block, 0);
  block.type = CellType::quad, block.n = {2, 1, 1};
  compare(block, 0);
}

TEST(Halo, UpdateBringsTheOwnersValues) {
  const TextFile file(BlockText(block_of(CellType::hex)).text());
  const Mesh mesh = divided(file.path(), {"left", "right"});
  for (const int width : {1, 3, 6, 3}) {
    std::vector<Real> values(static_cast<std::size_t>(width) * mesh.n_cells, -1);
    const auto expected = [&](Index c, int k) { return 0.1 * mesh.global_id[c] + 1000 * k; };
    for (Index c = 0; c < mesh.n_owned; ++c) {
      for (int k = 0; k < width; ++k) values[width * c + k] = expected(c, k);
    }
    mesh.halo.update(values.data(), width);
    for (Index c = 0; c < mesh.n_cells; ++c) {
      for (int k = 0; k < width; ++k) EXPECT_EQ(values[width * c + k], expected(c, k));
    }
  }
}

TEST(Halo, UpdateInTwoPartsWritesTheHaloAlone) {
  const TextFile file(BlockText(block_of(CellType::hex)).text());
  const Mesh mesh = divided(file.path(), {"left", "right"});
  for (const int width : {1, 3}) {
    const auto n = static_cast<std::size_t>(width) * mesh.n_owned;
    std::vector<Real> expected(static_cast<std::size_t>(width) * mesh.n_cells, -1);
    for (std::size_t i = 0; i < n; ++i) expected[i] = rank() + 0.1 * static_cast<Real>(i);
    const std::vector<Real> owned(expected.begin(), expected.begin() + static_cast<long>(n));
    std::vector<Real> values(expected.size(), -1);
    mesh.halo.begin(owned.data(), values.data(), width);
    mesh.halo.end(owned.data(), values.data(), width);
    mesh.halo.update(expected.data(), width);
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], i < n ? -1 : expected[i]);
  }
}

TEST(Halo, UpdateOfAFewCellsIsThatOfAll) {
  const TextFile file(BlockText(block_of(CellType::hex)).text());
  const Mesh mesh = divided(file.path(), {"left", "right"});
  const auto n = static_cast<std::size_t>(mesh.n_cells);
  for (const GlobalIndex every : {1, 2, 7, 1000}) {  // the last: no cell at all
    std::vector<Real> where(n, -1);
    for (Index c = 0; c < mesh.n_owned; ++c) where[c] = mesh.global_id[c] % every == 1 % every;
    mesh.halo.update(where.data(), 1);
    for (const int width : {1, 6, 18, 3}) {
      std::vector<Real> all(width * n, -1);
      for (std::size_t i = 0; i < static_cast<std::size_t>(width) * mesh.n_owned; ++i)
        all[i] = where[i / width] * (1 + 0.1 * static_cast<Real>(i));
      std::vector<Real> few = all;
      mesh.halo.update(all.data(), width);
      mesh.halo.update(few.data(), width, where.data());
      EXPECT_EQ(few, all);
    }
  }
}

TEST(Halo, AddToOwnerSumsTheCopies) {
  const TextFile file(BlockText(block_of(CellType::tet)).text());
  const Mesh mesh = divided(file.path(), {});
  for (const int width : {1, 2, 6}) {
    std::vector<Real> values(width * static_cast<std::size_t>(mesh.n_cells), 1);
    mesh.halo.add_to_owner(values.data(), width);
    GlobalIndex copies = 0;
    for (Index c = 0; c < mesh.n_owned; ++c) {
      EXPECT_EQ(values[width * c], values[width * c + width - 1]);
      copies += static_cast<GlobalIndex>(values[width * c]) - 1;
    }
    for (Index c = mesh.n_owned; c < mesh.n_cells; ++c) EXPECT_EQ(values[width * c], 1);
    EXPECT_EQ(global_sum(copies), global_sum(GlobalIndex{mesh.n_cells - mesh.n_owned}));
  }
}

}  // namespace
}  // namespace fsi::test
