#include "libfsi/solid/strain.hpp"

#include <cmath>

#include "libfsi/core/parallel.hpp"

namespace fsi::solid {

int parts(Real strain, int most) {
  const Real wanted = global_max(strain) / strain_of_part;
  // Nothing is gained by parts where the strain is not a number.
  return wanted > 1 ? static_cast<int>(std::ceil(std::min<Real>(wanted, most))) : 1;
}

}  // namespace fsi::solid
