// A time loop of one's own: a soft disc in a cavity whose lid slides, stepped without Solver by the
// functions that Solver::step is made of. At the end it is compared with Solver::step, bit for bit.
//   gmsh -2 -setnumber n 32 meshes/cavity.geo -o cavity.msh
//   mine/own-loop -mesh cavity.msh
// The numbers beside the calls are those of doc/theory/step.md. What one disc of the fluid's
// viscosity on an orthogonal mesh between walls does not need is left out: (3), (10), (13), (14)
// and (19), and of (9) all but the friction at flat walls.

#include <libfsi/fsi.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace flow = fsi::flow;
using fsi::BoundaryField, fsi::CellField, fsi::FaceField, fsi::Index, fsi::Real, fsi::Vec3;

fsi::RunStatus own_loop() {
  // 1 parameters
  fsi::Options options("own-loop", "a soft disc in a cavity, by a time loop of one's own");
  const std::string file = options.text("mesh", "", "a cavity of squares, made by cavity.geo");
  const Real dt = options.real("step", 0.01, {.help = "length of a step", .positive = true});
  const int steps = options.integer("steps", 50, {.help = "number of steps", .min = 1});
  if (options.help()) return fsi::RunStatus::complete;
  options.check_unknown();
  const fsi::Physics physics{.rho = 1, .mu_f = 0.01};
  const fsi::Solid solid{.shape = fsi::shapes::translate(fsi::shapes::sphere(0.2), {0.6, 0.5, 0}),
                         .G = 0.1,
                         .mu = 0.01};

  // 2 mesh and boundary conditions
  const fsi::Mesh mesh = fsi::read_mesh({.file = file});
  const fsi::Conditions walls{{"top", fsi::Wall{{1, 0, 0}}}, {"wall", fsi::Wall{}}};
  const std::vector<fsi::Condition> conditions = fsi::resolve(walls, mesh);
  const fsi::FaceWeights weights(mesh);
  fsi::require(mesh.dim == 2 && !weights.uneven, "the cavity must be one of squares");

  // 3 the unknowns at rest, the solid, and what the parts of the step hand to each other
  CellField<Vec3> u(mesh), grad_p(mesh), grad_q(mesh), force(mesh);
  CellField<Real> p(mesh), q(mesh), divergence(mesh);
  CellField<fsi::Tensor> L(mesh);
  FaceField<Real> phi(mesh), mu(mesh, physics.mu_f), kappa(mesh), stiffness(mesh), source(mesh),
      excess(mesh);
  BoundaryField<Vec3> u_b(mesh), u_b_new(mesh);
  const BoundaryField<Real> none(mesh);  // of p and q: no patch is open
  const std::vector<fsi::Tensor> L_f;    // at irregular faces: there are none
  fsi::Kinks kinks(mesh);                // of u at the surface of the disc
  const fsi::GradientStencil stencil(mesh, weights, {true, true});  // u is given on both patches
  flow::Projection projection(mesh, weights, conditions, fsi::Method::direct, 0);
  const flow::ViscousPressure viscous_pressure(mesh, weights);
  flow::WallParabola parabola(mesh, conditions, stencil);
  flow::Momentum momentum(mesh, weights, conditions, physics.rho, physics.mu_f);
  momentum.bound_explicit_viscosity(physics.mu_f, flow::WallParabola::theta_max);
  momentum.hold_old_of_part();
  fsi::Body disc(mesh, weights, solid, physics);
  fsi::StrainByFlux by_flux(mesh);
  const fsi::FlowAround around{.u = u,
                               .phi = phi,
                               .u_b = u_b,
                               .open = momentum.boundary().open,
                               .u_stencil = stencil,
                               .pressure = projection.stencil(),
                               .L_f = L_f,
                               .mu = mu,
                               .by_flux = &by_flux,
                               .rho_least = physics.rho};
  const flow::MomentumTerms momentum_terms{.u_b = u_b,
                                           .u_b_new = u_b_new,
                                           .grad_p = grad_p,
                                           .L = L,
                                           .L_f = L_f,
                                           .phi = phi,
                                           .mu = mu,
                                           .kappa = kappa,
                                           .stiff = true,
                                           .force = force,
                                           .kinks = &kinks,
                                           .parabola = &parabola};
  flow::FluxTerms flux_terms{.L_f = L_f,
                             .p = p,
                             .grad_p = grad_p,
                             .grad_p_f = projection.face_gradient(),
                             .p_b = none,
                             .rhie_chow_source = source,
                             .mu = mu,
                             .theta = momentum.theta_taken(),
                             .kappa = kappa,
                             .rho = physics.rho,
                             .dt = dt,
                             .stress = disc.G,
                             .stiffness = &stiffness,
                             .excess = &excess};

  // 4 the loop
  Real t = 0;
  for (int n = 0; n < steps; ++n, t += dt) {
    fsi::hold_shape(disc);                                              // (1)
    fsi::advance_interface(disc, around, t + disc.time_offset() * dt);  // (2)
    fsi::advect_pressure_jump(p, disc);                                 // (4)
    projection.set_gradient(grad_p, p, none);                           // (5)
    fsi::set_boundary_velocity(u_b, u, conditions, t, mesh);            // (6)
    force.fill({}), source.fill(0), disc.semi_implicit_elasticity.clear(kappa, stiffness);

    fsi::transport_memory(disc, L, around);   // (7)
    fsi::transport_elastic(disc, L, around);  // (8)
    parabola.reset();
    parabola.keep_off(disc.alpha, disc.band.cells());                      // (9)
    fsi::add_elastic_force(force, source, disc, L, around);                // (11)
    fsi::add_semi_implicit(kappa, stiffness, force, disc, L, around, dt);  // (12)

    fsi::set_boundary_velocity(u_b_new, u, conditions, t + dt, mesh);
    auto& old = *momentum.old();  // of the step before
    fsi::set_boundary_velocity(old.u_b, old.u, conditions, t - momentum.dt_old, mesh);
    flow::set_flux_excess(excess, phi, u, L_f, weights, mesh);  // (15)
    kinks.clear();
    fsi::add_kinks(kinks, disc, L, physics.mu_f);
    momentum.predict(u, momentum_terms, dt);  // (16)
    flux_terms.t = t;
    flow::predict_flux(phi, u, u_b_new, around.open, flux_terms, weights, mesh);  // (17)
    flow::divergence(divergence, phi, mesh);
    projection.project(phi, q, grad_q, none, 0);  // (18)
    for (Index c = 0; c < mesh.n_cells; ++c) {
      u[c] -= grad_q[c];
      p[c] += physics.rho / dt * q[c];
    }
    viscous_pressure.add(p, divergence, mu, kappa, momentum.theta_taken());
  }

  // 5 the same by the library's own step
  fsi::Solver solver(mesh, physics, {.conditions = walls});
  solver.start([](const Vec3&) { return Vec3{}; });
  solver.put_solid(solid);
  for (int n = 0; n < steps; ++n) solver.step(dt);
  Real apart = 0, fastest = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    apart = std::max(apart, norm(u[c] - solver.state().u[c]));
    fastest = std::max(fastest, norm(u[c]));
  }
  apart = fsi::global_max(apart), fastest = fsi::global_max(fastest);
  if (fsi::rank() == 0)
    std::printf("%d steps, max |u| = %.6f, max |u - u_Solver| = %.3g\n", steps, fastest, apart);
  fsi::require(apart <= 1e-12, "the loop and Solver::step are apart");
  return fsi::RunStatus::complete;
}

int main(int argc, char** argv) { return fsi::run(argc, argv, own_loop); }
