#pragma once
// The law of Mooney and Rivlin.

#include "libfsi/core/options.hpp"
#include "libfsi/solid/law/jet.hpp"

namespace fsi::solid {

/// W = ((1 - c) (I1 - 3) + c (I2 - 3)) / 2 in units of G:             [Mooney40], [Rivlin48]
///   tau = G dev((1 - c) B - c B^-1)
/// G stays the shear modulus at rest. In plane strain I2 = I1: there c changes the pressure alone.
struct MooneyRivlin {
  static constexpr const char* name = "mooney_rivlin";  ///< value of -solid_law
  Real c = 0.2;                                         ///< share of G in the term of I2

  /// Reads its parameter, with that beginning of its option.
  void read(Options& options, const std::string& option) {
    c = options.real(option + "_c2_share", c,
                     {.help = "mooney_rivlin: share of the shear modulus in the term of I2; "
                              "no matter in a 2-D run",
                      .unit = "",
                      .min = 0,
                      .max = 1});
  }
  /// W(I1, I2).
  Jet operator()(const Jet& I1, const Jet& I2) const {
    return ((I1 - 3) * (1 - c) + (I2 - 3) * c) * 0.5;
  }
};

}  // namespace fsi::solid
