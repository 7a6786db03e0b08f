#include "libfsi/solver/output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "libfsi/analysis/measures.hpp"
#include "libfsi/analysis/surface.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/core/signals.hpp"

namespace fsi {
namespace {

const std::vector<std::string> flow_columns{"t",
                                            "dt",
                                            "dt_limit",
                                            "courant",
                                            "pressure_gradient",
                                            "pressure_drop",
                                            "flow_rate",
                                            "divergence_max",
                                            "kinetic_energy",
                                            "elastic_energy",
                                            "pressure_iterations",
                                            "wall_per_step"};

const std::vector<std::string> solid_columns{
    "t",  "x",  "y",  "z",     "ux",        "uy",        "uz",        "volume",
    "nx", "ny", "nz", "angle", "det_B_min", "det_B_max", "min_eig_B", "overshoot"};

CellField<SymTensor> B_field(const Body& body, const Mesh& mesh) {
  CellField<SymTensor> B(mesh, identity());
  for (Index c = 0; c < mesh.n_cells; ++c) B[c] = solid::B_of(body.Bt[c], body.alpha[c]);
  return B;
}

Real kinetic_energy(const Solver& solver, Real rho) {
  const Mesh& mesh = solver.mesh();
  Sum sum;
  for (Index c = 0; c < mesh.n_owned; ++c)
    sum.add(rho / 2 * mesh.V[c] * norm2(solver.state().u[c]));
  return sum.total();
}

Real flow_rate(const Solver& solver, const Patch& patch) {
  Sum sum;
  for (Index f = patch.begin; f < patch.end; ++f) sum.add(solver.state().phi[f]);
  return sum.total();
}

Real pressure_span(const Solver& solver) {
  const auto p = solver.state().p.owned();
  Real low = std::numeric_limits<Real>::max(), high = -low;
  for (const Real value : p) low = std::min(low, value), high = std::max(high, value);
  return global_max(high) - global_min(low);
}

}  // namespace

Output::Output(const Case& which, const Options& options, const Solver& solver,
               const std::string& driver, std::string flow_patch)
    : case_(which),
      options_(options),
      solver_(solver),
      driver_(driver),
      flow_patch_(std::move(flow_patch)),
      sample_(which.output.sample_interval) {
  io::make_directory(which.output.directory);
  io::write_text(which.output.directory + "/run.yaml", options.yaml());
  flow_.emplace(which.output.directory + "/flow.csv", flow_columns);
  if (solver.body()) {
    solid_.emplace(which.output.directory + "/solid.csv", solid_columns);
    volume_0_ = solver.body()->filled.volume;
    write_solid();
  }
  io::write_text(which.output.directory + "/summary.json", summary("failed"));
}

Output::~Output() {
  if (finished_ || rank() != 0) return;
  std::ofstream(case_.output.directory + "/summary.json") << summary("failed");
}

bool Output::go_on() {
  const Signal signal = pending_signal();
  const Real wall = case_.output.wall_seconds_max;
  interrupted_ = signal == Signal::end || (wall > 0 && global_max(watch_.seconds()) > wall);
  return !interrupted_;
}

Real Output::next_event() const { return sample_.next(solver_.state().t); }

void Output::after_step(const Limit& limit, Real dt) {
  if (solver_.state().step == 1) options_.check_unused();
  const bool every_step = case_.output.sample_interval <= 0;
  if (every_step || sample_.due(solver_.state().t)) write_row(limit, dt);
}

void Output::write_row(const Limit& limit, Real dt) {
  const State& s = solver_.state();
  divergence_ = flow::divergence_max(s.phi, solver_.mesh());
  const Real courant = dt / solver_.advective_dt(1);
  const Real now = watch_.seconds();
  const Real per_step =
      (now - rows_at_) / static_cast<Real>(std::max<std::int64_t>(1, s.step - row_step_));
  const Real rate = flow_patch_.empty() ? 0 : flow_rate(solver_, solver_.mesh().patch(flow_patch_));
  const std::optional<Body>& body = solver_.body();
  const Real elastic =
      body ? analysis::elastic_energy(case_.physics.G, B_field(*body, solver_.mesh()), body->alpha,
                                      solver_.mesh())
           : 0;
  const std::array row{s.t,
                       dt,
                       limit.dt,
                       courant,
                       solver_.driving_gradient(),
                       pressure_span(solver_),
                       rate,
                       divergence_,
                       kinetic_energy(solver_, case_.physics.rho),
                       elastic,
                       static_cast<Real>(solver_.report().pressure_iterations),
                       per_step};
  flow_->row(row);
  if (solver_.body()) write_solid();
  rows_at_ = now;
  row_step_ = s.step;
  constexpr Real seconds_between = 1;
  const bool due = broadcast(now > progress_at_ + seconds_between ? "yes" : "") == "yes";
  if (due || s.step == 1) {
    write_progress(limit, dt, divergence_);
    progress_at_ = now;
  }
}

void Output::write_solid() {
  const Body& body = *solver_.body();
  const State& s = solver_.state();
  const Mesh& mesh = solver_.mesh();
  const analysis::Motion m = analysis::motion(tracker_, body.alpha, s.u, mesh);
  const analysis::Surface surface = analysis::isosurface(body.alpha, mesh, tracker_.home);
  const analysis::Orientation o = analysis::orientation(surface, tracker_.home, axis_);
  axis_ = o.n;
  const analysis::Health h = analysis::health(B_field(body, mesh), body.alpha, mesh);
  drift_ = m.volume / volume_0_ - 1;
  const std::array row{s.t,
                       m.centroid.x,
                       m.centroid.y,
                       m.centroid.z,
                       m.velocity.x,
                       m.velocity.y,
                       m.velocity.z,
                       m.volume,
                       o.n.x,
                       o.n.y,
                       o.n.z,
                       o.angle,
                       h.det_min,
                       h.det_max,
                       h.eigenvalue_min,
                       body.advected.overshoot};
  solid_->row(row);
}

void Output::write_progress(const Limit& limit, Real dt, Real divergence) const {
  if (rank() != 0) return;
  const State& s = solver_.state();
  const Real eta = watch_.seconds() * (case_.time.end / s.t - 1);
  std::printf(
      "step %8lld  t %.5g  dt %.3g (%s)  Co %.3f  div %.1e  drift %.1e  p-its %d  u-its %d  ETA "
      "%.0f s\n",
      static_cast<long long>(s.step), s.t, dt, limit.name.c_str(),
      dt / limit.dt * case_.time.courant, divergence, drift_, solver_.report().pressure_iterations,
      solver_.report().velocity_iterations, eta);
  std::fflush(stdout);
}

std::string Output::summary(const std::string& status) const {
  io::Summary s;
  s.case_name = driver_;
  s.status = status;
  s.cells = solver_.mesh().n_global;
  s.ranks = ranks();
  s.steps = solver_.state().step;
  s.t = solver_.state().t;
  s.wall_seconds = watch_.seconds();
  s.divergence_max = divergence_;
  s.solid_volume_drift = drift_;
  s.phases = solver_.profile().seconds();
  return io::json(s);
}

Ending Output::finish() {
  finished_ = true;
  const std::string status = interrupted_ ? "interrupted" : "complete";
  io::write_text(case_.output.directory + "/summary.json", summary(status));
  if (rank() == 0)
    std::printf("%s at t = %g after %lld steps in %.1f s; files in %s\n", status.c_str(),
                solver_.state().t, static_cast<long long>(solver_.state().step), watch_.seconds(),
                case_.output.directory.c_str());
  return interrupted_ ? Ending::interrupted : Ending::complete;
}

}  // namespace fsi
