#include "libfsi/solid/strain.hpp"

#include <cmath>

#include "libfsi/core/parallel.hpp"

namespace fsi::solid {

Strain largest(const Strain& strain) {
  return {.rate = global_max(strain.rate), .of_part = global_max(strain.of_part)};
}

int parts(Real strain, int most) {
  const Real wanted = global_max(strain) / strain_of_part;
  // A strain that is not a number gives one part.
  return wanted > 1 ? static_cast<int>(std::ceil(std::min<Real>(wanted, most))) : 1;
}

}  // namespace fsi::solid
