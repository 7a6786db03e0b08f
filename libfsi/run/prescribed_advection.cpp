#include "libfsi/run/prescribed_advection.hpp"

#include <array>
#include <cstdio>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/core/signals.hpp"
#include "libfsi/io/manifest.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/run/records.hpp"
#include "libfsi/vof/fill.hpp"

namespace fsi {
PrescribedAdvection::PrescribedAdvection(const Mesh& mesh, vof::Motion motion,
                                         const shapes::Shape& shape, bool trim)
    : mesh_(mesh),
      motion_(std::move(motion)),
      alpha_(mesh),
      start_(mesh),
      u_1_(mesh),
      u_(mesh),
      phi_1_(mesh),
      phi_(mesh),
      interface_(mesh),
      reconstruct_scratch_(mesh),
      advect_scratch_(mesh) {
  const vof::Filled filled = vof::fill(alpha_, mesh, shape);
  require(filled.volume > 0, "the solid is empty: its shape lies outside the mesh");
  require(trim || filled.clearance > 0,
          "the solid sticks out of the mesh, whose boundary reaches " +
              print("%.4g", -filled.clearance) + " deep into it: move it or make it smaller");
  start_.assign(alpha_);
  for (Index c = 0; c < mesh.n_cells; ++c) u_1_[c] = motion_.u(mesh.C[c]);
  vof::set_flux(phi_1_, motion_, mesh);
  Real most = 0;
  for (Index f = 0; f < mesh.n_faces; ++f) most = std::max(most, std::abs(phi_1_[f]));
  constexpr Real rounding = 1e-12;
  require(global_max(most) > rounding,
          "option -velocity: this motion is one of three dimensions; nothing moves in the mesh");
}

Real PrescribedAdvection::stable_dt(Real courant) const {
  const Real dt = vof::interface_dt(alpha_, phi_1_, courant, mesh_);
  return std::min(dt / std::max(std::abs(motion_.factor(t_)), 1e-10), motion_.period / 100);
}

void PrescribedAdvection::step(Real dt) {
  const Real factor = motion_.factor(t_ + dt / 2);
  for (Index f = 0; f < mesh_.n_faces; ++f) phi_[f] = factor * phi_1_[f];
  for (Index c = 0; c < mesh_.n_cells; ++c) u_[c] = factor * u_1_[c];
  vof::reconstruct(interface_, alpha_, mesh_, reconstruct_scratch_);
  report_ = vof::advect(alpha_, interface_, phi_, u_, dt, mesh_, advect_scratch_);
  t_ += dt;
  ++steps_;
}

PrescribedAdvectionOutput::PrescribedAdvectionOutput(const Case& setup, const Options& options,
                                                     const PrescribedAdvection& carried)
    : case_(setup),
      options_(options),
      carried_(carried),
      lock_(io::make_directory(setup.output.directory)),
      samples_(setup.output.sample_interval),
      field_(setup.output.field_interval) {
  require(
      !setup.output.restart && !setup.output.divide_anew && setup.output.checkpoint_interval == 0,
      "options -restart, -restart_divide and -checkpoint_interval: fsi-advect runs in one go");
  require(setup.flow_from.empty() && !setup.output.describe_step && !setup.output.end_when_empty,
          "options -flow_from, -describe_step and -end_when_empty: fsi-advect computes no flow");
  io::write_text(setup.output.directory + "/run.yaml", options.yaml());
  const Row first = row();
  table_.emplace(setup.output.directory + "/solid.csv", names(first.entries));
  table_->row(values(first.entries));
  samples_.hold({first});
  if (setup.output.field_interval > 0) fields_.emplace(setup.output.directory, carried.mesh());
  if (field_.due(0)) write_fields();
  io::write_text(summary_file(), summary("failed"));
}

bool PrescribedAdvectionOutput::go_on() {
  const Real wall = case_.output.wall_seconds_max;
  interrupted_ =
      pending_signal() == Signal::end || (wall > 0 && global_max(watch_.seconds()) > wall);
  return !interrupted_;
}

void PrescribedAdvectionOutput::after_step() {
  try {
    write_due();
  } catch (const Error& error) {
    const std::string text = summary("failed", error.what());
    if (rank() == 0)
      io::replace_file(summary_file(), {std::as_bytes(std::span(text))}, io::Durable::no);
    throw;
  }
}

void PrescribedAdvectionOutput::write_due() {
  if (carried_.steps() == 1) options_.check_unused();
  write_rows();
  if (field_.due(carried_.t())) write_fields();
}

Row PrescribedAdvectionOutput::row() {
  const Mesh& mesh = carried_.mesh();
  const auto alpha = carried_.alpha().owned();
  const analysis::Motion m = analysis::motion(tracker_, carried_.alpha(), carried_.u(), mesh);
  if (volume_0_ == 0) volume_0_ = m.volume;
  drift_ = m.volume / volume_0_ - 1;
  const auto [least, most] = std::minmax_element(alpha.begin(), alpha.end());
  low_ = global_min(least == alpha.end() ? 0 : *least);
  high_ = global_max(most == alpha.end() ? 0 : *most);
  const Real t = carried_.t();
  return {t,
          t,
          {{"t", t},
           {"x", m.centroid.x},
           {"y", m.centroid.y},
           {"z", m.centroid.z},
           {"volume", m.volume},
           {"drift", drift_},
           {"alpha_min", low_},
           {"alpha_max", high_},
           {"difference", carried_.difference()}}};
}

void PrescribedAdvectionOutput::write_rows() {
  const Row now = row();
  for (const Real t : samples_.due(carried_.t())) table_->row(samples_.row(0, now, t)), row_at_ = t;
  samples_.hold({now});
}

void PrescribedAdvectionOutput::write_fields() {
  fields_->write(carried_.t(),
                 std::array{io::named("alpha", carried_.alpha()), io::named("u", carried_.u())});
}

std::string PrescribedAdvectionOutput::summary(const std::string& status,
                                               const std::string& message) const {
  io::Summary s;
  s.case_name = "advect";
  s.status = status;
  s.message = message;
  s.cells = carried_.mesh().n_global;
  s.ranks = ranks();
  s.steps = carried_.steps();
  s.t = carried_.t();
  s.wall_seconds = watch_.seconds();
  s.solid_volume_drift = drift_;
  return io::json(s);
}

RunStatus PrescribedAdvectionOutput::finish() {
  if (row_at_ < carried_.t() * (1 - 1e-12)) table_->row(values(row().entries));
  io::write_text(summary_file(), summary(interrupted_ ? "interrupted" : "complete"));
  const Real difference = carried_.difference();
  if (rank() == 0)
    std::printf(
        "t = %g after %lld steps in %.1f s: difference to the start %.4e, volume drift %.1e, alpha "
        "within [%.1e, 1 + %.1e]; files in %s\n",
        carried_.t(), static_cast<long long>(carried_.steps()), watch_.seconds(), difference,
        drift_, low_, high_ - 1, case_.output.directory.c_str());
  return interrupted_ ? RunStatus::interrupted : RunStatus::complete;
}

}  // namespace fsi
