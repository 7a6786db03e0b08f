#include "libfsi/solver/energy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi {
namespace {

/// The elastic energy of an undeformed solid is not 0 but the rounding of (tr B - 3) G / 2 in each
/// cell: some eps G V that vary with every step.
constexpr Real energy_rounding = 100 * std::numeric_limits<Real>::epsilon();  // of sum_i G_i V_i

/// If a force is a gradient, the pressure balances it and nothing moves. A small part of it stays
/// in cells at walls and where two densities meet, and varies. So energies count only beyond the
/// work f L V of the force along this part of the domain's length L. Once the fluid has moved that
/// far, the work itself is larger.
constexpr Real borne = 1e-3;

void add_kinetic_energy(Sum& sum, const Solver& solver) {
  const Mesh& mesh = solver.mesh();
  const flow::Density* density = solver.density();
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Real rho = density ? density->of_cell()[c] : solver.physics().rho;
    sum.add(rho / 2 * mesh.V[c] * norm2(solver.state().u[c]));
  }
}

}  // namespace

EnergyBalance::EnergyBalance(const Solver& solver) : u_b_(solver.mesh()) {
  set_power_and_stored(solver);
  least_ = largest_ = stored_;
}

Real kinetic_energy(const Solver& solver) {
  Sum sum;
  add_kinetic_energy(sum, solver);
  return sum.total();
}

void EnergyBalance::set_power_and_stored(const Solver& solver) {
  std::array<Sum, 3> sums;
  add_power(sums[0], sums[2], solver);
  add_power_of_boundary(sums[0], solver);
  add_power_of_parabola(sums[0], solver);
  add_kinetic_energy(sums[1], solver);
  for (const Body& body : solver.bodies())
    body.law.add_energy(sums[1], body.G, body.B, body.alpha, solver.mesh());
  std::array<Real, 3> totals{};
  Sum::totals(totals, sums);
  power_ = totals[0], stored_ = totals[1];
  const Real length = std::pow(solver.mesh().total_volume, Real{1} / solver.mesh().dim);
  resolved_ = borne * totals[2] * length;
  for (const Body& body : solver.bodies())
    resolved_ += energy_rounding * body.G * body.filled.volume;
}

void EnergyBalance::add_power_of_boundary(Sum& sum, const Solver& solver) {
  const Mesh& mesh = solver.mesh();
  const State& state = solver.state();
  const FaceWeights& weights = solver.weights();
  const flow::Density* density = solver.density();
  set_boundary_velocity(u_b_, state.u, solver.conditions(), state.t, mesh);
  for (std::size_t i = 0; i < mesh.patches.size(); ++i) {
    const bool open = fixes_pressure(solver.conditions()[i]);
    const bool slips = lets_slip(solver.conditions()[i]);
    for (Index f = mesh.patches[i].begin; f < mesh.patches[i].end; ++f) {
      const Index b = f - mesh.n_internal, P = mesh.owner[f];
      const Vec3 u = open ? state.u[P] : u_b_[b];
      const Real phi = state.phi[f], p = open ? solver.p_b()[b] : state.p[P];
      const Real rho = density ? density->of_face()[f] : solver.physics().rho;
      sum.add(-(p + rho / 2 * norm2(u)) * phi);
      if (open || slips) continue;
      sum.add(solver.mu()[f] * weights.g[f] * dot(u - state.u[P], u));
      for (const Body& body : solver.bodies()) {
        if (body.alpha[P] <= 0) continue;
        const Vec3& S = mesh.Sf[f];
        Vec3 traction = dot(dev(body.T()[P]), S);
        if (body.film && body.film->faces()[static_cast<std::size_t>(b)] != 0)
          traction = (dot(traction, S) / norm2(S)) * S;
        sum.add(body.alpha_f[f] * body.G * dot(traction, u));
      }
    }
  }
}

// V u = sum_f sigma phi (x_f - x_c), from the fluxes of the faces. It is exact for a uniform force,
// whose work is zero without inflow. Summed over the cells, S . V u is sum_f phi S . d.
void EnergyBalance::add_power(Sum& power, Sum& force, const Solver& solver) {
  const Mesh& mesh = solver.mesh();
  const State& state = solver.state();
  Sum of_gradient;
  if (const Vec3 S = solver.driving_gradient() * solver.axis(); norm2(S) > 0)
    for (Index f = 0; f < mesh.n_faces; ++f)
      if (mesh.owner[f] < mesh.n_owned) of_gradient.add(state.phi[f] * dot(S, mesh.d[f]));
  power.add(of_gradient);
  const bool heavy =
      std::ranges::any_of(solver.bodies(), [](const Body& body) { return norm2(body.weight) > 0; });
  if (!solver.driving_force() && !heavy) return;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    Vec3 moved;
    for (const Index face : mesh.cell_faces[c])
      moved += (outward(mesh, face, c) * state.phi[face]) * (mesh.face_centre(face, c) - mesh.C[c]);
    Vec3 f, weight;
    if (solver.driving_force()) f = solver.driving_force()(mesh.C[c], state.t);
    for (const Body& body : solver.bodies()) weight += body.alpha[c] * body.weight;
    power.add(dot(f, moved) + mesh.V[c] * dot(weight, state.u[c]));
    force.add(mesh.V[c] * norm(f + weight));
  }
}

void EnergyBalance::add_power_of_parabola(Sum& sum, const Solver& solver) const {
  const flow::WallParabola& parabola = solver.wall_parabola();
  for (std::size_t i = 0; i < parabola.walls().size(); ++i) {
    const Index b = parabola.walls()[i];
    if (norm2(u_b_[b]) == 0) continue;
    const Vec3 excess = parabola.excess(i, solver.state().u, u_b_);
    sum.add(solver.mu()[solver.mesh().n_internal + b] * dot(excess, u_b_[b]));
  }
}

void EnergyBalance::add(const Solver& solver, Real dt) {
  const Real before = power_;
  set_power_and_stored(solver);
  work_ += dt * (before + power_) / 2;
  done_ += dt * (std::abs(before) + std::abs(power_)) / 2;
  largest_ = std::max({largest_, stored_, resolved_});
  const Real rest = stored_ - work_;
  least_ = ++steps_ <= start ? rest : std::min(least_, rest);
  made_ = std::max(made_, rest - least_);
}

Real EnergyBalance::part_made() const {
  const Real size = std::max({largest_, done_, resolved_});
  return size > 0 ? made_ / size : 0;
}

void EnergyBalance::list(io::Snapshot& snapshot) {
  snapshot.add("energy_least", &least_);
  snapshot.add("energy_largest", &largest_);
  snapshot.add("energy_work", &work_);
  snapshot.add("energy_done", &done_);
  snapshot.add("energy_power", &power_);
  snapshot.add("energy_made", &made_);
  snapshot.add("energy_steps", &steps_);
}

}  // namespace fsi
