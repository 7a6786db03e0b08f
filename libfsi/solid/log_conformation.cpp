#include "libfsi/solid/log_conformation.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/solid/alternation.hpp"
#include "libfsi/solid/interface_gradient.hpp"
#include "libfsi/solid/koren.hpp"
#include "libfsi/solid/log_tensor.hpp"
#include "libfsi/solid/one_sided.hpp"
#include "libfsi/solid/reference_map.hpp"
#include "libfsi/solid/solenoidal.hpp"
#include "libfsi/solid/work_bound.hpp"

namespace fsi::solid {
namespace {

/// (t : t / 2)^1/2, in a simple shear its rate.
Real size(const SymTensor& t) { return std::sqrt(contract(t, t) / 2); }

/// psi_delta, which corrects a face value for the skewness delta of its face. d leads from the
/// upwind cell to the other, and g is the mean of both cells' gradients:
///   g . delta - beta (step - g . d),   beta = |delta| / |d|, at most 1/2.
/// Here step = psi_down - psi_up. With the upwind cell's gradient in place of g, psi grows where
/// cells are small compared with their neighbours. Without the second part, which is of third
/// order, psi still grows slowly (tests/verification/tets/strain_test.cpp).
SymTensor for_skewness(const SymTensor& step, const SymGradient& up, const SymGradient& down,
                       const Vec3& s, const Vec3& d) {
  const Real b = std::min(0.5, norm(s) / norm(d));
  return 0.5 * (along(up, s + b * d) + along(down, s + b * d)) + (-b) * step;
}

/// Whether L of cell c is that of the simplex zone.
bool by_fit(const FlowSnapshot& snapshot, Index c) {
  return snapshot.one_sided != nullptr && snapshot.one_sided->zone().has(c);
}

}  // namespace

LogConformation::LogConformation(const Mesh& mesh, const SymmetryFaces& symmetry)
    : psi(mesh), mesh_(mesh), known_(mesh), extension_(mesh, symmetry) {}

void LogConformation::set_undeformed(const CellField<Real>& alpha) {
  psi.fill({});
  mark(alpha);
}

void LogConformation::resume(const CellField<Real>& alpha, CellField<SymGradient>& grad) {
  mark(alpha);
  extension_.linear(psi, grad);
}

SymTensor LogConformation::isochoric(SymTensor p) const {
  if (mesh_.dim == 3) return dev(p);
  const Real m = (p.xx + p.yy) / 2;
  p.xx -= m, p.yy -= m, p.zz = 0;
  return p;
}

void LogConformation::set_L(const CellField<Real>& alpha, const FlowSnapshot& snapshot, Real dt) {
  // Cells with a film have no psi of their own, but they move with the solid.
  const CellField<Real>& moving = snapshot.cuts ? snapshot.cuts->alpha : alpha;
  const auto known = [&](Index c) { return moving[c] >= alpha_known; };
  const auto inner = [&](Index c) { return extension_.inner(c); };
  const auto u_at = [&](Index f) -> const Vec3* {
    if (extension_.symmetry().has(f, mesh_)) return nullptr;  // the cell has an image there
    const Index b = f - mesh_.n_internal;
    return snapshot.contact && snapshot.contact->touched[b] ? &snapshot.contact->u_b[b] : nullptr;
  };
  // For T the bound takes log B, advanced by half a step with the unbounded L.
  const auto bounded = [&](const Tensor& L, Index c) {
    if (snapshot.cuts == nullptr) return L;
    const Tensor excess = excess_of_work(L, snapshot, alpha, extension_, mesh_, c);
    return bound_by_work(L, excess, psi[c] + (dt / 2) * log_rate(L, psi[c]));
  };
  const auto of_own_side = [&](Index c) {
    const SymmetryFaces& symmetry = extension_.symmetry();
    const Tensor L =
        one_sided_gradient(snapshot.L, snapshot.u, known, inner, u_at, mesh_, c, symmetry);
    return remove_normal_divergence(L, alpha, mesh_, c, symmetry);
  };
  L_.clear();
  for (const Index c : known_.core()) {
    const bool fitted = by_fit(snapshot, c);
    const Tensor L = fitted     ? snapshot.one_sided->strain()[c]
                     : inner(c) ? flux_consistent_gradient(snapshot, mesh_, c)
                                : of_own_side(c);
    const bool wedged = fitted && snapshot.one_sided->near_wall(c);
    L_.push_back(!inner(c) || wedged ? bounded(L, c) : L);
  }
}

Real LogConformation::rate(const FlowSnapshot& snapshot, CellField<SymGradient>& grad) {
  const std::vector<Index>& cells = known_.core();
  const FaceWeights& weights = snapshot.weights;
  gradient(grad, psi, snapshot.stencil, extension_.symmetry(), mesh_, extension_.inside());
  for (const Index c : extension_.last_ring()) grad[c] = {};
  mesh_.halo.update(grad, extension_.near());
  Real fastest = 0;
  rate_.clear();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Index c = cells[i];
    //   -(1/V) sum_f phi_f (psi_f - psi_c),
    //   psi_f = psi_up + lambda_up Ko(varrho) (psi_down - psi_up) + psi_delta,   lambda_up: share
    SymTensor sum;
    for (const Index f : mesh_.cell_faces[c]) {
      if (f >= mesh_.n_internal) continue;
      const Index P = mesh_.owner[f], N = mesh_.neighbour[f];
      const bool forward = snapshot.phi[f] >= 0;
      const Index up = forward ? P : N, down = forward ? N : P;
      const Real share = forward ? weights.lambda[f] : 1 - weights.lambda[f];
      const Vec3 d = forward ? mesh_.d[f] : -mesh_.d[f];
      SymTensor face = psi[up] + (2 * share) * koren(psi[down] - psi[up], along(grad[up], d));
      if (weights.place[f] >= 0)
        face += for_skewness(psi[down] - psi[up], grad[up], grad[down], weights.skew[f], d);
      sum += (P == c ? snapshot.phi[f] : -snapshot.phi[f]) * (face - psi[c]);
    }
    const SymTensor strain = log_rate(L_[i], psi[c]);
    if (extension_.inner(c)) fastest = std::max(fastest, size(strain));
    rate_.push_back(strain - (1 / mesh_.V[c]) * sum);
  }
  for (const Index c : extension_.inside()) grad[c] = {};
  return fastest;
}

void LogConformation::recall(const FlowSnapshot& snapshot, Real dt) {
  constexpr Real by_flow = 0.2;
  constexpr Real by_wave = 0.05;  // waves along the surface grow at a rate of up to 0.01 c_s / h
  // In the zone of triangles the memory's B is rougher, since its fits take twelve neighbours, and
  // the filter damps the waves.
  const Real by_wave_in_zone = recall_in_zone(mesh_.dim);
  const Real by_flow_in_zone = mesh_.dim == 3 ? by_flow : 0.05;
  const ReferenceMap& memory = *snapshot.memory;
  for (const Index c : known_.core()) {
    const bool fit = by_fit(snapshot, c);
    // In a cell at a wall the map's gradient is one-sided, and that of the velocity is not. Stress
    // from the map would push such a cell farther off.
    if (!fit && extension_.inner(c) && memory.one_sided(c)) continue;
    const Real of_wave = fit ? by_wave_in_zone : by_wave;
    const Real rate = (fit ? by_flow_in_zone : by_flow) * courant_rate(snapshot.phi, mesh_, c) +
                      of_wave * snapshot.wave_speed / cell_size(mesh_, c);
    const Real part = memory.trust(c) * (1 - std::exp(-dt * rate));
    if (memory.is_set[c] > 0 && part > 0) psi[c] += part * (log(memory.B(c, 1)) - psi[c]);
  }
}

Real LogConformation::advance(const FlowSnapshot& snapshot, Real dt, CellField<SymGradient>& grad) {
  const std::vector<Index>& core = known_.core();
  old_.clear();
  for (const Index c : core) old_.push_back(psi[c]);
  for (std::size_t i = 0; i < core.size(); ++i) psi[core[i]] += dt * rate_[i];
  // The rings are extrapolated for this stage too. Strained by the fluid's L, they would act back
  // on the solid through the faces with inflow.
  extension_.linear(psi, grad);
  const Real fastest = rate(snapshot, grad);
  for (std::size_t i = 0; i < core.size(); ++i)
    psi[core[i]] = isochoric(0.5 * (old_[i] + psi[core[i]] + dt * rate_[i]));
  if (snapshot.memory) recall(snapshot, dt);
  if (snapshot.one_sided)
    extension_.fourth_difference_filter(psi, grad, snapshot.one_sided->zone().cells(),
                                        snapshot.wave_speed, snapshot.recovery, dt);
  extension_.linear(psi, grad);
  return fastest;
}

Strain LogConformation::transport(const CellField<Real>& alpha, const FlowSnapshot& snapshot,
                                  Real dt, CellField<SymGradient>& grad) {
  set_L(alpha, snapshot, dt);
  return in_parts(
      dt, [&] { return rate(snapshot, grad); },
      [&](Real part) { return advance(snapshot, part, grad); });
}

Real LogConformation::update_B(CellField<SymTensor>& B, CellField<Real>& lambda,
                               const CellField<Real>& alpha, const Band& band) {
  // B holds log B at first.
  for (const Index c : known_.core()) B[c] = psi[c];
  extension_.constant(B, band.listed());
  Real least = 0;
  for (const Index c : band.cells()) {
    const Eigen e = eigen(B[c]);
    if (alpha[c] >= alpha_min) least = std::min(least, e.value[0]);
    B[c] = exp(e);
    lambda[c] = std::exp(e.value[2]);
  }
  return std::exp(least);
}

SymTensor LogConformation::B(Index c, Real /*alpha*/) const { return exp(psi[c]); }

}  // namespace fsi::solid
