#include "tests/unit/support/box_mesh.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace fsi::test {
namespace {

using Cell = std::array<Index, 3>;

struct Builder {
  const Box& box;
  int dim;
  Cell n;
  Vec3 h;
  Mesh mesh;

  explicit Builder(const Box& b)
      : box(b), dim(b.n[2] > 0 ? 3 : 2), n{b.n[0], b.n[1], std::max<Index>(b.n[2], 1)} {
    h = {b.length.x / n[0], b.length.y / n[1], dim == 3 ? b.length.z / n[2] : 1};
  }

  Index cell(const Cell& i) const { return i[0] + n[0] * (i[1] + n[1] * i[2]); }
  Index point(const Cell& i) const { return i[0] + (n[0] + 1) * (i[1] + (n[1] + 1) * i[2]); }
  Vec3 at(Real i, Real j, Real k) const { return {i * h.x, j * h.y, dim == 3 ? k * h.z : 0}; }

  /// Row of the table of translations for a jump of whole box lengths.
  Index translation(const Cell& jump) {
    const Vec3 t{jump[0] * box.length.x, jump[1] * box.length.y,
                 dim == 3 ? jump[2] * box.length.z : 0};
    for (std::size_t row = 0; row < mesh.translation.size(); ++row)
      if (mesh.translation[row] == t) return static_cast<Index>(row);
    mesh.translation.push_back(t);
    return static_cast<Index>(mesh.translation.size()) - 1;
  }

  /// The cell beyond, with the jump over periodic seams; false where there is none.
  bool wrap(Cell& i, Cell& jump) const {
    jump = {0, 0, 0};
    for (int a = 0; a < dim; ++a) {
      if (i[a] >= 0 && i[a] < n[a]) continue;
      if (!box.periodic[a]) return false;
      jump[a] = i[a] < 0 ? -1 : 1;
      i[a] -= jump[a] * n[a];
    }
    return true;
  }

  struct Face {
    Index P, N, shift;
    int axis, sign, patch;
    Cell i;
  };

  void cells() {
    for (Index k = 0; k < n[2]; ++k)
      for (Index j = 0; j < n[1]; ++j)
        for (Index i = 0; i < n[0]; ++i) {
          mesh.C.push_back(at(i + 0.5, j + 0.5, k + 0.5));
          mesh.V.push_back(h.x * h.y * h.z);
          mesh.global_id.push_back(cell({i, j, k}));
          for (Index dk = 0; dk <= (dim == 3 ? 1 : 0); ++dk)
            for (const auto& [di, dj] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
              mesh.cell_points.index.push_back(point({i + di, j + dj, k + dk}));
          mesh.cell_points.offset.push_back(static_cast<Index>(mesh.cell_points.index.size()));
        }
    for (Index k = 0; k <= (dim == 3 ? n[2] : 0); ++k)
      for (Index j = 0; j <= n[1]; ++j)
        for (Index i = 0; i <= n[0]; ++i) {
          const auto joined = [&](int a, Index p) { return box.periodic[a] && p == n[a] ? 0 : p; };
          mesh.points.push_back(at(i, j, k));
          mesh.vertex.push_back(point({joined(0, i), joined(1, j), joined(2, k)}));
        }
    mesh.dim = dim;
    mesh.n_owned = mesh.n_cells = static_cast<Index>(mesh.C.size());
    mesh.n_global = mesh.n_cells;
    mesh.total_volume = box.length.x * box.length.y * (dim == 3 ? box.length.z : 1);
  }

  std::vector<Face> faces() {
    std::vector<Face> all;
    for (Index c = 0; c < mesh.n_cells; ++c) {
      const Cell i{c % n[0], c / n[0] % n[1], c / n[0] / n[1]};
      for (int axis = 0; axis < dim; ++axis)
        for (const int sign : {-1, 1}) {
          Cell beyond = i, jump;
          beyond[axis] += sign;
          if (!wrap(beyond, jump))
            all.push_back({c, -1, 0, axis, sign, 2 * axis + (sign > 0 ? 1 : 0), i});
          else if (const Index N = cell(beyond); c < N)
            all.push_back({c, N, translation(jump), axis, sign, -1, i});
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const Face& a, const Face& b) {
      return std::tuple(a.patch, a.P, a.N) < std::tuple(b.patch, b.P, b.N);
    });
    return all;
  }

  void add(const Face& face) {
    const Real area = face.axis == 0 ? h.y * h.z : face.axis == 1 ? h.x * h.z : h.x * h.y;
    Vec3 n_hat;
    n_hat[face.axis] = face.sign;
    mesh.owner.push_back(face.P);
    mesh.Sf.push_back(area * n_hat);
    mesh.Cf.push_back(mesh.C[face.P] + 0.5 * h[face.axis] * n_hat);
    mesh.d.push_back((face.N < 0 ? 0.5 : 1) * h[face.axis] * n_hat);
    if (face.N >= 0) mesh.neighbour.push_back(face.N), mesh.shift.push_back(face.shift);
    // Corners counter-clockwise about +axis, reversed for -axis.
    std::vector<Cell> corners;
    const int a = (face.axis + 1) % 3, b = (face.axis + 2) % 3;
    const auto corner = [&](Index da, Index db) {
      Cell p = face.i;
      p[face.axis] += face.sign > 0 ? 1 : 0;
      p[a] += da, p[b] += db;
      return p;
    };
    if (dim == 3)
      corners = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
    else
      corners = face.axis == 0 ? std::vector{corner(0, 0), corner(1, 0)}
                               : std::vector{corner(0, 1), corner(0, 0)};
    if (face.sign < 0) std::reverse(corners.begin(), corners.end());
    for (const Cell& p : corners) mesh.face_points.index.push_back(point(p));
    mesh.face_points.offset.push_back(static_cast<Index>(mesh.face_points.index.size()));
  }

  void connect() {
    std::vector<std::vector<Index>> of_cell(static_cast<std::size_t>(mesh.n_cells));
    for (Index f = 0; f < mesh.n_faces; ++f) {
      of_cell[mesh.owner[f]].push_back(f);
      if (f < mesh.n_internal) of_cell[mesh.neighbour[f]].push_back(f);
    }
    for (const auto& row : of_cell) {
      mesh.cell_faces.index.insert(mesh.cell_faces.index.end(), row.begin(), row.end());
      mesh.cell_faces.offset.push_back(static_cast<Index>(mesh.cell_faces.index.size()));
    }
    for (Index c = 0; c < mesh.n_cells; ++c) {
      std::vector<std::pair<Index, Index>> near;
      for (Index k = (dim == 3 ? -1 : 0); k <= (dim == 3 ? 1 : 0); ++k)
        for (Index j = -1; j <= 1; ++j)
          for (Index i = -1; i <= 1; ++i) {
            Cell other{c % n[0] + i, c / n[0] % n[1] + j, c / n[0] / n[1] + k}, jump;
            if ((i != 0 || j != 0 || k != 0) && wrap(other, jump))
              near.emplace_back(cell(other), translation(jump));
          }
      std::sort(near.begin(), near.end());
      for (const auto& [other, row] : near) {
        mesh.cell_neighbours.index.push_back(other);
        mesh.cell_neighbour_shift.push_back(static_cast<std::int8_t>(row));
      }
      mesh.cell_neighbours.offset.push_back(static_cast<Index>(mesh.cell_neighbours.index.size()));
    }
  }
};

}  // namespace

Mesh box_mesh(const Box& box) {
  Builder builder(box);
  Mesh& mesh = builder.mesh;
  builder.cells();
  const std::vector<Builder::Face> faces = builder.faces();
  for (const Builder::Face& face : faces) builder.add(face);
  mesh.n_faces = static_cast<Index>(faces.size());
  mesh.n_internal = static_cast<Index>(mesh.neighbour.size());
  Index begin = mesh.n_internal;
  for (int p = 0; p < 2 * builder.dim; ++p) {
    const Index count = static_cast<Index>(std::count_if(
        faces.begin(), faces.end(), [p](const Builder::Face& face) { return face.patch == p; }));
    const std::array names{"left", "right", "bottom", "top", "back", "front"};
    if (count > 0)
      mesh.patches.push_back({names[static_cast<std::size_t>(p)], begin, begin + count});
    begin += count;
  }
  builder.connect();
  return std::move(mesh);
}

}  // namespace fsi::test
