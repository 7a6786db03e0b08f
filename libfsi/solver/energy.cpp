#include "libfsi/solver/energy.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"

namespace fsi {

EnergyBalance::EnergyBalance(const Solver& solver) : u_b_(solver.mesh()) {
  first_ = stored_ = largest_ = energy(solver);
  power_ = power(solver);
}

Real kinetic_energy(const Solver& solver) {
  const Mesh& mesh = solver.mesh();
  const flow::Density* density = solver.density();
  Sum sum;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Real rho = density ? density->of_cell()[c] : solver.physics().rho;
    sum.add(rho / 2 * mesh.V[c] * norm2(solver.state().u[c]));
  }
  return sum.total();
}

Real EnergyBalance::energy(const Solver& solver) const {
  const Mesh& mesh = solver.mesh();
  Real sum = kinetic_energy(solver);
  for (const Body& body : solver.bodies()) sum += body.law.energy(body.G, body.B, body.alpha, mesh);
  return sum;
}

Real EnergyBalance::power_of_boundary(const Solver& solver) {
  const Mesh& mesh = solver.mesh();
  const State& state = solver.state();
  const FaceWeights& weights = solver.weights();
  const flow::Density* density = solver.density();
  set_boundary_velocity(u_b_, state.u, solver.conditions(), state.t, mesh);
  Sum sum;
  for (std::size_t i = 0; i < mesh.patches.size(); ++i) {
    const bool open = fixes_pressure(solver.conditions()[i]);
    const bool slips = std::holds_alternative<Slip>(solver.conditions()[i]);
    for (Index f = mesh.patches[i].begin; f < mesh.patches[i].end; ++f) {
      const Index b = f - mesh.n_internal, P = mesh.owner[f];
      const Vec3 u = open ? state.u[P] : u_b_[b];
      const Real phi = state.phi[f], p = open ? solver.p_b()[b] : state.p[P];
      const Real rho = density ? density->of_face()[f] : solver.physics().rho;
      sum.add(-(p + rho / 2 * norm2(u)) * phi);
      if (open || slips) continue;
      sum.add(solver.mu()[f] * weights.g[f] * dot(u - state.u[P], u));
      for (const Body& body : solver.bodies())
        if (body.alpha[P] > 0)
          sum.add(body.alpha_f[f] * body.G * dot(dot(dev(body.T()[P]), mesh.Sf[f]), u));
    }
  }
  return sum.total();
}

Real EnergyBalance::power(const Solver& solver) {
  const Mesh& mesh = solver.mesh();
  const State& state = solver.state();
  const Vec3 S = solver.driving_gradient() * solver.axis();
  Sum sum;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    Vec3 f = S;
    if (solver.driving_force()) f += solver.driving_force()(mesh.C[c], state.t);
    for (const Body& body : solver.bodies()) f += body.alpha[c] * body.weight;
    sum.add(mesh.V[c] * dot(f, state.u[c]));
  }
  return sum.total() + power_of_boundary(solver);
}

void EnergyBalance::add(const Solver& solver, Real dt) {
  const Real before = power_;
  power_ = power(solver);
  work_ += dt * (before + power_) / 2;
  done_ += dt * (std::abs(before) + std::abs(power_)) / 2;
  stored_ = energy(solver);
  largest_ = std::max(largest_, stored_);
  made_ = std::max(made_, stored_ - first_ - work_);
}

Real EnergyBalance::part_made() const {
  const Real size = std::max(largest_, done_);
  return size > 0 ? made_ / size : 0;
}

void EnergyBalance::list(io::Snapshot& snapshot) {
  snapshot.add("energy_first", &first_);
  snapshot.add("energy_largest", &largest_);
  snapshot.add("energy_work", &work_);
  snapshot.add("energy_done", &done_);
  snapshot.add("energy_power", &power_);
  snapshot.add("energy_made", &made_);
}

}  // namespace fsi
