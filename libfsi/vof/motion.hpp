#pragma once
// Given motions, with which the error of an advected interface is known.

#include <functional>
#include <string>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::vof {

/// A divergence-free velocity u(x) factor(t) and a vector potential, u = curl A (2-D: the stream
/// function A.z). period: at its end the interface is back where it started.
struct Motion {
  /// Velocity and vector potential at x.
  std::function<Vec3(const Vec3&)> u, potential;
  std::function<Real(Real t)> factor;  ///< of both
  Real period = 1;                     ///< time
};

/// Names of all motions.
const std::vector<std::string>& motion_names();

/// - vortex: stream function sin^2(pi x) sin^2(pi y) / pi, reversed by cos(pi t / T), T = 8
/// [Scheufler19].
/// - deformation: [LeVeque96] (9.5) in the unit cube, reversed likewise, T = 3.
/// - rotation: one turn about (0.5, 0.5) in the x-y plane, T = 2 pi.
///
/// Errors: Error{input} for any other name.
Motion motion(const std::string& name);

/// Flux of u through every face at factor 1, as the circulation of A around it (three-point Gauss
/// along each edge): it sums to zero over the faces of a cell to round-off. phi: all faces set.
void set_flux(FaceField<Real>& phi, const Motion& motion, const Mesh& mesh);

/// Collective. dt of Courant number (dt / 2V) sum |phi| = `courant` in the cells that hold a part
/// of the interface; the largest number where there is none.
Real interface_dt(const CellField<Real>& alpha, const FaceField<Real>& phi, Real courant,
                  const Mesh& mesh);

/// Collective. sum |a - b| V.
Real difference(const CellField<Real>& a, const CellField<Real>& b, const Mesh& mesh);

}  // namespace fsi::vof
