#include "libfsi/solid/body_force.hpp"

namespace fsi::solid {

void BodyForce::apply(CellField<Vec3>& force, FaceField<Real>& balance,
                      const FaceField<Real>& alpha_f, PressureStencil& pressure, const Band& band) {
  level_.clear();
  for (const Index f : band.faces()) {
    const Real F = alpha_f[f] * dot(a_, mesh_.d[f]);
    level_.add(f, F, pressure.cells);
    if (f < mesh_.n_internal) balance[f] += F;
  }
  level_.apply(force, balance, pressure, band);
  mesh_.halo.update(force);
}

}  // namespace fsi::solid
