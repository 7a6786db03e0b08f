#include <array>
#include <cstdio>
#include <string>

#include "libfsi/core/error.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi {

void Solver::list(io::Snapshot& snapshot) {
  snapshot.add("t", &state_.t);
  snapshot.add("step", &state_.step);
  snapshot.add("u", state_.u);
  snapshot.add("p", state_.p);
  snapshot.add("phi", state_.phi);
  snapshot.add("momentum_history", momentum_.history());
  snapshot.add("momentum_dt_old", &momentum_.dt_old);
  snapshot.add("momentum_steps", &momentum_.steps_taken);
  if (forcing_) snapshot.add("driving_gradient", &forcing_->gradient);
  if (body_) body_->list(snapshot);
}

void Solver::resume() {
  if (body_) body_->resume();
}

Real Solver::advance(Real dt) {
  if (!backup_) {
    io::Snapshot state;
    list(state);
    backup_.emplace(state, mesh_);
  }
  backup_->keep();
  constexpr int halvings = 8;
  // Explicit convection cannot bear more in the velocity that a step ends with.
  constexpr Real courant_max = 2;
  std::string reason;
  for (int i = 0; i <= halvings; ++i, dt /= 2) {
    try {
      step(dt);
      if (dt <= advective_dt(courant_max)) return dt;
      reason = "the flow became too fast for the step";
    } catch (const Error& error) {
      if (error.kind() != Kind::numerics) throw;
      reason = error.what();
    }
    backup_->restore();
    resume();
    ++report_.rejected;
  }
  std::array<char, 96> where{};
  std::snprintf(where.data(), where.size(), "step %lld from t = %.6g failed down to dt = %.2g: ",
                static_cast<long long>(state_.step + 1), state_.t, 2 * dt);
  report_.failure = where.data() + reason;
  return 0;
}

}  // namespace fsi
