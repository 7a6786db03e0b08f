#include "libfsi/core/clock.hpp"

#include <algorithm>
#include <cmath>

namespace fsi {

// A time counts as a multiple when it is within this part of an interval: sums of steps round.
constexpr Real tolerance = 1e-9;

std::int64_t Schedule::index(Real t) const {
  return static_cast<std::int64_t>(std::floor(t / interval_ + tolerance));
}

bool Schedule::due(Real t) {
  if (interval_ <= 0 || index(t) <= done_) return false;
  done_ = index(t);
  return true;
}

std::vector<Real> Schedule::reached(Real t) {
  std::vector<Real> times;
  if (interval_ <= 0) return times;
  for (const std::int64_t end = index(t); done_ < end;)
    times.push_back(static_cast<Real>(++done_) * interval_);
  return times;
}

Real Schedule::next(Real t) const {
  return interval_ <= 0 ? std::numeric_limits<Real>::max()
                        : static_cast<Real>(index(t) + 1) * interval_;
}

bool Schedule::at(Real t) const {
  return interval_ > 0 && std::abs(t / interval_ - std::round(t / interval_)) <= tolerance;
}

void Schedule::resume(Real t) {
  if (interval_ > 0) done_ = index(t);
}

Real Clock::step(Real limit, const Events& ahead) const {
  const Real rest = std::min(end_, ahead.hit) - t_;
  const bool hits = rest <= limit * (1 + tolerance);
  const Real dt = hits ? rest : rest < 2 * limit ? rest / 2 : limit;
  return std::min(dt, ahead.not_past - t_);
}

Real Forecast::seconds_left(Real wall, Real t, Real end) {
  if (wall > wall_) {
    const Real recent = (t - t_) / (wall - wall_);
    speed_ = speed_ < 0 ? recent : (speed_ + recent) / 2;
    wall_ = wall, t_ = t;
  }
  const Real rest = std::max(Real{0}, end - t);
  return speed_ > 0 ? rest / speed_ : rest > 0 ? std::numeric_limits<Real>::infinity() : 0;
}

std::string Forecast::text(Real seconds) {
  constexpr Real most = 10 * 24 * 3600;
  if (!(seconds < most)) return "more than 10 days";
  return std::to_string(static_cast<std::int64_t>(std::round(seconds))) + " s";
}

}  // namespace fsi
