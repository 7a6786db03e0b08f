#pragma once
// The neo-Hookean law.

#include "libfsi/core/options.hpp"
#include "libfsi/solid/law/jet.hpp"

namespace fsi::solid {

/// W = (I1 - 3) / 2 in units of G:   tau = G dev(B)                       [Matsumiya25] (8)
struct NeoHookean {
  static constexpr const char* name = "neo_hookean";  ///< value of -solid_law
  /// It has no parameter.
  void read(Options& /*options*/, const std::string& /*option*/) {}

  /// W(I1, I2).
  Jet operator()(const Jet& I1, const Jet& /*I2*/) const { return (I1 - 3) * 0.5; }
};

}  // namespace fsi::solid
