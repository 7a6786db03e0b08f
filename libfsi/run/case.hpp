#pragma once
// The options all drivers share, resolved into plain structs.

#include <optional>
#include <string>
#include <vector>

#include "libfsi/core/clock.hpp"
#include "libfsi/core/options.hpp"
#include "libfsi/mesh/read.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi {

/// How time advances.
struct TimeSetup {
  Real end = 1, courant = 0.5;  ///< end of the run; Courant number of the flow
  Real step = 0;                ///< fixed step; 0: as large as the limits allow
  Real step_max = 0;            ///< 0: none
  Real step_first = 0;          ///< the next ones grow by a tenth each; 0: no such step
};

/// What is written, where and how often.
struct OutputSetup {
  std::string directory;  ///< where the files go
  /// Simulated time between field files, rows and checkpoints; 0: never.
  Real field_interval = 0, sample_interval = 0, checkpoint_interval = 0;
  bool restart = false;         ///< continue from the checkpoint in the directory
  bool divide_anew = false;     ///< divide the mesh by where the solids are, not were
  bool again = false;           ///< this body goes on from another one of the same program
  bool end_when_empty = false;  ///< once the solid has left the mesh
  bool describe_step = false;   ///< print what each call of a step does
  Real wall_seconds_max = 0;    ///< 0: no limit
};

/// A solid as the user described it.
struct SolidSetup {
  Solid solid;                 ///< shape, place and material
  shapes::Shape about_origin;  ///< the same shape, its axis of revolution along x
  Real angle = 0;              ///< between that axis and x when placed, in degrees
  std::string shape_name;      ///< as the option has it
  Real thickness = 0;          ///< the least of its dimensions, as a solid in three dimensions
  Vec3 centre{};               ///< its z is not used in a 2-D run
  bool on_path = false;        ///< whether its place still has to be found, on the mesh
  std::string options;         ///< prefix of its options: "solid_" or "solids_NAME_"
  std::string by_default{};    ///< its shear modulus and sizes that were not given
};

/// A case as the user described it.
struct Case {
  MeshOptions mesh;                ///< file, periods and division among ranks
  Physics physics;                 ///< the fluid's density and viscosity, gravity
  std::string fluid;               ///< in words, defaults included
  FlowSetup flow;                  ///< without conditions
  std::vector<SolidSetup> solids;  ///< in the order of their names
  TimeSetup time;                  ///< end and length of steps
  OutputSetup output;              ///< what is written
  std::string driver;              ///< its name, without fsi-
  std::string flow_from;           ///< folder of the run whose flow this one begins with; "": none
};

/// Reads the solids: that of the options -solid_..., or those of -solids_NAME_..., one for each
/// NAME with a shape. Errors: Error{input}, also if a solid has options but no shape, or an option
/// is of two solids.
std::vector<SolidSetup> read_solids(Options& options, const Physics& physics);
/// Prefixes of the options of solids whose shape is given as "none".
std::vector<std::string> solids_without_shape(const Options& options);
/// A solid's shape in a mesh of dimension 2 or 3: in 2-D the section through its centre, for any z
/// of the centre.
shapes::Shape shape_in(int dim, const SolidSetup& s);

/// The least of its dimensions in a run of that many: in a plane the least chord through the
/// centre.
Real thickness_in(int dim, const SolidSetup& s);
/// Collective. Puts all of them into the fluid, which begins as in Case::flow_from if there is one
/// and the run is no restart. Errors: those of Solver::put_solid and of `start_from_other_run`.
void put_solids(Solver& solver, const Case& setup);

/// Reads and checks the common options. `path`: the path of solids in this driver's flow, the
/// default of -mesh_divide_along. Errors: Error{input}.
Case read_case(Options& options, const std::string& driver, const Vec3& path = {});

/// The ranks shall share the cells whose centre the solids hold, as MeshOptions have it. The cells
/// around, which the surface cuts, are then shared well enough. A solid whose place is not known
/// does not count.
void share_solids(MeshOptions& mesh, const std::vector<SolidSetup>& solids);

/// Collective. Prints a description of the run: the mesh and its figures, with a warning if one is
/// past its limit (mesh/figures.hpp), the fluid, and the loads of the openings. Then come the
/// numbers that follow from the case's length and velocity. With a velocity of 0, which means
/// unknown, they are left out.
void describe(const Case& setup, const Mesh& mesh, Real length, Real velocity);

/// Collective. Every limit on the time step; a fixed step is the only one.
std::vector<Limit> limits(const Solver& solver, const TimeSetup& time);

/// Collective. The smallest of them.
Limit stable_dt(const Solver& solver, const TimeSetup& time);

}  // namespace fsi
