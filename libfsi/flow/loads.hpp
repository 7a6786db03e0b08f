#pragma once
// Openings whose pressure depends on the flow through them.

#include <vector>

#include "libfsi/flow/openings.hpp"
#include "libfsi/flow/projection.hpp"

namespace fsi::flow {

/// Solves the loads of openings together with the projection. The pressure matrix is constant, and
/// so is the flux of a unit of q at loaded opening k, phi_k = -grad q_k . S. The flow rates at the
/// end of a step are
///   Q_j = Q_j* + sum_k Y_jk pi_k,   Y_jk: the sum of phi_k over opening j,
/// with pi_k = dt / rho times the change of the pressure at opening k that the projection does not
/// contain. The loads give
///   p_j = p_far + R_p Q_mid + p_c,   C dp_c/dt = Q_mid - p_c / R_d  by the midpoint rule,
///   Q_mid = Q^(n+1) - (dt / 2) (Q^n - Q^(n-1)) / dt_old,
/// with 2 dt_old in place of dt if the step is more than twice as long as the last one (`reach`).
/// This is one small linear system in each step. It is implicit and of second order, and damped if
/// a step is long for the load (doc/theory/openings.md).
class Loads {
 public:
  /// Collective. One projection for each loaded opening. openings: must outlive it.
  Loads(const Mesh& mesh, Projection& projection, Openings& openings, Real rho);

  /// Collective. Sets the responses anew, which is needed after each change of the density.
  void renew(Projection& projection);
  /// Collective. After a projection over dt: adds the loads' part to phi (every face), q and grad_q
  /// (owned and halo). Updates the pressures, stored pressures and trends of the loaded openings.
  /// trend_over: the time over which the trend of the flow rates is taken to hold.
  void answer(FaceField<Real>& phi, CellField<Real>& q, CellField<Vec3>& grad_q, Real t, Real dt,
              Real trend_over);

 private:
  /// The response to a unit of q at an opening.
  struct Response {
    Openings::One* opening;
    FaceField<Real> phi;
    CellField<Real> q;
    CellField<Vec3> grad_q;
  };
  /// p = a + b Q_mid of an opening in a step.
  struct Line {
    Real a, b;
  };
  static Line line(const Openings::One& opening, Real t, Real dt);
  void set_flow_rates(const FaceField<Real>& phi);
  void solve();

  const Mesh& mesh_;
  Real rho_;
  std::vector<Response> responses_;
  std::vector<Real> S_;       // [responses^2] Y_jk at j * n + k
  std::vector<Real> A_, pi_;  // of the small system
  std::vector<Real> flow_;    // [responses] Q of the flux of the last call
  std::vector<Sum> sums_;     // scratch
  std::vector<Line> lines_;   // scratch
  BoundaryField<Real> q_b_;   // scratch
};

}  // namespace fsi::flow
