#include "libfsi/shapes/shapes.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "libfsi/core/error.hpp"

namespace fsi::shapes {
namespace {

void require_length(bool ok, const char* what, Real value) {
  require(ok, std::string(what) + " must be a positive length, not " + std::to_string(value));
}
void require_finite(const char* what, Real value) {
  require_length(value > 0 && std::isfinite(value), what, value);
}
void require_positive(const char* what, Real value) { require_length(value > 0, what, value); }

/// (a^2 + b^2)^(1/2), for lengths that neither overflow nor vanish when squared.
Real radius_of(Real a, Real b) { return std::sqrt(a * a + b * b); }

/// Distance to a product of two convex sets from the distances to each.
Real of_product(Real a, Real b) {
  return std::min(std::max(a, b), Real{0}) + radius_of(std::max(a, Real{0}), std::max(b, Real{0}));
}

/// Columns of a rotation matrix.
struct Frame {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
};

/// R = c I + s [k]x + (1 - c) k k^T   (Rodrigues), k a unit vector.
Frame rotation(const Vec3& k, Real c, Real s) {
  const auto column = [&](const Vec3& e) {
    return c * e + s * cross(k, e) + (1 - c) * dot(k, e) * k;
  };
  return {column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1})};
}

Shape turned(Shape shape, const Frame& r) {
  return [shape = std::move(shape), r](const Vec3& p) {
    return shape({dot(r.x, p), dot(r.y, p), dot(r.z, p)});
  };
}

Vec3 unit(const Vec3& axis) {
  const Real length = norm(axis);
  require(length > 0 && std::isfinite(length), "an axis must be a finite vector other than zero");
  return axis / length;
}

/// Signed distance to an axis-aligned ellipsoid. The foot point is y_i = a_i^2 p_i / (a_i^2 + t)
/// with t the largest root of F(t) = sum (a_i p_i / (a_i^2 + t))^2 - 1. With s = t + min a_i^2
/// nothing cancels. F falls and is convex in s > 0, so Newton's iteration from the left climbs to
/// the root.
Real ellipsoid_distance(const std::array<Real, 3>& a, const std::array<Real, 3>& p) {
  const Real least = *std::ranges::min_element(a);
  std::array<Real, 3> gap{};  // a_i^2 - least^2
  for (std::size_t i = 0; i < 3; ++i) gap[i] = (a[i] - least) * (a[i] + least);
  const auto finite = [&](std::size_t i) { return std::isfinite(a[i]); };

  Real s = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (finite(i)) s = std::max(s, a[i] * std::abs(p[i]) - gap[i]);
  }
  const auto foot = [&](std::size_t i) {
    return p[i] == 0 ? 0 : a[i] * (a[i] * p[i] / (s + gap[i]));
  };
  constexpr int max_iterations = 100;  // each multiplies s by at most 3/2; far fewer are needed
  for (int k = 0; k < max_iterations; ++k) {
    Real f = -1, slope = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!finite(i) || p[i] == 0) continue;
      const Real q = foot(i) / a[i];
      f += q * q, slope -= 2 * q * q / (s + gap[i]);
    }
    if (f <= 0) break;
    const Real next = s - f / slope;
    if (!(next > s)) break;
    s = next;
  }
  // Inside, on the symmetry plane of a least axis: s = 0 and the foot point leaves the plane.
  Real square = 0, rest = 1, level = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!finite(i)) continue;
    const Real y = foot(i), q = y / a[i];
    square += (p[i] - y) * (p[i] - y), rest -= q * q, level += (p[i] / a[i]) * (p[i] / a[i]);
  }
  if (s == 0) square += least * least * std::max(rest, Real{0});
  return std::copysign(std::sqrt(square), level);
}

}  // namespace

Shape sphere(Real radius) {
  require_finite("the radius of a sphere", radius);
  return [radius](const Vec3& p) { return norm(p) - radius; };
}

Shape ellipsoid(const Vec3& semi_axes) {
  for (int i = 0; i < 3; ++i) require_positive("a semi-axis of an ellipsoid", semi_axes[i]);
  const std::array<Real, 3> a{semi_axes.x, semi_axes.y, semi_axes.z};
  require(std::isfinite(*std::ranges::min_element(a)), "an ellipsoid needs a finite semi-axis");
  return [a](const Vec3& p) { return ellipsoid_distance(a, {p.x, p.y, p.z}); };
}

Shape cylinder(Real radius, Real height) {
  require_finite("the radius of a cylinder", radius);
  require_positive("the height of a cylinder", height);
  return [radius, half = height / 2](const Vec3& p) {
    return of_product(radius_of(p.y, p.z) - radius, std::abs(p.x) - half);
  };
}

Shape torus(Real major, Real minor) {
  require_finite("the major radius of a torus", major);
  require_finite("the minor radius of a torus", minor);
  require(minor <= major, "the minor radius of a torus must not exceed its major radius");
  return
      [major, minor](const Vec3& p) { return radius_of(radius_of(p.y, p.z) - major, p.x) - minor; };
}

Shape capsule(Real radius, Real length) {
  require_finite("the radius of a capsule", radius);
  require_finite("the length of a capsule", length);
  return [radius, half = length / 2](const Vec3& p) {
    return norm({p.x - std::clamp(p.x, -half, half), p.y, p.z}) - radius;
  };
}

Shape box(const Vec3& sides) {
  for (int i = 0; i < 3; ++i) require_positive("a side of a box", sides[i]);
  return [half = sides / 2](const Vec3& p) {
    const Real x = std::abs(p.x) - half.x, y = std::abs(p.y) - half.y, z = std::abs(p.z) - half.z;
    return of_product(of_product(x, y), z);
  };
}

Shape translate(Shape shape, const Vec3& offset) {
  return [shape = std::move(shape), offset](const Vec3& p) { return shape(p - offset); };
}

Shape rotate(Shape shape, const Vec3& axis, Real angle) {
  return turned(std::move(shape), rotation(unit(axis), std::cos(angle), std::sin(angle)));
}

Shape align(Shape shape, const Vec3& axis) {
  const Vec3 n = unit(axis), k = cross({1, 0, 0}, n);
  const Real s = norm(k);
  const Vec3 about = s > 0 ? k / s : Vec3{0, 0, 1};  // along x either way: half a turn or none
  return turned(std::move(shape), rotation(about, n.x, s));
}

Shape unite(std::vector<Shape> parts) {
  require(!parts.empty(), "a union needs at least one shape");
  return [parts = std::move(parts)](const Vec3& p) {
    Real least = infinity;
    for (const Shape& part : parts) least = std::min(least, part(p));
    return least;
  };
}

}  // namespace fsi::shapes
