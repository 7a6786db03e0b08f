#pragma once
// Boundary conditions as data: one condition a patch, resolved once.

#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/field/inflow.hpp"
#include "libfsi/field/of_time.hpp"

namespace fsi {

/// A wall at rest or sliding, in its own plane or along a cylinder: u = velocity, which has no part
/// through a face.
struct Wall {
  Vec3 velocity;  ///< of the wall
};
/// A plane without friction, or a plane of symmetry: u.n = 0, no shear.
struct Slip {};
/// Prescribed velocity u(x, t).
struct FixedVelocity {
  std::function<Vec3(const Vec3& x, Real t)> u;  ///< velocity at x and t
  /// The change of u over time, if it is known better than by samples of u; it limits the steps.
  OfTime pace = OfTime::nothing();
};
/// A flow rate into the domain (negative: out of it), spread over the patch.
struct FlowRate {
  OfTime rate;                                      ///< volume per time
  InflowProfile profile = InflowProfile::parabola;  ///< how the flow is spread over the patch
  std::vector<Vec3> shape{};  ///< [faces] velocity at rate 1; set by `resolve`
};
/// The load of an opening: a resistance, and behind it another one parallel to a capacitance.
struct Load {
  Real proximal = 0;     ///< R_p, pressure per flow rate
  Real distal = 0;       ///< R_d
  Real capacitance = 0;  ///< C, volume per pressure; 0: none
  Real stored = 0;       ///< pressure p_c of the capacitance at t = 0
  /// Whether there is a load at all.
  bool any() const { return proximal != 0 || distal != 0; }
};
/// Inlet or outlet at given pressure; velocity with zero gradient along the normal. With a load the
/// pressure is that beyond it, p = pressure + R_p Q + p_c, Q the flow rate out of the domain and
///   C dp_c/dt = Q - p_c / R_d,
/// the windkessel of three elements.
struct Opening {
  OfTime pressure;  ///< beyond the load, where there is one
  Load load{};      ///< between the opening and that pressure
};

/// What holds on a patch.
using Condition = std::variant<Wall, Slip, FixedVelocity, FlowRate, Opening>;
/// Patch name -> condition.
using Conditions = std::map<std::string, Condition>;

/// The conditions of a mesh's patches, in their order. Collective. Errors: Error{input} where a
/// patch has no condition or a condition no patch, or a wall moves through itself. Also if a load
/// is negative or has a capacitance without a parallel resistance, if a function is empty, or if
/// there is an `imbalance` at t = 0.
std::vector<Condition> resolve(const Conditions& conditions, const Mesh& mesh);

/// Collective. If no patch gives the pressure, inflow and outflow must be equal. Returns a message
/// if they differ by more than 1e-3 of the flow through the patches, or by 2 % if a velocity is
/// given, which is sampled in the middle of faces. Returns "" if they agree or are not finite. The
/// projection spreads a smaller difference over the patches. passed: the largest flow through them
/// so far, which counts if it is larger than the present one; updated on return.
std::string imbalance(Real& passed, const BoundaryField<Vec3>& u_b,
                      const std::vector<Condition>& conditions, const Mesh& mesh);

/// Velocity on the boundary faces at time t; at openings that of the cell. u: owned cells set.
void set_boundary_velocity(BoundaryField<Vec3>& u_b, const CellField<Vec3>& u,
                           const std::vector<Condition>& conditions, Real t, const Mesh& mesh);

/// The longest step from t by the values that the conditions give over time (`step_of`), without
/// velocities that need samples (OfPlaceAndTime).
Real conditions_dt(const std::vector<Condition>& conditions, Real t, Real end);

/// Whether the condition gives the velocity (for its gradient and the implicit viscous term).
bool fixes_velocity(const Condition& condition);
/// Whether it prescribes a flow through the patch: FixedVelocity or FlowRate.
bool prescribes_flow(const Condition& condition);
/// Whether fluid passes one of the patches.
bool has_openings(const Conditions& conditions);
/// Whether the condition gives the pressure: an Opening.
bool fixes_pressure(const Condition& condition);
/// Whether the fluid slips along the patch: Slip.
bool lets_slip(const Condition& condition);

/// [patches] whether the condition `holds`.
std::vector<bool> patches_where(const std::vector<Condition>& conditions,
                                bool (*holds)(const Condition&));
/// [n_boundary] 1 on the faces of these patches.
std::vector<char> faces_where(const std::vector<Condition>& conditions, const Mesh& mesh,
                              bool (*holds)(const Condition&));

}  // namespace fsi
