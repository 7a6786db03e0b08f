#pragma once
// Openings whose pressure answers the flow through them.

#include <vector>

#include "libfsi/flow/openings.hpp"
#include "libfsi/flow/projection.hpp"

namespace fsi::flow {

/// Solves the openings' loads together with the projection. The pressure matrix is constant, and so
/// is the flux of a unit of q at loaded opening k, phi_k = -grad q_k . S. The flow rates of a step
/// are
///   Q_j = Q_j* + sum_k S_jk pi_k,   S_jk: the sum of phi_k over opening j,
/// with pi = dt / rho times what the pressures change by besides what was projected. With
///   p_j = p_far + R_p Q_mid + p_c,   C dp_c/dt = Q_mid - p_c / R_d  by the midpoint rule,
///   Q_mid = Q^(n+1) - (dt / 2) (Q^n - Q^(n-1)) / dt_old
/// that is one small linear system a step. It is implicit and of second order, and damped where a
/// step is long for the load (doc/theory/openings.md).
class Loads {
 public:
  /// Collective. One projection for each loaded opening. openings: must outlive it.
  Loads(const Mesh& mesh, Projection& projection, Openings& openings, Real rho);

  /// Collective. The responses to the projection as it stands, to be set anew where the density
  /// is.
  void renew(Projection& projection, Real absolute);
  /// Collective. After a projection over dt: adds the loads' part to phi (every face), q and grad_q
  /// (owned and halo); the loaded openings' pressures, stored pressures and trends go on.
  void answer(FaceField<Real>& phi, CellField<Real>& q, CellField<Vec3>& grad_q, Real t, Real dt);

 private:
  /// What one unit of q at an opening does.
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
  std::vector<Real> S_;       // [responses^2] S_jk at j * n + k
  std::vector<Real> A_, pi_;  // of the small system
  std::vector<Real> flow_;    // [responses] Q of the last flux asked for
  std::vector<Sum> sums_;     // scratch
  std::vector<Line> lines_;   // scratch
  BoundaryField<Real> q_b_;   // scratch
};

}  // namespace fsi::flow
