#pragma once
// The jump of the pressure at the surface, carried on with it.

#include <span>

#include "libfsi/field/field.hpp"

namespace fsi::solid {

/// Takes the jump along with the surface on the listed owned cells:
///   p_c += s d alpha_c,   s = m . G dev(T) . m,   d alpha = 2 (alpha - alpha_mid).
/// m is the normal of the surface, alpha_mid the mean of before and after. A cell that the solid
/// takes gets the solid's pressure, which bears the normal part s of its stress (ElasticForce). A
/// cell that the solid leaves gets the fluid's. T, around the solid too, is that before, as the
/// jump is; m is that after. What two viscosities add to the jump stays behind. alpha: owned and
/// halo.
///
/// Left where it was, the jump pushes at the cells that the surface has passed. What the projection
/// takes off again is the increment's averaged gradient in the cells and its compact one in the
/// fluxes. So cells and fluxes part by dt s / (rho h).
void advect_pressure_jump(CellField<Real>& p, const CellField<Real>& alpha_mid,
                          const CellField<Real>& alpha, const CellField<SymTensor>& T, Real G,
                          const Mesh& mesh, std::span<const Index> cells);

}  // namespace fsi::solid
