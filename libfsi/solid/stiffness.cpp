#include "libfsi/solid/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libfsi/core/eigen.hpp"

namespace fsi::solid {

void largest_stretch(CellField<Real>& lambda, const CellField<SymTensor>& aB,
                     std::span<const Index> cells) {
  for (const Index c : cells) lambda[c] = eigen(aB[c]).value[2];
}

Real elastic_time(const CellField<Real>& lambda, Real G, Real rho, const Mesh& mesh,
                  std::span<const Index> cells) {
  Real time = std::numeric_limits<Real>::max();
  if (G <= 0) return time;
  for (const Index c : cells) {
    Real area = 0;
    for (const Index f : mesh.cell_faces[c]) area = std::max(area, norm2(mesh.Sf[f]));
    const Real h = mesh.V[c] / std::sqrt(area);
    time = std::min(time, h * std::sqrt(rho / (G * std::max(lambda[c], 1.0))));
  }
  return time;
}

void Stiffness::clear(FaceField<Real>& kappa) {
  for (const Index f : last_faces_) kappa[f] = 0;
  last_faces_.clear();
}

void Stiffness::apply(FaceField<Real>& kappa, const CellField<Real>& lambda, Real G, Real dt,
                      const FaceWeights& weights, const Band& band) {
  constexpr Real share = 0.3, lambda_max = 20;
  clear(kappa);
  last_faces_ = band.faces();
  for (const Index f : band.faces()) {
    const Index P = mesh_.owner[f];
    Real l = std::min(lambda[P], lambda_max);
    if (f < mesh_.n_internal)
      l += weights.lambda[f] * (std::min(lambda[mesh_.neighbour[f]], lambda_max) - l);
    kappa[f] = share * dt * G * l;
  }
}

}  // namespace fsi::solid
