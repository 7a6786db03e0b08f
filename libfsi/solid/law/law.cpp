#include "libfsi/solid/law/law.hpp"

#include <algorithm>
#include <sstream>

#include "libfsi/core/eigen.hpp"
#include "libfsi/core/error.hpp"
#include "libfsi/solid/log_tensor.hpp"

namespace fsi::solid {
namespace {

/// Largest modulus of waves in the plane of the stretches, b of B in rising order. With n at an
/// angle a from the axis of b_3 and x = sin^2 a it is
///   (1 - x) g_31 + x g_13 + 4 x (1 - x) K,   g_ij = 2 W_1 b_i + 2 W_2 / b_j,
///   K = W_11 r^2 + 2 W_12 r s + W_22 s^2,   r = b_3 - b_1, s = 1 / b_1 - 1 / b_3
Real fastest(const Jet& W, const std::array<Real, 3>& b) {
  const Real r = b[2] - b[0], s = b[1] * r;  // b_1 b_2 b_3 = 1
  const Real g31 = 2 * W.d1 * b[2] + 2 * W.d2 * b[1] * b[2];
  const Real g13 = 2 * W.d1 * b[0] + 2 * W.d2 * b[0] * b[1];
  const Real K = W.d11 * r * r + 2 * W.d12 * r * s + W.d22 * s * s;
  Real most = std::max(g31, g13);
  if (4 * K > std::abs(g31 - g13)) {
    const Real x = (1 - (g31 - g13) / (4 * K)) / 2;
    most = std::max(most, (1 - x) * g31 + x * g13 + 4 * x * (1 - x) * K);
  }
  return std::isnan(g31) || std::isnan(g13) ? std::numeric_limits<Real>::quiet_NaN() : most;
}

}  // namespace

Response response(const Jet& W, const SymTensor& B) {
  // The adjugate is B^-1 where det B = 1, and finite for any B.
  return {(2 * W.d1) * B - (2 * W.d2) * adjugate(B), fastest(W, eigen(B).value), W.f};
}

SymTensor root(const SymTensor& B) {
  return apply_to_eigenvalues(eigen(B), [](Real b) { return std::sqrt(std::max(b, 1e-6)); });
}

Real Law::energy(Real G, const CellField<SymTensor>& B, const CellField<Real>& alpha,
                 const Mesh& mesh) const {
  Sum sum;
  sum_(sum, G, B, alpha, mesh);
  return sum.total();
}

void Law::check_at_rest() const {
  constexpr Real exact = 1e-9;
  const Response rest = at(identity());
  const auto refuse = [&](const char* what, Real value, const char* wanted) {
    std::ostringstream text;
    text << "law \"" << name_ << "\": " << what << " is " << value << ", but must be " << wanted;
    throw Error(ErrorKind::input, text.str());
  };
  if (!(std::abs(rest.W) < exact)) refuse("its energy at rest, I1 = I2 = 3,", rest.W, "0");
  if (!(std::abs(rest.modulus - 1) < exact))
    refuse("its shear modulus at rest, 2 (W_1 + W_2),", rest.modulus,
           "1: the energy is given in units of the solid's G");
}

}  // namespace fsi::solid
