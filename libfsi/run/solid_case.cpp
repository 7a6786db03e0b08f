#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "libfsi/core/arguments.hpp"
#include "libfsi/core/error.hpp"
#include "libfsi/core/option_names.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/run/case.hpp"
#include "libfsi/run/continuation.hpp"
#include "libfsi/solid/law/laws.hpp"

namespace fsi {
namespace {

const std::vector<std::string> shapes_known{"none", "torus",    "sphere", "ellipsoid",
                                            "disk", "cylinder", "capsule"};

Real length(Options& options, const std::string& name, Real fallback, const std::string& help) {
  return options.real(name, fallback, {.help = help, .unit = "length", .positive = true});
}

/// Each size with the shapes that take it.
constexpr std::array<std::array<const char*, 2>, 5> sizes{
    {{"major_radius", "torus"},
     {"minor_radius", "torus"},
     {"semi_axes", "ellipsoid"},
     {"radius", "sphere, disk, cylinder, capsule"},
     {"height", "disk, cylinder, capsule"}}};

bool takes(const std::string& shape, const std::string& size) {
  return std::ranges::any_of(sizes, [&](const auto& known) {
    return known[0] == size && std::string(known[1]).find(shape) != std::string::npos;
  });
}

/// Whether that option, a_minor_radius of `a`, is the radius of another solid, `a_minor`.
bool is_radius_of_other(const Options& options, const std::string& option) {
  Options aside(options);
  if (!option.ends_with("_radius")) return false;
  const std::string shape = option.substr(0, option.rfind("radius")) + "shape";
  return options.given(shape) && takes(aside.text(shape, "", ""), "radius");
}

/// Errors: Error{input} where a size is given that the shape does not take.
void refuse_sizes_of_others(const Options& options, const std::string& of,
                            const std::string& name) {
  for (const auto& [size, shapes] : sizes)
    require(
        takes(name, size) || !options.given(of + size) || is_radius_of_other(options, of + size),
        "option -" + of + size + " is for " + shapes + ", but -" + of + "shape is " + name);
}

/// The sizes of a shape that no option gives, each with its value.
std::string sizes_by_default(const Options& options, const std::string& of,
                             const std::string& name) {
  std::string list;
  for (const auto& [key, value] : options.values())
    for (const auto& [size, shapes] : sizes)
      if (key == of + size && !options.given(key) &&
          std::string(shapes).find(name) != std::string::npos)
        list.append(list.empty() ? "-" : ", -").append(key).append(" ").append(value);
  return list;
}

/// Errors: Error{input} where a size of one solid can be that of another, a_minor_radius of `a` or
/// of `a_minor`, and the first one takes it. No other keys end in a key. Where the second one takes
/// none, only an option that is given is refused.
void refuse_shared_sizes(const Options& options, const std::vector<std::string>& names) {
  Options aside(options);
  const auto shape = [&](const std::string& name) {
    return aside.text("solids_" + name + "_shape", "", "");
  };
  for (const std::string& one : names)
    for (const std::string& other : names)
      for (const char* size : {"minor_radius", "major_radius"}) {
        const std::string option = "solids_" + one + "_" + size;
        if (plain_name("solids_" + other + "_radius") != plain_name(option)) continue;
        require(
            !takes(shape(one), size) || !(options.given(option) || takes(shape(other), "radius")),
            "option -" + option + " would be that of solid \"" + one + "\" and of solid \"" +
                other + "\"; rename one of them");
      }
}

/// The shape about the origin, its axis along x. With -help and for "none" every shape's options
/// are read.
shapes::Shape undeformed(Options& options, const std::string& of, const std::string& name,
                         Real& thickness) {
  shapes::Shape shape = shapes::sphere(1);
  const bool all = options.help() || name == "none";
  if (!all) refuse_sizes_of_others(options, of, name);
  if (all || name == "torus") {
    const Real R = length(options, of + "major_radius", 0.3,
                          "torus: radius of the circle in the middle of its tube");
    const Real r = length(options, of + "minor_radius", 0.1, "torus: radius of its tube");
    require(r < R || name == "none",
            "option -" + of + "minor_radius must be smaller than -" + of + "major_radius");
    shape = shapes::torus(R, std::min(r, R));
    thickness = 2 * r;
  }
  if (all || name == "ellipsoid") {
    const Vec3 axes =
        options.vec3(of + "semi_axes", {0.4, 0.25, 0.25},
                     {.help = "ellipsoid: half its lengths along x, y, z", .unit = "length"});
    require(axes.x > 0 && axes.y > 0 && axes.z > 0,
            "option -" + of + "semi_axes: all three must be > 0");
    shape = shapes::ellipsoid(axes);
    thickness = 2 * std::min({axes.x, axes.y, axes.z});
  }
  if (all || name == "sphere" || name == "disk" || name == "cylinder" || name == "capsule") {
    const Real r = length(options, of + "radius", 0.2, "sphere, disk, cylinder, capsule: radius");
    thickness = 2 * r;
    if (name == "sphere") shape = shapes::sphere(r);
    if (all || name != "sphere") {
      const Real h = length(options, of + "height", 0.2,
                            "disk, cylinder, capsule: length along the axis, without caps");
      if (name == "capsule") shape = shapes::capsule(r, h);
      if (name == "disk" || name == "cylinder") shape = shapes::cylinder(r, h);
      if (name != "capsule") thickness = std::min(thickness, h);
    }
  }
  return shape;
}

KinematicsKind read_kinematics(Options& options, const std::string& of) {
  const std::string kinematics =
      options.choice(of + "kinematics", "log_conformation",
                     {"log_conformation", "left_cauchy_green", "reference_map"},
                     "what carries the strain: log B, the paper's B~, or the map to the place of "
                     "each particle in the undeformed solid");
  return kinematics == "left_cauchy_green" ? KinematicsKind::left_cauchy_green
         : kinematics == "reference_map"   ? KinematicsKind::reference_map
                                           : KinematicsKind::log_conformation;
}

/// Sets G, mu and the acceleration.
void read_material(Options& options, const std::string& of, const Physics& physics, Solid& solid) {
  const Real density = options.real(of + "density", physics.rho,
                                    {.help = "density of the solid, a tenth to twenty times that "
                                             "of the fluid",
                                     .unit = "mass / volume",
                                     .positive = true});
  require(density >= density_ratio_min * physics.rho && density <= density_ratio_max * physics.rho,
          "option -" + of + "density: must be 0.1 to 20 times -fluid_density");
  solid.rho = density;
  solid.mu =
      options.real(of + "viscosity", physics.mu_f,
                   {.help = "dynamic viscosity of the solid, at most 200 times that of the fluid",
                    .unit = "mass / (length time)",
                    .min = 0});
  require(solid.mu <= viscosity_ratio_max * physics.mu_f,  // doc/verification/stiff.md
          "option -" + of +
              "viscosity: must be at most 200 times -fluid_viscosity; for a body that is " +
              "nearly rigid take a large -" + of + "shear_modulus");
  solid.G = options.real(of + "shear_modulus", 1,
                         {.help = "shear modulus G", .unit = "mass / (length time^2)", .min = 0});
  solid.law = solid::read_law(options, of + "law");
  solid.acceleration =
      options.vec3(of + "acceleration", {},
                   {.help = "body force on the solid alone, per mass", .unit = "length / time^2"});
}

/// Puts the shape about the origin where the options say.
void place(Options& options, const std::string& of, SolidSetup& solid) {
  const bool on_path = options.given(of + "path") && !options.help();
  require(!on_path || !options.given(of + "center") || solid.shape_name == "none",
          "options -" + of + "path and -" + of +
              "center exclude each other: the path says where the solid starts; give one of them");
  solid.on_path = on_path;
  const Vec3 unset{0.5, 0.5, 0.5};
  const Vec3 centre =
      on_path ? unset
              : options.vec3(
                    of + "center", unset,
                    {.help = "centre of the shape; its z is left out in 2-D", .unit = "length"});
  solid.centre = centre;
  if (options.given(of + "axis") || options.help()) {
    const Vec3 axis = options.vec3(
        of + "axis", {1, 0, 0}, {.help = "axis of revolution, in place of the angle", .unit = ""});
    require(norm(axis) > 0, "option -" + of + "axis must not be zero");
    require(!options.given(of + "angle") || options.help(),
            "options -" + of + "axis and -" + of + "angle exclude each other");
    solid.solid.shape = shapes::translate(shapes::align(solid.about_origin, axis), centre);
    if (!options.help()) return;
  }
  solid.angle = options.real(of + "angle", 0,
                             {.help = "between the axis of revolution and x, in the x-y plane",
                              .unit = "degrees",
                              .min = -360,
                              .max = 360});
  const Real turn = solid.angle * std::numbers::pi / 180;
  solid.solid.shape =
      shapes::translate(shapes::rotate(solid.about_origin, {0, 0, 1}, turn), centre);
}

/// Whether -solid_shape none, and no other option of a single solid, stands beside several solids.
/// So the command line leaves the solids of any case out.
bool leaves_solids_out(const Options& options) {
  Options aside(options);
  return options.names("solid_", "") == std::vector<std::string>{"shape"} &&
         !options.names("solids_", "_shape").empty() && aside.text("solid_shape", "", "") == "none";
}

/// Adds the solid of the options that begin with `of`; none if it is left out or its shape is
/// "none". The other options of that one are checked but not recorded.
void add_solid(std::vector<SolidSetup>& solids, Options& options, const std::string& of,
               const std::string& name, const Physics& physics, bool left_out = false) {
  SolidSetup solid;
  solid.solid.name = name;
  solid.options = of;
  solid.shape_name = options.choice(of + "shape", "none", shapes_known,
                                    "undeformed shape; none: no solid, in two dimensions sphere is "
                                    "a disc. Of several solids each has all of these options under "
                                    "a name of its own: -solids_NAME_shape ...");
  if (left_out) solid.shape_name = "none";
  const bool none = solid.shape_name == "none";
  Options aside(options);
  Options& read = none && !options.help() ? aside : options;
  read_material(read, of, physics, solid.solid);
  solid.solid.kinematics = read_kinematics(read, of);
  solid.solid.film_thickness = read.real(
      of + "film_thickness", 0,
      {.help = "least thickness of the film of fluid between the solid and a wall, for the "
               "friction in it; 0: half a cell; log_conformation alone",
       .unit = "length",
       .min = 0});
  require(none || options.help() || solid.solid.film_thickness == 0 ||
              solid.solid.kinematics == KinematicsKind::log_conformation,
          "option -" + of + "film_thickness is for log_conformation alone");
  solid.solid.memory = read.flag(
      of + "memory", true,
      "log_conformation: carry a map to the undeformed solid too, and hold shape and strain to "
      "it; reference_map: hold the shape to its map; left_cauchy_green: no effect");
  solid.solid.trim = read.flag(of + "trim", false,
                               "the part of the shape beyond the mesh is cut off, not refused");
  solid.about_origin = undeformed(read, of, solid.shape_name, solid.thickness);
  require(none || options.help() || solid.solid.film_thickness <= solid.thickness,
          "option -" + of +
              print("film_thickness: %.4g is more than the solid's own thickness, "
                    "%.4g: look whether both are in the same unit",
                    solid.solid.film_thickness, solid.thickness));
  const std::string& sizes_here = solid.solid.by_default =
      sizes_by_default(read, of, solid.shape_name);
  if (!read.given(of + "shear_modulus"))
    solid.by_default = "-" + of + print("shear_modulus %g", solid.solid.G);
  if (!sizes_here.empty()) solid.by_default += (solid.by_default.empty() ? "" : ", ") + sizes_here;
  place(read, of, solid);
  if (!none) solids.push_back(std::move(solid));
}

/// Errors: Error{input} if a solid has options but no shape.
void check_shapes(const Options& options, const std::vector<std::string>& names) {
  std::string list;
  if (names.empty() && !options.given("solid_shape"))
    for (const std::string& name : options.names("solid_", ""))
      list += (list.empty() ? "-solid_" : ", -solid_") + name;
  std::string shapes;
  for (const std::string& shape : shapes_known) shapes += (shapes.empty() ? "" : ", ") + shape;
  require(list.empty(), "option -solid_shape is missing beside " + list +
                            "; choose from: " + shapes + " (none: no solid)");
  for (const std::string& text : options.names("solids_", "")) {
    if (std::ranges::any_of(names, [&](auto& name) { return text.starts_with(name + "_"); }))
      continue;
    const std::string near = nearest_before_underscore(text, names, 2);
    throw Error(ErrorKind::input,
                "option -solids_" + text +
                    " is of no solid: each has a name without blanks, and a " +
                    "shape in -solids_NAME_shape; choose from: " + shapes +
                    (near.empty() ? "" : "; did you mean -solids_" + near + "_...?"));
  }
}

}  // namespace

std::vector<SolidSetup> read_solids(Options& options, const Physics& physics) {
  std::vector<SolidSetup> solids;
  const std::vector<std::string> names = options.names("solids_", "_shape");
  const std::vector<std::string> alone = options.names("solid_", "");
  const bool left_out = leaves_solids_out(options);
  if (!names.empty() && !alone.empty() && !options.help() && !left_out)
    throw Error(ErrorKind::input, "option -solid_" + alone.front() + " stands beside -solids_" +
                                      names.front() + "_shape: give one solid or a list of solids");
  if (!options.help() && !left_out) refuse_shared_sizes(options, names);
  if (names.empty() || options.help() || left_out)
    add_solid(solids, options, "solid_", "", physics);
  for (const std::string& name : names)
    add_solid(solids, options, "solids_" + name + "_", name, physics, left_out);
  if (!options.help()) check_shapes(options, names);
  return solids;
}

shapes::Shape shape_in(int dim, const SolidSetup& s) {
  return dim == 3 ? s.solid.shape : shapes::translate(s.solid.shape, {0, 0, -s.centre.z});
}

Real thickness_in(int dim, const SolidSetup& s) {
  const shapes::Shape shape = shape_in(dim, s);
  const Vec3 centre{s.centre.x, s.centre.y, 0};
  if (dim == 3 || !(shape(centre) < 0)) return s.thickness;  // a torus is open in the middle
  constexpr int directions = 180, halvings = 40;
  Real least = shapes::infinity;
  for (int i = 0; i < directions; ++i) {
    const Real angle = std::numbers::pi * i / directions;
    const Vec3 along{std::cos(angle), std::sin(angle), 0};
    Real inside = 0, outside = s.thickness;
    while (shape(centre + outside * along) < 0) inside = outside, outside *= 2;
    for (int k = 0; k < halvings; ++k) {
      const Real middle = (inside + outside) / 2;
      (shape(centre + middle * along) < 0 ? inside : outside) = middle;
    }
    least = std::min(least, 2 * inside);
  }
  return least;
}

void put_solids(Solver& solver, const Case& setup) {
  if (!setup.flow_from.empty() && !setup.output.restart) start_from_other_run(solver, setup);
  for (const SolidSetup& s : setup.solids) {
    Solid solid = s.solid;
    solid.shape = shape_in(solver.mesh().dim, s);
    solver.put_solid(solid);
    const Body& body = solver.bodies().back();
    if (rank() != 0) continue;
    const std::string name = body.name.empty() ? s.shape_name : body.name;
    if (body.bonded_faces > 0)
      std::printf(
          "%s: touches walls at the start and is bonded to %lld of their faces for the whole run\n",
          name.c_str(), static_cast<long long>(body.bonded_faces));
    if (body.bonded_faces > 0 && body.map() == nullptr)
      std::fprintf(stderr,
                   "fsi: warning: %s: without the memory or a map nothing keeps the place of a "
                   "bonded solid, and under a lasting load it creeps along the wall\n",
                   name.c_str());
    if (body.sliding_faces > 0)
      std::fprintf(stderr,
                   "fsi: notice: %s touches %lld faces of walls that move, or of inlets: nothing "
                   "holds it at them. On such a wall a solid with ends slips by some per cent of "
                   "its speed: better let the other walls move. At an inlet no more of it comes in "
                   "(doc/theory/walls.md)\n",
                   name.c_str(), static_cast<long long>(body.sliding_faces));
    if (body.zone.any() && s.solid.kinematics == KinematicsKind::left_cauchy_green)
      std::fprintf(stderr,
                   "fsi: warning: %s: -solid_kinematics left_cauchy_green becomes unstable on "
                   "triangles and tetrahedra; take log_conformation\n",
                   s.shape_name.c_str());
    constexpr Real most = 50;
    if (!body.traction && body.mu > most * solver.physics().mu_f)
      std::fprintf(stderr,
                   "fsi: warning: %s: its viscosity is %g times the fluid's; with "
                   "-solid_kinematics left_cauchy_green the friction at the surface is an "
                   "approximation, beyond %g times a wrong one; take log_conformation or "
                   "reference_map (doc/theory/two_viscosities.md)\n",
                   name.c_str(), body.mu / solver.physics().mu_f, most);
  }
}

std::vector<std::string> solids_without_shape(const Options& options) {
  Options aside(options);
  std::vector<std::string> begins{"solid_"}, found;
  for (const std::string& name : options.names("solids_", "_shape"))
    begins.push_back("solids_" + name + "_");
  for (const std::string& of : begins)
    if (options.given(of + "shape") &&
        (aside.text(of + "shape", "", "") == "none" || leaves_solids_out(options)))
      found.push_back(of);
  return found;
}

}  // namespace fsi
