#pragma once
// Elastic stress of a neo-Hookean solid and the force it puts into the momentum equation.

#include "libfsi/field/band.hpp"
#include "libfsi/solid/carrier.hpp"

namespace fsi::solid {

/// What the law makes a stress of.
struct Strained {
  const CellField<SymTensor>& B;     ///< on the band's cells, zero elsewhere; owned and halo
  const CellField<Real>& alpha;      ///< owned and halo
  const FaceField<Real>* alpha_f{};  ///< part of solid at the band's faces; B is then known around
                                     ///< the solid as well. None: from alpha B of the cells
  bool along_normal = false;         ///< the face flux is balanced along the surface's normal
};

/// Force of the elastic stress, and its counterpart in the balanced face flux.
class NeoHookean {
 public:
  NeoHookean(const Mesh& mesh, Real G);

  /// Collective. tau = G dev(alpha B)                                     [Matsumiya25] (11)
  /// force_c = (1/V) sum_f tau_f . S_f, tau_f = alpha_f G dev B_f with B_f linear between cells, or
  /// without alpha_f alpha B linear between cells, as in the paper; with skewness correction.
  /// At boundaries alpha B continues linearly.
  /// balance_f = (s_N - s_P) - (grad s)_f . d, s = n . tau . n along d, which vanishes for a linear
  /// stress. With along_normal n is that of the surface, along grad alpha, where that is near:
  /// where tau jumps the pressure jumps by m . tau . m, m normal to the surface, and what
  /// n . tau . n with another n has besides, up to |tau|, drives a flux through the face.
  /// Zero outside the band of this and of the last call. force: owned and halo.
  /// grad: scratch that nothing but the solid writes to, zero at first.
  void apply(CellField<Vec3>& force, FaceField<Real>& balance, const Strained& solid,
             const FaceWeights& weights, const GradientStencil& stencil, const Band& band,
             CellField<SymGradient>& grad);

  Real G() const { return G_; }

 private:
  void clear(CellField<Vec3>& force, FaceField<Real>& balance, CellField<SymGradient>& grad,
             const Band& band);
  void set_slope(const CellField<Real>& alpha, const GradientStencil& stencil, const Band& band);
  void push(CellField<Vec3>& force, const Strained& solid, const FaceWeights& weights,
            const Band& band, const CellField<SymGradient>& grad) const;

  const Mesh& mesh_;
  Real G_;
  CellField<Vec3> slope_;                       // grad alpha, for along_normal
  std::vector<Index> last_cells_, last_faces_;  // where something was written
};

}  // namespace fsi::solid
