#include "libfsi/solid/semi_implicit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "libfsi/solid/extension.hpp"
#include "libfsi/solid/velocity_kink.hpp"

namespace fsi::solid {
namespace {

/// (L - L^T) / 2.
Tensor spin(const Tensor& L) { return 0.5 * (L + -1.0 * transpose(L)); }

/// cos^2 of the angle between d and the unit normal m; 0 without one.
Real part_across(const Vec3& m, const Vec3& d) { return dot(m, d) * dot(m, d) / norm2(d); }

/// Weight of L_N in the mean of L over the line between the cells of face f. The trapezoidal rule
/// u_N - u_P = (L_P + L_N) / 2 . d is of third order. Across the kink at the surface the part
/// alpha_f of the line is the solid's.
Real part_of_N(const ElasticTerms& solid, const FaceWeights& weights, const Mesh& mesh, Index f) {
  if (f >= mesh.n_internal) return 0.5;
  if (!solid.kink) return weights.lambda[f];
  const bool P_in = solid.fraction[mesh.owner[f]] >= alpha_known;
  const bool N_in = solid.fraction[mesh.neighbour[f]] >= alpha_known;
  return P_in == N_in ? 0.5 : N_in ? solid.alpha[f] : 1 - solid.alpha[f];
}

}  // namespace

std::vector<Real> wave_widths(const Mesh& mesh, WaveWidth kind) {
  CellField<Real> own(mesh);
  for (Index c = 0; c < mesh.n_owned; ++c) {
    Real area = 0;
    for (const Index f : mesh.cell_faces[c]) area = std::max(area, norm2(mesh.Sf[f]));
    own[c] = mesh.V[c] / std::sqrt(area);
  }
  mesh.halo.update(own);
  std::vector<Real> width(own.data(), own.data() + mesh.n_owned);
  for (Index c = 0; kind == WaveWidth::of_neighbourhood && c < mesh.n_owned; ++c) {
    if (!mesh.simplex(c)) continue;
    Real volume = mesh.V[c], sum = volume * own[c];
    for (const Index n : mesh.cell_neighbours[c]) volume += mesh.V[n], sum += mesh.V[n] * own[n];
    width[c] = sum / volume;
  }
  return width;
}

Real elastic_time(const CellField<Real>& lambda, Real G, Real rho, std::span<const Real> width,
                  std::span<const Index> cells) {
  Real time = std::numeric_limits<Real>::max();
  if (G <= 0) return time;
  for (const Index c : cells)
    time = std::min(time, width[c] * std::sqrt(rho / (G * std::max(lambda[c], 1.0))));
  return time;
}

SemiImplicitElasticity::SemiImplicitElasticity(const Mesh& mesh, const FaceWeights& weights,
                                               const SimplexZone& zone, SymmetryFaces symmetry)
    : mesh_(mesh), zone_(zone), symmetry_(std::move(symmetry)) {
  CellField<Real> K(mesh);
  for (Index c = 0; c < mesh.n_owned; ++c)
    for (const Index f : mesh.cell_faces[c]) {
      // between the cell and its image g |d|^2 = |S| |d|
      K[c] += (symmetry_.has(f, mesh) ? norm(mesh.Sf[f]) * norm(to_image(mesh, f))
                                      : weights.g[f] * norm2(mesh.d[f])) /
              (2 * mesh.V[c]);
    }
  mesh.halo.update(K);
  for (Index f = 0; f < mesh.n_faces; ++f)
    inertia_.push_back(std::min(0.125, 0.5 / std::max(K[mesh.owner[f]], K[second_cell(mesh, f)])));
}

void SemiImplicitElasticity::clear(FaceField<Real>& kappa, FaceField<Real>& stiffness) {
  for (const Index f : last_faces_) kappa[f] = 0, stiffness[f] = 0;
}

void SemiImplicitElasticity::apply(FaceField<Real>& kappa, FaceField<Real>& stiffness,
                                   CellField<Vec3>& force, const ElasticTerms& solid,
                                   const FaceWeights& weights, const Band& band) {
  const CellField<Real>& lambda = solid.lambda;
  last_faces_ = band.faces();
  for (const Index f : band.faces()) {
    const Index P = mesh_.owner[f];
    Real l = lambda[P];
    if (f < mesh_.n_internal) l += weights.lambda[f] * (lambda[mesh_.neighbour[f]] - l);
    l *= solid.alpha[f];
    const Real waves = solid.dt * solid.G * l;
    stiffness[f] += waves;
    Real k = implicit_fraction * waves;
    // Beyond the band L is not set.
    const bool internal = f < mesh_.n_internal;
    if ((internal || symmetry_.has(f, mesh_)) && l > 0 && lambda[P] != 0 &&
        lambda[second_cell(mesh_, f)] != 0) {
      const Line between = line(solid, weights, f);
      Vec3 flux = damping(k, solid, weights, between, l);
      flux += (k * solid.dt * between.g) * change_of_rise(solid, between);
      force[P] += (1 / mesh_.V[P]) * flux;
      if (internal) force[mesh_.neighbour[f]] -= (1 / mesh_.V[mesh_.neighbour[f]]) * flux;
    }
    kappa[f] += k;
  }
  mesh_.halo.update(force);
}

SemiImplicitElasticity::Line SemiImplicitElasticity::line(const ElasticTerms& solid,
                                                          const FaceWeights& weights,
                                                          Index f) const {
  const Index P = mesh_.owner[f];
  if (f < mesh_.n_internal) {
    const Index N = mesh_.neighbour[f];
    return {.f = f,
            .d = mesh_.d[f],
            .g = weights.g[f],
            .u_N = solid.u[N],
            .L_N = solid.L[N],
            .in_zone = zone_.has(P) || zone_.has(N)};
  }
  const Vec3 n = mesh_.normal(f), d = to_image(mesh_, f);
  return {.f = f,
          .d = d,
          .g = norm2(mesh_.Sf[f]) / dot(mesh_.Sf[f], d),
          .u_N = image(solid.u[P], n),
          .L_N = image(solid.L[P], n),
          .in_zone = zone_.has(P)};
}

// b s u_f . grad (u_N - u_P), u_f = (u_P + u_N) / 2, b the part that the Courant number at f allows
Vec3 SemiImplicitElasticity::change_of_rise(const ElasticTerms& solid, const Line& line) const {
  constexpr Real whole = 0.3, none = 0.5;
  const Index P = mesh_.owner[line.f];
  const Vec3 u = 0.5 * (solid.u[P] + line.u_N), d = line.d;
  const Real along = dot(u, d) / norm(d);
  const Real across = norm(u - (along / norm(d)) * d);
  const Real courant = solid.dt * (std::abs(along) + across) / norm(d);
  const Real part = std::clamp((none - courant) / (none - whole), Real{0}, Real{1});
  // L_N - L_P is half the jump of L across the surface, but for one-sided gradients.
  const bool internal = line.f < mesh_.n_internal;
  const Real s = internal && !line.in_zone && crosses(solid.fraction, line.f, mesh_) ? 2 : 1;
  return (s * part) * dot(line.L_N + -1.0 * solid.L[P], u);
}

Vec3 SemiImplicitElasticity::damping(Real& k, const ElasticTerms& solid, const FaceWeights& weights,
                                     const Line& line, Real l) const {
  constexpr Real in_boxes = 1.5, in_simplices = 1;  // of kappa + mu_rho, for stability
  const Index f = line.f, P = mesh_.owner[f];
  const Real d = norm(line.d);
  Real e = d * std::sqrt(solid.rho * solid.G * l);
  const Real inertia = inertia_[f] * solid.rho_least * d * d / solid.dt;
  // less alpha_f mu_s, since the compact viscous term of the solid damps too
  const bool in_zone = line.in_zone, one_sided = in_zone && solid.one_sided;
  if (in_zone && !one_sided) {
    e *= 2;
    k += e;
  } else {
    const Real viscous = solid.alpha[f] * solid.mu_s;
    e = std::max(e - viscous, Real{0});
    if (!in_zone && solid.normal)
      e -= part_across((*solid.normal)[f], line.d) * std::max(e - solid.across * viscous, Real{0});
    k += std::max(e / (in_zone ? in_simplices : in_boxes) - k - inertia, Real{0});
  }
  // The flux e g (u_N - u_P - L_f . d). With a one-sided L it is left out if its product with u_N
  // - u_P - W . d is negative, W the spin of L_f.
  const Real w = part_of_N(solid, weights, mesh_, f);
  const Tensor L_f = (1 - w) * solid.L[P] + w * line.L_N;
  const Vec3 rise = line.u_N - solid.u[P];
  const Vec3 flux = e * line.g * (rise - dot(L_f, line.d));
  if (one_sided && dot(flux, rise - dot(spin(L_f), line.d)) < 0) return {};
  return flux;
}

}  // namespace fsi::solid
