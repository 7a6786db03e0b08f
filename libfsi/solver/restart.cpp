#include "libfsi/solver/solver.hpp"

namespace fsi {

namespace {

void list_opening(io::Snapshot& snapshot, flow::Openings::One& opening) {
  const std::string& name = opening.patch.name;
  snapshot.add_optional("pressure_" + name, &opening.pressure);
  if (!opening.load.any()) return;
  // A patch may get a load when a run goes on.
  snapshot.add_optional("stored_" + name, &opening.stored);
  snapshot.add_optional("flow_" + name, &opening.flow);
  snapshot.add_optional("known_flow_" + name, &opening.flow_known);
  snapshot.add_optional("trend_" + name, &opening.trend);
}

}  // namespace

void Solver::list(io::Snapshot& snapshot) {
  snapshot.add("t", &state_.t);
  snapshot.add("step", &state_.step);
  snapshot.add("u", state_.u);
  snapshot.add("p", state_.p);
  snapshot.add("phi", state_.phi);
  if (auto& rest = projection_.oblique_rest()) snapshot.add("oblique_rest", *rest);
  auto& [last, before, rest] = momentum_.history();
  snapshot.add("convection", last);
  snapshot.add("convection_before", before);
  snapshot.add("viscous_rest", rest);
  if (auto& old = momentum_.old()) snapshot.add("momentum_past", old->u, "u");
  snapshot.add("momentum_dt_old", &momentum_.dt_old);
  snapshot.add("momentum_dt_before", &momentum_.dt_before);
  snapshot.add("momentum_steps", &momentum_.steps_taken);
  for (flow::Openings::One& opening : openings_.all()) list_opening(snapshot, opening);
  snapshot.add("dt_cap", &dt_cap_);
  if (prescribed_) snapshot.add_optional("flow_passed", &passed_);
  if (forcing_) snapshot.add_optional("driving_gradient", &forcing_->gradient);
  for (Body& body : bodies_) body.list(snapshot);
}

void Solver::resume() {
  for (Body& body : bodies_) body.resume();
  mix_density();
}

}  // namespace fsi
