#include "libfsi/solid/left_cauchy_green.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libfsi/core/eigen.hpp"

namespace fsi::solid {
namespace {

/// L . B + B . L^T, symmetric.
SymTensor stretch(const Tensor& L, const SymTensor& B) {
  SymTensor r;
  r.xx = 2 * (L.xx * B.xx + L.xy * B.xy + L.xz * B.xz);
  r.yy = 2 * (L.yx * B.xy + L.yy * B.yy + L.yz * B.yz);
  r.zz = 2 * (L.zx * B.xz + L.zy * B.yz + L.zz * B.zz);
  r.xy = L.xx * B.xy + L.xy * B.yy + L.xz * B.yz + L.yx * B.xx + L.yy * B.xy + L.yz * B.xz;
  r.xz = L.xx * B.xz + L.xy * B.yz + L.xz * B.zz + L.zx * B.xx + L.zy * B.xy + L.zz * B.xz;
  r.yz = L.yx * B.xz + L.yy * B.yz + L.yz * B.zz + L.zx * B.xy + L.zy * B.yy + L.zz * B.yz;
  return r;
}

}  // namespace

LeftCauchyGreen::LeftCauchyGreen(const Mesh& mesh, SymmetryFaces symmetry)
    : Bt(mesh), mesh_(mesh), band_(mesh), symmetry_(std::move(symmetry)) {}

void LeftCauchyGreen::set_undeformed(const CellField<Real>& alpha) {
  for (Index c = 0; c < mesh_.n_cells; ++c)
    Bt[c] = alpha[c] >= alpha_min ? std::sqrt(alpha[c]) * identity() : SymTensor{};
  mark(alpha);
}

void LeftCauchyGreen::rate(const FlowSnapshot& snapshot, CellField<SymGradient>& grad) {
  gradient(grad, Bt, snapshot.stencil, symmetry_, mesh_, band_.cells());
  mesh_.halo.update(grad);
  rate_.clear();
  for (const Index c : band_.core()) {
    // -(1/V) sum_f phi_f (Bt_f - Bt_c), Bt_f = Bt_up + grad Bt_up . (x_f - x_up)
    SymTensor sum;
    for (const Index f : mesh_.cell_faces[c]) {
      if (f >= mesh_.n_internal)
        continue;  // only fluid flows in; a solid that leaves has the value of its cell
      const Real phi = snapshot.phi[f];
      const Index up = phi >= 0 ? mesh_.owner[f] : mesh_.neighbour[f];
      const SymTensor face = Bt[up] + along(grad[up], mesh_.face_centre(f, up) - mesh_.C[up]);
      sum += (mesh_.owner[f] == c ? phi : -phi) * (face - Bt[c]);
    }
    rate_.push_back(stretch(snapshot.L[c], Bt[c]) - (1 / mesh_.V[c]) * sum);
  }
}

Strain LeftCauchyGreen::transport(const CellField<Real>& alpha, const FlowSnapshot& snapshot,
                                  Real dt, CellField<SymGradient>& grad) {
  const std::vector<Index>& core = band_.core();
  old_.clear();
  for (const Index c : core) old_.push_back(Bt[c]);
  rate(snapshot, grad);
  for (std::size_t i = 0; i < core.size(); ++i) Bt[core[i]] += dt * rate_[i];
  mesh_.halo.update(Bt);
  rate(snapshot, grad);
  for (std::size_t i = 0; i < core.size(); ++i)
    Bt[core[i]] = 0.5 * (old_[i] + Bt[core[i]] + dt * rate_[i]);
  for (const Index c : band_.last_core())
    if (alpha[c] < alpha_min) Bt[c] = {};
  mesh_.halo.update(Bt);
  return {};
}

Real LeftCauchyGreen::update_B(CellField<SymTensor>& B, CellField<Real>& lambda,
                               const CellField<Real>& alpha, const Band& band) const {
  for (const Index c : band.core()) {
    const bool strain_cells = alpha[c] >= alpha_min;
    B[c] = strain_cells ? (1 / std::sqrt(alpha[c])) * Bt[c] : SymTensor{};
    lambda[c] = strain_cells ? eigen(B[c]).value[2] : 0;
  }
  return 1;
}

SymTensor LeftCauchyGreen::B(Index c, Real alpha) const {
  return alpha >= alpha_min ? (1 / std::sqrt(alpha)) * Bt[c] : identity();
}

}  // namespace fsi::solid
