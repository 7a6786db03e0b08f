#pragma once
// Figures of a case before its first step, and whether its mesh fits.

#include <string>
#include <vector>

#include "libfsi/field/boundary.hpp"
#include "libfsi/field/of_place_and_time.hpp"
#include "libfsi/shapes/shapes.hpp"

namespace fsi {

/// The largest flow that a patch prescribes during a run.
struct PeakFlow {
  std::string patch;  ///< "" where no patch prescribes a flow
  Real t = 0;         ///< when
  Real rate = 0;      ///< Q into the mesh; below 0 it leaves there
  Real mean = 0;      ///< |Q| / A
  Real top = 0;       ///< largest velocity; of a parabola that of a round section (2-D: of a slit)
  Real length = 0;    ///< (4 A / pi)^(1/2), in 2-D the patch's length
};

/// Collective. The flow with the largest mean * length, of all patches and of all times up to
/// `end`. Flow rates are sampled at 4000 even times and as many others, velocities at
/// 100 and 100.
PeakFlow peak_flow(const Conditions& conditions, const Mesh& mesh, Real end);

/// That flow in a sentence, with its Reynolds number. nu: kinematic viscosity.
std::string text_of(const PeakFlow& peak, Real nu);

/// Collective. The largest |f| in the cells at twenty times between 0 and end; 0 without a force.
Real largest_force(const OfPlaceAndTime::Function& f, const Mesh& mesh, Real end);

/// Errors: Error{input} unless the mesh comes again along x, to a thousandth of the way; the
/// direction in which it does is told.
void require_period_along_x(const Mesh& mesh);

/// Collective. Mean edge (mesh/gap.hpp) of the cells with their centre in the shape; of all cells
/// where there are none.
Real mean_edge(const shapes::Shape& shape, const Mesh& mesh);

/// Collective. By how many degrees at most the surface of the shape is off a right angle to the
/// boundary faces b with faces[b] != 0 that it meets; 0 if the shape is symmetric about them.
Real lean_at_planes(const shapes::Shape& shape, const std::vector<char>& faces, const Mesh& mesh);

/// Cells through the thickness of a solid that give its elastic energy to about a tenth. With 5 its
/// way is right to a hundredth, but the energy may be twice too large (doc/howto/vessel.md).
inline constexpr Real well_resolved = 16;

/// Of one rank: tells on standard error where the cells through a solid are few. through: their
/// number, dim: dimensions of the mesh.
void tell_of_section(const std::string& name, const std::string& shape, int dim, Real through);

/// Of one rank: tells on standard error where an elastic solid is much more viscous than the fluid.
/// On a coarse mesh it is strained too much. ratio: mu_s / mu_f.
void tell_of_viscosity(const std::string& name, Real ratio, Real through);

}  // namespace fsi
