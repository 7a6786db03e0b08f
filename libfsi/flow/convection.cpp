#include "libfsi/flow/convection.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "libfsi/core/error.hpp"

namespace fsi::flow {
namespace {

/// conv_c += phi_b (u_b - u_c) at the boundary.
void add_boundary(CellField<Vec3>& conv, const FaceField<Real>& phi, const CellField<Vec3>& u,
                  const BoundaryField<Vec3>& u_b, const Mesh& mesh) {
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
    const Index P = mesh.owner[f];
    conv[P] += phi[f] * (u_b[f - mesh.n_internal] - u[P]);
  }
}

/// Sw(r) step with r = 2 slope . rise / |rise|^2 - 1 [Sweby84], and step shortened to |rise|. With
/// a longer one, which a skewed face may have, rounding would decide where the rise vanishes.
Vec3 limited_step(const Vec3& step, const Vec3& slope, const Vec3& rise) {
  const Real r2 = norm2(rise), s2 = norm2(step);
  const Real r = 2 * dot(slope, rise) / r2 - 1;
  if (!(r > 0)) return {};  // also without a rise
  return (std::min(2 * r, Real{1}) * (s2 > r2 ? std::sqrt(r2 / s2) : 1)) * step;
}

}  // namespace

Convection convection_of(const std::string& name) {
  const std::vector<std::string> names = convection_names();
  const auto at = std::ranges::find(names, name);
  require(at != names.end(), "convection scheme \"" + name + "\" unknown");
  return static_cast<Convection>(at - names.begin());
}

std::string name_of(Convection scheme) {
  return convection_names()[static_cast<std::size_t>(scheme)];
}

std::vector<std::string> convection_names() {
  return {"linear", "symmetric", "linear_upwind", "limited"};
}

void convection(CellField<Vec3>& conv, const FaceField<Real>& phi, const CellField<Vec3>& u,
                const BoundaryField<Vec3>& u_b, const std::vector<Tensor>& L_f,
                const FaceWeights& weights, const Mesh& mesh, bool symmetric) {
  conv.fill({});
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    const Vec3 half = (0.5 * phi[f]) * (u[N] - u[P]);
    conv[P] += half;
    conv[N] += half;
  }
  add_boundary(conv, phi, u, u_b, mesh);
  if (symmetric) return;
  for (std::size_t i = 0; i < weights.irregular.size(); ++i) {
    const Index f = weights.irregular[i];
    if (f >= mesh.n_internal) break;
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    const Vec3 d = mesh.d[f], m = weights.from_midpoint(f, mesh);
    const Real beta = weights.damping(f, mesh);
    const Vec3 rest =
        phi[f] * dot(L_f[i], m) - (0.5 * beta * std::abs(phi[f])) * (u[N] - u[P] - dot(L_f[i], d));
    conv[P] += rest;
    conv[N] -= rest;
  }
}

void add_kinks(CellField<Vec3>& conv, const FaceField<Real>& phi, const Kinks& kinks,
               const Mesh& mesh) {
  for (std::size_t i = 0; i < kinks.faces().size(); ++i) {
    const Index f = kinks.faces()[i];
    const Vec3 flux = phi[f] * kinks.excess()[i];
    conv[mesh.owner[f]] += flux;
    conv[mesh.neighbour[f]] -= flux;
  }
}

void convection_upwind(CellField<Vec3>& conv, const FaceField<Real>& phi, const CellField<Vec3>& u,
                       const BoundaryField<Vec3>& u_b, const CellField<Tensor>& L,
                       const std::vector<Tensor>& L_f, const FaceWeights& weights, const Mesh& mesh,
                       bool limited) {
  conv.fill({});
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f], i = weights.place[f];
    const bool forward = phi[f] >= 0;
    const Index U = forward ? P : N;
    const Tensor& L_U = i >= 0 && mesh.simplex(U) ? L_f[i] : L[U];
    const Vec3 d = mesh.d[f], r = mesh.Cf[f] - mesh.C[P];
    Vec3 step = dot(L_U, forward ? r : r - d);  // u_f - u_U
    if (limited) {
      const Vec3 rise = (forward ? 1 : -1) * (u[N] - u[P]);
      const Vec3 slope = dot(L_U, forward ? d : -d);
      Vec3 whole = 0.5 * rise;
      if (i >= 0) whole += dot(L_f[i], weights.from_midpoint(f, mesh));
      step = limited_step(whole, slope, rise);
    }
    const Vec3 u_f = u[U] + step;
    conv[P] += phi[f] * (u_f - u[P]);
    conv[N] -= phi[f] * (u_f - u[N]);
  }
  add_boundary(conv, phi, u, u_b, mesh);
}

}  // namespace fsi::flow
