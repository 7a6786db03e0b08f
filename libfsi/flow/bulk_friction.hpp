#pragma once
// The part of a pressure increment that the friction of a whole vessel needs.

#include <vector>

#include "libfsi/flow/openings.hpp"
#include "libfsi/flow/projection.hpp"

namespace fsi::flow {

/// What q of a projection adds to the pressure where a step is long for the viscous time of a
/// vessel. An increment of rho / dt q accelerates the fluid, and -chi mu div u* of it bears the
/// friction within short waves (`add_viscous_pressure`). That of a flow along a vessel, which has
/// no divergence, takes
///   p += k q,   k = 0.9 mu / max w,   -Lap w = 1,   w = 0 where the velocity is given.
/// Of an error of p whose flow decays at the rate lambda, a step leaves
///   1 - (1 + dt k / rho) / (1 + theta dt lambda),
/// and k / rho < lambda, since 1 / max w is less than the smallest eigenvalue of -Lap. So no error
/// grows where theta >= 1/2. The 0.9 leaves room for chi between sides that slip, where a flow
/// along them is a short wave, too. With rho / dt alone a given flow rate at a Reynolds number of
/// 0.005 finds its pressure in some hundred steps. k q is of second order in dt.
///
/// q also holds what the pressures at openings changed by, harmonic inside: that is whole as it is,
/// and does not count here.
class BulkFriction {
 public:
  /// Collective. One projection for each opening, where there are several. openings: must outlive
  /// it.
  BulkFriction(const Mesh& mesh, Projection& projection, Openings& openings);

  /// Before the openings' pressures go on.
  void begin();
  /// p += k (q - what the openings changed by). k: 0 where nothing is to be added; dt_rho: dt /
  /// rho, q per pressure.
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

/// Collective. 0.9 / max w, per area; 0 where no patch gives the velocity. One set-up of a
/// multigrid method or of factors, and one solve.
Real bulk_friction(const Mesh& mesh, const FaceWeights& weights,
                   const std::vector<Condition>& conditions, Method method);

}  // namespace fsi::flow
