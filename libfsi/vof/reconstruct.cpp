#include "libfsi/vof/reconstruct.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"

namespace fsi::vof {
namespace {

/// Calls visit(cell, its centre relative to C[c]) for every cell that shares a vertex with c.
template <class F>
void for_neighbours(const Mesh& mesh, Index c, F visit) {
  for (Index i = mesh.cell_neighbours.offset[c]; i < mesh.cell_neighbours.offset[c + 1]; ++i) {
    const Index n = mesh.cell_neighbours.index[i];
    visit(n, mesh.C[n] + mesh.translation[mesh.cell_neighbour_shift[i]] - mesh.C[c]);
  }
}

/// Solves the symmetric positive 3x3 system A x = b.
Vec3 solve(const SymTensor& A, const Vec3& b) {
  const Real s = 1 / det(A);
  const Real xx = A.yy * A.zz - A.yz * A.yz, xy = A.xz * A.yz - A.xy * A.zz,
             xz = A.xy * A.yz - A.xz * A.yy, yy = A.xx * A.zz - A.xz * A.xz,
             yz = A.xy * A.xz - A.xx * A.yz, zz = A.xx * A.yy - A.xy * A.xy;
  return s * Vec3{xx * b.x + xy * b.y + xz * b.z, xy * b.x + yy * b.y + yz * b.z,
                  xz * b.x + yz * b.y + zz * b.z};
}

}  // namespace

Vec3 least_squares_gradient(const CellField<Real>& q, const Mesh& mesh, Index c) {
  SymTensor A;
  Vec3 b;
  for_neighbours(mesh, c, [&](Index n, const Vec3& d) {
    const Real w = 1 / norm2(d);
    A += w * SymTensor{d.x * d.x, d.x * d.y, d.x * d.z, d.y * d.y, d.y * d.z, d.z * d.z};
    b += (w * (q[n] - q[c])) * d;
  });
  if (mesh.dim == 2) A.zz = 1;
  return solve(A, b);
}

Reconstruct::Reconstruct(const Mesh& mesh)
    : mesh_(mesh), psi_(mesh), stamp_(static_cast<std::size_t>(mesh.n_owned), 0) {
  std::vector<std::vector<Index>> around(static_cast<std::size_t>(mesh.n_cells - mesh.n_owned));
  for (Index c = 0; c < mesh.n_owned; ++c)
    for (const Index n : mesh.cell_neighbours[c])
      if (n >= mesh.n_owned) around[n - mesh.n_owned].push_back(c);
  for (const auto& row : around) {
    halo_neighbours_.index.insert(halo_neighbours_.index.end(), row.begin(), row.end());
    halo_neighbours_.offset.push_back(static_cast<Index>(halo_neighbours_.index.size()));
  }
}

int Reconstruct::operator()(Interface& interface, const CellField<Real>& alpha) {
  find_cells(interface, alpha);
  const bool guessed = first_normals(interface, alpha);
  cut(interface, alpha);
  const int most = guessed ? 1 : 5;
  constexpr Real tolerance = 1e-6;
  for (int i = 1; i <= most; ++i) {
    distance(interface);
    const Real change = turn(interface);
    cut(interface, alpha);
    if (change < tolerance) return i;
  }
  return most;
}

void Reconstruct::renew(Interface& interface, const CellField<Real>& alpha) {
  find_cells(interface, alpha);
  cut(interface, alpha);
}

void Reconstruct::find_cells(Interface& interface, const CellField<Real>& alpha) {
  // Cells that held a plane but hold none now are cleared; the halo is set by the exchange in
  // cut().
  for (const Index c : interface.cells)
    if (!is_interface(alpha[c])) interface.normal[c] = interface.centre[c] = {};
  interface.cells.clear();
  near_.clear();
  ++calls_;
  const auto list = [&](Index c) {
    if (c >= mesh_.n_owned || stamp_[c] == calls_) return;
    stamp_[c] = calls_;
    near_.push_back(c);
  };
  for (Index c = 0; c < mesh_.n_owned; ++c)
    if (is_interface(alpha[c])) interface.cells.push_back(c);
  for (const Index c : interface.cells) {
    list(c);
    for (const Index n : mesh_.cell_neighbours[c]) list(n);
  }
  // A cell of this rank whose interface neighbours all lie on other ranks.
  for (Index c = mesh_.n_owned; c < mesh_.n_cells; ++c)
    if (is_interface(alpha[c]))
      for (const Index n : halo_neighbours_[c - mesh_.n_owned]) list(n);
}

bool Reconstruct::first_normals(Interface& interface, const CellField<Real>& alpha) {
  GlobalIndex guessed = 0;
  for (const Index c : interface.cells) {
    if (norm2(interface.normal[c]) > 0) {
      ++guessed;
      continue;
    }
    const Vec3 g = least_squares_gradient(alpha, mesh_, c);
    const Real size = norm(g);
    interface.normal[c] = size > 0 ? -1 / size * g : Vec3{1, 0, 0};
  }
  return global_sum(guessed) > 0;
}

void Reconstruct::cut(Interface& interface, const CellField<Real>& alpha) {
  for (const Index c : interface.cells) {
    gather(cell_, mesh_, c);
    interface.centre[c] = geometry::cut_at_fraction(cell_, interface.normal[c], alpha[c]).centre;
  }
  mesh_.halo.update(interface.normal);
  mesh_.halo.update(interface.centre);
}

void Reconstruct::distance(const Interface& interface) {
  for (const Index c : near_) {
    Real sum = 0, weights = 0;
    const auto add = [&](Index n, const Vec3& d) {
      const Vec3& normal = interface.normal[n];
      if (norm2(normal) == 0) return;
      const Vec3 r = -d - interface.centre[n];  // x_c - c_n
      const Real distance = dot(normal, r), size = norm2(r);
      // A centre on the plane itself has distance zero and says so with full weight.
      const Real w = size > 0 ? std::max(distance * distance / size, 1e-12) : 1;
      sum += w * distance;
      weights += w;
    };
    add(c, {});
    for_neighbours(mesh_, c, add);
    psi_[c] = weights > 0 ? sum / weights : 0;
  }
  mesh_.halo.update(psi_);
}

Real Reconstruct::turn(Interface& interface) {
  guess_.clear();
  Real change = 0;
  for (const Index c : interface.cells) {
    const Vec3 g = least_squares_gradient(psi_, mesh_, c);
    const Real size = norm(g);
    const Vec3 n = size > 0 ? g / size : interface.normal[c];
    change += 1 - dot(n, interface.normal[c]);
    guess_.push_back(n);
  }
  for (std::size_t i = 0; i < guess_.size(); ++i) interface.normal[interface.cells[i]] = guess_[i];
  const GlobalIndex count = global_sum(static_cast<GlobalIndex>(guess_.size()));
  Sum total;
  total.add(change);
  const Real sum = total.total();
  return count > 0 ? sum / static_cast<Real>(count) : 0;
}

}  // namespace fsi::vof
