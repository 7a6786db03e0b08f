#include "libfsi/operators/gradient.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/operators/stencil.hpp"

namespace fsi {
namespace {

constexpr Real no_inverse = 0.05;  // of the determinant of a cell's matrix, 1 on a good cell

void add_to(Vec3& grad, Real dq, const Vec3& g) { grad += dq * g; }
void add_to(Tensor& grad, const Vec3& dq, const Vec3& g) { grad += outer(dq, g); }

template <class Grad, class T>
void gradient_of(CellField<Grad>& grad, const CellField<T>& q, const BoundaryField<T>& q_b,
                 const GradientStencil& stencil, const Mesh& mesh) {
  grad.fill(Grad{});
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    const T dq = q[N] - q[P];
    add_to(grad[P], dq, stencil.owner[f]);
    add_to(grad[N], -dq, stencil.neighbour[f]);
  }
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
    const Index P = mesh.owner[f];
    add_to(grad[P], q_b[f - mesh.n_internal] - q[P], stencil.owner[f]);
  }
  mesh.halo.update(grad);
}

/// The boundary faces of cell c without a value that have another such face across the cell. Along
/// their normals the cell has no neighbour, and the field has no gradient there.
std::vector<Index> opposite_faces(const std::vector<char>& given, const Mesh& mesh, Index c) {
  constexpr Real facing = -0.7;  // cosine
  std::vector<Index> faces, opposite;
  for (const Index f : mesh.cell_faces[c])
    if (f >= mesh.n_internal && given[f - mesh.n_internal] == 0) faces.push_back(f);
  for (const Index f : faces)
    if (std::ranges::any_of(faces, [&](Index g) {
          return dot(mesh.Sf[f], mesh.Sf[g]) < facing * norm(mesh.Sf[f]) * norm(mesh.Sf[g]);
        }))
      opposite.push_back(f);
  return opposite;
}

/// Sets `closed` of cells with boundary faces without a value.
void set_closed(GradientStencil& stencil, const Mesh& mesh) {
  constexpr Tensor unit{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::vector<Index> at(static_cast<std::size_t>(mesh.n_owned), -1);
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
    const Index P = mesh.owner[f];
    if (stencil.given[f - mesh.n_internal] != 0 || !mesh.brick(P)) continue;
    if (at[P] < 0) {
      at[P] = static_cast<Index>(stencil.closed.size());
      stencil.closed_cells.push_back(P), stencil.closed.push_back(unit);
    }
    stencil.closed[at[P]] += (-1 / mesh.V[P]) * outer(mesh.Sf[f], stencil.to_boundary(f, mesh));
  }
  for (std::size_t i = 0; i < stencil.closed.size(); ++i) {
    const Index c = stencil.closed_cells[i];
    Tensor& M = stencil.closed[i];
    if (std::abs(det(M)) < no_inverse)
      for (const Index f : opposite_faces(stencil.given, mesh, c))
        M += (1 / mesh.V[c]) * outer(mesh.Sf[f], stencil.to_boundary(f, mesh));
    M = std::abs(det(M)) < no_inverse ? unit : inverse(M);
  }
}

}  // namespace

GradientStencil::GradientStencil(const Mesh& mesh, const FaceWeights& weights_,
                                 const std::vector<bool>& has_value,
                                 const std::vector<bool>& mirrors)
    : weights(weights_),
      owner(static_cast<std::size_t>(mesh.n_faces)),
      neighbour(static_cast<std::size_t>(mesh.n_internal)),
      given(static_cast<std::size_t>(mesh.n_boundary()), 0),
      mirror(given),
      image(given.size()) {
  // M as above; fallback = I - sum over faces without a value of g0 (x) tangential part of d: the
  // gradient along the normal is taken as zero there.
  std::vector<Tensor> M(static_cast<std::size_t>(mesh.n_cells)), fallback(M.size());
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    owner[f] = weights.lambda[f] / mesh.V[P] * mesh.Sf[f];
    neighbour[f] = -(1 - weights.lambda[f]) / mesh.V[N] * mesh.Sf[f];
    M[P] += outer(owner[f], mesh.d[f]);
    M[N] += outer(neighbour[f], -mesh.d[f]);
  }
  for (std::size_t i = 0; i < mesh.patches.size(); ++i)
    for (Index f = mesh.patches[i].begin; f < mesh.patches[i].end; ++f) {
      const Index P = mesh.owner[f];
      const Vec3 g0 = (1 / mesh.V[P]) * mesh.Sf[f], n = mesh.normal(f),
                 foot = dot(mesh.d[f], n) * n;
      given[f - mesh.n_internal] = has_value[i] ? 1 : 0;
      mirror[f - mesh.n_internal] = !mirrors.empty() && mirrors[i] ? 1 : 0;
      const bool mirrored = mirror[f - mesh.n_internal] != 0;
      if (has_value[i]) owner[f] = g0;
      if (mirrored) image[f - mesh.n_internal] = 0.5 * g0;
      if (has_value[i] || mirrored) {
        M[P] += outer(g0, mirrored ? foot : mesh.d[f]);
      } else {
        fallback[P] += outer(g0, mesh.d[f] - foot);
      }
    }
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (mesh.dim == 2) M[c].zz = 1;
    if (std::abs(det(M[c])) < no_inverse)
      for (const Index f : opposite_faces(given, mesh, c))
        M[c] += (0.5 / norm2(mesh.Sf[f])) * outer(mesh.Sf[f], mesh.Sf[f]);
    // A corner cell has too few neighbours for a linear fit when det M vanishes (1 on a good cell).
    if (std::abs(det(M[c])) < no_inverse) {
      unfit.push_back(c);
      M[c] = -1.0 * fallback[c];
      M[c].xx += 1, M[c].yy += 1, M[c].zz += 1;
    }
    M[c] = inverse(M[c]);
  }
  for (Index f = 0; f < mesh.n_faces; ++f) {
    if (mesh.owner[f] < mesh.n_owned) owner[f] = dot(M[mesh.owner[f]], owner[f]);
    if (f >= mesh.n_internal)
      image[f - mesh.n_internal] = dot(M[mesh.owner[f]], image[f - mesh.n_internal]);
    if (f < mesh.n_internal && mesh.neighbour[f] < mesh.n_owned)
      neighbour[f] = dot(M[mesh.neighbour[f]], neighbour[f]);
  }
  set_closed(*this, mesh);
}

void gradient(CellField<Vec3>& grad, const CellField<Real>& q, const BoundaryField<Real>& q_b,
              const GradientStencil& stencil, const Mesh& mesh) {
  gradient_of(grad, q, q_b, stencil, mesh);
}

void pressure_gradient(CellField<Vec3>& grad, const std::vector<Vec3>& g_f,
                       const CellField<Real>& q, const BoundaryField<Real>& q_b,
                       const GradientStencil& stencil, const Mesh& mesh) {
  const FaceWeights& weights = stencil.weights;
  grad.fill({});
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    const Real lambda = weights.lambda[f], rise = q[N] - q[P];
    grad[P] += (lambda * rise) * mesh.Sf[f];
    grad[N] += ((1 - lambda) * rise) * mesh.Sf[f];
  }
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
    const Index P = mesh.owner[f], b = f - mesh.n_internal;
    if (stencil.given[b] != 0) grad[P] += (q_b[b] - q[P]) * mesh.Sf[f];
  }
  for (std::size_t i = 0; i < weights.irregular.size(); ++i) {
    const Index f = weights.irregular[i], P = mesh.owner[f];
    if (f < mesh.n_internal) {
      const Vec3 rest = dot(g_f[i], weights.skew[f]) * mesh.Sf[f];
      grad[P] += rest;
      grad[mesh.neighbour[f]] -= rest;
    } else if (stencil.given[f - mesh.n_internal] == 0 && !mesh.brick(P)) {
      grad[P] += dot(g_f[i], stencil.to_boundary(f, mesh)) * mesh.Sf[f];
    }
  }
  for (Index c = 0; c < mesh.n_owned; ++c) grad[c] *= 1 / mesh.V[c];
  for (std::size_t i = 0; i < stencil.closed.size(); ++i) {
    Vec3& own = grad[stencil.closed_cells[i]];
    own = dot(stencil.closed[i], own);
  }
  mesh.halo.update(grad);
}

void gradient(CellField<Tensor>& L, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
              const GradientStencil& stencil, const Mesh& mesh) {
  gradient_of(L, u, u_b, stencil, mesh);
}

void gradient(CellField<Tensor>& L, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
              const GradientStencil& stencil, const Mesh& mesh, std::span<const Index> cells) {
  for (const Index c : cells) {
    Tensor sum;
    for (const Index f : mesh.cell_faces[c]) {
      const Index n = beyond(mesh, f, c);
      const Vec3& u_n = n < 0 ? u_b[f - mesh.n_internal] : u[n];
      sum += outer(u_n - u[c], stencil.weight(f, mesh.owner[f] == c));
    }
    L[c] = sum;
  }
}

}  // namespace fsi
