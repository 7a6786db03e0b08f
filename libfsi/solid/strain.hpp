#pragma once
// How far the solid strains in a step, and the parts in which it does.

#include <algorithm>

#include "libfsi/core/types.hpp"

namespace fsi::solid {

/// What a transport did to the solid, on this rank.
struct Strain {
  Real rate = 0;     ///< largest rate of log B following the solid
  Real of_part = 0;  ///< largest change of log B in one part of the step
};

/// A step in which the solid would strain by more than this is taken in parts, or made smaller.
inline constexpr Real strain_of_part = 0.4;
/// A step, or one of its parts, in which it strains by more than this is taken back.
inline constexpr Real strain_max = 0.5;
/// At most so many parts.
inline constexpr int parts_max = 16;

/// Collective. Into how many equal parts to divide what is left of a step, at most `most`. strain:
/// what this rank's solid would strain in it.
int parts(Real strain, int most);

/// Collective. A step of dt in parts: rate() is the strain rate to begin the next part with,
/// advance(part) takes it over that time and returns the rate that it ended with.
template <class Rate, class Advance>
Strain in_parts(Real dt, const Rate& rate, const Advance& advance) {
  Strain strain;
  Real left = dt;
  for (int taken = 0, count = 0; count != 1; ++taken) {
    count = parts(rate() * left, parts_max - taken);
    const Real part = left / count, now = advance(part);
    strain = {std::max(strain.rate, now), std::max(strain.of_part, now * part)};
    left -= part;
  }
  return strain;
}

}  // namespace fsi::solid
