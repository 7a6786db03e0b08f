#pragma once
// A mesh full of solid, with all that the transport of its deformation needs.

#include <algorithm>
#include <cmath>
#include <functional>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solid/flow_snapshot.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi::test {

inline Real largest(const SymTensor& t) {
  Real m = 0;
  for (const Real v : {t.xx, t.xy, t.xz, t.yy, t.yz, t.zz}) m = std::max(m, std::abs(v));
  return m;
}

template <class Kinematics>
struct Full {
  explicit Full(const BoxFile& box)
      : mesh(read_box(box)),
        weights(mesh),
        stencil(mesh, weights, std::vector<bool>(mesh.patches.size(), false)),
        alpha(mesh, 1),
        phi(mesh),
        u(mesh),
        L(mesh),
        kinematics(mesh),
        grad(mesh) {
    kinematics.set_undeformed(alpha);
  }

  void set_phi(const std::function<Vec3(const Vec3&)>& stream) {
    for (Index f = 0; f < mesh.n_faces; ++f) phi[f] = dot(stream(mesh.Cf[f]), mesh.Sf[f]);
    for (Index c = 0; c < mesh.n_cells; ++c) u[c] = stream(mesh.C[c]);
  }
  void set_B(const std::function<SymTensor(const Vec3&)>& B) {
    for (Index c = 0; c < mesh.n_cells; ++c) kinematics.set(c, B(mesh.C[c]), 1);
    kinematics.resume(alpha, grad);
  }
  /// Of a reference map: where what is at x came from.
  void set_map(const std::function<Vec3(const Vec3&)>& xi) {
    for (Index c = 0; c < mesh.n_cells; ++c) kinematics.set_map(c, xi(mesh.C[c]));
    kinematics.resume(alpha, grad);
  }
  void step(Real dt) {
    kinematics.mark(alpha);
    kinematics.transport(alpha, {phi, u, L, stencil, weights}, dt, grad);
  }
  /// Largest component of B - exact over all cells.
  Real error(const std::function<SymTensor(const Vec3&)>& exact) const {
    Real worst = 0;
    for (Index c = 0; c < mesh.n_owned; ++c)
      worst = std::max(worst, largest(kinematics.B(c, 1) - exact(mesh.C[c])));
    return global_max(worst);
  }
  /// L2 norm of the same.
  Real mean_error(const std::function<SymTensor(const Vec3&)>& exact) const {
    Sum squares;
    for (Index c = 0; c < mesh.n_owned; ++c) {
      const SymTensor e = kinematics.B(c, 1) - exact(mesh.C[c]);
      squares.add(mesh.V[c] * (e.xx * e.xx + 2 * e.xy * e.xy + e.yy * e.yy + e.zz * e.zz));
    }
    return std::sqrt(squares.total());
  }

  Mesh mesh;
  FaceWeights weights;
  GradientStencil stencil;
  CellField<Real> alpha;
  FaceField<Real> phi;
  CellField<Vec3> u;
  CellField<Tensor> L;
  Kinematics kinematics;
  CellField<solid::SymGradient> grad;
};

}  // namespace fsi::test
