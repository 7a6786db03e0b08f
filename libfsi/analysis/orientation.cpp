#include "libfsi/analysis/orientation.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/core/eigen.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/shapes/shapes.hpp"

namespace fsi::analysis {

namespace {

/// v or -v, the one along `previous`, or along x without a previous one.
Vec3 agreeing(const Vec3& v, const Vec3& previous) {
  return (previous == Vec3{} ? v.x : dot(v, previous)) < 0 ? -v : v;
}

}  // namespace

Real angle_to_x(const Vec3& v) {
  return std::acos(std::min(std::abs(v.x), Real{1})) * (180 / shapes::pi);
}

Real turn_about_z(const Vec3& from, const Vec3& to) {
  constexpr Real upright = 1e-3;
  if (std::hypot(from.x, from.y) < upright || std::hypot(to.x, to.y) < upright) return 0;
  const Real angle = std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
  return std::remainder(angle * (180 / shapes::pi), 180);
}

Orientation orientation(const Surface& surface, const Vec3& centroid, const Orientation& previous) {
  std::array<Sum, 7> sums;
  for (Index k = 0; k < surface.size(); ++k) {
    // Exact over a facet with d corners of size A: A / (d (d + 1)) (sum r_i r_i + (sum r_i)^2).
    Vec3 total;
    SymTensor moment;
    for (int i = 0; i < surface.dim; ++i) {
      const Vec3 r = surface.facet(k)[i] - centroid;
      total += r, moment += square(r);
    }
    const Real size = surface.measure(k);
    moment += square(total);
    moment *= size / (surface.dim * (surface.dim + 1));
    sums[0].add(size);
    sums[1].add(moment.xx), sums[2].add(moment.xy), sums[3].add(moment.xz);
    sums[4].add(moment.yy), sums[5].add(moment.yz), sums[6].add(moment.zz);
  }
  std::array<Real, 7> t{};
  Sum::totals(t, sums);
  Orientation result;
  if (t[0] == 0) return result;
  result.gyration = SymTensor{t[1], t[2], t[3], t[4], t[5], t[6]};
  result.gyration *= 1 / t[0];
  SymTensor m = result.gyration;
  if (surface.dim == 2) m.zz = 2 * trace(m);  // keeps the z axis out of the choice
  const Eigen e = eigen(m);
  result.value = e.value;
  if (surface.dim == 2) result.value[2] = 0;
  result.n = agreeing(e.vector[0], previous.n);
  result.longest = agreeing(e.vector[surface.dim == 2 ? 1 : 2], previous.longest);
  return result;
}

}  // namespace fsi::analysis
