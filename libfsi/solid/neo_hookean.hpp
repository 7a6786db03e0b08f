#pragma once
// Elastic stress of a neo-Hookean solid and the force it puts into the momentum equation.

#include "libfsi/solid/left_cauchy_green.hpp"

namespace fsi::solid {

/// Force of the elastic stress, and its counterpart in the balanced face flux.
class NeoHookean {
 public:
  NeoHookean(const Mesh& mesh, Real G);

  /// Collective. tau_c = alpha^(1/2) G dev(Bt)                            [Matsumiya25] (11)
  /// force_c = (1/V) sum_f tau_f . S_f, tau_f linear between cells with skewness correction, the
  /// cell's own at boundaries;
  /// balance_f = (s_N - s_P) - (grad s)_f . d, s = n . tau . n along d, which vanishes for a linear
  /// stress. Zero outside the band of this and of the last call. force: owned and halo.
  /// grad: scratch that nothing but the solid writes to, zero at first.
  void apply(CellField<Vec3>& force, FaceField<Real>& balance, const CellField<SymTensor>& Bt,
             const CellField<Real>& alpha, const FaceWeights& weights,
             const GradientStencil& stencil, const Band& band, CellField<SymGradient>& grad);

  Real G() const { return G_; }

 private:
  const Mesh& mesh_;
  Real G_;
  CellField<SymTensor> tau_;
  std::vector<Index> last_cells_, last_faces_;  // where something was written
};

/// Largest step that resolves the elastic shear wave: 0.8 h (rho / (G lambda))^(1/2) over the
/// cells, h = V / max |Sf|, lambda = alpha times the largest eigenvalue of B, at least 1.
/// [Matsumiya25] (15) This rank's cells only.
Real elastic_dt(const CellField<SymTensor>& Bt, const CellField<Real>& alpha, Real G, Real rho,
                const Mesh& mesh, std::span<const Index> cells);

/// B of a cell: Bt / alpha^(1/2), the unit tensor where alpha < alpha_min.
SymTensor B_of(const SymTensor& Bt, Real alpha);

}  // namespace fsi::solid
