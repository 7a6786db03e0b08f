#pragma once
// The logarithm of B: its rate, and the way back.

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
/// The same, with the eigenvalues of psi taken here.
SymTensor exp(const SymTensor& psi);
/// psi = log(B), B positive definite.
SymTensor log(const SymTensor& B);

/// Rate of psi = log(B) following the material where B moves by dB/dt = L . B + B . L^T [Fattal04]
/// (19). In the eigenframe e_i of psi, with M_ij = e_i . L e_j and d = psi_j - psi_i, it is
///   (dpsi/dt)_ij = b(-d) M_ij + b(d) M_ji,   b(d) = d / (exp(d) - 1),   b(0) = 1,
/// This holds on the diagonal and for equal eigenvalues too.
SymTensor log_rate(const Tensor& L, const SymTensor& psi);

}  // namespace fsi::solid
