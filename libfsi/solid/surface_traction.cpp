#include "libfsi/solid/surface_traction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libfsi/field/fraction.hpp"
#include "libfsi/operators/least_squares.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/solid/extension.hpp"
#include "libfsi/solid/one_sided.hpp"

namespace fsi::solid {
namespace {

SymTensor twice_symmetric(const Tensor& L) {
  return {2 * L.xx, L.xy + L.yx, L.xz + L.zx, 2 * L.yy, L.yz + L.zy, 2 * L.zz};
}

Vec3 along_surface(const Vec3& v, const Vec3& m) { return v - dot(v, m) * m; }

/// (v m + m v) . S
Vec3 shear(const Vec3& v, const Vec3& m, const Vec3& S) { return dot(m, S) * v + dot(v, S) * m; }

}  // namespace

SurfaceTraction::SurfaceTraction(const Mesh& mesh, const FaceWeights& weights, Real G,
                                 Viscosities mu, SymmetryFaces symmetry)
    : mesh_(mesh),
      weights_(weights),
      G_(G),
      mu_(mu),
      symmetry_(std::move(symmetry)),
      mu_least_(std::max(mu.solid, mu.fluid / 4)),
      jump_force_(mesh, weights),
      touch_(mesh),
      L_(mesh),
      L_viscous_(mesh),
      fitted_(mesh),
      kink_(mesh),
      own_(mesh),
      has_own_(mesh) {}

bool SurfaceTraction::uncut(Real alpha) const {
  return mu_.solid > mu_.fluid ? alpha > 1 - interface_eps : alpha < interface_eps;
}

void SurfaceTraction::clear(const Band& band) {
  jump_force_.clear();
  const auto reset = [&](Index c) { kink_[c] = {}, touch_[c] = has_own_[c] = fitted_[c] = 0; };
  for (const Index c : last_cells_) reset(c), own_[c] = {};
  for (const Index f : last_faces_) reset(mesh_.owner[f]), reset(second_cell(mesh_, f));
  last_cells_ = band.cells();
  last_faces_ = band.faces();
}

bool SurfaceTraction::simplex(Index f) const {
  return mesh_.simplex(mesh_.owner[f]) || mesh_.simplex(second_cell(mesh_, f));
}

bool SurfaceTraction::separates(const CutFaces& cut, Index f) const {
  const bool internal = f < mesh_.n_internal;
  if ((!internal && !symmetry_.has(f, mesh_)) || norm2(cut.normal[f]) == 0) return false;
  const Real a = cut.alpha[mesh_.owner[f]], b = cut.alpha[second_cell(mesh_, f)];
  return is_cut(a) || is_cut(b) || std::abs(a - b) > 0.5;
}

bool SurfaceTraction::is_own(Real mu, Real own) const {
  constexpr Real rounding = 1e-6;  // of mu_s - mu_f
  return std::abs(mu - own) <= rounding * std::abs(mu_.solid - mu_.fluid);
}

Real SurfaceTraction::mean(const CutFaces& cut, Index f) const {
  const Index P = mesh_.owner[f];
  const Real alpha = f < mesh_.n_internal ? face_mean(cut.alpha, f, weights_, mesh_) : cut.alpha[P];
  return mu_.fluid + (mu_.solid - mu_.fluid) * alpha;
}

Real SurfaceTraction::harmonic(Real alpha_f, Real mu) const {
  return 1 / (alpha_f / mu + (1 - alpha_f) / mu_.fluid);
}

Real SurfaceTraction::bounded(const CutFaces& cut, Index f) const {
  const Real most = harmonic(cut.alpha_f[f], mu_least_) + explicit_ratio_max * mu_.fluid;
  return std::min(mean(cut, f), most);
}

void SurfaceTraction::bound_viscosity(FaceField<Real>& mu, const CutFaces& cut,
                                      const Band& band) const {
  for (const Index f : band.faces())
    if (separates(cut, f) && is_own(mu[f], mean(cut, f))) mu[f] = bounded(cut, f);
}

bool SurfaceTraction::at_surface(const Surface& surface, Index f) const {
  const CutFaces cut{surface.alpha_f, surface.normal_f, surface.alpha};
  return separates(cut, f) && is_own(surface.mu[f], bounded(cut, f));
}

void SurfaceTraction::mark(const Surface& surface, const Band& band) {
  for (const Index f : band.faces()) {
    if (!at_surface(surface, f)) continue;
    for (const Index c : {mesh_.owner[f], second_cell(mesh_, f)})
      if (c < mesh_.n_owned) touch_[c] = uncut(surface.alpha[c]) ? 2 : 1;
  }
  mesh_.halo.update(touch_);
}

// Each component of u has its own fit: M L^T = R^T - k a, a = (h - R M^-1 k) / (q - k M^-1 k).
void SurfaceTraction::fit(const Surface& surface, Index c) {
  const Vec3 m = surface.normal[c];
  const Real height = surface.height[c];
  fitted_[c] = 1;
  SlopeFit fit;
  Vec3 k, h;
  Real q = 0;
  for_neighbours_and_images(
      c, symmetry_, mesh_, [&](Index n, const Vec3& r, const Reflection& plane) {
        const Real depth = std::min(Real{0}, height + dot(m, r)) - std::min(Real{0}, height);
        const Vec3 du = image(surface.u[n], plane) - surface.u[c];
        const Real w = fit.add(r, du);
        k += (w * depth) * r, q += w * depth * depth, h += (w * depth) * du;
      });
  constexpr Real flat = 1e-3;  // part below which a direction is not spanned
  if (!tells(fit.M, mesh_.dim, flat)) {
    L_[c] = surface.L[c], kink_[c] = {};
    return;
  }
  if (mesh_.dim == 2) fit.M.zz = 1;
  const SymTensor inv = inverse(fit.M);
  const Vec3 ik = dot(inv, k);
  const Real rest = q - dot(k, ik);
  const Vec3 a = rest > flat * q ? (1 / rest) * (h - dot(fit.R, ik)) : Vec3{};
  kink_[c] = along_surface(a, m);
  L_[c] = dot(fit.R + (-1) * outer(kink_[c], k), inv);
}

template <class T>
void SurfaceTraction::extend(CellField<T>& own, const Band& band) {
  for (const Real ring : {1, 2}) {
    mesh_.halo.update(own), mesh_.halo.update(has_own_);
    for (const Index c : band.cells()) {
      if (touch_[c] == 0 || has_own_[c] > 0) continue;
      T sum;
      Real weight = 0;
      for_neighbours_and_images(c, symmetry_, mesh_,
                                [&](Index n, const Vec3& r, const Reflection& m) {
                                  if (has_own_[n] == 0 || has_own_[n] > ring) return;
                                  sum += (1 / norm2(r)) * image(own[n], m), weight += 1 / norm2(r);
                                });
      if (weight > 0) own[c] = (1 / weight) * sum, has_own_[c] = ring + 1;
    }
  }
  mesh_.halo.update(own);
}

void SurfaceTraction::take_own_strain(const Surface& surface, const Band& band) {
  const auto known = [&](Index c) { return surface.alpha[c] >= alpha_known; };
  const bool in = mu_.solid > mu_.fluid;
  // Around a triangle or tetrahedron too few cells are uncut.
  const auto viscous = [&](Index c) {
    return in && !mesh_.simplex(c) ? uncut(surface.alpha[c]) : known(c) == in;
  };
  const bool lends = mu_least_ > mu_.solid;
  const auto inner = [&](Index c) { return uncut(surface.alpha[c]) && touch_[c] == 0; };
  const auto none = [](Index) { return false; };
  for (const Index c : band.cells()) {
    if (touch_[c] == 0) continue;
    L_viscous_[c] = surface.L[c];
    if (in ? viscous(c) : touch_[c] > 1) {
      L_viscous_[c] =
          one_sided_gradient(surface.L, surface.u, viscous, inner, nowhere, mesh_, c, symmetry_);
      has_own_[c] = in ? 1 : 0;
    }
    if (lends && known(c)) {
      own_[c] = twice_symmetric(
          one_sided_gradient(surface.L, surface.u, known, none, nowhere, mesh_, c, symmetry_));
      has_own_[c] = 1;
    }
  }
  if (in)
    extend(L_viscous_, band);
  else
    mesh_.halo.update(L_viscous_);
  if (lends) extend(own_, band);
}

template <class T>
T SurfaceTraction::with_image(const T& of_owner, Index f) const {
  return 0.5 * (of_owner + image(of_owner, mesh_.normal(f)));
}

template <class T>
T SurfaceTraction::at_face(const CellField<T>& field, Index f) const {
  return f < mesh_.n_internal ? face_mean(field, f, weights_, mesh_)
                              : with_image(field[mesh_.owner[f]], f);
}

template <class T>
T SurfaceTraction::of_fits(const CellField<T>& field, Index f) const {
  const Index P = mesh_.owner[f];
  if (f >= mesh_.n_internal) return with_image(field[P], f);
  const Index N = mesh_.neighbour[f];
  return (1 / (fitted_[P] + fitted_[N])) * (fitted_[P] * field[P] + fitted_[N] * field[N]);
}

SurfaceTraction::Pair SurfaceTraction::pair(Index f, const CellField<Vec3>& u) const {
  const Index P = mesh_.owner[f];
  if (f < mesh_.n_internal)
    return {.du = u[mesh_.neighbour[f]] - u[P], .d = mesh_.d[f], .k = weights_.k[f]};
  const Vec3 n = mesh_.normal(f);
  return {.du = -dot(u[P], n) * n, .d = dot(mesh_.d[f], n) * n, .k = {}};
}

SurfaceTraction::Sides SurfaceTraction::sides(Index f, const Vec3& m, Real alpha_f) const {
  const Tensor L = of_fits(L_, f);
  if (mu_.solid > mu_.fluid) {
    const Tensor L_solid = at_face(L_viscous_, f);
    return {.mean = alpha_f * L_solid + (1 - alpha_f) * L, .common = L_solid, .lent = {}};
  }
  const Tensor mean = L + outer(alpha_f * along_surface(of_fits(kink_, f), m), m);
  return {.mean = mean, .common = mean, .lent = (mu_least_ - mu_.solid) * at_face(own_, f)};
}

SurfaceTraction::FaceExcess SurfaceTraction::excess_at(Index f, const Surface& surface) const {
  const Vec3 m = surface.normal_f[f], S = mesh_.Sf[f];
  const auto [du, d, k] = pair(f, surface.u);
  const Real alpha_f = surface.alpha_f[f];
  const Sides side = sides(f, m, alpha_f);
  const SymTensor D = twice_symmetric(side.common);  // 2 D
  const Vec3 Dm = dot(D, m);
  const Vec3 e = along_surface(dot(twice_symmetric(side.mean), m), m);
  const Vec3 Tm = dot(G_ * at_face(surface.T, f), m);
  const Vec3 Gb = along_surface(Tm, m);
  // (mu_least - mu_s) 2 D . m of the own side: the surplus of mu_least
  const Vec3 lent = along_surface(dot(side.lent, m), m);
  const Real most = explicit_ratio_max * mu_.fluid;
  const Real excess = std::min(mu_.solid, most) - mu_.fluid, s = excess * dot(Dm, m);
  const Real mu_h = harmonic(alpha_f, mu_least_), series = alpha_f * mu_h / mu_least_;
  // gammadot (m . S): the difference along d is that of the face, m . S = g m . d + m . k
  const Vec3 e_mS =
      along_surface(weights_.g[f] * (du - dot(side.common, along_surface(d, m))) +
                        dot(m, k) * dot(side.mean, m) + dot(m, S) * dot(transpose(side.common), m),
                    m);
  // (mu_h - mu_f) (gammadot m + m gammadot) + alpha_f (mu_h / mu_s - 1) (tau_t m + m tau_t)
  const Vec3 traction =
      (mu_h - mu_.fluid) * e_mS +
      ((harmonic(alpha_f, std::min(mu_least_, most)) - mu_.fluid) * dot(e, S)) * m +
      (series - alpha_f) * shear(Gb, m, S) - series * shear(lent, m, S);
  // + alpha_f ((mu_s - mu_f) 2 D^0 - s_mu I)
  const Vec3 rest =
      (alpha_f * excess) * (dot(D, S) - shear(along_surface(Dm, m), m, S)) - (alpha_f * s) * S;
  const Vec3 transposed = std::max(-excess, Real{0}) * dot(transpose(side.mean), S);
  return {traction + transposed + rest, s};
}

void SurfaceTraction::add_excess(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source,
                                 const Surface& surface, PressureStencil& pressure,
                                 const Band& band) {
  const CellField<Real>& alpha = surface.alpha;
  for (const Index f : band.faces()) {
    if (!at_surface(surface, f)) continue;
    const Index P = mesh_.owner[f], N = second_cell(mesh_, f);
    if (fitted_[P] + fitted_[N] == 0) continue;
    const bool internal = f < mesh_.n_internal;
    const FaceExcess at_face = excess_at(f, surface);
    const Real s = at_face.s;
    const Vec3 S = mesh_.Sf[f];
    // the stress of the momentum equation that it replaces: the mean viscosity
    Vec3 along_S = weights_.g[f] * pair(f, surface.u).du;
    if (const Index i = weights_.place[f]; internal && i >= 0)
      along_S += dot(surface.L_f[i], weights_.k[f]);
    const Real mean_excess = surface.mu[f] - mu_.fluid;
    const auto flux_of = [&](Index c) {
      return at_face.flux + (alpha[c] * s) * S -
             mean_excess * (along_S + dot(transpose(surface.L[c]), S));
    };
    force[P] += (1 / mesh_.V[P]) * flux_of(P);
    if (!internal) continue;
    force[N] -= (1 / mesh_.V[N]) * flux_of(N);
    const Real jump = s * (alpha[N] - alpha[P]);
    jump_force_.add(f, jump, pressure.cells);
    rhie_chow_source[f] += jump;
  }
}

void SurfaceTraction::add_transposed(CellField<Vec3>& force, const Surface& surface,
                                     const Band& band) const {
  const Real excess = std::abs(mu_.solid - mu_.fluid);
  const bool in = mu_.solid > mu_.fluid;
  const auto L_of = [&](Index c) -> const Tensor& {
    return touch_[c] > 1 ? L_viscous_[c] : surface.L[c];
  };
  for (const Index c : band.cells()) {
    const bool more_viscous = uncut(surface.alpha[c]);
    if (!more_viscous && (in || surface.alpha[c] <= 1 - interface_eps)) continue;
    // the term of the momentum equation in the solid, over |mu_s - mu_f|
    const Tensor in_place = (in ? -1 : 1) * surface.L[c];
    const Tensor none{};
    Vec3 sum;
    for (const Index f : mesh_.cell_faces[c]) {
      const Index P = mesh_.owner[f];
      const Real out = P == c ? 1 : -1;
      if (at_surface(surface, f) && fitted_[P] + fitted_[second_cell(mesh_, f)] > 0) continue;
      Tensor L_f = more_viscous ? L_of(c) : none;
      if (more_viscous && f < mesh_.n_internal)
        L_f = (1 - weights_.lambda[f]) * L_of(P) + weights_.lambda[f] * L_of(mesh_.neighbour[f]);
      else if (symmetry_.has(f, mesh_))
        L_f = with_image(L_f, f);
      sum += out * dot(transpose(L_f + (more_viscous && !in ? none : in_place)), mesh_.Sf[f]);
    }
    force[c] += (excess / mesh_.V[c]) * sum;
  }
}

void SurfaceTraction::apply(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source,
                            const Surface& surface, PressureStencil& pressure, const Band& band) {
  clear(band);
  mark(surface, band);
  for (const Index c : band.cells())
    if (norm2(surface.normal[c]) > 0) fit(surface, c);
  mesh_.halo.update(fitted_), mesh_.halo.update(L_), mesh_.halo.update(kink_);
  take_own_strain(surface, band);
  add_excess(force, rhie_chow_source, surface, pressure, band);
  add_transposed(force, surface, band);
  jump_force_.apply(force, rhie_chow_source, pressure, band);
  mesh_.halo.update(force);
}

void SurfaceTraction::add_semi_implicit(FaceField<Real>& stiff, const FaceField<Real>& kappa,
                                        const FaceField<Real>& alpha_f, const Band& band) const {
  const bool in = mu_.solid > mu_.fluid;
  const Real most = explicit_ratio_max * mu_.fluid;
  for (const Index f : band.faces()) {
    if (touch_[mesh_.owner[f]] + touch_[second_cell(mesh_, f)] == 0) continue;
    if (in) {
      if (simplex(f) && (f < mesh_.n_internal || symmetry_.has(f, mesh_)))
        stiff[f] += std::min(implicit_share * (mu_.solid - mu_.fluid), most);
      continue;
    }
    // mu_h / mu_s
    const Real weight = 1 / (alpha_f[f] + (1 - alpha_f[f]) * mu_least_ / mu_.fluid);
    stiff[f] += kappa[f] * (weight - 1) + mu_.fluid - mu_.solid;
  }
}

}  // namespace fsi::solid
