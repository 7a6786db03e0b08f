#pragma once
// A bound for the strain of the solid's outermost cells, and of those near walls in the zone of
// simplices: the work that its force takes up.

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

/// M - L, where M is the gradient on which the elastic force works in known cell c. Let T be the
/// stress there and in what goes on with it around the solid. From a flow whose gradients are L and
/// those of the cells inside, ElasticForce takes W T : L, from u
///   W T : M,   W (M - L) = sum_f w [alpha_f e (x) S_f + (alpha' - alpha_f) (e . S_f) n (x) n],
///   e = u_N - u_P - L_f . d,   W = sum_f w alpha' d . S_f / dim.
/// L_f is the mean of L and that of an inner cell behind the face, else L. alpha' is that of both
/// cells and n the surface's normal. w is the cell's part of the face's stress, 1 where the other
/// cell goes on with it. M - L is zero where no face has a part of it. alpha: of what is known.
/// Between two viscosities in series the traction of T along the surface is mu_h / mu_s times as
/// large (SurfaceTraction). With v = u_N - u_P the sum gets, at inner faces,
///   w alpha_f (mu_h / mu_s - 1) (I - n n) . (v (x) S_f + S_f (x) v) . n (x) n.
/// Of both viscosities' exact kink, the cell takes up less than the force by (1 - alpha mu_h /
/// mu_s) |b|^2 alpha / mu_s, b the elastic traction: the bound leaves it as it is.
Tensor excess_of_work(const Tensor& L, const FlowSnapshot& snapshot, const CellField<Real>& alpha,
                      const Extension& extension, const Mesh& mesh, Index c);

/// L - chi T, chi = (-T : excess - |T| |D| / 10) / (T : T) from 0 to |D| / |T|. Gone is the part of
/// L by which the cell would take up more energy than the force takes from the flow. A tenth of |T|
/// |D|, the largest power of D, is left, since M is of first order there. So the strain of a
/// resolved slab is as exact as without the bound, and with twice as much waves grow on stiff
/// triangles. With more than |D| what is at rest would follow the noise of u around it.
inline Tensor bound_by_work(const Tensor& L, const Tensor& excess, const SymTensor& T) {
  const Tensor t{T.xx, T.xy, T.xz, T.xy, T.yy, T.yz, T.xz, T.yz, T.zz};
  constexpr Real allowed = 0.1;
  const Tensor D = 0.5 * (L + transpose(L));
  const Real square = power(T, t), most = std::sqrt(square * trace(dot(D, D)));
  const Real made = std::min(-power(T, excess) - allowed * most, most);
  return made > 0 && square > 0 ? L + (-made / square) * t : L;
}

}  // namespace fsi::solid
