#pragma once
// The jump of the pressure at the surface, moved with the surface.

#include <span>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/symmetry_faces.hpp"

namespace fsi::solid {

/// Moves the jump with the surface on the listed owned cells:
///   p_c += s d alpha_c,   s = m . G dev(T) . m,   d alpha = 2 (alpha - alpha_mid).
/// m is the normal of the surface, alpha_mid the mean of alpha before and after the step. A cell
/// that fills with solid so gets the pressure of the solid, which balances the normal part s of its
/// stress (ElasticForce). A cell that the solid leaves gets that of the fluid. T is that before the
/// motion, set around the solid too, and m is that after it. The jump from two viscosities is not
/// moved. alpha: owned and halo.
///
/// Without this the old jump would accelerate the cells that the surface has passed. The projection
/// corrects cells by the averaged gradient of the increment and fluxes by the compact one. So
/// velocities and fluxes would differ by dt s / (rho h).
void advect_pressure_jump(CellField<Real>& p, const CellField<Real>& alpha_mid,
                          const CellField<Real>& alpha, const CellField<SymTensor>& T, Real G,
                          const Mesh& mesh, std::span<const Index> cells,
                          const SymmetryFaces& symmetry = {});

}  // namespace fsi::solid
