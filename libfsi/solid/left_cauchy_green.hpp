#pragma once
// Kinematics of the solid: transport of Bt = alpha^(1/2) B, B the left Cauchy-Green tensor.

#include <span>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/gradient.hpp"

namespace fsi::solid {

/// Derivatives of a symmetric tensor along x, y, z.
struct SymGradient {
  SymTensor x, y, z;
};
/// Change along the vector d.
inline SymTensor along(const SymGradient& g, const Vec3& d) {
  return d.x * g.x + d.y * g.y + d.z * g.z;
}

/// Below this fraction of solid Bt is set to zero [Matsumiya25] 2.3: no stress there.
inline constexpr Real alpha_min = 0.1;

/// Gradient of T on the listed owned cells, with zero gradient at boundaries.
void gradient(CellField<SymGradient>& grad, const CellField<SymTensor>& T,
              const GradientStencil& stencil, const Mesh& mesh, std::span<const Index> cells);

/// Bt with B = I, the undeformed state, where alpha >= alpha_min. Halo set.
void set_undeformed(CellField<SymTensor>& Bt, const CellField<Real>& alpha, const Mesh& mesh);

/// d Bt/dt + div(u Bt) = L . Bt + Bt . L^T            [Matsumiya25] (10)
/// with linear-upwind face values and Heun's method over dt, phi and L frozen. Second order in
/// space; explicit. Works on the band of alpha at the end of the step.
class LeftCauchyGreen {
 public:
  explicit LeftCauchyGreen(const Mesh& mesh);

  /// Collective. Bt: owned and halo, of the start of the step, zero outside the band's last core.
  /// alpha, band: of its end. L: on the cells of the band's core. On return Bt is set on owned
  /// cells and halo, zero where alpha < alpha_min. grad: scratch.
  void transport(CellField<SymTensor>& Bt, const CellField<Real>& alpha, const FaceField<Real>& phi,
                 const CellField<Tensor>& L, const GradientStencil& stencil, const Band& band,
                 Real dt, CellField<SymGradient>& grad);

 private:
  void rate(const CellField<SymTensor>& Bt, const FaceField<Real>& phi, const CellField<Tensor>& L,
            const GradientStencil& stencil, const Band& band, CellField<SymGradient>& grad);

  const Mesh& mesh_;
  CellField<SymTensor> old_, rate_;
};

}  // namespace fsi::solid
