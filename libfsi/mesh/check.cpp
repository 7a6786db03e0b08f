#include "libfsi/mesh/check.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "libfsi/core/error.hpp"

namespace fsi {
namespace {

void name_faces(const RawMesh& raw, CellList& list) {
  std::map<std::array<Index, max_face_corners>, Index> name_of;
  for (const RawMesh::Side& side : raw.sides) {
    std::array<Index, max_face_corners> key = side.corner;
    for (Index& p : key) p = p < 0 ? p : list.vertex[p];
    std::ranges::sort(key);
    name_of[key] = side.name;
  }
  const auto mate = match_faces(list);
  list.face_patch.assign(list.types.size(), {-1, -1, -1, -1, -1, -1});
  for (Index c = 0; c < list.n_cells(); ++c) {
    for (int f = 0; f < shape_of(list.types[c]).faces; ++f) {
      const Half half(half_of(c, f));
      if (mate[half_of(c, f)] != no_mate) continue;
      const auto found = name_of.find(face_key(list, half));
      require(found != name_of.end() && found->second >= 0,
              raw.file + ": a boundary face carries no physical name");
      list.face_patch[c][f] = static_cast<std::int8_t>(found->second);
    }
  }
  list.patches = raw.names;
}

}  // namespace

CellList check_mesh(RawMesh raw, const std::vector<std::string>&) {
  CellList list;
  list.dim = raw.dim;
  list.points = std::move(raw.points);
  list.types = std::move(raw.types), list.corners = std::move(raw.corners);
  list.vertex.resize(list.points.size());
  std::iota(list.vertex.begin(), list.vertex.end(), 0);
  list.offset.assign(list.points.size(), Offset{});
  list.n_owned = list.n_cells(), list.n_global = list.n_cells();
  list.global_id.resize(list.types.size());
  std::iota(list.global_id.begin(), list.global_id.end(), 0);
  name_faces(raw, list);
  return list;
}

}  // namespace fsi
