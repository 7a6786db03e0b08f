#include "libfsi/run/output.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <exception>
#include <fstream>
#include <limits>

#include "libfsi/analysis/measures.hpp"
#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/core/signals.hpp"
#include "libfsi/io/manifest.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/run/continuation.hpp"

namespace fsi {
namespace {

/// `text` of rank 0 decides for all.
bool agreed(bool holds) { return broadcast(holds ? "yes" : "") == "yes"; }

/// Rank 0. Writes summary.json; if that fails, the old file stays.
void put_text(const std::string& directory, const std::string& text) {
  io::replace_file(directory + "/summary.json", {std::as_bytes(std::span(text))}, io::Durable::no);
}

}  // namespace

Output::Output(const Case& setup, const Options& options, Solver& solver, const std::string& driver,
               std::vector<Column> columns)
    : case_(setup),
      options_(options),
      solver_(solver),
      driver_(driver),
      simulated_(simulated(options)),
      columns_(std::move(columns)),
      lock_(io::make_directory(setup.output.directory)),
      checkpoints_(setup.output.directory, solver.mesh()),
      energy_(solver),
      watch_(solver.bodies().size()),
      diameters_(whole_diameters(solver)),
      samples_(setup.output.sample_interval),
      field_(setup.output.field_interval),
      checkpoint_(setup.output.checkpoint_interval) {
  for (std::size_t i = 0; i < solver.bodies().size(); ++i)
    records_.emplace_back(i < setup.solids.size() && setup.solids[i].shape_name == "torus");
  if (setup.output.restart) {
    go_on_from_checkpoint();
  } else {
    begin_anew(setup.output.directory, checkpoints_);
    checkpoint_.resume(solver_.state().t);  // the start needs none
    samples_.resume(solver_.state().t, "none");
    if (!setup.flow_from.empty()) tell_of_changes(changes_of_flow(solver_, setup, simulated_));
    solver_.report().rejected = 0, solver_.report().rejections.clear();
  }
  tell_of_solids(solver_);
  first_step_ = row_step_ = solver_.state().step;
  forecast_ = Forecast(solver_.state().t);
  for (const Column& column : columns_)
    require(column.value != nullptr, "column \"" + column.name + "\" has an empty function");
  saving([this] { open(); });
  tell_of_missing_solids(solver_, setup.solids.size());
  std::string line = "limits on dt:";
  for (const Limit& limit : limits(solver_, setup.time))
    line += " " + limit.name + (limit.dt < 1e300 ? print(" %.3g", limit.dt) : " none");
  if (rank() != 0) return;
  std::printf("%s\n", line.c_str());
  if (!setup.output.describe_step) return;
  for (const std::string& call : solver.describe_step()) std::printf("%s\n", call.c_str());
}

Output::~Output() {
  if (finished_ || rank() != 0) return;
  if (message_.empty())
    message_ = std::uncaught_exceptions() > 0 ? "ended by an error that standard error tells"
                                              : tell_of_no_finish();
  put_text(case_.output.directory, summary("failed"));
}

/// Calls `write`. A file that cannot be written ends the run, with a checkpoint and a message.
void Output::saving(const std::function<void()>& write) {
  try {
    write();
  } catch (const Error& error) {
    const std::string& failure = solver_.report().failure;
    message_ = (failure.empty() ? "" : failure + "; ") + error.what() + rescue(error.kind());
    if (rank() == 0) put_text(case_.output.directory, summary("failed"));
    finished_ = true;
    throw Error(error.kind(), message_);
  }
}

/// Whether a checkpoint holds the state; it may have been lost since.
bool Output::saved() const {
  return saved_step_ == solver_.state().step && agreed(std::ifstream(checkpoints_.file()).good());
}

/// Saves the state, if possible and useful; returns a message on it. Call it only if all ranks fail
/// alike, which errors of these kinds do.
std::string Output::rescue(ErrorKind kind) {
  if (kind != ErrorKind::io && kind != ErrorKind::numerics) return "";
  if (solver_.state().step == first_step_) return "";
  try {
    io::make_directory(case_.output.directory);  // it may be what was lost
    if (!saved()) write_checkpoint();
  } catch (const Error&) {
    // The first error is the one that is reported.
  }
  return where();
}

std::string Output::where() const {
  return saved() ? "; the state is in \"" + checkpoints_.file() + "\""
                 : "; the state could not be saved";
}

void Output::go_on_from_checkpoint() {
  const std::string now = simulated_;
  checkpoints_.read(snapshot(),
                    "leave out -restart, or choose its -output_dir (a run that reaches its end "
                    "keeps one only with -checkpoint_interval)");
  const std::string notice = differences(simulated_, now);
  simulated_ = now;
  solver_.resume();
  energy_.resume(solver_), watch_.resume(solver_);
  saved_step_ = solver_.state().step;
  samples_.resume(solver_.state().t, samples_text_);
  for (Schedule* event : {&field_, &checkpoint_}) event->resume(solver_.state().t);
  tell_of_start(solver_.state(), case_.time.end, checkpoints_.file());
  tell_of_changes(notice);
}

io::Snapshot Output::snapshot() {
  io::Snapshot all(identity(driver_, case_, solver_.bodies()));
  all.add("simulated", &simulated_);
  solver_.list(all);
  energy_.list(all);
  all.add("rejected_steps", &solver_.report().rejected);
  samples_text_ = samples_.text();
  all.add("rows", &samples_text_);
  for (std::size_t i = 0; i < records_.size(); ++i) records_[i].list(all, solver_.bodies()[i].name);
  return all;
}

void Output::open() {
  if (!case_.output.again) io::write_text(case_.output.directory + "/run.yaml", options_.yaml());
  open_tables();
  io::write_text(case_.output.directory + "/summary.json", summary("failed"));
}

void Output::open_tables() {
  const std::string& directory = case_.output.directory;
  const bool restart = case_.output.restart;
  const Real t = restart ? solver_.state().t : -std::numeric_limits<Real>::infinity();
  const Real t_row = restart ? std::max(t, samples_.last(t)) : t;
  const std::vector<SolidRecord> before = records_;
  std::vector<Row> first = rows({}, 0, 0);
  const std::vector<std::string> of_flow = names(first[0].entries);
  flow_.emplace(directory + "/flow.csv", of_flow, t_row);
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const std::string& name = solver_.bodies()[i].name;
    auto& table = solids_.emplace_back();
    if (solver_.bodies()[i].gone != 0) continue;  // its rows stay as they are
    table.emplace(directory + (name.empty() ? "/solid.csv" : "/solid_" + name + ".csv"),
                  names(first[i + 1].entries), t_row);
  }
  if (restart) {
    records_ = before;  // they must be found as they were
  } else {
    for (std::size_t i = 0; i < records_.size(); ++i)
      if (solids_[i]) solids_[i]->row(values(first[i + 1].entries));
    samples_.hold(std::move(first));
  }
  if (case_.output.field_interval <= 0) return;
  fields_.emplace(directory, solver_.mesh(), t);
  // On a restart the fields of its time may be missing: the last run may not have written them.
  if (field_.due(solver_.state().t) || field_.at(solver_.state().t)) write_fields();
}

bool Output::go_on() {
  saving([this] { require_same_solids(solver_, records_.size()); });
  const Signal signal = pending_signal();
  const Real wall = case_.output.wall_seconds_max;
  if (signal == Signal::checkpoint) write_checkpoint();
  interrupted_ = signal == Signal::end || (wall > 0 && global_max(stopwatch_.seconds()) > wall);
  const bool empty = !solver_.bodies().empty() &&
                     std::ranges::all_of(solver_.bodies(), [](auto& b) { return b.gone != 0; });
  if (empty && case_.output.end_when_empty) return false;
  again_ = divides_anew();
  return !interrupted_ && !again_ && solver_.report().failure.empty();
}

/// Whether the mesh is to be divided anew now; then a checkpoint holds the state, or all goes on.
bool Output::divides_anew() {
  constexpr std::int64_t between = 100;  // steps; a start costs as much as some tens of them
  if (!uneven_ || !case_.output.divide_anew || case_.solids.empty() || interrupted_ ||
      !solver_.report().failure.empty() || solver_.state().step < first_step_ + between)
    return false;
  uneven_ = false;  // where no file can be written, the next row asks again
  if (!saved()) write_checkpoint();
  return saved();
}

Events Output::next_event() const {
  const Real t = solver_.state().t;
  return {.hit = std::min(field_.next(t), checkpoint_.next(t)), .not_past = samples_.not_past(t)};
}

Limit Output::count(const Limit& limit, Real dt) {
  Limit taken = limit;
  if (solver_.report().held_back) {
    taken.name = "retry";
  } else if (dt < limit.dt * (1 - 1e-9)) {
    taken.name = "event";
  }
  ++limits_[taken.name];
  return taken;
}

void Output::after_step(const Limit& asked, Real dt) {
  ++steps_told_;
  if (solver_.report().failure.empty()) saving([&] { write_due(asked, dt); });
}

void Output::write_due(const Limit& asked, Real dt) {
  require_same_solids(solver_, records_.size());
  const Limit limit = count(asked, dt);
  const State& s = solver_.state();
  watch_.end(s.t - dt, case_.time.end);
  if (s.step == first_step_ + 1) options_.check_unused();
  energy_.add(solver_, dt);
  if (const std::string wrong = watch_.energy(energy_.part_made(), solver_); !wrong.empty())
    solver_.report().failure = wrong;
  watch_.taken_back(solver_.report(), s.step - first_step_, asked);
  watch_.leaving(solver_);
  write_rows(limit, dt);
  watch_.between_rows(solver_, energy_, energy_.started() ? dt : 0);
  if (field_.due(s.t)) write_fields();
  if (checkpoint_.due(s.t)) write_checkpoint();
  constexpr Real seconds_between = 1;
  if (!agreed(stopwatch_.seconds() > progress_at_ + seconds_between || s.step == first_step_ + 1))
    return;
  write_progress(limit, dt);
  progress_at_ = stopwatch_.seconds();
}

/// Of all tables.
std::vector<Row> Output::rows(const Limit& limit, Real dt, Real wall_per_step) {
  const State& s = solver_.state();
  std::vector<Row> all{{s.t, solver_.body() != nullptr ? solver_.body()->t : s.t, {}}};
  Real elastic_energy = 0;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const Body& body = solver_.bodies()[i];
    all.push_back({s.t, body.t, {}});
    if (body.gone != 0) continue;
    all.back().entries = records_[i].row(solver_, body);
    elastic_energy += records_[i].soundness().elastic_energy;
  }
  all[0].entries = flow_row(solver_, diameters_, elastic_energy, limit, dt, wall_per_step);
  all[0].entries.push_back({"work", energy_.work()});
  all[0].entries.push_back({"energy_made", energy_.part_made(), Course::step});
  watch_.flow(all[0].entries, energy_, energy_.started() ? dt : 0, s.t);
  for (const Column& column : columns_)
    all[0].entries.push_back({column.name, column.value(solver_), column.course});
  if (s.step == 0)
    for (Entry& entry : all[0].entries)
      if (entry.course == Course::pressure) entry.value = std::numeric_limits<Real>::quiet_NaN();
  for (std::size_t i = 0; i < records_.size(); ++i)
    if (solver_.bodies()[i].gone == 0) watch_.strain(i, solver_, records_[i].soundness(), energy_);
  uneven_ = watch_.balance(solver_, case_.output.divide_anew, case_.output.restart);
  return all;
}

void Output::write_rows(const Limit& limit, Real dt) {
  const State& s = solver_.state();
  const std::vector<Real> times = samples_.due(s.t);
  constexpr Real longer = 1.25;  // a next step that is longer still ends at the row
  // Each row follows the solids from the one before, so some are made that are not written.
  constexpr std::int64_t steps_between = 5;
  const bool near = samples_.near(s.t, longer * std::max(dt, limit.dt));
  std::vector<Row> now;
  if (near || !times.empty() || s.step % steps_between == 0) {
    const Real seconds = stopwatch_.seconds();
    const auto steps = static_cast<Real>(std::max<std::int64_t>(1, s.step - row_step_));
    now = rows(limit, dt, (seconds - rows_at_) / steps);
    if (!times.empty()) rows_at_ = seconds, row_step_ = s.step;
  }
  for (const Real t : times) {
    const std::vector<std::vector<Real>> all = samples_.rows(now, t);
    flow_->row(all[0]);
    for (std::size_t i = 1; i < all.size(); ++i)
      if (!all[i].empty()) solids_[i - 1]->row(all[i]);
  }
  samples_.hold(near ? std::move(now) : std::vector<Row>{});
}

void Output::write_fields() {
  solver_.at_one_time([this] {
    const State& s = solver_.state();
    CellField<Real> Q(solver_.mesh());
    analysis::q_criterion(Q, solver_.velocity_gradient());
    std::vector fields{io::named("u", s.u), io::named("p", s.p), io::named("Q", Q)};
    std::deque<CellField<SymTensor>> B;
    for (const Body& body : solver_.bodies()) {
      B.push_back(B_field(body, body.mesh));
      const std::string of = body.name.empty() ? "" : "_" + body.name;
      fields.push_back(io::named("alpha" + of, body.alpha));
      fields.push_back(io::named("B" + of, B.back()));
    }
    fields_->write(s.t, fields);
  });
  fields_at_ = solver_.state().t;
}

/// The last good state of a run that failed, after its checkpoint: bringing the solid to the time
/// of the flow may fail in its turn.
void Output::write_last_fields() {
  if (!fields_ || fields_at_ >= solver_.state().t) return;
  try {
    write_fields();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerics) throw;  // else the first error is reported
  }
}

void Output::write_checkpoint() {
  if (checkpoints_.write(snapshot())) saved_step_ = solver_.state().step;
}

void Output::write_progress(const Limit& limit, Real dt) {
  const State& s = solver_.state();
  divergence_ = flow::divergence_max(s.phi, solver_.mesh());
  const Real courant = dt / solver_.advective_dt(1);
  if (rank() != 0) return;
  const Real left = forecast_.seconds_left(stopwatch_.seconds(), s.t, case_.time.end);
  std::printf(
      "step %8lld  t %.5g  dt %.3g (%s)  Co %.3f  div %.1e  drift %.1e  p-its %d  u-its %d  ETA "
      "%s\n",
      static_cast<long long>(s.step), s.t, dt, limit.name.c_str(), courant, divergence_,
      largest_drift(records_), solver_.report().pressure_iterations,
      solver_.report().velocity_iterations, Forecast::text(left).c_str());
  std::fflush(stdout);
}

std::string Output::summary(const std::string& status) const {
  io::Summary s;
  s.case_name = driver_;
  s.status = status;
  s.message = message_.empty() ? solver_.report().failure : message_;
  s.cells = solver_.mesh().n_global;
  s.ranks = ranks();
  s.steps = solver_.state().step;
  s.first_step = first_step_;
  s.rejected_steps = solver_.report().rejected;
  s.t = solver_.state().t;
  s.wall_seconds = stopwatch_.seconds();
  s.divergence_max = divergence_;
  s.solid_volume_drift = largest_drift(records_);
  s.phases = solver_.profile().seconds();
  s.limits = limits_;
  for (const auto& [reason, number] : solver_.report().rejections)
    s.rejections[reason] = static_cast<Real>(number);
  return io::json(s);
}

RunStatus Output::finish() {
  const std::string& failure = solver_.report().failure;
  const bool complete = failure.empty() && !interrupted_ && !again_;
  saving([this] { require_same_solids(solver_, records_.size()); });
  tell_of_steps(solver_.state().step - first_step_, steps_told_);
  divergence_ = flow::divergence_max(solver_.state().phi, solver_.mesh());
  saving([&] {
    if (complete && fields_ && fields_at_ < solver_.state().t) write_fields();
    if ((!complete || case_.output.checkpoint_interval > 0) && !saved()) write_checkpoint();
    if (!failure.empty()) write_last_fields();
    if (complete && case_.output.again && case_.output.checkpoint_interval <= 0)
      checkpoints_.clear(false);
    if (failure.empty() && !complete && !saved())
      throw Error(ErrorKind::io, "the run was interrupted and its checkpoint could not be written");
    const std::string status = complete ? "complete" : failure.empty() ? "interrupted" : "failed";
    io::write_text(case_.output.directory + "/summary.json", summary(status));
  });
  finished_ = true;
  const std::string on = interrupted_ ? where() + ", and -restart goes on from it" : "";
  if (!failure.empty()) throw Error(ErrorKind::numerics, failure + where());
  if (rank() == 0)
    std::printf("%s at t = %g after %s in %.1f s; files in %s%s\n",
                again_         ? "mesh divided anew"
                : interrupted_ ? "interrupted"
                               : "complete",
                solver_.state().t, text_of_steps(solver_.state().step, first_step_).c_str(),
                stopwatch_.seconds(), case_.output.directory.c_str(), on.c_str());
  if (again_) hand_on(case_.output, global_max(stopwatch_.seconds()));
  return again_ ? RunStatus::again : interrupted_ ? RunStatus::interrupted : RunStatus::complete;
}

}  // namespace fsi
