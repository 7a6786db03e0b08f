#include "libfsi/solid/map_extension.hpp"

#include "libfsi/operators/least_squares.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi::solid {

Tensor MapExtension::regression(Index c, int up_to_ring) const {
  SymTensor M;
  Tensor R;
  for_neighbours_and_images(c, symmetry_, mesh_, [&](Index k, const Vec3& r, const Reflection& n) {
    if (!rings_.within(up_to_ring, k)) return;
    const Real w = 1 / norm2(r);
    M += w * square(r);
    R += w * outer(image(item_[k].d, n) - item_[c].d, r);
  });
  for (const Index f : mesh_.cell_faces[c])
    if (held(f)) {
      const Real w = 1 / norm2(mesh_.d[f]);
      M += w * square(mesh_.d[f]);
      R += w * outer(-item_[c].d, mesh_.d[f]);
    }
  return M == SymTensor{} ? Tensor{} : dot(R, raised_inverse(M, mesh_.dim));
}

MapExtension::Item MapExtension::fit(Index c, int ring) const {
  // With W = sum w, m = sum w r / W and e = sum w xihat / W: xihat_c = e - Gamma . m and
  //   Gamma (sum w r (x) r - W m (x) m + n I) = sum w xihat (x) r - W e (x) m + sum Gamma_k
  Real W = 0;
  Vec3 m, e;
  SymTensor M;
  Tensor R;
  for_neighbours_and_images(c, symmetry_, mesh_, [&](Index k, const Vec3& r, const Reflection& n) {
    if (!rings_.within(ring - 1, k)) return;
    const Real w = 1 / norm2(r);
    const Vec3 d = image(item_[k].d, n);
    W += w, m += w * r, e += w * d;
    M += w * square(r) + identity();
    R += w * outer(d, r) + image(item_[k].g, n);
  });
  for (const Index f : mesh_.cell_faces[c])
    if (held(f)) {  // xihat = 0
      const Real w = 1 / norm2(mesh_.d[f]);
      W += w, m += w * mesh_.d[f], M += w * square(mesh_.d[f]);
    }
  m *= 1 / W, e *= 1 / W;
  const Tensor g = dot(R + -W * outer(e, m), raised_inverse(M - W * square(m), mesh_.dim));
  return {e - dot(g, m), g};
}

void MapExtension::apply(CellField<Vec3>& d, CellField<Real>& is_set, const Band& known) {
  rings_.list(known.core(), known.around_halo());
  for (const Index c : rings_.ring(0)) item_[c].d = d[c];
  mesh_.halo.update(item_, rings_.number());
  for (const Index c : rings_.ring(0)) item_[c].g = regression(c, 0);
  mesh_.halo.update(item_, rings_.number());
  for (int i = 1; i <= Rings::count; ++i) {
    for (const Index c : rings_.ring(i)) item_[c] = fit(c, i);
    mesh_.halo.update(item_, rings_.number());
  }
  for (const Index c : rings_.before()) d[c] = {}, is_set[c] = 0;
  for (const Index c : rings_.all()) d[c] = item_[c].d, is_set[c] = 1;
  mesh_.halo.update(d);
  mesh_.halo.update(is_set);
}

}  // namespace fsi::solid
