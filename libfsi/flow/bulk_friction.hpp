#pragma once
// The part of the pressure increment that balances the friction along a vessel.

#include <vector>

#include "libfsi/flow/openings.hpp"
#include "libfsi/flow/projection.hpp"

namespace fsi::flow {

/// The term in kappa_w that q of a projection adds to the pressure, if a step is long for the
/// viscous time of a vessel. The increment rho / dt q accelerates the fluid, and -chi mu_c div u*
/// balances the friction in short waves (`ViscousPressure`). The friction of a flow along a
/// vessel, which has no divergence, needs
///   p += kappa_w q,   kappa_w = 0.9 mu / max y,   -Lap y = 1,   y = 0 where the velocity is given.
/// Consider an error of p whose flow decays at the rate Lambda. A step leaves the part
///   1 - (1 + dt kappa_w / rho) / (1 + theta dt Lambda)
/// of it. kappa_w / rho < Lambda, since 1 / max y is less than the smallest eigenvalue of -Lap. So
/// no error grows if theta >= 1/2. Between sides that slip, a flow along them is a short wave too,
/// and the factor 0.9 leaves room for the term in chi there. With rho / dt alone, a given flow rate
/// at a Reynolds number of 0.005 finds its pressure after some hundred steps only. kappa_w q is of
/// second order in dt.
///
/// q also contains q_o, harmonic inside, with values at the openings from the changes of their
/// pressures. This part needs no addition.
class BulkFriction {
 public:
  /// Collective. One projection for each opening, where there are several. openings: must outlive
  /// it.
  BulkFriction(const Mesh& mesh, Projection& projection, Openings& openings);

  /// Call before the openings' pressures change.
  void begin();
  /// p += kappa_w (q - q_o). k: kappa_w, 0 if nothing is to be added; dt_rho: dt / rho, q over
  /// pressure.
  void add(CellField<Real>& p, const CellField<Real>& q, Real k, Real dt_rho) const;

 private:
  /// An opening.
  struct Changing {
    const Openings::One* opening;
    CellField<Real> share;  ///< q inside per q at it
    Real before = 0;        ///< its pressure before the step
  };
  std::vector<Changing> changing_;
};

/// Collective. 0.9 / max y, per area; 0 if no patch gives the velocity. One set-up of a multigrid
/// method or of factors, and one solve.
Real bulk_friction(const Mesh& mesh, const FaceWeights& weights,
                   const std::vector<Condition>& conditions, Method method);

}  // namespace fsi::flow
