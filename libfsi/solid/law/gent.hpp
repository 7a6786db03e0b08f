#pragma once
// The law of Gent, for a solid whose molecular chains have a largest length.

#include "libfsi/core/options.hpp"
#include "libfsi/solid/law/jet.hpp"

namespace fsi::solid {

/// W = -(J_m / 2) ln(1 - (I1 - 3) / J_m) in units of G:                            [Gent96]
///   tau = G J_m / (J_m - (I1 - 3)) dev(B),   I1 - 3 < J_m
struct Gent {
  static constexpr const char* name = "gent";  ///< value of -solid_law
  Real limit = 50;                             ///< J_m

  /// Reads its parameter, with that beginning of its option.
  void read(Options& options, const std::string& option) {
    limit = options.real(
        option + "_limit", limit,
        {.help = "gent: the value J_m that tr B - 3 cannot reach", .unit = "", .positive = true});
  }
  /// W(I1, I2).
  Jet operator()(const Jet& I1, const Jet& /*I2*/) const {
    return log1p((I1 - 3) * (-1 / limit)) * (-limit / 2);
  }
};

}  // namespace fsi::solid
