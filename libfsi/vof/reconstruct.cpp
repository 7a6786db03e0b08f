#include "libfsi/vof/reconstruct.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "libfsi/core/parallel.hpp"
#include "libfsi/field/band.hpp"
#include "libfsi/operators/least_squares.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi::vof {
namespace {

// A gradient this small, over that of a sharp interface, has no direction.
constexpr Real degenerate = 1e-6;

/// Owned cells with an interface, and all owned cells that touch one.
void find_cells(const CellField<Real>& alpha, const Mesh& mesh, ReconstructScratch& s) {
  for (const Index c : s.near) s.marked[c] = 0;
  s.cells.clear(), s.near.clear();
  const auto mark = [&](Index c) {
    if (c < mesh.n_owned && !s.marked[c]) s.marked[c] = 1, s.near.push_back(c);
  };
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (!is_cut(alpha[c])) continue;
    s.cells.push_back(c);
    mark(c);
    for (const Index n : mesh.cell_neighbours[c]) mark(n);
  }
  for (Index c = mesh.n_owned; c < mesh.n_cells; ++c) {
    if (!is_cut(alpha[c])) continue;
    for (const Index n : s.halo_neighbours[c - mesh.n_owned]) mark(n);
  }
}

/// n = -grad alpha / |grad alpha|; none where the gradient vanishes.
void first_normals(const CellField<Real>& alpha, const Mesh& mesh, ReconstructScratch& s) {
  s.fit.resize(s.cells.size()), s.normal.resize(s.cells.size());
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    const Index c = s.cells[i];
    s.fit[i] = inverse_moments(mesh, c, s.symmetry);
    const Vec3 g = slope_at(alpha, s.fit[i], mesh, c, s.symmetry);
    const Real size = norm(g);
    s.normal[i] = size * cell_size(mesh, c) > interface_eps * degenerate ? g / -size : Vec3{};
  }
}

/// The plane with normal s.normal and the part alpha of the cell behind it, in every cell of
/// s.cells.
void cut_cells(Interface& interface, const CellField<Real>& alpha, const Mesh& mesh,
               ReconstructScratch& s) {
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    const Index c = s.cells[i];
    if (norm2(s.normal[i]) == 0) continue;
    gather(s.cell, mesh, c);
    const geometry::Plane plane = geometry::plane_at(s.cell, s.normal[i], alpha[c]);
    const geometry::Cut cut = geometry::cut(s.cell, plane);
    interface.piece[c] = cut.area > 0 ? Piece{plane.n, mesh.C[c] + cut.centre, cut.area} : Piece{};
  }
  mesh.halo.update(interface.piece);
}

/// Signed distance to the interface at the centres of s.near: to the cell's own plane, else
///   distance = sum w n.(x - x_S) / sum w,  w = (n . (x - x_S) / |x - x_S|)^2   [Scheufler19]
/// over the planes of the vertex neighbours.
void reconstruct_distance(const Interface& interface, const Mesh& mesh, ReconstructScratch& s) {
  for (const Index c : s.near) {
    const Vec3 x = mesh.C[c];
    if (const Piece& own = interface.piece[c]; own.area > 0) {
      s.distance[c] = dot(own.n_hat, x - own.centre);
      continue;
    }
    Real sum = 0, total = 0;
    const auto add = [&](Index k, const Vec3& r, const Reflection& n) {
      const Piece& p = interface.piece[k];
      if (!(p.area > 0)) return;
      const Vec3 d = -r - image(p.centre - mesh.C[k], n);
      const Real to_plane = dot(image(p.n_hat, n), d);
      const Real w = to_plane * to_plane / norm2(d);
      sum += w * to_plane, total += w;
    };
    for_neighbours_and_images(c, s.symmetry, mesh, add);
    s.distance[c] = total > 0 ? sum / total : 0;
  }
  mesh.halo.update(s.distance);
}

/// Means over the interface of 1 - cos.
struct Change {
  Real turned = 0;  ///< between a cell's normals before and after
  Real bent = 0;    ///< between a cell's normal and its neighbours'
};

/// n = grad distance / |grad distance|, of length 1 unless planes contradict each other.
Change new_normals(const Interface& interface, const Mesh& mesh, ReconstructScratch& s) {
  std::array<Sum, 3> sums;
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    const Index c = s.cells[i];
    if (norm2(s.normal[i]) == 0) continue;
    const Vec3 g = slope_at(s.distance, s.fit[i], mesh, c, s.symmetry);
    const Real size = norm(g);
    if (!(size > degenerate)) continue;
    const Vec3 n = g / size;
    Real bent = 0;
    int count = 0;
    const auto add = [&](Index k, const Vec3& /*r*/, const Reflection& plane) {
      const Piece& p = interface.piece[k];
      if (p.area > 0) bent += 1 - dot(image(p.n_hat, plane), s.normal[i]), ++count;
    };
    for_neighbours_and_images(c, s.symmetry, mesh, add);
    sums[0].add(1 - dot(n, s.normal[i])), sums[1].add(count > 0 ? bent / count : 0), sums[2].add(1);
    s.normal[i] = n;
  }
  std::array<Real, 3> totals;
  Sum::totals(totals, sums);
  if (totals[2] == 0) return {};
  return {totals[0] / totals[2], totals[1] / totals[2]};
}

}  // namespace

ReconstructScratch::ReconstructScratch(const Mesh& mesh, SymmetryFaces planes)
    : symmetry(std::move(planes)),
      halo_neighbours(cells_around_halo(mesh)),
      distance(mesh),
      marked(static_cast<std::size_t>(mesh.n_owned), 0),
      cell(mesh.dim) {}

void reconstruct(Interface& interface, const CellField<Real>& alpha, const Mesh& mesh,
                 ReconstructScratch& s, const ReconstructAccuracy& accuracy) {
  for (const Index c : interface.cells) interface.piece[c] = {};
  find_cells(alpha, mesh, s);
  first_normals(alpha, mesh, s);
  cut_cells(interface, alpha, mesh, s);
  for (int i = 0; i < accuracy.max_rounds; ++i) {
    reconstruct_distance(interface, mesh, s);
    const Change change = new_normals(interface, mesh, s);
    cut_cells(interface, alpha, mesh, s);
    if (change.turned < accuracy.turn || change.turned < accuracy.turn_of_bend * change.bent) break;
  }
  interface.cells.clear();
  for (const Index c : s.cells) {
    if (interface.piece[c].area > 0) interface.cells.push_back(c);
  }
}

void gather(geometry::Polytope& cell, const Mesh& mesh, Index c) {
  cell.clear();
  std::array<Vec3, geometry::Polytope::max_points> x;
  for (const Index f : mesh.cell_faces[c]) {
    const auto n = static_cast<Index>(mesh.face_points[f].size());
    for (Index i = 0; i < n; ++i) x[i] = mesh.corner(f, i, c) - mesh.C[c];
    cell.add_face({x.data(), static_cast<std::size_t>(n)}, mesh.owner[f] != c);
  }
}

}  // namespace fsi::vof
