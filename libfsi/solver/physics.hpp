#pragma once
// What a scene is made of: the fluid and gravity, what drives the flow, and a solid as it is put
// in.

#include <functional>
#include <optional>
#include <string>

#include "libfsi/field/boundary.hpp"
#include "libfsi/flow/convection.hpp"
#include "libfsi/shapes/shapes.hpp"
#include "libfsi/solid/law/law.hpp"

namespace fsi {

/// The fluid and gravity, in consistent units; the material of a solid is in its `Solid`.
struct Physics {
  Real rho = 1;      ///< density of the fluid, and of a solid without one of its own
  Real mu_f = 0.01;  ///< dynamic viscosity of the fluid
  Vec3 gravity{};    ///< acceleration of fluid and solids; p goes without rho gravity . x
};

/// What drives and how the flow is solved.
struct FlowSetup {
  Conditions conditions{};              ///< one a patch
  Vec3 axis{1, 0, 0};                   ///< of the mean velocity
  std::optional<Real> mean_velocity{};  ///< held exactly in a periodic channel
  /// Velocity of the frame that conditions, places and results stand in. The equations are the same
  /// in all; a run tells it, and goes on from checkpoints of the same frame alone.
  Vec3 frame{};
  int non_orthogonal_correctors = 1;  ///< solves for the pressure beyond the first
  flow::Convection convection = flow::Convection::linear;  ///< face values of the velocity
  /// The cells' own velocities are projected, too, which keeps their kinetic energy
  /// (flow/orthogonal.hpp). For a fluid alone, and no pressure given.
  bool orthogonal_projection = false;
  /// Force per volume on fluid and solid at x and t; none where empty.
  std::function<Vec3(const Vec3& x, Real t)> body_force{};
};

/// The kinematics of a solid.
enum class KinematicsKind { left_cauchy_green, log_conformation, reference_map };

/// Bounds of a solid's density and viscosity, in parts of the fluid's
/// (doc/verification/settling.md, stiff.md).
inline constexpr Real density_ratio_min = 0.1, density_ratio_max = 20, viscosity_ratio_max = 200;

/// A solid as it is put into the fluid, in consistent units.
struct Solid {
  shapes::Shape shape;  ///< undeformed
  Real G = 0;           ///< shear modulus
  Real mu = 0.01;       ///< dynamic viscosity
  std::string name{};   ///< of its columns and fields; may be empty where there is one solid only
  KinematicsKind kinematics = KinematicsKind::log_conformation;  ///< how the strain is carried
  Vec3 acceleration{};  ///< of a body force that acts on this solid alone
  solid::Law law{};     ///< of its elastic stress
  Real rho = 0;         ///< density; 0: that of the fluid
  /// log_conformation: whether the memory is carried in addition to psi, and holds the shape. The
  /// map kinematics: whether its map holds the shape.
  bool memory = true;
  /// log_conformation: least thickness of the film of fluid between this solid and a wall, for the
  /// friction in it; 0: half a cell (solid/wall_film.hpp).
  Real film_thickness = 0;
  /// Whether the part of the shape beyond the mesh is cut off, so that a sphere about a point of a
  /// wall makes a half sphere on it. Else such a shape is refused.
  bool trim = false;
  /// Whether the checkpoint of a restart is about to replace its state. It may then overlap other
  /// solids, which have left the place where it enters.
  bool from_checkpoint = false;
  /// Sizes by default, in words, for the message that the solid does not fit.
  std::string by_default{};
};

}  // namespace fsi
