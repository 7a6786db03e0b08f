#include "libfsi/run/case.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/io/checkpoint.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/run/forewords.hpp"
#include "libfsi/solid/strain.hpp"

namespace fsi {
namespace {

MeshOptions read_mesh_options(Options& options, const Vec3& path) {
  MeshOptions mesh;
  mesh.file = options.text(
      "mesh", "", "gmsh file, 2.2 or 4.x, or .h5 of fsi-mesh convert; a 2-D mesh makes a 2-D run");
  mesh.periodic =
      options.list("mesh_periodic", "pairs of patches joined by translation: a,b[,c,d ...]");
  mesh.partitioner =
      options.choice("petscpartitioner_type", "metis", {"metis", "ptscotch", "simple"},
                     "how the mesh is divided among ranks");
  if (mesh.partitioner == "metis")
    mesh.along = options.vec3("mesh_divide_along", path,
                              {.help = "direction the solid travels in: the mesh is divided "
                                       "lengthwise, so that ranks share the solid all the way; "
                                       "0,0,0: none",
                               .unit = ""});
  return mesh;
}

Physics read_physics(Options& options) {
  const std::string viscosity = "mass / (length time)", density = "mass / volume";
  Physics physics;
  physics.rho = options.real("fluid_density", 1,
                             {.help = "density of the fluid", .unit = density, .positive = true});
  physics.mu_f =
      options.real("fluid_viscosity", 0.01,
                   {.help = "dynamic viscosity of the fluid", .unit = viscosity, .positive = true});
  physics.gravity = options.vec3(
      "gravity", {},
      {.help = "acceleration of fluid and solids; pressures are given and written without the "
               "part fluid_density gravity . x that bears the fluid itself",
       .unit = "length / time^2"});
  return physics;
}

/// Density and viscosity in words.
std::string fluid(const Options& options, const Physics& physics) {
  const auto given = [&](const char* name) {
    return options.given(name) ? "" : " (not given, the default)";
  };
  return print("density %g%s, viscosity %g%s, kinematic viscosity %g", physics.rho,
               given("fluid_density"), physics.mu_f, given("fluid_viscosity"),
               physics.mu_f / physics.rho);
}

/// Rank 0. Prints the loads of the openings.
void tell_of_loads(const Conditions& conditions) {
  for (const auto& [name, condition] : conditions) {
    const auto* opening = std::get_if<Opening>(&condition);
    if (opening == nullptr || !opening->load.any()) continue;
    const Load& load = opening->load;
    std::printf("patch %s: resistance %g", name.c_str(), load.proximal);
    if (load.distal > 0)
      std::printf(
          ", distal resistance %g, capacitance %g: its pressure follows a change of the flow with "
          "the time R_d C = %g; the part R / (R + R_d) = %.3g of a change comes at once",
          load.distal, load.capacitance, load.distal * load.capacitance,
          load.proximal / (load.proximal + load.distal));
    std::printf("\n");
  }
}

/// Collective. A patch of type symmetry is a plane, or several.
void warn_of_curved_planes(const Conditions& conditions, const Mesh& mesh) {
  constexpr Real rounding = 0.1;  // degrees
  for (const Patch& patch : mesh.patches) {
    const auto found = conditions.find(patch.name);
    if (found == conditions.end() || !lets_slip(found->second)) continue;
    const Real turn = curvature(patch, mesh);
    if (turn > rounding && rank() == 0)
      std::fprintf(stderr,
                   "fsi: warning: patch \"%s\" of type symmetry is curved, by up to %.2g degrees "
                   "from face to face: symmetry is meant for planes, and a vessel's wall is of "
                   "type wall\n",
                   patch.name.c_str(), turn);
  }
}

/// Rank 0. Sets the length and the velocity that Ca and G* of the solids are to be of.
FlowSetup read_flow(Options& options) {
  FlowSetup flow;
  flow.convection = flow::convection_of(options.choice(
      "flow_convection", "linear", flow::convection_names(),
      "velocity at a face: linear between its cells, their mean (symmetric: makes no "
      "kinetic energy on any mesh), linear_upwind, or that without new extremes "
      "(limited)"));
  flow.orthogonal_projection =
      options.choice(
          "flow_projection", "compact", {"compact", "orthogonal"},
          "what is made free of divergence: the fluxes alone, or first the cells' velocities "
          "(orthogonal). With symmetric convection the latter keeps kinetic energy without "
          "viscosity; no solid, no pressure given") == "orthogonal";
  return flow;
}

TimeSetup read_time(Options& options) {
  TimeSetup time;
  time.end =
      options.real("time_end", 1, {.help = "end of the run", .unit = "time", .positive = true});
  time.courant = options.real(
      "time_courant", 0.5,
      {.help = "largest Courant number; with upwind convection it is 0.25 at most in cells "
               "other than triangles and tetrahedra, and beside a solid of r times the "
               "fluid's viscosity (2.5 / r)^(1/2)",
       .unit = "",
       .max = 1,
       .positive = true});
  time.step = options.real(
      "time_step", 0, {.help = "fixed step; 0: as the limits allow", .unit = "time", .min = 0});
  time.step_max =
      options.real("time_step_max", 0, {.help = "largest step; 0: none", .unit = "time", .min = 0});
  time.step_first = options.real(
      "time_step_first", 0,
      {.help = "first step, from which the next ones grow by a tenth each; 0: none of that",
       .unit = "time",
       .min = 0});
  for (const auto& [name, other] : {std::pair{"max", time.step_max}, {"first", time.step_first}})
    require(time.step == 0 || other == 0, std::string("options -time_step and -time_step_") + name +
                                              ": a fixed step has no other; give one of them");
  return time;
}

OutputSetup read_output(Options& options, const std::string& driver) {
  OutputSetup output;
  output.directory = options.text("output_dir", "out/" + driver, "where the files of the run go");
  output.field_interval =
      options.real("output_interval", 0,
                   {.help = "time between field files; 0: none", .unit = "time", .min = 0});
  output.sample_interval =
      options.real("sample_interval", 0,
                   {.help = "time between rows of the csv files, which cut no step, unless its "
                            "limit jumps up; 0: a row every step",
                    .unit = "time",
                    .min = 0});
  output.checkpoint_interval =
      options.real("checkpoint_interval", 0,
                   {.help = "time between checkpoints, of which the two newest are kept; 0: one "
                            "where the run does not reach its end",
                    .unit = "time",
                    .min = 0});
  output.restart =
      options.flag("restart", false, "go on from the newest checkpoint in -output_dir");
  output.divide_anew = options.flag(
      "restart_divide", false,
      "divide the mesh anew, so that the ranks share the solids where they are now: with -restart "
      "at once, and during a run when one rank has twice the mean of their cells");
  output.again = options.given("restart_again");
  output.end_when_empty = options.flag(
      "end_when_empty", false,
      "end the run once all solids have left the mesh: no cell is half full, or less than "
      "1 % is left");
  output.describe_step =
      options.flag("describe_step", false, "print what each call of a step does in this scene");
  output.wall_seconds_max = options.real(
      "max_wall_time", 0,
      {.help = "wall time after which the run ends in order; 0: no limit", .unit = "s", .min = 0});
  return output;
}

/// Errors: Error{input} for so short intervals that the run would not end: its steps stop at every
/// file.
void check_intervals(const OutputSetup& output, Real end) {
  constexpr Real files = 1e5, rows = 1e8;
  const auto check = [&](const char* name, Real interval, Real most, const char* things) {
    require(interval == 0 || end / interval <= most,
            std::string("option -") + name +
                print(": %g asks for %.2g %s in a run to t = %g; at most %g: give %.2g or more",
                      interval, end / interval, things, end, most, 1.06 * end / most));
  };
  check("output_interval", output.field_interval, files, "files");
  check("checkpoint_interval", output.checkpoint_interval, files, "files");
  check("sample_interval", output.sample_interval, rows, "rows");
}

/// The patches with that type of condition.
template <typename Type>
std::vector<std::string> patches_of(const Conditions& conditions, const Mesh& mesh) {
  std::vector<std::string> names;
  for (const Patch& patch : mesh.patches) {
    const auto found = conditions.find(patch.name);
    if (found != conditions.end() && std::holds_alternative<Type>(found->second))
      names.push_back(patch.name);
  }
  return names;
}

/// With -restart -restart_divide the cells that the solids of the newest checkpoint fill at least
/// half.
void share_as_in_checkpoint(MeshOptions& mesh, const std::vector<SolidSetup>& solids,
                            const OutputSetup& output) {
  if (solids.empty() || !output.restart || !output.divide_anew) return;
  std::vector<std::string> names;
  for (const SolidSetup& s : solids) names.push_back(s.solid.name);
  mesh.loads = [names, directory = output.directory](Index first, Index count) {
    std::vector<Real> loads = io::solid_fractions(directory, names, first, count);
    for (Real& load : loads) load = load >= 0.5 ? 1 : 0;
    return loads;
  };
}

}  // namespace

void share_solids(MeshOptions& mesh, const std::vector<SolidSetup>& solids) {
  std::array<std::vector<shapes::Shape>, 2> placed;  // in 2-D, in 3-D
  for (const SolidSetup& s : solids)
    for (const int dim : {2, 3})
      if (!s.on_path) placed[dim - 2].push_back(shape_in(dim, s));
  if (placed[0].empty()) return;
  mesh.load = [placed](const Vec3& x, int dim) {
    const auto holds = [&](const shapes::Shape& shape) { return shape(x) < 0; };
    return static_cast<Real>(std::ranges::count_if(placed[dim - 2], holds));
  };
}

Case read_case(Options& options, const std::string& driver, const Vec3& path) {
  Case result;
  result.mesh = read_mesh_options(options, path);
  result.physics = read_physics(options);
  result.fluid = fluid(options, result.physics);
  result.flow = read_flow(options);
  result.solids = read_solids(options, result.physics);
  result.time = read_time(options);
  result.output = read_output(options, driver);
  result.driver = driver;
  result.flow_from = options.text(
      "flow_from", "",
      "folder of a run without solids on the same mesh: begin with the flow of its newest "
      "checkpoint, and at its time");
  share_solids(result.mesh, result.solids);
  share_as_in_checkpoint(result.mesh, result.solids, result.output);
  check_intervals(result.output, result.time.end);
  require(options.help() || !result.mesh.file.empty(),
          "option -mesh is missing: the gmsh file of the geometry");
  return result;
}

namespace {

/// Whether a force of its own moves a solid.
bool has_weight(const Case& setup) {
  return std::ranges::any_of(setup.solids, [&](const SolidSetup& s) {
    return norm(setup.physics.gravity + s.solid.acceleration) > 0;
  });
}

/// How to find Re where no one gives a velocity.
const char* text_of_velocity(const Case& setup) {
  if (has_openings(setup.flow.conditions)) return "column reynolds of flow.csv";
  return has_weight(setup) ? "rho U L / mu, U from ux, uy, uz of the solid's table"
                           : "rho U L / mu, U = mean_velocity of flow.csv";
}

void warn_of_empty_tables(Real interval, Real end) {
  if (interval <= end * (1 + 1e-9)) return;
  std::fprintf(stderr,
               "fsi: warning: -sample_interval %g is longer than the run to t = %g: the csv files "
               "will have no row after the start\n",
               interval, end);
}

}  // namespace

void tell_of_inertia(const Case& setup, Real length, Real velocity) {
  constexpr Real slow = 0.1;  // where it moves nothing
  const Physics& p = setup.physics;
  if (velocity == 0 || p.rho * velocity * length / p.mu_f >= slow || setup.solids.empty() ||
      has_weight(setup))
    return;
  std::printf(
      "inertia hardly matters at this Re: larger densities, up to Re = 1, give the same motion in "
      "fewer steps (doc/howto/vessel.md)\n");
}

void describe(const Case& setup, const Mesh& mesh, Real length, Real velocity) {
  warn_of_curved_planes(setup.flow.conditions, mesh);
  const PeakFlow peak =
      velocity == 0 ? peak_flow(setup.flow.conditions, mesh, setup.time.end) : PeakFlow{};
  std::vector<Real> edges;
  for (const SolidSetup& s : setup.solids) edges.push_back(mean_edge(shape_in(mesh.dim, s), mesh));
  const Conditions& conditions = setup.flow.conditions;
  const MeshFigures figures =
      mesh_figures(mesh, patches_of<Wall>(conditions, mesh), patches_of<Slip>(conditions, mesh));
  const Real force = largest_force(setup.flow.body_force, mesh, setup.time.end);
  if (rank() != 0) return;
  std::printf("%s\n", summary(setup.mesh.file, mesh, figures).c_str());
  const std::string past = warning(setup.mesh.file, findings(figures));
  if (!past.empty()) std::fprintf(stderr, "fsi: warning: %s\n", past.c_str());
  warn_of_empty_tables(setup.output.sample_interval, setup.time.end);
  const Physics& p = setup.physics;
  std::printf("fluid: %s\n", setup.fluid.c_str());
  if (setup.flow.body_force)
    std::printf("body force: %.4g per volume at its largest of twenty times\n", force);
  tell_of_loads(setup.flow.conditions);
  if (!peak.patch.empty()) {
    std::printf("%s\n", text_of(peak, p.mu_f / p.rho).c_str());
    length = peak.length, velocity = peak.top;
  } else if (velocity == 0)
    std::printf("the flow decides on Re: %s\n", text_of_velocity(setup));
  else
    std::printf("Re = %.4g on length %g and velocity %g\n", p.rho * velocity * length / p.mu_f,
                length, velocity);
  tell_of_inertia(setup, length, velocity);
  if (const Vec3& v = setup.flow.frame; norm(v) > 0)
    std::printf("the mesh moves at (%g, %g, %g): all that is written stands in its frame\n", v.x,
                v.y, v.z);
  for (std::size_t i = 0; i < setup.solids.size(); ++i) {
    const SolidSetup& s = setup.solids[i];
    const std::string name =
        s.solid.name.empty() ? s.shape_name : s.solid.name + " (" + s.shape_name + ")";
    const Real rho = s.solid.rho > 0 ? s.solid.rho : p.rho;
    const Real thickness = thickness_in(mesh.dim, s);
    std::printf(
        "%s: density ratio %.4g, viscosity ratio %.4g, %.1f cells (edges) through its thickness of "
        "%g",
        name.c_str(), rho / p.rho, s.solid.mu / p.mu_f, thickness / edges[i], thickness);
    if (s.solid.G > 0 && thickness < well_resolved * edges[i])
      std::printf(" (%g give its strain and elastic energy to about a tenth)", well_resolved);
    if (velocity != 0)
      std::printf(", Ca = mu_f U / (G L) = %.4g, G* = G / (rho U^2) = %.4g",
                  p.mu_f * velocity / (s.solid.G * length),
                  s.solid.G / (p.rho * velocity * velocity));
    if (!s.by_default.empty()) std::printf("; not given, the defaults: %s", s.by_default.c_str());
    std::printf("\n");
    tell_of_section(name, s.shape_name, mesh.dim, thickness / edges[i]);
    if (s.solid.G > 0) tell_of_viscosity(name, s.solid.mu / p.mu_f, thickness / edges[i]);
  }
  std::fflush(stdout);
}

std::vector<Limit> limits(const Solver& solver, const TimeSetup& time) {
  if (time.step > 0) return {{time.step, "fixed"}};
  // The motion of the solid has a limit of its own under the same name.
  const Real carried = solver.body() != nullptr ? solver.carried_dt() : Limit{}.dt;
  const Real of_flow = std::min(solver.advective_dt(time.courant), solver.upwind_dt());
  std::vector<Limit> all{{std::min(of_flow, carried), "advective"}};
  // Values given over time may change while the flow is slow and would allow any step.
  const Real over_time = solver.conditions_dt(time.end);
  all.push_back({over_time < time.end ? over_time : Limit{}.dt, "conditions"});
  const Real whole = time.end - solver.t_begun();
  // The pressure of a load follows a change of the flow over some steps.
  constexpr int least_steps = 20;
  all.push_back({whole / least_steps, "end"});
  // A start from rest has no advective limit but from what moves at the boundary and what
  // accelerates the fluid. After a solid is put in, a hundredth of the run is small enough.
  constexpr int steps_of_start = 10;
  if (solver.steps() < steps_of_start) {
    Real start = std::min(whole / 100, solver.boundary_dt(time.courant));
    if (solver.state().step < steps_of_start)
      start = std::min(start, solver.acceleration_dt(time.courant, steps_of_start));
    all.push_back({start, "start"});
  }
  if (solver.body() != nullptr) all.push_back({solver.elastic_dt(), "elastic"});
  if (solver.body() != nullptr) all.push_back({solver.strain_dt(solid::strain_of_part), "strain"});
  if (time.step_first > 0)
    all.push_back({time.step_first * std::pow(step_growth, solver.steps()), "start"});
  if (time.step_max > 0) all.push_back({time.step_max, "step_max"});
  return all;
}

Limit stable_dt(const Solver& solver, const TimeSetup& time) {
  Limit limit;
  for (const Limit& other : limits(solver, time)) limit = tighter(limit, other);
  return limit;
}

}  // namespace fsi
