#include "libfsi/solver/energy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/figures.hpp"
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

/// B / (det B)^(1/dim), in plane strain with B_zz = 1; I where B is not positive definite.
SymTensor isochoric(SymTensor B, int dim) {
  const Real in_plane = B.xx * B.yy - B.xy * B.xy, J2 = dim == 2 ? in_plane : det(B);
  if (!(B.xx > 0 && in_plane > 0 && J2 > 0)) return identity();
  B = (1 / (dim == 2 ? std::sqrt(J2) : std::cbrt(J2))) * B;
  if (dim == 2) B.zz = 1;
  return B;
}

}  // namespace

CellField<SymTensor> B_field(const Body& body, const Mesh& mesh) {
  CellField<SymTensor> B(mesh, identity());
  for (Index c = 0; c < mesh.n_cells; ++c)
    if (body.alpha[c] > 0) B[c] = body.B_of(c);
  return B;
}

Real elastic_energy(const Body& body) { return elastic_energy(body, B_field(body, body.mesh)); }

Real elastic_energy(const Body& body, CellField<SymTensor> B) {
  // With left_cauchy_green det B drifts, so the energy is that of B / (det B)^(1/dim).
  if (std::holds_alternative<solid::LeftCauchyGreen>(body.kinematics))
    for (Index c = 0; c < body.mesh.n_owned; ++c) B[c] = isochoric(B[c], body.mesh.dim);
  return body.law.energy(body.G, B, body.alpha, body.mesh);
}

EnergyBalance::EnergyBalance(const Solver& solver)
    : u_b_(solver.mesh()), u_b_old_(solver.mesh()), phi_b_old_(solver.mesh()) {
  resume(solver);
  least_ = largest_ = stored_;
}

void EnergyBalance::resume(const Solver& solver) {
  const Real read = power_of_flow_, turning = power_of_turning_, stored = stored_;
  set_velocities(solver);
  keep_velocities(solver);
  set_powers_and_stored(solver);
  if (steps_ > 0) {
    power_of_flow_ = read, power_of_turning_ = turning;
    work_ += stored_ - stored;
  }
  power_ = power_of_flow_ + power_of_step_;
}

void EnergyBalance::set_velocities(const Solver& solver) {
  const State& state = solver.state();
  set_boundary_velocity(u_b_, state.u, solver.conditions(), state.t, solver.mesh());
  through_ = solver.holds_mean_velocity() ? solver.mean_velocity() : 0;
}

void EnergyBalance::keep_velocities(const Solver& solver) {
  const Index first = solver.mesh().n_internal;
  u_b_old_.assign(u_b_);
  for (Index b = 0; b < phi_b_old_.size(); ++b) phi_b_old_[b] = solver.state().phi[first + b];
  through_old_ = through_;
  const auto heavy = [](const Body& body) { return norm2(body.weight) > 0; };
  if (std::ranges::none_of(solver.bodies(), heavy)) return;
  if (!u_old_) u_old_.emplace(solver.mesh());
  u_old_->assign(solver.state().u);
}

Real kinetic_energy(const Solver& solver) {
  Sum sum;
  add_kinetic_energy(sum, solver);
  return sum.total();
}

void EnergyBalance::set_powers_and_stored(const Solver& solver) {
  std::array<Sum, 6> sums;
  auto& [of_flow, of_step, force, kinetic, elastic, of_turning] = sums;
  add_power_of_force(of_flow, force, solver);
  add_power_of_weight(of_step, force, solver);
  add_power_of_boundary(of_flow, of_step, of_turning, solver);
  add_power_of_parabola(of_flow, solver);
  add_kinetic_energy(kinetic, solver);
  Real of_drifting = 0;
  for (const Body& body : solver.bodies())
    if (std::holds_alternative<solid::LeftCauchyGreen>(body.kinematics))
      of_drifting += elastic_energy(body);
    else
      body.law.add_energy(elastic, body.G, body.B, body.alpha, solver.mesh());
  std::array<Real, 6> totals{};
  Sum::totals(totals, sums);
  if (!std::isfinite(totals[2]))
    throw Error(ErrorKind::numerics,
                print("the body force is not finite at t = %.8g", solver.state().t));
  power_of_flow_ = totals[0], power_of_step_ = totals[1], power_of_turning_ = totals[5];
  power_of_step_ +=
      solver.driving_gradient() * (through_old_ + through_) / 2 * solver.mesh().total_volume;
  kinetic_ = totals[3], elastic_ = totals[4] + of_drifting;
  stored_ = kinetic_ + elastic_;
  const Real length = std::pow(solver.mesh().total_volume, Real{1} / solver.mesh().dim);
  resolved_ = borne * totals[2] * length;
  for (const Body& body : solver.bodies())
    resolved_ += energy_rounding * body.G * body.filled.volume;
}

Real EnergyBalance::power_of_turning(const Solver& solver, Index f) const {
  const Mesh& mesh = solver.mesh();
  const GradientStencil& stencil = solver.u_stencil();
  const CellField<Vec3>& u = solver.state().u;
  const Index P = mesh.owner[f];
  Tensor L;
  for (const Index k : mesh.cell_faces[P]) {
    const Index n = beyond(mesh, k, P);
    if (n < 0 && stencil.given[k - mesh.n_internal] == 0) continue;
    const Vec3 rise = (n >= 0 ? u[n] : u_b_[k - mesh.n_internal]) - u[P];
    L += outer(rise, stencil.weight(k, mesh.owner[k] == P));
  }
  return solver.mu()[f] * dot(dot(transpose(L), mesh.Sf[f]), u_b_[f - mesh.n_internal]);
}

void EnergyBalance::add_power_of_boundary(Sum& of_flow, Sum& of_step, Sum& of_turning,
                                          const Solver& solver) {
  const Mesh& mesh = solver.mesh();
  const State& state = solver.state();
  const FaceWeights& weights = solver.weights();
  const flow::Density* density = solver.density();
  for (std::size_t i = 0; i < mesh.patches.size(); ++i) {
    const bool open = fixes_pressure(solver.conditions()[i]);
    const bool slips = lets_slip(solver.conditions()[i]);
    const bool given = prescribes_flow(solver.conditions()[i]);
    for (Index f = mesh.patches[i].begin; f < mesh.patches[i].end; ++f) {
      const Index b = f - mesh.n_internal, P = mesh.owner[f];
      const Vec3 u = open ? state.u[P] : u_b_[b];
      const Real p =
          open ? solver.p_b()[b] : state.p[P] + dot(solver.pressure_gradient()[P], mesh.d[f]);
      const Real rho = density ? density->of_face()[f] : solver.physics().rho;
      of_flow.add(-rho / 2 * norm2(u) * state.phi[f]);
      of_step.add(-p * (phi_b_old_[b] + state.phi[f]) / 2);
      if (open || slips) continue;
      const Vec3 mean = 0.5 * (u_b_old_[b] + u);
      of_flow.add(solver.mu()[f] * weights.g[f] * dot(u - state.u[P], u));
      if (given) {
        of_turning.add(power_of_turning(solver, f));
        if (const Index k = weights.place[f]; k >= 0)
          of_flow.add(solver.mu()[f] * dot(dot(solver.L_f()[k], weights.k[f]), u));
      }
      for (const Body& body : solver.bodies()) {
        if (body.alpha[P] <= 0) continue;
        const Vec3& S = mesh.Sf[f];
        Vec3 traction = dot(dev(body.T()[P]), S);
        if (body.film && body.film->faces()[static_cast<std::size_t>(b)] != 0)
          traction = (dot(traction, S) / norm2(S)) * S;
        of_step.add(body.alpha_f[f] * body.G * dot(traction, mean));
      }
    }
  }
}

// V u = sum_f sigma phi (x_f - x_c), from the fluxes of the faces. It is exact for a uniform force,
// whose work is zero without inflow.
void EnergyBalance::add_power_of_force(Sum& power, Sum& force, const Solver& solver) {
  if (!solver.driving_force()) return;
  const Mesh& mesh = solver.mesh();
  const State& state = solver.state();
  for (Index c = 0; c < mesh.n_owned; ++c) {
    Vec3 moved;
    for (const Index face : mesh.cell_faces[c])
      moved += (outward(mesh, face, c) * state.phi[face]) * (mesh.face_centre(face, c) - mesh.C[c]);
    const Vec3 f = solver.driving_force()(mesh.C[c], state.t);
    power.add(dot(f, moved));
    force.add(mesh.V[c] * norm(f));
  }
}

void EnergyBalance::add_power_of_weight(Sum& power, Sum& force, const Solver& solver) const {
  if (!u_old_) return;
  const Mesh& mesh = solver.mesh();
  for (const Body& body : solver.bodies()) {
    if (norm2(body.weight) == 0) continue;
    for (Index c = 0; c < mesh.n_owned; ++c) {
      if (!(body.alpha[c] > 0)) continue;
      const Vec3 weight = (mesh.V[c] * body.alpha[c]) * body.weight;
      power.add(dot(weight, 0.5 * ((*u_old_)[c] + solver.state().u[c])));
      force.add(norm(weight));
    }
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

// Stress and pressure of a step are those of its middle, so R is taken there.
void EnergyBalance::add(const Solver& solver, Real dt) {
  const Real before = power_of_flow_, kinetic = kinetic_, turned = power_of_turning_;
  set_velocities(solver);
  set_powers_and_stored(solver);
  power_ = (before + power_of_flow_) / 2 + power_of_step_;
  const Real rest = (kinetic + kinetic_) / 2 + elastic_ - (work_ + dt * power_ / 2);
  work_ += dt * power_;
  turning_ += dt * (turned + power_of_turning_) / 2;
  done_ += dt * std::abs(power_);
  largest_ = std::max({largest_, stored_, resolved_});
  least_ = ++steps_ <= start ? rest : std::min(least_, rest);
  made_ = std::max(made_, rest - least_);
  keep_velocities(solver);
}

Real EnergyBalance::part_made() const {
  const Real size = std::max({largest_, done_, resolved_});
  return size > 0 ? made_ / size : 0;
}

void EnergyBalance::list(io::Snapshot& snapshot) {
  snapshot.add("energy_stored", &stored_);
  snapshot.add("energy_least", &least_);
  snapshot.add("energy_largest", &largest_);
  snapshot.add("energy_work", &work_);
  snapshot.add("energy_done", &done_);
  snapshot.add("energy_power", &power_of_flow_);
  snapshot.add("energy_made", &made_);
  snapshot.add_optional("energy_turning", &turning_);
  snapshot.add_optional("energy_turning_power", &power_of_turning_);
  snapshot.add("energy_steps", &steps_);
}

}  // namespace fsi
