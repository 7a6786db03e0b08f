#include "libfsi/solid/body_force.hpp"

namespace fsi::solid {

void BodyForce::apply(CellField<Vec3>& force, FaceField<Real>& balance,
                      const FaceField<Real>& alpha_f, const FaceWeights& weights,
                      const GradientStencil& stencil, const Band& band) {
  for (const Index c : last_cells_) f_[c] = {};
  last_cells_ = band.cells();
  for (const Index c : band.cells()) {
    // f_c = sum_f g_cf F_f, F_f = alpha_f a . d outward
    Vec3 sum;
    for (const Index f : mesh_.cell_faces[c]) {
      const Real F = alpha_f[f] * dot(a_, mesh_.d[f]);
      sum += mesh_.owner[f] == c ? F * stencil.owner[f] : -F * stencil.neighbour[f];
    }
    f_[c] = sum;
    force[c] += sum;
  }
  mesh_.halo.update(f_);
  mesh_.halo.update(force);
  for (const Index f : band.faces()) {
    if (f >= mesh_.n_internal) continue;
    // c_f += F_f - (f)_f . d
    const Vec3& d = mesh_.d[f];
    const Real lambda = weights.lambda[f];
    const Vec3 mean = (1 - lambda) * f_[mesh_.owner[f]] + lambda * f_[mesh_.neighbour[f]];
    balance[f] += alpha_f[f] * dot(a_, d) - dot(mean, d);
  }
}

}  // namespace fsi::solid
