#include "libfsi/field/of_place_and_time.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "libfsi/core/parallel.hpp"

namespace fsi {
namespace {

constexpr int samples = 64;  // in time

/// How far a component at a point comes from its value at t = 0.
struct Swing {
  Real size = 0;
  Vec3 x;
  int component = 0;
};

/// Collective. The largest of all ranks; of equal ones that of the least x, y, z.
Swing largest(const Swing& here) {
  constexpr std::size_t n = 5;
  const std::vector<Real> all = gathered(std::array<Real, n>{
      here.size, here.x.x, here.x.y, here.x.z, static_cast<Real>(here.component)});
  const Real* best = all.data();
  for (const Real* one = best; one < all.data() + all.size(); one += n)
    if (*one > *best ||
        (*one == *best && std::lexicographical_compare(one, one + n, best, best + n)))
      best = one;
  return {best[0], {best[1], best[2], best[3]}, static_cast<int>(best[4])};
}

}  // namespace

void OfPlaceAndTime::choose(Real end) const {
  constexpr Real rounding = 1e-12, part = 0.1;
  constexpr std::size_t most = 8;
  end_ = end, whole_ = 0, followed_.clear();
  std::array<bool, samples> seen{};  // what is followed swings there
  Real odd = 0;
  while (followed_.size() < most) {
    Swing here;
    Real size = 0;
    for (const Vec3& x : points_) {
      const Vec3 first = given_(x, 0);
      for (int k = 1; k < samples; ++k) {
        if (seen[k]) continue;
        const Vec3 u = given_(x, golden(k) * end);
        for (int i = 0; i < 3; ++i) {
          const Real swing = std::abs(u[i] - first[i]);
          size = std::max(size, std::abs(u[i]));
          if (swing > here.size) here = {swing, x, i};
        }
      }
    }
    const Swing next = largest(here);
    if (followed_.empty()) odd = rounding * global_max(size);
    if (!(next.size > std::max(odd, part * whole_))) return;
    followed_.emplace_back(
        [u = given_, x = next.x, i = next.component](Real t) { return u(x, t)[i]; });
    const OfTime& one = followed_.back();
    const OfTime::Range range = one.range(0, end);
    whole_ = std::max(whole_, range[1] - range[0]);
    for (int k = 1; k < samples; ++k)
      seen[k] = seen[k] || std::abs(one(golden(k) * end) - one(0)) > part * whole_;
  }
}

Real OfPlaceAndTime::step_of(Real t, Real end) const {
  if (end != end_) choose(end);
  Real dt = end;
  for (const OfTime& one : followed_) dt = std::min(dt, fsi::step_of(one, whole_, t, end));
  return dt;
}

}  // namespace fsi
