#pragma once
// Boundary conditions as data: one condition a patch, resolved once.

#include <functional>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "libfsi/field/field.hpp"

namespace fsi {

/// A wall at rest or sliding, in its own plane or along a cylinder: u = velocity, which has no part
/// through a face.
struct Wall {
  Vec3 velocity;
};
/// A plane without friction, or a plane of symmetry: u.n = 0, no shear.
struct Slip {};
/// Prescribed velocity u(x, t).
struct FixedVelocity {
  std::function<Vec3(const Vec3& x, Real t)> u;
};
/// A number that may depend on time.
class OfTime {
 public:
  OfTime(Real constant = 0) : at_([constant](Real) { return constant; }) {}
  template <class Function>
  requires std::is_invocable_r_v<Real, Function, Real> OfTime(Function function)
      : at_(std::move(function)) {}
  Real operator()(Real t) const { return at_(t); }

 private:
  std::function<Real(Real)> at_;
};
/// Inlet or outlet at given pressure; velocity with zero gradient along the normal.
struct Opening {
  OfTime pressure;
};

using Condition = std::variant<Wall, Slip, FixedVelocity, Opening>;
/// Patch name -> condition.
using Conditions = std::map<std::string, Condition>;

/// The conditions of a mesh's patches, in their order.
/// Collective. Errors: Error{input} where a patch has no condition or a condition no patch, or a
/// wall moves through itself.
std::vector<Condition> resolve(const Conditions& conditions, const Mesh& mesh);

/// Velocity on the boundary faces at time t; at openings that of the cell. u: owned cells set.
void set_boundary_velocity(BoundaryField<Vec3>& u_b, const CellField<Vec3>& u,
                           const std::vector<Condition>& conditions, Real t, const Mesh& mesh);

/// Whether the condition gives the velocity (for its gradient and the implicit viscous term).
bool fixes_velocity(const Condition& condition);
bool fixes_pressure(const Condition& condition);

}  // namespace fsi
