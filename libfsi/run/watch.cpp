#include "libfsi/run/watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "libfsi/core/eigen.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/run/forewords.hpp"
#include "libfsi/run/thin_film.hpp"
#include "libfsi/run/told.hpp"

namespace fsi {
namespace {

/// Of what the solid does at a wall with a film that is not resolved.
std::string tell_of_wall(const std::string& wall, const Body& body) {
  if (!body.film)
    return name_of(body) + " touches " + wall + " and sticks to it: with " +
           fsi::name_of(body.kinematics) +
           " there is no film between them; log_conformation has one";
  const std::string option = body.name.empty() ? "-solid" : "-solids_" + body.name;
  return "film between " + name_of(body) + " and " + wall +
         " is thinner than half a cell: how fast it slides there depends on the mesh; " + option +
         "_film_thickness gives the film's friction a thickness (doc/theory/walls.md)";
}

/// Cells at least half full of solid.
struct SolidCells {
  Real mean = 0;     // of the ranks
  Real busiest = 0;  // the most a rank has, over the mean; 0: none
};

/// Collective.
SolidCells solid_cells(const Solver& solver) {
  GlobalIndex mine = 0;
  for (const Body& body : solver.bodies())
    for (Index c = 0; c < body.mesh.n_owned; ++c) mine += body.alpha[c] >= 0.5 ? 1 : 0;
  const Real mean = static_cast<Real>(global_sum(mine)) / ranks();
  const Real most = global_max(static_cast<Real>(mine));
  return {mean, mean > 0 ? most / mean : 0};
}

/// Collective. Where the solid is strained most: the cell with the smallest eigenvalue of B.
std::string place_of_strain(const Solver& solver) {
  Real least = std::numeric_limits<Real>::max();
  Vec3 x;
  for (const Body& body : solver.bodies())
    for (Index c = 0; c < body.mesh.n_owned; ++c) {
      if (body.alpha[c] <= 0.5) continue;
      const Real value = eigen(body.B_of(c)).value[0];
      if (value < least) least = value, x = body.mesh.C[c];
    }
  // The least of all ranks, and of equal ones that of the first rank.
  const std::vector<Real> all = gathered(std::array{least, x.x, x.y, x.z});
  std::size_t best = 0;
  for (std::size_t i = 0; i < all.size(); i += 4)
    if (all[i] < all[best]) best = i;
  if (all[best] == std::numeric_limits<Real>::max()) return "";
  return print(
      "; the solid is strained most at (%.4g, %.4g, %.4g), where the smallest eigenvalue "
      "of B is %.3g",
      all[best + 1], all[best + 2], all[best + 3], all[best]);
}

}  // namespace

void tell_of_solids(const Solver& solver) {
  const Real busiest = ranks() > 1 ? solid_cells(solver).busiest : 0;
  if (rank() == 0 && busiest > 0)
    std::printf("solid cells on the ranks: largest over mean %.2f\n", busiest);
  constexpr Real straight = 1;  // degrees
  for (const Body& body : solver.bodies()) {
    const Real lean = lean_at_planes(body.shape, body.filled.cut_by.faces, body.mesh);
    if (lean > straight)
      say("warning", name_of(body) +
                         print(" is cut by a plane of symmetry, and is not symmetric about it: its "
                               "surface is off a right angle by %.2g degrees. The run takes the "
                               "part in the mesh and its image, with an edge between them; move "
                               "its centre into the plane, and turn its axis along or across it",
                               lean));
    if (body.filled.cut_by.odd)
      say("notice",
          name_of(body) +
              " is cut by parallel, oblique or curved planes of symmetry: its directions, angles, "
              "sections, bending and taylor are those of the part in the mesh");
  }
}

void tell_of_missing_solids(const Solver& solver, std::size_t in_case) {
  if (in_case > 0 && solver.bodies().empty())
    say("notice",
        "the case has a solid and the solver none: call put_solids(solver, setup) before the "
        "Output is made");
}

void tell_of_steps(std::int64_t made, std::int64_t told) {
  if (told < made)
    say("warning", print("%lld of %lld steps are in no file: Output::after_step follows every "
                         "Solver::advance",
                         static_cast<long long>(made - told), static_cast<long long>(made)));
}

std::string tell_of_no_finish() {
  std::string text = "the driver ended without Output::finish()";
  say("warning", text);
  return text;
}

std::string Watch::energy(Real made, const Solver& solver) {
  constexpr Real odd = 0.1, wrong = 0.5;
  if (made < odd || (told_of_energy_ && made <= wrong)) return "";
  const std::string text =
      print("at t = %.4g %.0f %% of the energy comes from nothing (column energy_made of flow.csv)",
            solver.state().t, 100 * made) +
      (solver.bodies().empty() ? ": the mesh has cells too flat for the flow (fsi-mesh check), or "
                                 "the steps are too long"
                               : ": the steps are too long or the mesh too coarse for the solid's "
                                 "stiffness or viscosity") +
      place_of_strain(solver);
  if (made <= wrong) say("warning", text);
  told_of_energy_ = true;
  return made > wrong ? text : "";
}

void Watch::end(Real begin, Real end) {
  constexpr Real rounding = 1e-9;
  if (told_of_end_ || begin < end * (1 - rounding)) return;
  told_of_end_ = true;
  say("warning",
      print(
          "a step begins at t = %g, at or past the end at %g: give the Clock time.end of the case, "
          "and the time after every step by Clock::set",
          begin, end));
}

void Watch::flow(const std::vector<Entry>& row, const EnergyBalance& energy, Real dt, Real t) {
  for (const Entry& entry : row) {
    if (entry.name == "reynolds") reynolds(entry.value);
    if (entry.name != "dissipation") continue;
    dissipation(entry.value, energy, dt, t);
    source(entry.value, energy, dt, t);
  }
}

void Watch::dissipation(Real taken, const EnergyBalance& energy, Real dt, Real t) {
  constexpr Real odd = 10;
  constexpr Real little = 1e-3;  // of the largest energy of the run: where a flow turns round
  if (told_of_dissipation_ || !(taken > odd * std::abs(energy.power())) ||
      !(taken * dt > std::max(std::abs(energy.stored()), little * energy.largest())))
    return;
  told_of_dissipation_ = true;
  say("warning",
      print("at t = %.4g viscosity takes %.3g per unit of time (column dissipation of flow.csv), "
            "where %.3g is put in and %.3g is stored: the velocity alternates from cell to cell; "
            "a slow flow on triangles or tetrahedra with a solid needs larger densities "
            "(doc/howto/vessel.md)",
            t, taken, energy.power(), energy.stored()));
}

void Watch::source(Real taken, const EnergyBalance& energy, Real dt, Real t) {
  constexpr int few = 20;               // values
  constexpr Real often = 2, odd = 0.5;  // of the energy stored meanwhile; of what viscosity takes
  constexpr Real little = 0.1;          // of the largest energy of the run
  if (told_of_source_) return;
  Span& s = span_;
  if (dt <= 0) return;
  steps_since_ = 0;
  if (s.values >= 0) {
    s.taken += (t - s.t) * (s.rate + taken) / 2;
    s.t = t, s.rate = taken, s.largest = std::max(s.largest, energy.stored()), ++s.values;
    if (s.values < few || s.taken < std::max(often * s.largest, little * energy.largest())) return;
    const Real made = s.taken + energy.stored() - s.stored - (energy.work() - s.work);
    if (made > odd * s.taken) {
      told_of_source_ = true;
      say("warning",
          print("between t = %.4g and %.4g %.0f %% of what viscosity takes (column dissipation of "
                "flow.csv) comes from nothing: neither work nor stored energy gave it; the steps "
                "are too long or the mesh too coarse",
                s.begin, t, 100 * made / s.taken));
    }
  }
  s = {.begin = t,
       .work = energy.work(),
       .stored = energy.stored(),
       .t = t,
       .rate = taken,
       .largest = energy.stored(),
       .values = 0};
}

void Watch::between_rows(Solver& solver, const EnergyBalance& energy, Real dt) {
  constexpr int often = 5;
  if (told_of_source_ || dt <= 0) return;
  if (++steps_since_ < often) return;
  source(fsi::dissipation(solver), energy, dt, solver.state().t);
}

void Watch::reynolds(Real number) {
  constexpr Real turbulent = 4000;  // in a straight pipe
  if (told_of_turbulence_ || !(number > turbulent)) return;
  told_of_turbulence_ = true;
  say("warning", print("the Reynolds number of the openings is %.3g (column reynolds of flow.csv): "
                       "beyond %.0f a vessel's flow is turbulent, and nothing here models that; if "
                       "it ought to be less, look at the units of density, viscosity, and of the "
                       "pressures, velocities and flow rates of the patches",
                       number, turbulent));
}

void Watch::taken_back(const StepReport& report, std::int64_t steps, const Limit& asked) {
  constexpr std::int64_t few = 20, part = 10;  // one in ten
  std::int64_t count = 0;
  for (const auto& [reason, number] : report.rejections) count += number;
  const bool fixed = asked.name == "fixed";
  if (told_of_steps_ || count < (fixed ? 1 : few) || (!fixed && count * part < steps)) return;
  told_of_steps_ = true;
  const auto of_reason = [](const auto& entry) { return entry.second; };
  const auto most = std::ranges::max_element(report.rejections, {}, of_reason);
  std::string text =
      print("%lld attempts at a step failed in %lld steps and were made again, shorter: ",
            static_cast<long long>(count), static_cast<long long>(steps)) +
      most->first;
  if (fixed)
    text += print("; -time_step %.4g is too long, a shorter one, or none, costs less", asked.dt);
  say("notice", text);
}

bool Watch::balance(const Solver& solver, bool divides, bool goes_on) {
  constexpr Real uneven = 2, few = 30;  // cells a rank: so few cost little
  constexpr Real grown = 1.5;           // where a new division was no better
  if (ranks() == 1 || (told_of_balance_ && !divides)) return false;
  const SolidCells cells = solid_cells(solver);
  if (share_at_start_ < 0) share_at_start_ = goes_on ? cells.busiest : 0;
  if (cells.mean < few || cells.busiest < uneven) return false;
  // The most there can be is all on one rank.
  const Real asked = std::min(grown * share_at_start_, (share_at_start_ + ranks()) / 2);
  const bool worse = cells.busiest >= asked;
  if (told_of_balance_) return worse;
  told_of_balance_ = true;
  say("notice", print("at t = %.4g one rank has %.2f times the mean of the solid's cells, and the "
                      "others wait for it",
                      solver.state().t, cells.busiest) +
                    (divides ? "" : "; with -restart_divide the run shares them anew"));
  return worse;
}

void Watch::bond(std::size_t i, const Solver& solver, const Soundness& sound) {
  const Body& body = solver.bodies()[i];
  Said& said = said_[i];
  constexpr Real most = 0.8;  // a strained solid may bare the cells at its edge
  if (sound.bond_kept < most && !said.off) {
    said.off = true;
    say("warning", print("at t = %.4g the ", solver.state().t) + name_of(body) +
                       print(" covers only %.0f %% of the faces of walls that it was bonded to: it "
                             "comes off, and nothing holds it there; the mesh is too coarse for "
                             "the strain at its foot, or it only touched the wall at the start "
                             "(doc/theory/walls.md)",
                             100 * sound.bond_kept));
  }
}

void Watch::films(std::size_t i, const Solver& solver) {
  const Body& body = solver.bodies()[i];
  Said& said = said_[i];
  if ((said.sliding && told_of_touch_) || leaves(body)) return;
  const ThinFilms thin = thin_films(i, solver);
  const std::string at = print("at t = %.4g the ", solver.state().t);
  if (!thin.wall.empty() && !said.sliding && body.film_thickness == 0) {
    said.sliding = true;
    say("notice", at + tell_of_wall(thin.wall, body));
  }
  if (!thin.other.empty() && !told_of_touch_) {
    told_of_touch_ = true;
    say("notice", at + "film between " + name_of(body) + " and " + thin.other +
                      " is thinner than a cell: there they move with one velocity, and how they "
                      "slide along each other depends on the mesh (doc/theory/step.md)");
  }
}

void Watch::crumbs(std::size_t i, const Solver& solver) {
  constexpr Real least = 1e-3;
  const Body& body = solver.bodies()[i];
  const Real part = body.volume_returned / body.filled.volume;
  if (part < least || said_[i].crumbled) return;
  said_[i].crumbled = true;
  say("notice", print("at t = %.4g %.2g %% of the ", solver.state().t, 100 * part) + name_of(body) +
                    " had come off it, and was taken back to its surface (column " +
                    "volume_returned of " + table_of(body) +
                    "): the mesh is coarse for the film at a wall, or for an edge");
}

void Watch::map(std::size_t i, const Solver& solver, const Soundness& sound) {
  constexpr Real least = 0.5, most = 2;  // there the map is not trusted at all
  const Body& body = solver.bodies()[i];
  Said& said = said_[i];
  const bool right = sound.map_det_min > least && sound.map_det_max < most;
  // What an opening has cut off has no neighbours to tell of.
  if (right || said.unmapped || leaves(body)) return;
  said.unmapped = true;
  say("warning",
      print("at t = %.4g the map of the ", solver.state().t) + name_of(body) +
          (sound.map_det_min > 0 ? print(" is wrong by a factor of %.2g in volume",
                                         std::max(1 / sound.map_det_min, sound.map_det_max))
                                 : std::string(" has folded")) +
          " (columns map_det_min and map_det_max of " + table_of(body) +
          "): its shape is no longer held there, and with reference_map its stress is wrong; the "
          "mesh is too coarse for the strain, or for the film at a wall");
}

void Watch::strain(std::size_t i, const Solver& solver, const Soundness& sound,
                   const EnergyBalance& energy) {
  constexpr Real least = 0.05;  // doc/verification/stability.md
  const Body& body = solver.bodies()[i];
  const std::string at = print("at t = %.4g ", solver.state().t);
  Said& said = said_[i];
  if (said.pieces < 0) said.pieces = std::max(sound.pieces, 1);
  if (sound.eigenvalue_min < least && !said.strained) {
    said.strained = true;
    say("warning", at + "the smallest eigenvalue of B in the " + name_of(body) +
                       print(" is %.3g, below %g", sound.eigenvalue_min, least) +
                       " (column min_eig_B of " + table_of(body) +
                       "): the mesh is too coarse for so much strain, or the solid too soft");
  }
  bond(i, solver, sound);
  films(i, solver);
  crumbs(i, solver);
  map(i, solver, sound);
  constexpr Real apart = 0.5;      // of the larger
  constexpr Real of_solid = 1e-3;  // of G times the volume
  // A stiff solid is far below that, and yet may store more than the flow gave. In slow flow little
  // is stored, and the work tells what counts.
  constexpr Real of_stored = 0.5, of_work = 0.01;
  const Real matters =
      std::min(of_solid * body.G * body.filled.volume,
               std::max(of_stored * energy.largest(), of_work * std::abs(energy.work())));
  const Real larger = std::max(sound.elastic_energy, sound.shape_energy);
  const Real off = std::abs(sound.elastic_energy - sound.shape_energy);
  // They may part at the start, belong together for long, and part again.
  constexpr int long_enough = 50;  // values
  said.agreed = off < apart / 2 * larger ? said.agreed + 1 : 0;
  if (said.agreed == long_enough) said.forgetful = false;
  // A solid that leaves has no shape to compare with.
  if (body.map() != nullptr && !leaves(body) && !said.forgetful && larger > matters &&
      off > apart * larger) {
    said.forgetful = true;
    say("warning", at + "the stress of the " + name_of(body) +
                       print(" holds an energy of %.3g, its shape one of %.3g",
                             sound.elastic_energy, sound.shape_energy) +
                       " (columns elastic_energy and shape_energy of " + table_of(body) +
                       "): strain and shape no longer belong to each other; the mesh is too " +
                       "coarse for the strain");
  }
  // The opening may cut a solid in two on its way out.
  if (sound.pieces > said.pieces && !said.torn && !leaves(body)) {
    said.torn = true;
    say("warning", at + "the " + name_of(body) + print(" is in %d pieces", sound.pieces) +
                       " of at least 1 % of its volume (column pieces of " + table_of(body) +
                       "): the mesh is too coarse for it, or the solid too soft; what follows is " +
                       "not to be believed");
  }
}

}  // namespace fsi
