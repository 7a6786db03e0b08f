#include "libfsi/mesh/build.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/metrics.hpp"

namespace fsi {
namespace {

/// A face of the Mesh: its owner's half, and the cell beyond or the patch.
struct Face {
  Index half;
  Index other;
};

/// The points of a half, in order, right-handed about the normal that leaves the cell.
std::span<const Index> points_of(const CellList& list, Half half,
                                 std::array<Index, max_face_corners>& points) {
  const auto corners = list.corners[half.cell];
  std::size_t n = 0;
  for (const std::int8_t i : shape_of(list.types[half.cell]).face_corners(half.face)) {
    points[n++] = corners[i];
  }
  return {points.data(), n};
}

void fill_cells(const CellList& list, Mesh& mesh) {
  const Index n = list.n_cells();
  mesh.C.resize(n), mesh.V.resize(n);
  std::array<Vec3, max_corners> x;
  for (Index c = 0; c < n; ++c) {
    std::size_t count = 0;
    for (const Index p : list.corners[c]) x[count++] = list.points[p];
    const CellMetrics cell = cell_metrics(list.types[c], {x.data(), count});
    mesh.C[c] = cell.centre, mesh.V[c] = cell.V;
  }
}

/// Internal faces of owned cells, then their boundary faces, each in the order of mesh.hpp.
std::pair<std::vector<Face>, std::vector<Face>> faces_of(const CellList& list) {
  const std::vector<Index> mate = match_faces(list);
  const auto& id = list.global_id;
  std::vector<Face> internal, boundary;
  for (Index c = 0; c < list.n_owned; ++c) {
    for (int f = 0; f < shape_of(list.types[c]).faces; ++f) {
      const Index half = half_of(c, f);
      if (mate[half] < 0) {
        boundary.push_back({half, list.face_patch[c][f]});
        continue;
      }
      const Index other = Half(mate[half]).cell;
      if (id[c] < id[other]) internal.push_back({half, other});
      if (id[c] > id[other] && other >= list.n_owned) internal.push_back({mate[half], c});
    }
  }
  std::ranges::sort(internal, {}, [&](const Face& face) {
    const Half half(face.half);
    return std::tuple(id[half.cell], id[face.other], half.face);
  });
  std::ranges::sort(boundary, {}, [&](const Face& face) {
    const Half half(face.half);
    return std::tuple(face.other, id[half.cell], half.face);
  });
  return {std::move(internal), std::move(boundary)};
}

void add_face(const CellList& list, const Face& face, Mesh& mesh) {
  std::array<Index, max_face_corners> storage;
  std::array<Vec3, max_face_corners> x;
  const auto points = points_of(list, Half(face.half), storage);
  for (std::size_t i = 0; i < points.size(); ++i) x[i] = list.points[points[i]];
  const FaceMetrics metrics = face_metrics({x.data(), points.size()});
  mesh.owner.push_back(Half(face.half).cell);
  mesh.Sf.push_back(metrics.Sf), mesh.Cf.push_back(metrics.centre);
  mesh.face_points.index.insert(mesh.face_points.index.end(), points.begin(), points.end());
  mesh.face_points.offset.push_back(static_cast<Index>(mesh.face_points.index.size()));
}

void fill_faces(const CellList& list, Mesh& mesh) {
  const auto [internal, boundary] = faces_of(list);
  mesh.n_internal = static_cast<Index>(internal.size());
  mesh.n_faces = mesh.n_internal + static_cast<Index>(boundary.size());
  mesh.owner.reserve(mesh.n_faces), mesh.neighbour.reserve(mesh.n_internal);
  mesh.shift.reserve(mesh.n_internal), mesh.d.reserve(mesh.n_faces);
  mesh.Sf.reserve(mesh.n_faces), mesh.Cf.reserve(mesh.n_faces);
  mesh.face_points.offset.reserve(mesh.n_faces + 1);
  mesh.face_points.index.reserve((list.dim == 2 ? 2 : 4) * static_cast<std::size_t>(mesh.n_faces));

  for (const Face& face : internal) {
    add_face(list, face, mesh);
    const Index P = mesh.owner.back(), N = face.other;
    const Index corner = mesh.face_points.index[mesh.face_points.offset.end()[-2]];
    const auto shift = shift_of(list.offset[corner], offset_in(list, N, list.vertex[corner]));
    mesh.neighbour.push_back(N), mesh.shift.push_back(shift);
    mesh.d.push_back(mesh.C[N] + mesh.translation[shift] - mesh.C[P]);
  }
  for (const std::string& name : list.patches) mesh.patches.push_back({name, 0, 0});
  for (const Face& face : boundary) {
    FSI_ASSERT(face.other >= 0);
    add_face(list, face, mesh);
    mesh.d.push_back(mesh.Cf.back() - mesh.C[mesh.owner.back()]);
    ++mesh.patches[face.other].end;
  }
  Index begin = mesh.n_internal;
  for (Patch& patch : mesh.patches) {
    patch.begin = begin, patch.end += begin;
    begin = patch.end;
  }
}

void fill_cell_faces(Mesh& mesh) {
  Csr& rows = mesh.cell_faces;
  rows.offset.assign(mesh.n_owned + 1, 0);
  const auto each = [&](auto&& visit) {
    for (Index f = 0; f < mesh.n_faces; ++f) {
      if (mesh.owner[f] < mesh.n_owned) visit(mesh.owner[f], f);
      if (f < mesh.n_internal && mesh.neighbour[f] < mesh.n_owned) visit(mesh.neighbour[f], f);
    }
  };
  each([&](Index c, Index) { ++rows.offset[c + 1]; });
  for (Index c = 0; c < mesh.n_owned; ++c) rows.offset[c + 1] += rows.offset[c];
  rows.index.resize(rows.offset.back());
  std::vector<Index> next(rows.offset.begin(), rows.offset.end() - 1);
  each([&](Index c, Index f) { rows.index[next[c]++] = f; });
}

void fill_cell_neighbours(const CellList& list, Mesh& mesh) {
  const Csr touching = cells_of_vertices(list);
  struct Seen {
    GlobalIndex id;
    Index cell;
    std::int8_t shift;
    auto operator<=>(const Seen&) const = default;  // NOLINT(modernize-use-nullptr)
  };
  std::vector<Seen> seen;
  Csr& rows = mesh.cell_neighbours;
  rows.offset.reserve(mesh.n_owned + 1);
  for (Index c = 0; c < mesh.n_owned; ++c) {
    seen.clear();
    for (const Index p : list.corners[c]) {
      const Index v = list.vertex[p];
      for (const Index n : touching[v]) {
        if (n == c) continue;
        const auto shift = shift_of(list.offset[p], offset_in(list, n, v));
        seen.push_back({list.global_id[n], n, shift});
      }
    }
    std::ranges::sort(seen);
    const auto twice = std::ranges::unique(seen);
    seen.erase(twice.begin(), twice.end());
    for (const Seen& s : seen) {
      rows.index.push_back(s.cell);
      mesh.cell_neighbour_shift.push_back(s.shift);
    }
    rows.offset.push_back(static_cast<Index>(rows.index.size()));
  }
  rows.index.shrink_to_fit(), mesh.cell_neighbour_shift.shrink_to_fit();
}

}  // namespace

Mesh build_mesh(CellList list) {
  Mesh mesh;
  mesh.dim = list.dim;
  mesh.n_owned = list.n_owned, mesh.n_cells = list.n_cells(), mesh.n_global = list.n_global;
  mesh.hash = list.hash;
  mesh.translation = translations(list.periods);
  fill_cells(list, mesh);
  fill_faces(list, mesh);
  fill_cell_faces(mesh);
  fill_cell_neighbours(list, mesh);
  mesh.halo = Halo(list.n_owned, list.halo_owner, list.halo_owner_cell);
  mesh.global_id = std::move(list.global_id);
  mesh.points = std::move(list.points);
  mesh.cell_points = std::move(list.corners);
  mesh.vertex = std::move(list.vertex);
  mesh.point_id = std::move(list.point_id), mesh.vertex_id = std::move(list.vertex_id);
  mesh.total_volume = exact_sum({mesh.V.data(), static_cast<std::size_t>(mesh.n_owned)});
  return mesh;
}

}  // namespace fsi
