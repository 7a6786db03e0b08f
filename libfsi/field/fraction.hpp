#pragma once
// Limits of the fraction of solid.

#include "libfsi/core/types.hpp"

namespace fsi {

/// A cell has an interface where alpha lies in (eps, 1 - eps).
inline constexpr Real interface_eps = 1e-8;
/// Whether a cell of that fraction holds a piece of the surface.
inline bool is_cut(Real alpha) { return alpha > interface_eps && alpha < 1 - interface_eps; }

}  // namespace fsi
