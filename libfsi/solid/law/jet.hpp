#pragma once
// Numbers that carry their derivatives, so that the energy alone gives stress and stiffness.

#include <cmath>

#include "libfsi/core/types.hpp"

namespace fsi::solid {

/// A function of two variables up to its second derivatives, exact to rounding: value f, d1 =
/// df/dx_1, d12 = d2f/dx_1 dx_2 ... Arithmetic, exp, log, log1p, sqrt and pow work on all six.
struct Jet {
  Real f = 0, d1 = 0, d2 = 0, d11 = 0, d12 = 0, d22 = 0;  ///< value and derivatives

  constexpr Jet() = default;
  /// A constant.
  constexpr Jet(Real value) : f(value) {}  // NOLINT: a constant is a jet
  /// All six numbers.
  constexpr Jet(Real value, Real a, Real b, Real aa, Real ab, Real bb)
      : f(value), d1(a), d2(b), d11(aa), d12(ab), d22(bb) {}
  /// The variables themselves.
  static constexpr Jet first(Real x) { return {x, 1, 0, 0, 0, 0}; }
  /// The second variable.
  static constexpr Jet second(Real x) { return {x, 0, 1, 0, 0, 0}; }
};

///@{
/// Rules of differentiation.
constexpr Jet operator+(const Jet& a, const Jet& b) {
  return {a.f + b.f, a.d1 + b.d1, a.d2 + b.d2, a.d11 + b.d11, a.d12 + b.d12, a.d22 + b.d22};
}
constexpr Jet operator-(const Jet& a) { return {-a.f, -a.d1, -a.d2, -a.d11, -a.d12, -a.d22}; }
constexpr Jet operator-(const Jet& a, const Jet& b) {
  return {a.f - b.f, a.d1 - b.d1, a.d2 - b.d2, a.d11 - b.d11, a.d12 - b.d12, a.d22 - b.d22};
}
constexpr Jet operator*(const Jet& a, const Jet& b) {
  return {a.f * b.f,
          a.d1 * b.f + a.f * b.d1,
          a.d2 * b.f + a.f * b.d2,
          a.d11 * b.f + 2 * a.d1 * b.d1 + a.f * b.d11,
          a.d12 * b.f + a.d1 * b.d2 + a.d2 * b.d1 + a.f * b.d12,
          a.d22 * b.f + 2 * a.d2 * b.d2 + a.f * b.d22};
}
///@}
/// g(a) of g, g' and g'' at a.f.
constexpr Jet chain(const Jet& a, Real g, Real g1, Real g2) {
  return {g,
          g1 * a.d1,
          g1 * a.d2,
          g1 * a.d11 + g2 * a.d1 * a.d1,
          g1 * a.d12 + g2 * a.d1 * a.d2,
          g1 * a.d22 + g2 * a.d2 * a.d2};
}
/// The rule of the quotient.
constexpr Jet operator/(const Jet& a, const Jet& b) {
  const Real r = 1 / b.f;
  return a * chain(b, r, -r * r, 2 * r * r * r);
}
/// e^a.
inline Jet exp(const Jet& a) {
  const Real e = std::exp(a.f);
  return chain(a, e, e, e);
}
/// The natural logarithm.
inline Jet log(const Jet& a) { return chain(a, std::log(a.f), 1 / a.f, -1 / (a.f * a.f)); }
/// log(1 + a), exact for small a as well.
inline Jet log1p(const Jet& a) {
  const Real r = 1 / (1 + a.f);
  return chain(a, std::log1p(a.f), r, -r * r);
}
/// The square root.
inline Jet sqrt(const Jet& a) {
  const Real s = std::sqrt(a.f);
  return chain(a, s, 0.5 / s, -0.25 / (s * a.f));
}
/// a^n.
inline Jet pow(const Jet& a, Real n) {
  // powers of zero that are multiplied by zero count as zero
  const Real g1 = n == 0 ? 0 : n * std::pow(a.f, n - 1);
  const Real g2 = n == 0 || n == 1 ? 0 : n * (n - 1) * std::pow(a.f, n - 2);
  return chain(a, std::pow(a.f, n), g1, g2);
}

}  // namespace fsi::solid
