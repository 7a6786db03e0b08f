#include <algorithm>
#include <numbers>

#include "libfsi/core/error.hpp"
#include "libfsi/run/case.hpp"
#include "libfsi/solid/law/laws.hpp"

namespace fsi {
namespace {

Real length(Options& options, const std::string& name, Real fallback, const std::string& help) {
  return options.real(name, fallback, {.help = help, .unit = "length", .positive = true});
}

/// The shape about the origin, its axis along x. With -help every shape's options are listed.
shapes::Shape undeformed(Options& options, const std::string& name, Real& thickness) {
  shapes::Shape shape = shapes::sphere(1);
  const bool all = options.help();
  if (all || name == "torus") {
    const Real R = length(options, "solid_major_radius", 0.3, "torus: of the circle");
    const Real r = length(options, "solid_minor_radius", 0.1, "torus: of the tube");
    require(r < R, "option -solid_minor_radius must be smaller than -solid_major_radius");
    shape = shapes::torus(R, r);
    thickness = 2 * r;
  }
  if (all || name == "ellipsoid") {
    const Vec3 axes = options.vec3("solid_semi_axes", {0.4, 0.25, 0.25},
                                   {.help = "ellipsoid: along x, y, z", .unit = "length"});
    require(axes.x > 0 && axes.y > 0 && axes.z > 0,
            "option -solid_semi_axes: all three must be > 0");
    shape = shapes::ellipsoid(axes);
    thickness = 2 * std::min({axes.x, axes.y, axes.z});
  }
  if (all || name == "sphere" || name == "disk" || name == "cylinder" || name == "capsule") {
    const Real r = length(options, "solid_radius", 0.2, "sphere, disk, cylinder, capsule");
    thickness = 2 * r;
    if (name == "sphere") shape = shapes::sphere(r);
    if (all || name != "sphere") {
      const Real h =
          length(options, "solid_height", 0.2, "disk, cylinder, capsule: along the axis");
      if (name == "capsule") shape = shapes::capsule(r, h);
      if (name == "disk" || name == "cylinder") shape = shapes::cylinder(r, h);
      if (name != "capsule") thickness = std::min(thickness, h);
    }
  }
  return shape;
}

}  // namespace

SolidSetup read_solid(Options& options, Physics& physics) {
  SolidSetup solid;
  solid.name =
      options.choice("solid_shape", "none",
                     {"none", "torus", "sphere", "ellipsoid", "disk", "cylinder", "capsule"},
                     "undeformed shape; none: no solid");
  const Real density =
      options.real("solid_density", physics.rho,
                   {.help = "density of the solid", .unit = "mass / volume", .positive = true});
  require(density == physics.rho,
          "option -solid_density: only a solid as dense as the fluid can be run so far");
  physics.mu_s = options.real(
      "solid_viscosity", physics.mu_f,
      {.help = "dynamic viscosity of the solid", .unit = "mass / (length time)", .min = 0});
  physics.G = options.real("solid_shear_modulus", 1,
                           {.help = "shear modulus G", .unit = "mass / (length time^2)", .min = 0});
  physics.law = solid::read_law(options);
  const std::string kinematics =
      options.choice("solid_kinematics", "log_conformation",
                     {"log_conformation", "left_cauchy_green", "reference_map"},
                     "how deformation is tracked: log B, the paper's B~, or the map to where each "
                     "particle once was");
  solid.kinematics = kinematics == "left_cauchy_green" ? KinematicsKind::left_cauchy_green
                     : kinematics == "reference_map"   ? KinematicsKind::reference_map
                                                       : KinematicsKind::log_conformation;
  if (solid.name == "none" && !options.help()) return solid;
  physics.solid_acceleration =
      options.vec3("solid_acceleration", {},
                   {.help = "body force on the solid alone, per mass", .unit = "length / time^2"});

  const shapes::Shape shape = undeformed(options, solid.name, solid.thickness);
  solid.about_origin = shape;
  const Vec3 centre = options.vec3("solid_center", {0.5, 0.5, 0.5},
                                   {.help = "centre of the shape", .unit = "length"});
  if (options.given("solid_axis")) {
    const Vec3 axis =
        options.vec3("solid_axis", {1, 0, 0}, {.help = "axis of revolution", .unit = ""});
    require(norm(axis) > 0, "option -solid_axis must not be zero");
    require(!options.given("solid_angle"),
            "options -solid_axis and -solid_angle exclude each other");
    solid.shape = shapes::translate(shapes::align(shape, axis), centre);
    return solid;
  }
  const Real angle = options.real(
      "solid_angle", 0,
      {.help = "between the axis of revolution and x, in the x-y plane; or -solid_axis x,y,z",
       .unit = "degrees",
       .min = -360,
       .max = 360});
  solid.angle = angle;
  solid.shape =
      shapes::translate(shapes::rotate(shape, {0, 0, 1}, angle * std::numbers::pi / 180), centre);
  return solid;
}

}  // namespace fsi
