#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/read.hpp"

namespace fsi {
namespace {

/// Of the internal faces whose owner is owned: each face of the mesh once.
void face_quality(const Mesh& mesh, Quality& q) {
  Sum angles;
  GlobalIndex n = 0;
  for (Index f = 0; f < mesh.n_internal; ++f) {
    if (mesh.owner[f] >= mesh.n_owned) continue;
    const Vec3 &d = mesh.d[f], &Sf = mesh.Sf[f];
    const Real along = dot(d, Sf);
    // theta = acos(d . Sf / |d||Sf|)
    const Real cosine = std::clamp(along / (norm(d) * norm(Sf)), -1.0, 1.0);
    const Real angle = std::acos(cosine) * 180 / std::numbers::pi;
    q.non_orthogonality_max = std::max(q.non_orthogonality_max, angle);
    angles.add(angle), ++n;
    // the line C_P + t d crosses the plane of the face at t = (Cf - C_P) . Sf / d . Sf
    const Vec3 r = mesh.Cf[f] - mesh.C[mesh.owner[f]];
    const Vec3 crossing = (dot(r, Sf) / along) * d;
    q.skewness_max = std::max(q.skewness_max, norm(r - crossing) / norm(d));
  }
  q.non_orthogonality_max = global_max(q.non_orthogonality_max);
  q.skewness_max = global_max(q.skewness_max);
  const Real total = angles.total();
  n = global_sum(n);
  q.non_orthogonality_mean = n > 0 ? total / static_cast<Real>(n) : 0;
}

Real closure(const Mesh& mesh) {
  Real worst = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    Vec3 sum;
    Real area = 0;
    for (const Index f : mesh.cell_faces[c]) {
      sum += mesh.owner[f] == c ? mesh.Sf[f] : -mesh.Sf[f];
      area += norm(mesh.Sf[f]);
    }
    worst = std::max(worst, norm(sum) / area);
  }
  return global_max(worst);
}

}  // namespace

Quality quality(const Mesh& mesh) {
  Quality q;
  face_quality(mesh, q);
  q.closure_max = closure(mesh);
  const auto owned = mesh.V.begin() + mesh.n_owned;
  const auto [low, high] = std::minmax_element(mesh.V.begin(), owned);
  constexpr Real none = std::numeric_limits<Real>::infinity();
  q.volume_min = global_min(mesh.n_owned > 0 ? *low : none);
  q.volume_max = global_max(mesh.n_owned > 0 ? *high : -none);
  return q;
}

Vec3 centre(const Mesh& mesh, const std::string& patch) {
  const Patch& faces = mesh.patch(patch);
  std::array<Sum, 4> sums;
  for (Index f = faces.begin; f < faces.end; ++f) {
    const Real area = norm(mesh.Sf[f]);
    for (int i = 0; i < 3; ++i) sums[i].add(area * mesh.Cf[f][i]);
    sums[3].add(area);
  }
  std::array<Real, 4> total{};
  Sum::totals(total, sums);
  return Vec3{total[0], total[1], total[2]} / total[3];
}

}  // namespace fsi
