#include "libfsi/operators/symmetry_faces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libfsi/core/parallel.hpp"
#include "libfsi/field/field.hpp"

namespace fsi {
namespace {

using geometry::Mirror;

// What the digits of a mesh file leave.
constexpr Real level = 1e-3;       // of the angle between planes
constexpr Real negligible = 1e-4;  // height over a plane, in parts of a cell

bool parallel(const Mirror& a, const Mirror& b) { return norm(cross(a.n, b.n)) < level; }

bool holds(const Mirror& plane, const Vec3& x, Real size) {
  return std::abs(dot(plane.n, x - plane.x)) < negligible * size;
}

/// The planes of the listed boundary faces of cells, up to three for each; owned and halo.
struct PlanesOfCells {
  PlanesOfCells(const std::vector<char>& faces, const Mesh& mesh) : normals(mesh), heights(mesh) {
    std::vector<int> count(static_cast<std::size_t>(mesh.n_owned), 0);
    for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
      const Index P = mesh.owner[f];
      if (faces[f - mesh.n_internal] == 0 || count[P] >= mesh.dim) continue;
      const Vec3 n = mesh.normal(f);
      const Vec3 row{count[P] == 0 ? 1.0 : 0, count[P] == 1 ? 1.0 : 0, count[P] == 2 ? 1.0 : 0};
      normals[P] += outer(row, n);
      heights[P] += dot(n, mesh.Cf[f]) * row;
      ++count[P];
    }
    mesh.halo.update(normals), mesh.halo.update(heights);
  }
  std::array<Mirror, 3> of_cell(Index c) const {
    const Tensor& N = normals[c];
    const Vec3 x{N.xx, N.xy, N.xz}, y{N.yx, N.yy, N.yz}, z{N.zx, N.zy, N.zz}, h = heights[c];
    return {{{h.x * x, x}, {h.y * y, y}, {h.z * z, z}}};
  }

  CellField<Tensor> normals;  // by rows; zero: no plane
  CellField<Vec3> heights;    // n . x of their points
};

/// Adds a plane that is not in the list. size: of a cell at it.
void add_new(std::vector<Mirror>& planes, const Mirror& plane, Real size) {
  const auto known = [&](const Mirror& m) { return parallel(m, plane) && holds(m, plane.x, size); };
  if (std::ranges::none_of(planes, known)) planes.push_back(plane);
}

/// The vertices of cell c on a plane. Those of its own face there count also if the face is warped.
std::vector<Index> vertices_on(const Mirror& plane, const std::vector<char>& faces,
                               const Mesh& mesh, Index c) {
  const Real size = cell_size(mesh, c);
  std::vector<Index> on;
  for (const Index p : mesh.cell_points[c])
    if (holds(plane, mesh.points[p], size)) on.push_back(mesh.vertex[p]);
  for (const Index f : mesh.cell_faces[c]) {
    if (f < mesh.n_internal || faces[f - mesh.n_internal] == 0) continue;
    const Mirror own{mesh.Cf[f], mesh.normal(f)};
    if (!parallel(plane, own) || !holds(plane, own.x, size)) continue;
    for (const Index p : mesh.face_points[f]) on.push_back(mesh.vertex[p]);
  }
  return on;
}

/// The place of the reflection in these planes among the last ones of a list, to which it is added
/// if it is not there.
Index number_of(std::vector<Reflection>& known, const std::vector<Mirror>& planes) {
  constexpr std::size_t last = 8;
  constexpr Real rounding = 1e-9;
  Reflection reflection;
  for (const Mirror& plane : planes) reflection.normals[reflection.count++] = plane.n;
  for (std::size_t i = known.size(); i > 0 && i + last > known.size(); --i) {
    const Reflection& there = known[i - 1];
    bool same = there.count == reflection.count;
    for (int j = 0; j < there.count; ++j)
      same = same && norm(there.normals[j] - reflection.normals[j]) < rounding;
    if (same) return static_cast<Index>(i - 1);
  }
  known.push_back(reflection);
  return static_cast<Index>(known.size()) - 1;
}

}  // namespace

std::unordered_map<Index, std::vector<Mirror>> planes_through_vertices(
    const std::vector<char>& faces, const Mesh& mesh) {
  const PlanesOfCells planes(faces, mesh);
  std::unordered_map<Index, std::vector<Mirror>> through;
  for (Index c = 0; c < mesh.n_cells; ++c)
    for (const Mirror& plane : planes.of_cell(c)) {
      if (plane.n == Vec3{}) continue;
      for (const Index p : mesh.cell_points[c]) {
        if (!holds(plane, mesh.points[p], cell_size(mesh, c))) continue;
        std::vector<Mirror>& here = through[mesh.vertex[p]];
        const auto known = [&](const Mirror& m) { return parallel(m, plane); };
        if (std::ranges::none_of(here, known)) here.push_back(plane);
      }
    }
  return through;
}

bool at_right_angles(const std::vector<Mirror>& planes) {
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(dot(planes[i].n, planes[j].n)) > level) return false;
  return true;
}

SymmetryFaces::SymmetryFaces(std::vector<char> faces, const Mesh& mesh) {
  if (all_of_ranks(std::ranges::none_of(faces, [](char is) { return is != 0; }))) return;
  Lists lists{.is = std::move(faces)};
  const auto through = planes_through_vertices(lists.is, mesh);
  lists.begin.assign(1, 0);
  for (Index c = 0; c < mesh.n_owned; ++c) {
    std::vector<Mirror> planes;
    for (const Index f : mesh.cell_faces[c])
      if (f >= mesh.n_internal && lists.is[f - mesh.n_internal] != 0)
        add_new(planes, {mesh.Cf[f], mesh.normal(f)}, cell_size(mesh, c));
    for (const Index p : mesh.cell_points[c]) {
      const auto at = through.find(mesh.vertex[p]);
      if (at == through.end() || !at_right_angles(at->second)) continue;
      for (const Mirror& plane : at->second)  // through p also if found across a period
        add_new(planes, {mesh.points[p], plane.n}, cell_size(mesh, c));
    }
    if (!planes.empty()) list_images_of(lists, c, planes, mesh);
    lists.begin.push_back(static_cast<Index>(lists.images.size()));
  }
  lists_ = std::make_shared<const Lists>(std::move(lists));
}

void SymmetryFaces::list_images_of(Lists& lists, Index c, const std::vector<Mirror>& planes,
                                   const Mesh& mesh) {
  std::vector<std::vector<Index>> on;  // vertices on each plane
  for (const Mirror& plane : planes) on.push_back(vertices_on(plane, lists.is, mesh, c));
  for (unsigned set = 1; set < 1U << planes.size(); ++set) {
    std::vector<Mirror> of_set;
    std::vector<Index> common;  // corners of c on all of these planes
    for (const Index p : mesh.cell_points[c]) common.push_back(mesh.vertex[p]);
    for (std::size_t i = 0; i < planes.size(); ++i) {
      if ((set >> i & 1U) == 0) continue;
      of_set.push_back(planes[i]);
      std::erase_if(common, [&](Index v) { return std::ranges::find(on[i], v) == on[i].end(); });
    }
    if (of_set.size() > 3 || !at_right_angles(of_set)) continue;
    const Index number = number_of(lists.reflections, of_set);
    const auto add = [&](Index k, Vec3 r) {
      const auto is_common = [&](Index p) {
        return std::ranges::find(common, mesh.vertex[p]) != common.end();
      };
      if (std::ranges::none_of(mesh.cell_points[k], is_common)) return;
      for (const Mirror& plane : of_set) r = plane.of_point(mesh.C[c] + r) - mesh.C[c];
      lists.images.push_back({k, number, r});
    };
    add(c, {});
    for_vertex_neighbours(c, mesh, add);
  }
}

}  // namespace fsi
