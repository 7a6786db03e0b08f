#include "libfsi/flow/projection.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi::flow {
namespace {

Real density(const FluxTerms& terms, Index f) {
  return terms.density != nullptr ? terms.density->of_face()[f] : terms.rho;
}

/// d_f = t_f / (rho_f + 4 t_f k_f / |d|^2), k_f the sum of all implicit coefficients.
Real damped(const FluxTerms& terms, const Mesh& mesh, Index f, Real t_f) {
  const Real strain = terms.stiffness != nullptr ? (*terms.stiffness)[f] : 0;
  const Real implicit = terms.theta[f] * terms.mu[f] + terms.kappa[f] + 2 * strain;
  return t_f / (density(terms, f) + 4 * t_f * implicit / norm2(mesh.d[f]));
}

/// lambda u_P + (1 - lambda) u_N + L_f . delta_1-lambda.
Vec3 face_velocity(const CellField<Vec3>& u, const std::vector<Tensor>& L_f,
                   const FaceWeights& weights, const Mesh& mesh, Index f) {
  const Real lambda = weights.lambda[f];
  Vec3 u_f = lambda * u[mesh.owner[f]] + (1 - lambda) * u[mesh.neighbour[f]];
  if (const Index i = weights.place[f]; i >= 0) u_f += dot(L_f[i], weights.from_mirror(f, mesh));
  return u_f;
}

/// A part of the stress that is 0 away from solids: from 0 to 1e-7 of the stress it rises to 1.
Real nearness(const FluxTerms& terms, Real part) {
  constexpr Real whole = 1e-7;
  if (part == 0) return 0;
  return terms.stress > 0 ? std::min(Real{1}, part / (whole * terms.stress)) : 1;
}

/// t_f: at the solid's surface the braces contain a jump, and its flux is an error in proportion
/// to t_f.
Real damping_time(const FluxTerms& terms, const Mesh& mesh, Index f, Real speed, Real dt) {
  constexpr Real courant = 0.02;
  const Real near = nearness(terms, std::abs(terms.rhie_chow_source[f]));
  if (near == 0) return dt;
  const Real shorter = std::min(dt, courant * norm(mesh.d[f]) / std::max(speed, 1e-300));
  return dt - near * (dt - shorter);
}

/// w_f = (1 - a_f) max(0, 1 - rho d_f / T_f) + a_f max(0, 1 - t_f / t_f,old),
/// 1 / T_f = 6 |u_f| / |d| + 3 mu / (rho |d|^2) + 1 / t; a_f: nearness to solids. ratio: t_f over
/// that of the last step.
Real held(const FluxTerms& terms, const Mesh& mesh, Index f, Real d_f, Real speed, Real ratio) {
  constexpr Real convection = 6, viscosity = 3;
  if (terms.excess == nullptr || terms.t <= 0) return 0;
  const Real strain = terms.stiffness != nullptr ? (*terms.stiffness)[f] / terms.dt : 0;
  const Real near = nearness(terms, std::abs(terms.rhie_chow_source[f]) + strain);
  const Real rate = density(terms, f) * (convection * speed / norm(mesh.d[f]) + 1 / terms.t) +
                    viscosity * terms.mu[f] / norm2(mesh.d[f]);
  return (1 - near) * std::max(Real{0}, 1 - d_f * rate) + near * std::max(Real{0}, 1 - ratio);
}

}  // namespace

void set_flux_excess(FaceField<Real>& excess, const FaceField<Real>& phi, const CellField<Vec3>& u,
                     const std::vector<Tensor>& L_f, const FaceWeights& weights, const Mesh& mesh) {
  for (Index f = 0; f < mesh.n_internal; ++f)
    excess[f] = phi[f] - dot(face_velocity(u, L_f, weights, mesh, f), mesh.Sf[f]);
}

void predict_flux(FaceField<Real>& phi, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
                  const std::vector<char>& open_face, const FluxTerms& terms,
                  const FaceWeights& weights, const Mesh& mesh) {
  const Real old = terms.dt_old;
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f], i = weights.place[f];
    const Real lambda = weights.lambda[f];
    const Vec3 u_f = face_velocity(u, terms.L_f, weights, mesh, f);
    const Vec3 grad_f = lambda * terms.grad_p[P] + (1 - lambda) * terms.grad_p[N];
    Real brace = dot(grad_f, mesh.Sf[f]) +
                 weights.g[f] * (terms.rhie_chow_source[f] - (terms.p[N] - terms.p[P]));
    if (i >= 0) brace -= dot(terms.grad_p_f[i], weights.k[f]);
    if (terms.density != nullptr)
      brace += flux_of_force(*terms.density, *terms.acceleration, weights, mesh, f);
    const Real speed = norm(u_f);
    const Real t_f = damping_time(terms, mesh, f, speed, terms.dt);
    const Real ratio = terms.dt < old ? t_f / damping_time(terms, mesh, f, speed, old) : 1;
    const Real d_f = damped(terms, mesh, f, t_f);
    phi[f] = dot(u_f, mesh.Sf[f]) + d_f * brace;
    if (const Real w_f = held(terms, mesh, f, d_f, speed, ratio); w_f > 0)
      phi[f] += w_f * (*terms.excess)[f];
  }
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
    const Index b = f - mesh.n_internal, P = mesh.owner[f], i = weights.place[f];
    phi[f] = dot(u_b[b], mesh.Sf[f]);
    if (open_face[b] == 0) continue;
    Real brace = dot(terms.grad_p[P], mesh.Sf[f]) - weights.g[f] * (terms.p_b[b] - terms.p[P]);
    if (i >= 0) brace -= dot(terms.grad_p_f[i], weights.k[f]);
    if (terms.density != nullptr)
      brace += flux_of_force(*terms.density, *terms.acceleration, weights, mesh, f);
    const Real d_f = damped(terms, mesh, f, terms.dt);
    phi[f] += d_f * brace;
    const Real ratio = terms.dt < old ? terms.dt / old : 1;
    if (const Real w_f = held(terms, mesh, f, d_f, norm(u_b[b]), ratio); w_f > 0)
      phi[f] += w_f * (*terms.excess)[f];
  }
}

Projection::Projection(const Mesh& mesh, const FaceWeights& weights,
                       const std::vector<Condition>& conditions, Method method, int correctors,
                       const std::vector<bool>& mirrors)
    : mesh_(mesh),
      weights_(weights),
      correctors_(weights.uneven ? correctors : 0),
      open_(std::ranges::any_of(conditions, fixes_pressure)),
      open_face_(faces_where(conditions, mesh, fixes_pressure)),
      adjustable_(faces_where(conditions, mesh, prescribes_flow)),
      stencil_(mesh, weights, patches_where(conditions, fixes_pressure), mirrors),
      first_(mesh),
      grad_f_(weights.irregular.size()),
      b_(static_cast<std::size_t>(mesh.n_owned)),
      system_(mesh, "p", method, !open_, 1e-6) {
  if (weights.uneven) oblique_rest_.emplace(mesh);
  Sum area;
  for (Index b = 0; b < mesh.n_boundary(); ++b)
    if (adjustable_[b] != 0) area.add(norm(mesh.Sf[mesh.n_internal + b]));
  adjustable_area_ = area.total();
  FaceMatrix matrix(mesh);
  set(matrix);
  system_.assemble(matrix);
}

void Projection::set(FaceMatrix& matrix) {
  std::ranges::fill(matrix.diagonal, 0);
  for (Index f = 0; f < mesh_.n_faces; ++f) {
    const Index P = mesh_.owner[f];
    const Real g = mobility(f) * weights_.g[f];
    if (f < mesh_.n_internal) {
      matrix.off_diagonal[f] = -g;
      if (mesh_.neighbour[f] < mesh_.n_owned) matrix.diagonal[mesh_.neighbour[f]] += g;
    } else if (open_face_[f - mesh_.n_internal] == 0) {
      continue;
    }
    if (P < mesh_.n_owned) matrix.diagonal[P] += g;
  }
  Sum conductance;
  for (Index b = 0; b < mesh_.n_boundary(); ++b)
    if (const Index f = mesh_.n_internal + b; open_face_[b] != 0)
      conductance.add(mobility(f) * weights_.g[f]);
  conductance_ = conductance.total();
}

void Projection::set_density(const Density& density) {
  density_ = &density;
  if (!matrix_) matrix_.emplace(mesh_);
  set(*matrix_);
  system_.renew(*matrix_);
}

void Projection::set_face_gradient(const CellField<Real>& q, const BoundaryField<Real>& q_b) {
  if (!weights_.uneven) return;
  gradient(first_, q, q_b, stencil_.cells, mesh_);
  stencil_.at_faces.set(grad_f_, first_);
}

void Projection::set_gradient(CellField<Vec3>& grad, const CellField<Real>& p,
                              const BoundaryField<Real>& p_b) {
  if (orthogonal_) return orthogonal_->set_gradient(grad, p);
  set_face_gradient(p, p_b);
  pressure_gradient(grad, grad_f_, p, p_b, stencil_.cells, mesh_);
}

void Projection::balance_boundary(FaceField<Real>& phi) const {
  if (open_ || adjustable_area_ == 0) return;
  Sum net;
  for (Index f = mesh_.n_internal; f < mesh_.n_faces; ++f) net.add(phi[f]);
  const Real excess = net.total() / adjustable_area_;
  for (Index f = mesh_.n_internal; f < mesh_.n_faces; ++f)
    if (adjustable_[f - mesh_.n_internal] != 0) phi[f] -= excess * norm(mesh_.Sf[f]);
}

// b = -sum_f phi_f, at openings + g q_b; g times rho_0 / rho_f
void Projection::set_outflow(const FaceField<Real>& phi, const BoundaryField<Real>& q_b) {
  for (Index c = 0; c < mesh_.n_owned; ++c) b_[c] = -net_outflow(phi, mesh_, c);
  for (Index b = 0; b < mesh_.n_boundary(); ++b)
    if (const Index f = mesh_.n_internal + b; open_face_[b] != 0)
      b_[mesh_.owner[f]] += mobility(f) * weights_.g[f] * q_b[b];
}

// b += sum_f k . (grad q)_f, outward; k times rho_0 / rho_f
void Projection::add_oblique_outflow() {
  for (std::size_t i = 0; i < weights_.irregular.size(); ++i) {
    const Index f = weights_.irregular[i], P = mesh_.owner[f];
    const bool internal = f < mesh_.n_internal;
    if (!internal && open_face_[f - mesh_.n_internal] == 0) continue;
    const Real oblique = mobility(f) * dot(grad_f_[i], weights_.k[f]);
    if (P < mesh_.n_owned) b_[P] += oblique;
    if (internal && mesh_.neighbour[f] < mesh_.n_owned) b_[mesh_.neighbour[f]] -= oblique;
  }
}

// phi = phi* - rho_0 / rho_f (g (q_N - q_P) + k . (grad q)_f), with the grad q of the last
// right-hand side
void Projection::subtract_gradient(FaceField<Real>& phi, const CellField<Real>& q,
                                   const BoundaryField<Real>& q_b) const {
  for (Index f = 0; f < mesh_.n_internal; ++f)
    phi[f] -= mobility(f) * weights_.g[f] * (q[mesh_.neighbour[f]] - q[mesh_.owner[f]]);
  for (Index b = 0; b < mesh_.n_boundary(); ++b)
    if (const Index f = mesh_.n_internal + b; open_face_[b] != 0)
      phi[f] -= mobility(f) * weights_.g[f] * (q_b[b] - q[mesh_.owner[f]]);
  for (std::size_t i = 0; i < weights_.irregular.size(); ++i) {
    const Index f = weights_.irregular[i];
    if (f < mesh_.n_internal || open_face_[f - mesh_.n_internal] != 0)
      phi[f] -= mobility(f) * dot(grad_f_[i], weights_.k[f]);
  }
}

// r = k . ((grad q)_f - (grad q')_f), times rho_0 / rho_f
void Projection::add_to_oblique_rest(Real sign) {
  if (!oblique_rest_) return;
  for (std::size_t i = 0; i < weights_.irregular.size(); ++i) {
    const Index f = weights_.irregular[i];
    if (f < mesh_.n_internal || open_face_[f - mesh_.n_internal] != 0)
      (*oblique_rest_)[f] += sign * mobility(f) * dot(grad_f_[i], weights_.k[f]);
  }
}

void Projection::subtract_oblique_rest(FaceField<Real>& excess, Real part) const {
  if (!oblique_rest_) return;
  for (const Index f : weights_.irregular) excess[f] -= part * (*oblique_rest_)[f];
}

// A constant added to q changes the flux through the openings alone. The constant that leaves no
// net flux corrects what the solver's tolerance has left.
void Projection::close_balance(FaceField<Real>& phi, CellField<Real>& q) const {
  if (!open_) return;
  Sum net;
  for (Index f = mesh_.n_internal; f < mesh_.n_faces; ++f) net.add(phi[f]);
  const Real shift = -net.total() / conductance_;
  for (Index c = 0; c < mesh_.n_cells; ++c) q[c] += shift;
  for (Index b = 0; b < mesh_.n_boundary(); ++b)
    if (const Index f = mesh_.n_internal + b; open_face_[b] != 0)
      phi[f] += mobility(f) * weights_.g[f] * shift;
}

SolveResult Projection::project(FaceField<Real>& phi, CellField<Real>& q, CellField<Vec3>& grad_q,
                                const BoundaryField<Real>& q_b, Real absolute) {
  balance_boundary(phi);
  if (orthogonal_) return project_cells(phi, q, grad_q, q_b, absolute);
  // The solves before the last one only set the non-orthogonal term, which is q times the sine of
  // the angle. Two digits are enough for it.
  constexpr Real loosened = 1e4, two_densities = 1e-2;
  const Real last = density_ != nullptr ? two_densities : 1;
  q.fill(0);
  std::ranges::fill(grad_f_, Vec3{});
  SolveResult total;
  for (int corrector = 0; corrector <= correctors_; ++corrector) {
    set_outflow(phi, q_b);
    if (corrector > 0) add_oblique_outflow();
    const SolveResult solve =
        system_.solve(q, b_, absolute, corrector < correctors_ ? loosened : last);
    total.iterations += solve.iterations;
    total.residual = solve.residual;
    if (corrector < correctors_) set_face_gradient(q, q_b);
  }
  subtract_gradient(phi, q, q_b);
  close_balance(phi, q);
  if (oblique_rest_) oblique_rest_->fill(0);
  add_to_oblique_rest(-1);
  set_gradient(grad_q, q, q_b);
  add_to_oblique_rest(1);
  if (density_ != nullptr)
    for (Index c = 0; c < mesh_.n_cells; ++c)
      grad_q[c] = density_->rho_0() * density_->divided(grad_q[c], c);
  return total;
}

void Projection::make_orthogonal(const GradientStencil& stencil,
                                 const std::vector<Condition>& conditions) {
  orthogonal_.emplace(mesh_, stencil, conditions);
  rest_.emplace(mesh_);
}

// phi = phi* - Phi(calG q) - g (r_N - r_P), A r = div(phi* - Phi(calG q)): q changes cells and
// faces alike, r only the faces, by the tenth that is left. r is q' of
// doc/theory/orthogonal_projection.md.
SolveResult Projection::project_cells(FaceField<Real>& phi, CellField<Real>& q,
                                      CellField<Vec3>& grad_q, const BoundaryField<Real>& q_b,
                                      Real absolute) {
  const int iterations = orthogonal_->project(phi, q, grad_q, system_, absolute);
  std::ranges::fill(grad_f_, Vec3{});
  set_outflow(phi, q_b);
  rest_->fill(0);
  SolveResult total = system_.solve(*rest_, b_, absolute, 1 / Orthogonal::tolerance);
  total.iterations += iterations;
  subtract_gradient(phi, *rest_, q_b);
  return total;
}

void flux_of_rest(FaceField<Real>& phi, const ForceOfFaces& of, const std::vector<char>& open_face,
                  const FluxTerms& terms, const FaceWeights& weights, const Mesh& mesh) {
  for (Index f = 0; f < mesh.n_faces; ++f) {
    const Index P = mesh.owner[f], i = weights.place[f];
    const bool internal = f < mesh.n_internal;
    phi[f] = 0;
    if (!internal && open_face[f - mesh.n_internal] == 0) continue;
    const Index N = internal ? mesh.neighbour[f] : P;
    const Real lambda = internal ? weights.lambda[f] : 0;
    const Real rise = (internal ? terms.p[N] : terms.p_b[f - mesh.n_internal]) - terms.p[P];
    Real flux = -weights.g[f] * rise;
    if (of.force != nullptr)
      flux += dot(lambda * (*of.force)[P] + (1 - lambda) * (*of.force)[N], mesh.Sf[f]) +
              weights.g[f] * (*of.source)[f];
    if (i >= 0) flux -= dot(terms.grad_p_f[i], weights.k[f]);
    phi[f] = terms.rho / density(terms, f) * flux;
  }
}

void divergence(CellField<Real>& div, const FaceField<Real>& phi, const Mesh& mesh) {
  for (Index c = 0; c < mesh.n_owned; ++c) div[c] = net_outflow(phi, mesh, c) / mesh.V[c];
}

Real divergence_max(const FaceField<Real>& phi, const Mesh& mesh) {
  Real worst = 0;
  for (Index c = 0; c < mesh.n_owned; ++c)
    worst = std::max(worst, std::abs(net_outflow(phi, mesh, c)) / mesh.V[c]);
  return global_max(worst);
}

Real size(const FaceField<Real>& phi, const Mesh& mesh) {
  Sum squares;  // every face once: by the rank of its owner
  for (Index f = 0; f < mesh.n_faces; ++f)
    if (mesh.owner[f] < mesh.n_owned) squares.add(phi[f] * phi[f]);
  return std::sqrt(squares.total());
}

}  // namespace fsi::flow
