#include "libfsi/flow/viscous_pressure.hpp"

#include <algorithm>
#include <limits>

#include "libfsi/operators/symmetry_faces.hpp"

namespace fsi::flow {

// An error of p that differs from all its neighbours changes the predicted flux. Through it the
// term chi mu_c div u* takes up to chi K times the error off p, K = sum_f g |d|^2 / (2 V). K is dim
// on quads and hexes, and chi K must be less than 2.
ViscousPressure::ViscousPressure(const Mesh& mesh, const FaceWeights& weights,
                                 const std::vector<char>& mirrors)
    : mesh_(mesh), chi_(static_cast<std::size_t>(mesh.n_owned)) {
  constexpr Real chi_max = 0.5, answer_max = 1.5;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    Real K = 0;
    for (const Index f : mesh.cell_faces[c]) {
      const bool mirrored =
          f >= mesh.n_internal && !mirrors.empty() && mirrors[f - mesh.n_internal] != 0;
      // between the cell and its image g |d|^2 = |S| |d|
      K += (mirrored ? norm(mesh.Sf[f]) * norm(to_image(mesh, f))
                     : weights.g[f] * norm2(mesh.d[f])) /
           (2 * mesh.V[c]);
    }
    chi_[c] = std::min(chi_max, answer_max / K);
  }
}

// u* = u^(n+1) + grad q obeys the predictor, u^(n+1) does not. The difference is theta mu Lap grad
// q = grad(theta mu Lap q), with Lap q = div u*      [Brown01], [Timmermans96].
void ViscousPressure::add(CellField<Real>& p, const CellField<Real>& div, const FaceField<Real>& mu,
                          const FaceField<Real>& kappa, const FaceField<Real>& theta) const {
  for (Index c = 0; c < mesh_.n_owned; ++c) {
    Real mu_c = std::numeric_limits<Real>::max();
    for (const Index f : mesh_.cell_faces[c]) mu_c = std::min(mu_c, theta[f] * mu[f] + kappa[f]);
    p[c] -= chi_[c] * mu_c * div[c];
  }
  mesh_.halo.update(p);
}

}  // namespace fsi::flow
