#pragma once
// The bound by the work: L of the outermost cells, and of known cells near walls of the simplex
// zone, stores no more energy than the elastic force takes from the flow.

#include <algorithm>
#include <cmath>

#include "libfsi/field/field.hpp"
#include "libfsi/solid/extension.hpp"
#include "libfsi/solid/flow_snapshot.hpp"

namespace fsi::solid {

/// T : L, the power of the stress T per volume.
constexpr Real power(const SymTensor& T, const Tensor& L) {
  return T.xx * L.xx + T.yy * L.yy + T.zz * L.zz + T.xy * (L.xy + L.yx) + T.xz * (L.xz + L.zx) +
         T.yz * (L.yz + L.zy);
}

/// L* - L, where L* is the velocity gradient on which the elastic force works in known cell c. Let
/// T be the stress in the cell and in the unknown cells to which it is extrapolated. From a flow
/// with the gradient L in the cell and those of the inner cells beside it, ElasticForce takes
/// V* T : L per time. From u it takes V* T : L*, with
///   V* (L* - L) = sum_f w_f [alpha_f Delta_f (x) S_f
///                            + (alphabar_f - alpha_f) (Delta_f . S_f) m (x) m],
///   V* = sum_f w_f alphabar_f d . S_f / dim,   Delta_f = u_N - u_P - L_f . d.
/// If the cell beyond the face is an inner one, L_f is the mean of L and of its gradient, else L.
/// alphabar_f is the mean of alpha of both cells, m the normal of the surface. w_f is the share of
/// the cell in the stress of the face, and 1 if the cell beyond is not known. Without such faces
/// the result is zero. alpha: the fraction that decides which cells are known.
///
/// Between two viscosities in series the elastic traction b = (T . m)_t along the surface acts with
/// the factor mu_h / mu_s (SurfaceTraction). At inner faces the sum then gets, with v = u_N - u_P,
///   w_f alpha_f (mu_h / mu_s - 1) (I - m m) . (v (x) S_f + S_f (x) v) . m (x) m.
/// In the exact flow with a kink, the cell stores less than the force takes, by
/// (1 - alpha mu_h / mu_s) |b|^2 alpha / mu_s. The bound leaves its L unchanged.
Tensor excess_of_work(const Tensor& L, const FlowSnapshot& snapshot, const CellField<Real>& alpha,
                      const Extension& extension, const Mesh& mesh, Index c);

/// L - zeta T,   zeta = (T : (L - L*) - |T| |D| / 10) / (T : T), limited to 0 to |D| / |T|. excess:
/// L* - L. Without this part of L the cell stores no more energy than the force takes from the
/// flow. L* is of first order, so a tenth of |T| |D|, the largest power of D, is tolerated. With it
/// the strain of a resolved slab is as exact as without the bound. With two tenths, waves grow on
/// stiff triangles. If zeta could exceed |D| / |T|, a solid at rest would strain with the noise of
/// u around it.
inline Tensor bound_by_work(const Tensor& L, const Tensor& excess, const SymTensor& T) {
  const Tensor t{T.xx, T.xy, T.xz, T.xy, T.yy, T.yz, T.xz, T.yz, T.zz};
  constexpr Real allowed = 0.1;
  const Tensor D = 0.5 * (L + transpose(L));
  const Real square = power(T, t), most = std::sqrt(square * trace(dot(D, D)));
  const Real made = std::min(-power(T, excess) - allowed * most, most);
  return made > 0 && square > 0 ? L + (-made / square) * t : L;
}

}  // namespace fsi::solid
