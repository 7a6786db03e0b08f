#pragma once
// What the fluid is made of, gravity, and a solid as it is put in.

#include <string>

#include "libfsi/shapes/shapes.hpp"
#include "libfsi/solid/law/law.hpp"

namespace fsi {

/// The fluid and gravity, in consistent units; what a solid is made of stands in its `Solid`.
struct Physics {
  Real rho = 1;      ///< density of the fluid, and of a solid without one of its own
  Real mu_f = 0.01;  ///< dynamic viscosity of the fluid
  Vec3 gravity{};    ///< acceleration of fluid and solids; p goes without rho gravity . x
};

/// How the deformation of a solid is tracked.
enum class KinematicsKind { left_cauchy_green, log_conformation, reference_map };

/// A solid as it is put into the fluid, in consistent units.
struct Solid {
  shapes::Shape shape;  ///< undeformed
  Real G = 0;           ///< shear modulus
  Real mu = 0.01;       ///< dynamic viscosity
  std::string name{};   ///< of its columns and fields; may be empty where there is one solid only
  KinematicsKind kinematics = KinematicsKind::log_conformation;  ///< how the strain is tracked
  Vec3 acceleration{};  ///< of a body force that acts on this solid alone
  solid::Law law{};     ///< of its elastic stress
  Real rho = 0;         ///< density; 0: that of the fluid
  /// Whether a map to the undeformed solid holds shape and strain to each other; not with
  /// left_cauchy_green.
  bool memory = true;
  /// Sizes that nobody chose, in words. The sentence that the solid does not fit tells them.
  std::string by_default{};
};

}  // namespace fsi
