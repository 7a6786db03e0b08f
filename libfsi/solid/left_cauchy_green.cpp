#include "libfsi/solid/left_cauchy_green.hpp"

#include <cmath>

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

void gradient(CellField<SymGradient>& grad, const CellField<SymTensor>& T,
              const GradientStencil& stencil, const Mesh& mesh, std::span<const Index> cells) {
  for (const Index c : cells) {
    SymGradient sum;
    for (const Index f : mesh.cell_faces[c]) {
      if (f >= mesh.n_internal) continue;
      const bool owner = mesh.owner[f] == c;
      const SymTensor dT = T[owner ? mesh.neighbour[f] : mesh.owner[f]] - T[c];
      const Vec3& g = owner ? stencil.owner[f] : stencil.neighbour[f];
      sum.x += g.x * dT, sum.y += g.y * dT, sum.z += g.z * dT;
    }
    grad[c] = sum;
  }
}

void set_undeformed(CellField<SymTensor>& Bt, const CellField<Real>& alpha, const Mesh& mesh) {
  for (Index c = 0; c < mesh.n_cells; ++c)
    Bt[c] = alpha[c] >= alpha_min ? std::sqrt(alpha[c]) * identity() : SymTensor{};
}

LeftCauchyGreen::LeftCauchyGreen(const Mesh& mesh) : mesh_(mesh), old_(mesh), rate_(mesh) {}

void LeftCauchyGreen::rate(const CellField<SymTensor>& Bt, const FaceField<Real>& phi,
                           const CellField<Tensor>& L, const GradientStencil& stencil,
                           const Band& band, CellField<SymGradient>& grad) {
  gradient(grad, Bt, stencil, mesh_, band.cells());
  mesh_.halo.update(grad);
  for (const Index c : band.core()) {
    // -(1/V) sum_f phi_f (Bt_f - Bt_c), Bt_f = Bt_up + grad Bt_up . (x_f - x_up)
    SymTensor sum;
    for (const Index f : mesh_.cell_faces[c]) {
      if (f >= mesh_.n_internal)
        continue;  // nothing flows in but fluid; what leaves keeps its value
      const bool owner = mesh_.owner[f] == c;
      const Real out = owner ? phi[f] : -phi[f];
      const Index up = phi[f] >= 0 ? mesh_.owner[f] : mesh_.neighbour[f];
      const SymTensor face = Bt[up] + along(grad[up], mesh_.face_centre(f, up) - mesh_.C[up]);
      sum += out * (face - Bt[c]);
    }
    rate_[c] = stretch(L[c], Bt[c]) - (1 / mesh_.V[c]) * sum;
  }
}

void LeftCauchyGreen::transport(CellField<SymTensor>& Bt, const CellField<Real>& alpha,
                                const FaceField<Real>& phi, const CellField<Tensor>& L,
                                const GradientStencil& stencil, const Band& band, Real dt,
                                CellField<SymGradient>& grad) {
  for (const Index c : band.core()) old_[c] = Bt[c];
  rate(Bt, phi, L, stencil, band, grad);
  for (const Index c : band.core()) Bt[c] += dt * rate_[c];
  mesh_.halo.update(Bt);
  rate(Bt, phi, L, stencil, band, grad);
  for (const Index c : band.core()) Bt[c] = 0.5 * (old_[c] + Bt[c] + dt * rate_[c]);
  for (const Index c : band.last_core())
    if (alpha[c] < alpha_min) Bt[c] = {};
  mesh_.halo.update(Bt);
}

}  // namespace fsi::solid
