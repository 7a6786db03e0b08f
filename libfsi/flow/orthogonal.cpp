#include "libfsi/flow/orthogonal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi::flow {
namespace {

/// out_c = -sum_f phi_f of owned cells.
void set_inflow(std::vector<Real>& out, const FaceField<Real>& phi, const Mesh& mesh) {
  for (Index c = 0; c < mesh.n_owned; ++c) out[c] = -net_outflow(phi, mesh, c);
}

/// Sums over the cells of all ranks of a b and of a a.
std::array<Real, 2> products(const std::vector<Real>& a, std::span<const Real> b) {
  std::array<Sum, 2> parts;
  for (std::size_t c = 0; c < a.size(); ++c) parts[0].add(a[c] * b[c]), parts[1].add(a[c] * a[c]);
  std::array<Real, 2> totals{};
  Sum::totals(totals, parts);
  return totals;
}

}  // namespace

void face_means(std::vector<Tensor>& g_f, const CellField<Tensor>& L, const FaceWeights& weights,
                const Mesh& mesh) {
  for (std::size_t i = 0; i < weights.irregular.size(); ++i)
    if (const Index f = weights.irregular[i]; f < mesh.n_internal)
      g_f[i] = face_mean(L, f, weights, mesh);
}

Orthogonal::Orthogonal(const Mesh& mesh, const GradientStencil& stencil,
                       const std::vector<Condition>& conditions)
    : mesh_(mesh),
      stencil_(stencil),
      slips_(faces_where(conditions, mesh, lets_slip)),
      L_(mesh),
      L_f_(stencil.weights.irregular.size()),
      u_b_(mesh),
      z_(mesh),
      direction_(mesh),
      slope_(mesh),
      flux_(mesh),
      r_(static_cast<std::size_t>(mesh.n_owned)),
      Md_(r_.size()) {}

void Orthogonal::set_flux(FaceField<Real>& phi, const CellField<Vec3>& u) {
  const FaceWeights& weights = stencil_.weights;
  phi.fill(0);
  for (Index f = 0; f < mesh_.n_internal; ++f)
    phi[f] = dot(mirror_mean(u, f, weights, mesh_), mesh_.Sf[f]);
  if (!weights.uneven) return;
  for (Index f = mesh_.n_internal; f < mesh_.n_faces; ++f) {
    const Vec3 &S = mesh_.Sf[f], &u_P = u[mesh_.owner[f]];
    const Index b = f - mesh_.n_internal;
    u_b_[b] = slips_[b] != 0 ? u_P - (dot(u_P, S) / norm2(S)) * S : Vec3{};
  }
  gradient(L_, u, u_b_, stencil_, mesh_);
  face_means(L_f_, L_, weights, mesh_);
  for (std::size_t i = 0; i < weights.irregular.size(); ++i)
    if (const Index f = weights.irregular[i]; f < mesh_.n_internal)
      phi[f] += dot(dot(L_f_[i], weights.from_mirror(f, mesh_)), mesh_.Sf[f]);
}

// The part of L_f . delta in V calG p, delta = delta_1-lambda, with p_N - p_P at the faces in place
// of the flux:
//   T_c = sum_f lambda_cf (p_N - p_P) S (x) delta,
//   V calG p_n += T_c . g_cf,   V calG p_c -= T_c . g_cf.
// Cell n lies beyond face f of c, lambda_cf is the weight of c in L_f, g_cf that of f in L_c. At a
// face that slips only the normal part of u_b - u_c = -(u_c . n) n depends on u_c.
void Orthogonal::add_skewed(CellField<Vec3>& grad, const CellField<Real>& p) {
  const FaceWeights& weights = stencil_.weights;
  L_.fill({});
  for (const Index f : weights.irregular) {
    if (f >= mesh_.n_internal) break;
    const Index P = mesh_.owner[f], N = mesh_.neighbour[f];
    const Tensor T = outer((p[N] - p[P]) * mesh_.Sf[f], weights.from_mirror(f, mesh_));
    L_[P] += (1 - weights.lambda[f]) * T;
    L_[N] += weights.lambda[f] * T;
  }
  for (Index f = 0; f < mesh_.n_faces; ++f) {
    const Index P = mesh_.owner[f];
    if (f >= mesh_.n_internal) {
      const Vec3 S = mesh_.Sf[f], back = dot(L_[P], stencil_.owner[f]);
      grad[P] -= slips_[f - mesh_.n_internal] != 0 ? (dot(back, S) / norm2(S)) * S : back;
      continue;
    }
    const Index N = mesh_.neighbour[f];
    Vec3 rest;
    if (P < mesh_.n_owned) rest += dot(L_[P], stencil_.owner[f]);
    if (N < mesh_.n_owned) rest -= dot(L_[N], stencil_.neighbour[f]);
    grad[N] += rest;
    grad[P] -= rest;
  }
  mesh_.halo.add_to_owner(reinterpret_cast<Real*>(grad.data()), components<Vec3>);
}

// V calG p = sum_f lambda_cf (p_N - p_P) S, lambda_cf the weight of c in Phi, and the part of L_f
void Orthogonal::set_gradient(CellField<Vec3>& grad, const CellField<Real>& p) {
  const FaceWeights& weights = stencil_.weights;
  grad.fill({});
  if (weights.uneven) add_skewed(grad, p);
  for (Index f = 0; f < mesh_.n_internal; ++f) {
    const Index P = mesh_.owner[f], N = mesh_.neighbour[f];
    const Vec3 rise = (p[N] - p[P]) * mesh_.Sf[f];
    grad[P] += weights.lambda[f] * rise;
    grad[N] += (1 - weights.lambda[f]) * rise;
  }
  for (Index c = 0; c < mesh_.n_owned; ++c) grad[c] *= 1 / mesh_.V[c];
  mesh_.halo.update(grad);
}

// -M q = -div phi by conjugate gradients, r = -div(phi - Phi(calG q)); -M has no negative
// eigenvalue
int Orthogonal::project(FaceField<Real>& phi, CellField<Real>& q, CellField<Vec3>& grad_q,
                        LinearSystem& compact, Real absolute) {
  constexpr int most = 100;
  q.fill(0), grad_q.fill({}), direction_.fill(0);
  set_inflow(r_, phi, mesh_);
  Real last = 0, enough = 0;
  for (int i = 0; i <= most; ++i) {
    compact.precondition(z_, r_);
    const auto [rz, rr] = products(r_, z_.owned());
    if (i == 0) enough = std::max(tolerance * std::sqrt(rr), absolute);
    if (std::sqrt(rr) <= enough) return i;
    if (!std::isfinite(rr))
      throw Error(ErrorKind::numerics, "the flux to be projected is not finite");
    if (i == most) break;
    const Real beta = i == 0 ? 0 : rz / last;
    last = rz;
    for (Index c = 0; c < mesh_.n_cells; ++c) direction_[c] = z_[c] + beta * direction_[c];
    set_gradient(slope_, direction_);
    set_flux(flux_, slope_);
    set_inflow(Md_, flux_, mesh_);
    const Real a = rz / products(Md_, direction_.owned())[0];
    for (Index c = 0; c < mesh_.n_cells; ++c) {
      q[c] += a * direction_[c];
      grad_q[c] += a * slope_[c];
    }
    for (Index f = 0; f < mesh_.n_faces; ++f) phi[f] -= a * flux_[f];
    for (Index c = 0; c < mesh_.n_owned; ++c) r_[c] -= a * Md_[c];
  }
  throw Error(ErrorKind::numerics, "the orthogonal projection did not converge in " +
                                       std::to_string(most) +
                                       " iterations; take -flow_projection compact");
}

}  // namespace fsi::flow
