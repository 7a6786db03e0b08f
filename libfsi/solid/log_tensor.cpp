#include "libfsi/solid/log_tensor.hpp"

#include <array>
#include <cmath>

namespace fsi::solid {
namespace {

/// Be(d) = d / (exp(d) - 1), the Bernoulli function.
Real bernoulli(Real d) { return d == 0 ? 1 : d / std::expm1(d); }

}  // namespace

SymTensor exp(const Eigen& e) {
  return apply_to_eigenvalues(e, [](Real v) { return std::exp(v); });
}

SymTensor exp(const SymTensor& psi) { return exp(eigen(psi)); }

SymTensor log(const SymTensor& B) {
  return apply_to_eigenvalues(eigen(B), [](Real v) { return std::log(v); });
}

SymTensor log_rate(const Tensor& L, const SymTensor& psi) {
  const Eigen e = eigen(psi);
  std::array<Vec3, 3> Le;
  for (std::size_t j = 0; j < 3; ++j) Le[j] = dot(L, e.vector[j]);
  SymTensor rate;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& a = e.vector[i];
    const Real m = 2 * dot(a, Le[i]);
    rate += m * square(a);
    for (std::size_t j = i + 1; j < 3; ++j) {
      const Vec3& b = e.vector[j];
      const Real d = e.value[j] - e.value[i], up = bernoulli(d);
      // Be(-d) = Be(d) + d
      const Real r = (up + d) * dot(a, Le[j]) + up * dot(b, Le[i]);
      rate += r * both_ways(a, b);
    }
  }
  return rate;
}

}  // namespace fsi::solid
