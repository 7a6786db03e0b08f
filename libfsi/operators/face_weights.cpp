#include "libfsi/operators/face_weights.hpp"

#include <algorithm>

#include "libfsi/core/parallel.hpp"

namespace fsi {

FaceWeights::FaceWeights(const Mesh& mesh)
    : lambda(static_cast<std::size_t>(mesh.n_internal)),
      skew(lambda.size()),
      g(static_cast<std::size_t>(mesh.n_faces)),
      k(g.size()) {
  constexpr Real round_off = 1e-10;
  Real skew_max = 0, k_max = 0;
  for (Index f = 0; f < mesh.n_faces; ++f) {
    const Vec3 S = mesh.Sf[f], d = mesh.d[f];
    g[f] = norm2(S) / dot(S, d);
    k[f] = S - g[f] * d;
    k_max = std::max(k_max, norm(k[f]) / norm(S));
    if (f >= mesh.n_internal) continue;
    const Vec3 r = mesh.Cf[f] - mesh.C[mesh.owner[f]];
    lambda[f] = dot(S, r) / dot(S, d);
    skew[f] = r - lambda[f] * d;
    skew_max = std::max(skew_max, norm(skew[f]) / norm(d));
  }
  skewed = global_max(skew_max) > round_off;
  non_orthogonal = global_max(k_max) > round_off;
  if (!skewed) std::fill(skew.begin(), skew.end(), Vec3{});
  if (!non_orthogonal) std::fill(k.begin(), k.end(), Vec3{});
}

}  // namespace fsi
