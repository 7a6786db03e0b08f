#pragma once
// How much the solid strains in a step, and the parts into which a step is divided for it.

#include <algorithm>

#include "libfsi/core/types.hpp"

namespace fsi::solid {

/// The strain of the solid in a transport.
struct Strain {
  Real rate = 0;     ///< largest rate of log B along a particle
  Real of_part = 0;  ///< largest change of log B in one part of the step
};

/// A step in which the solid would strain by more than this is divided, or made smaller.
inline constexpr Real strain_of_part = 0.4;
/// A step is taken back if the solid strains by more than this in it or in one of its parts.
inline constexpr Real strain_max = 0.5;
/// The largest number of parts.
inline constexpr int parts_max = 16;

/// Collective. The largest strain of all ranks.
Strain largest(const Strain& strain);

/// Collective. The number of equal parts into which to divide the rest of a step, at most `most`.
/// strain: what this rank's solid would strain in this rest.
int parts(Real strain, int most);

/// Collective. Takes a step of dt in parts. rate() is the strain rate at the start of the next
/// part. advance(part) takes the solid over that time and returns the rate at its end. Both are
/// those of this rank; the strain returned is that of all ranks.
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
  return largest(strain);
}

}  // namespace fsi::solid
