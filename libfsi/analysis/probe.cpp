#include "libfsi/analysis/probe.hpp"

#include <array>
#include <limits>

#include "libfsi/core/parallel.hpp"

namespace fsi::analysis {

Probe probe(const Mesh& mesh, const Vec3& point) {
  constexpr Real none = std::numeric_limits<Real>::max();
  Real least = none;
  Index cell = -1;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Real square = norm2(point - mesh.C[c]);
    if (square < least) least = square, cell = c;  // cells are sorted by global_id
  }
  const bool nearest = least == global_min(least) && cell >= 0;
  const Real id = nearest ? static_cast<Real>(mesh.global_id[cell]) : none;
  const bool first = id == global_min(id) && nearest;
  return first ? Probe{point - mesh.C[cell], cell} : Probe{};
}

Real sample(const Probe& at, const CellField<Real>& value, const CellField<Vec3>& gradient) {
  Sum sum;
  if (at.cell >= 0) sum.add(value[at.cell] + dot(gradient[at.cell], at.offset));
  return sum.total();
}

Vec3 sample(const Probe& at, const CellField<Vec3>& u, const CellField<Tensor>& L) {
  std::array<Sum, 3> sums;
  if (at.cell >= 0) {
    const Vec3 value = u[at.cell] + dot(L[at.cell], at.offset);
    for (int i = 0; i < 3; ++i) sums[i].add(value[i]);
  }
  std::array<Real, 3> total{};
  Sum::totals(total, sums);
  return {total[0], total[1], total[2]};
}

}  // namespace fsi::analysis
