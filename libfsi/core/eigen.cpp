#include "libfsi/core/eigen.hpp"

#include <limits>
#include <utility>

namespace fsi {
namespace {

using Matrix = Real[3][3];

/// Zeroes a[p][q] by a rotation in the plane (p, q), applied to the columns of v as well.
/// theta = (a_qq - a_pp) / (2 a_pq), t = tan of the smaller angle   [GolubVanLoan13] alg. 8.5.1
void rotate(Matrix& a, Matrix& v, int p, int q) {
  const Real theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const Real t = std::copysign(1 / (std::abs(theta) + std::sqrt(theta * theta + 1)), theta);
  const Real c = 1 / std::sqrt(t * t + 1), s = t * c;
  const int r = 3 - p - q;
  a[p][p] -= t * a[p][q], a[q][q] += t * a[p][q];
  a[p][q] = a[q][p] = 0;
  const Real arp = a[r][p], arq = a[r][q];
  a[r][p] = a[p][r] = c * arp - s * arq;
  a[r][q] = a[q][r] = s * arp + c * arq;
  for (int k = 0; k < 3; ++k) {
    const Real vkp = v[k][p], vkq = v[k][q];
    v[k][p] = c * vkp - s * vkq;
    v[k][q] = s * vkp + c * vkq;
  }
}

}  // namespace

Eigen eigen(const SymTensor& t) {
  Matrix a = {{t.xx, t.xy, t.xz}, {t.xy, t.yy, t.yz}, {t.xz, t.yz, t.zz}};
  Matrix v = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  // A norm without squares, which would leave the range of numbers long before t does.
  const Real scale = std::abs(t.xx) + std::abs(t.yy) + std::abs(t.zz) + std::abs(t.xy) +
                     std::abs(t.xz) + std::abs(t.yz);
  Eigen result;
  if (!(scale <= std::numeric_limits<Real>::max())) {
    result.value.fill(std::numeric_limits<Real>::quiet_NaN());
    result.vector = {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return result;
  }
  const Real small = scale * std::numeric_limits<Real>::epsilon() / 16;
  // Convergence is quadratic: five sweeps do for any tensor.
  constexpr int max_sweeps = 12;
  for (int sweep = 0, turned = 1; turned != 0 && sweep < max_sweeps; ++sweep) {
    turned = 0;
    for (const auto& [p, q] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
      if (std::abs(a[p][q]) > small) rotate(a, v, p, q), turned = 1;
    }
  }
  std::array<int, 3> order{0, 1, 2};
  const auto order_pair = [&](int& i, int& j) {
    if (a[j][j] < a[i][i]) std::swap(i, j);
  };
  order_pair(order[0], order[1]), order_pair(order[1], order[2]), order_pair(order[0], order[1]);
  for (std::size_t i = 0; i < 3; ++i) {
    const int k = order[i];
    result.value[i] = a[k][k];
    result.vector[i] = {v[0][k], v[1][k], v[2][k]};
  }
  result.vector[2] = cross(result.vector[0], result.vector[1]);
  return result;
}

}  // namespace fsi
