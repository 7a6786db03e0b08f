#include "libfsi/solid/body_force.hpp"

namespace fsi::solid {

void BodyForce::apply(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source,
                      const FaceField<Real>& alpha_f, PressureStencil& pressure, const Band& band) {
  jump_force_.clear();
  for (const Index f : band.faces()) {
    const Real F = alpha_f[f] * dot(a_, mesh_.d[f]);
    jump_force_.add(f, F, pressure.cells);
    if (f < mesh_.n_internal) rhie_chow_source[f] += F;
  }
  jump_force_.apply(force, rhie_chow_source, pressure, band);
  mesh_.halo.update(force);
}

}  // namespace fsi::solid
