#pragma once
// Eigenvalues and eigenvectors of a symmetric 3x3 tensor.

#include <array>

#include "libfsi/core/types.hpp"

namespace fsi {

/// t . vector[i] = value[i] vector[i], value[0] <= value[1] <= value[2]; the vectors are a
/// right-handed orthonormal frame.
struct Eigen {
  std::array<Real, 3> value{};   ///< in ascending order
  std::array<Vec3, 3> vector{};  ///< of unit length, beside them
};

/// Cyclic Jacobi rotations [GolubVanLoan13] 8.5: residual and orthogonality to a few units of
/// round-off of |t|, for repeated and nearly equal eigenvalues and for |t| from 1e-290 to 1e290
/// too. A tensor that is already diagonal costs only the ordering; a non-finite one gives values
/// NaN.
Eigen eigen(const SymTensor& t);

}  // namespace fsi
