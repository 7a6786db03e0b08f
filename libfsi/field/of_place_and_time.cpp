#include "libfsi/field/of_place_and_time.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "libfsi/core/parallel.hpp"

namespace fsi {

void OfPlaceAndTime::choose(Real end) const {
  constexpr Real rounding = 1e-12;
  constexpr int samples = 9;
  end_ = end, followed_.clear();
  std::array<Real, 3> widest{};
  std::array<Vec3, 3> where{};
  Real size = 0;
  for (const Vec3& x : points_) {
    std::array<Real, 3> low{}, high{};
    for (int k = 0; k < samples; ++k) {
      const Vec3 u = given_(x, golden(k) * end);
      for (int i = 0; i < 3; ++i) {
        low[i] = k == 0 ? u[i] : std::min(low[i], u[i]);
        high[i] = k == 0 ? u[i] : std::max(high[i], u[i]);
        size = std::max(size, std::abs(u[i]));
      }
    }
    for (int i = 0; i < 3; ++i)
      if (high[i] - low[i] > widest[i]) widest[i] = high[i] - low[i], where[i] = x;
  }
  const Real odd = rounding * global_max(size);
  whole_ = 0;
  for (int i = 0; i < 3; ++i) {
    if (!(widest[i] > odd)) continue;
    followed_.emplace_back([u = given_, i, x = where[i]](Real t) { return u(x, t)[i]; });
    const OfTime::Range range = followed_.back().range(0, end);
    whole_ = std::max(whole_, range[1] - range[0]);
  }
  whole_ = global_max(whole_);
}

Real OfPlaceAndTime::step_of(Real t, Real end) const {
  if (end != end_) choose(end);
  if (whole_ == 0) return end;
  Real dt = end;
  for (const OfTime& one : followed_) dt = std::min(dt, fsi::step_of(one, whole_, t, end));
  return global_min(dt);
}

}  // namespace fsi
