#include "libfsi/operators/face_weights.hpp"

#include "libfsi/core/parallel.hpp"

namespace fsi {

FaceWeights::FaceWeights(const Mesh& mesh)
    : lambda(static_cast<std::size_t>(mesh.n_internal)),
      skew(lambda.size()),
      g(static_cast<std::size_t>(mesh.n_faces)),
      k(g.size()),
      place(g.size(), -1) {
  constexpr Real negligible = 1e-8;
  for (Index f = 0; f < mesh.n_faces; ++f) {
    const Vec3 S = mesh.Sf[f], d = mesh.d[f];
    g[f] = norm2(S) / dot(S, d);
    k[f] = S - g[f] * d;
    bool needed = tangent(f, mesh) > negligible;
    if (f < mesh.n_internal) {
      const Vec3 r = mesh.Cf[f] - mesh.C[mesh.owner[f]];
      lambda[f] = dot(S, r) / dot(S, d);
      skew[f] = r - lambda[f] * d;
      needed = needed || norm(from_midpoint(f, mesh)) > negligible * norm(d);
    } else {
      needed = needed || !mesh.brick(mesh.owner[f]);
    }
    if (!needed) continue;
    place[f] = static_cast<Index>(irregular.size());
    irregular.push_back(f);
  }
  uneven = !all_of_ranks(irregular.empty());
}

}  // namespace fsi
