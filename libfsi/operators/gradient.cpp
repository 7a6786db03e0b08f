#include "libfsi/operators/gradient.hpp"

#include <cmath>

namespace fsi {
namespace {

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

/// (1/V) sum_f (first)_f . skew S outward of cell c, first . d S at the boundary without a value.
Vec3 skewness(const CellField<Vec3>& first, const GradientStencil& stencil, const Mesh& mesh,
              Index c) {
  const FaceWeights& weights = stencil.weights;
  Vec3 sum;
  for (const Index f : mesh.cell_faces[c]) {
    const Index P = mesh.owner[f];
    if (f >= mesh.n_internal) {
      if (stencil.given[f - mesh.n_internal] == 0) sum += dot(first[c], mesh.d[f]) * mesh.Sf[f];
      continue;
    }
    const Real lambda = weights.lambda[f];
    const Vec3 mean = (1 - lambda) * first[P] + lambda * first[mesh.neighbour[f]];
    sum += (P == c ? 1 : -1) * dot(mean, weights.skew[f]) * mesh.Sf[f];
  }
  return (1 / mesh.V[c]) * sum;
}

}  // namespace

GradientStencil::GradientStencil(const Mesh& mesh, const FaceWeights& weights_,
                                 const std::vector<bool>& has_value)
    : weights(weights_),
      owner(static_cast<std::size_t>(mesh.n_faces)),
      neighbour(static_cast<std::size_t>(mesh.n_internal)),
      given(static_cast<std::size_t>(mesh.n_boundary()), 0) {
  // M as above; fallback = I - sum over faces without a value of g0 (x) tangential part of d:
  // the gradient along the normal taken as zero there.
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
      const Vec3 g0 = (1 / mesh.V[P]) * mesh.Sf[f];
      given[f - mesh.n_internal] = has_value[i] ? 1 : 0;
      if (has_value[i]) {
        owner[f] = g0;
        M[P] += outer(g0, mesh.d[f]);
      } else {
        const Vec3 n = mesh.Sf[f] / norm(mesh.Sf[f]);
        fallback[P] += outer(g0, mesh.d[f] - dot(mesh.d[f], n) * n);
      }
    }
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (mesh.dim == 2) M[c].zz = 1;
    // A corner cell has too few neighbours for a linear fit when det M vanishes (1 on a good cell).
    if (std::abs(det(M[c])) < 0.05) {
      M[c] = -1.0 * fallback[c];
      M[c].xx += 1, M[c].yy += 1, M[c].zz += 1;
    }
    M[c] = inverse(M[c]);
  }
  for (Index f = 0; f < mesh.n_faces; ++f) {
    if (mesh.owner[f] < mesh.n_owned) owner[f] = dot(M[mesh.owner[f]], owner[f]);
    if (f < mesh.n_internal && mesh.neighbour[f] < mesh.n_owned)
      neighbour[f] = dot(M[mesh.neighbour[f]], neighbour[f]);
  }
}

void gradient(CellField<Vec3>& grad, const CellField<Real>& q, const BoundaryField<Real>& q_b,
              const GradientStencil& stencil, const Mesh& mesh) {
  gradient_of(grad, q, q_b, stencil, mesh);
}

void pressure_gradient(CellField<Vec3>& grad, CellField<Vec3>& first, const CellField<Real>& q,
                       const BoundaryField<Real>& q_b, const GradientStencil& stencil,
                       const Mesh& mesh) {
  const FaceWeights& weights = stencil.weights;
  if (!weights.skewed) return gradient(grad, q, q_b, stencil, mesh);
  gradient(first, q, q_b, stencil, mesh);
  grad.fill({});
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    const Real lambda = weights.lambda[f], rise = q[N] - q[P];
    const Real rest = dot((1 - lambda) * first[P] + lambda * first[N], weights.skew[f]);
    grad[P] += (lambda * rise + rest) * mesh.Sf[f];
    grad[N] += ((1 - lambda) * rise - rest) * mesh.Sf[f];
  }
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
    const Index P = mesh.owner[f], b = f - mesh.n_internal;
    const Real rise = stencil.given[b] != 0 ? q_b[b] - q[P] : dot(first[P], mesh.d[f]);
    grad[P] += rise * mesh.Sf[f];
  }
  for (Index c = 0; c < mesh.n_owned; ++c) grad[c] *= 1 / mesh.V[c];
  mesh.halo.update(grad);
}

void add_skewness(CellField<Vec3>& sum, const CellField<Vec3>& first,
                  const GradientStencil& stencil, const Mesh& mesh, std::span<const Index> cells) {
  for (const Index c : cells) sum[c] += skewness(first, stencil, mesh, c);
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
      if (f >= mesh.n_internal)
        sum += outer(u_b[f - mesh.n_internal] - u[c], stencil.owner[f]);
      else if (mesh.owner[f] == c)
        sum += outer(u[mesh.neighbour[f]] - u[c], stencil.owner[f]);
      else
        sum += outer(u[mesh.owner[f]] - u[c], stencil.neighbour[f]);
    }
    L[c] = sum;
  }
}

}  // namespace fsi
