#pragma once
// The logarithm of B: its rate, and B from it.

#include "libfsi/core/eigen.hpp"
#include "libfsi/core/types.hpp"

namespace fsi::solid {

/// sum_i f(value_i) e_i (x) e_i.
template <class Function>
SymTensor apply_to_eigenvalues(const Eigen& e, Function&& f) {
  SymTensor sum;
  for (std::size_t i = 0; i < 3; ++i) sum += f(e.value[i]) * square(e.vector[i]);
  return sum;
}

/// B = exp(psi): symmetric and positive definite for any finite psi. e: of psi.
SymTensor exp(const Eigen& e);
/// The same from psi itself.
SymTensor exp(const SymTensor& psi);
/// psi = log(B), B positive definite.
SymTensor log(const SymTensor& B);

/// Rate of psi = log(B) along a particle for which dB/dt = L . B + B . L^T        [Fattal04] (19)
/// Let psi_i and v_i be the eigenvalues and eigenvectors of psi, and Lhat_ij = v_i . L . v_j. In
/// the basis of the v_i the rate is
///   (dpsi/dt)_ij = Be(psi_i - psi_j) Lhat_ij + Be(psi_j - psi_i) Lhat_ji
/// with Be(x) = x / (exp(x) - 1) and Be(0) = 1. This holds on the diagonal and for equal
/// eigenvalues too.
SymTensor log_rate(const Tensor& L, const SymTensor& psi);

}  // namespace fsi::solid
