#include "libfsi/solid/reference_map.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/core/eigen.hpp"
#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/solid/alternation.hpp"
#include "libfsi/solid/interface_gradient.hpp"
#include "libfsi/solid/inward_normal.hpp"
#include "libfsi/solid/koren.hpp"
#include "libfsi/solid/solenoidal.hpp"

namespace fsi::solid {
namespace {

/// (2 D : D)^1/2, in a simple shear its rate.
Real shear_rate(const Tensor& L) {
  const Real xy = L.xy + L.yx, xz = L.xz + L.zx, yz = L.yz + L.zy;
  return std::sqrt(2 * (L.xx * L.xx + L.yy * L.yy + L.zz * L.zz) + xy * xy + xz * xz + yz * yz);
}

/// Collective. Which patches of the mesh have such faces.
std::vector<bool> patches_of(const SymmetryFaces& symmetry, const Mesh& mesh) {
  std::vector<bool> found;
  for (const Patch& patch : mesh.patches) {
    bool any = false;
    for (Index f = patch.begin; f < patch.end; ++f) any = any || symmetry.has(f, mesh);
    found.push_back(!all_of_ranks(!any));
  }
  return found;
}

}  // namespace

ReferenceMap::ReferenceMap(const Mesh& mesh, Role role, const std::vector<Patch>& walls,
                           const SymmetryFaces& symmetry)
    : d(mesh),
      is_set(mesh, 1),
      mesh_(mesh),
      beside_psi_(role == Role::beside_psi),
      at_wall_(mesh),
      known_(mesh),
      extension_(mesh, symmetry),
      filled_(mesh),
      slope_(mesh) {
  const FaceWeights weights(mesh);
  lost_part_ = lost_part(weights, mesh, beside_psi_ ? 1 : 0);
  const std::vector<bool> mirrors = patches_of(symmetry, mesh);
  GradientStencil stencil(mesh, weights, mirrors, mirrors);
  of_owner_ = std::move(stencil.owner);
  of_neighbour_ = std::move(stencil.neighbour);
  for (const Patch& patch : walls)
    for (Index f = patch.begin; f < patch.end; ++f) at_wall_[mesh.owner[f]] = 1;
  mesh.halo.update(at_wall_);
  hold({});
}

void ReferenceMap::hold(std::vector<char> faces) {
  extension_.hold(std::move(faces));
  one_sided_.assign(static_cast<std::size_t>(mesh_.n_owned), 0);
  for (Index f = mesh_.n_internal; f < mesh_.n_faces; ++f)
    if (at_wall_[mesh_.owner[f]] > 0 && has_one_side(f)) one_sided_[mesh_.owner[f]] = 1;
}

void ReferenceMap::set_undeformed(const CellField<Real>& alpha) {
  d.fill({});
  is_set.fill(1);
  mark(alpha);
  is_set.fill(0);
  extend();
}

void ReferenceMap::resume(const CellField<Real>& alpha, CellField<SymGradient>& /*grad*/) {
  mark(alpha);
  extend();
}

void ReferenceMap::mark(const CellField<Real>& alpha) {
  for (Index c = 0; c < mesh_.n_cells; ++c) filled_[c] = is_set[c] > 0 ? alpha[c] : 0;
  known_.rebuild(filled_, alpha_known);
}

Tensor ReferenceMap::gradient_of_map(Index c) const {
  Tensor g = slope_[c];
  g.xx += 1, g.yy += 1, g.zz += 1;
  return g;
}

Real ReferenceMap::trust(Index c) const {
  const Real J = volume_ratio(c);
  return J > 0 ? std::max(Real{0}, 1 - std::abs(std::log2(J))) : 0;
}

Tensor ReferenceMap::gradient(Index c) const {
  const SymmetryFaces& symmetry = extension_.symmetry();
  Tensor sum;
  if (static_cast<int>(mesh_.cell_faces[c].size()) <= mesh_.dim + 1)
    return extension_.regression(c);
  for (const Index f : mesh_.cell_faces[c]) {
    const Index n = beyond(mesh_, f, c);
    const Vec3& g = weight(f, c);
    if (n >= 0) {
      sum += outer(d[n] - d[c], g);
    } else if (symmetry.has(f, mesh_)) {
      // xihat - (xihat . n) n is the value at the foot of the centre on the plane, half way to the
      // image.
      const Vec3 normal = mesh_.normal(f);
      sum += outer(-dot(d[c], normal) * normal, g);
    } else {
      return extension_.regression(c);
    }
  }
  return sum;
}

void ReferenceMap::extend() {
  const Rings& rings = extension_.rings();
  for (const Index c : rings.all()) slope_[c] = {};
  extension_.apply(d, is_set, known_);
  for (const Index c : rings.inside()) slope_[c] = gradient(c);
  for (const Index c : rings.last_ring()) slope_[c] = extension_.slope(c);
  mesh_.halo.update(slope_);
}

bool ReferenceMap::has_one_side(Index f) const {
  return f >= mesh_.n_internal && !extension_.symmetry().has(f, mesh_) && !extension_.held(f);
}

bool ReferenceMap::leaves_known(Index f, Index c) const {
  const Index n = beyond(mesh_, f, c);
  return n >= 0 && filled_[n] < alpha_known;
}

bool ReferenceMap::in_open_fluid(Index c) const {
  if (at_wall_[c] > 0) return false;
  bool open = false;
  for (const Index f : mesh_.cell_faces[c]) {
    if (!leaves_known(f, c)) continue;
    if (at_wall_[beyond(mesh_, f, c)] > 0) return false;
    open = true;
  }
  return open;
}

Tensor ReferenceMap::mean_of_known(const CellField<Tensor>& L, Index c) const {
  Tensor sum;
  int count = 0;
  for (const Index f : mesh_.cell_faces[c]) {
    const Index n = beyond(mesh_, f, c);
    if (n >= 0 && filled_[n] >= alpha_known) sum += L[n], ++count;
    if (extension_.symmetry().has(f, mesh_)) sum += image(L[c], mesh_.normal(f)), ++count;
  }
  return count > 0 ? (1.0 / count) * sum : L[c];
}

Vec3 ReferenceMap::face_value(Index f, Index c, bool out, const FlowSnapshot& snapshot,
                              Real dt) const {
  // The particles that pass the face within dt come from the upwind cell, and their mean path is
  // that of dt / 2.
  //   xihat_f = xihat_up + lambda_up Ko(varrho) (xihat_down - xihat_up) + grad xihat_up . skew
  //             - dt / 2 (I + grad xihat_up) . u_f
  // Between the cells u_f is linear and corrected for skewness, at boundaries it continues
  // linearly.
  const auto back = [&](Index up, const Vec3& u) { return (dt / 2) * (u + dot(slope_[up], u)); };
  if (f >= mesh_.n_internal) {
    const Vec3 r = mesh_.Cf[f] - mesh_.C[c];
    return d[c] + dot(slope_[c], r) - back(c, snapshot.u[c] + dot(snapshot.L[c], r));
  }
  const FaceWeights& weights = snapshot.weights;
  const Index P = mesh_.owner[f], N = mesh_.neighbour[f];
  const bool forward = out == (P == c);
  const Index up = forward ? P : N, down = forward ? N : P;
  const Real share = forward ? weights.lambda[f] : 1 - weights.lambda[f];
  const Vec3 way = forward ? mesh_.d[f] : -mesh_.d[f];
  Vec3 face = d[up] + (2 * share) * koren(d[down] - d[up], dot(slope_[up], way));
  Vec3 u = (1 - share) * snapshot.u[up] + share * snapshot.u[down];
  if (weights.place[f] >= 0) {
    face += dot(slope_[up], weights.skew[f]);
    u += dot(snapshot.L[c], weights.skew[f]);
  }
  return face - back(up, u);
}

Vec3 ReferenceMap::towards_volume(Index c, const FlowSnapshot& snapshot, Real dt) const {
  // In triangles and tetrahedra grad xi is a least-squares fit, and more of the volume is lost.
  // With the map kinematics a larger nu_J would pull a coarse solid towards a moving lid.
  const bool lossy = beside_psi_ && mesh_.simplex(c);
  const Real by_flow = lossy ? 0.18 : 0.06, by_wave = lossy ? 0.12 : 0.06;
  const Real J = volume_ratio(c), h = cell_size(mesh_, c);
  Vec3 grad_J;
  for (const Index f : mesh_.cell_faces[c]) {
    const Index n = beyond(mesh_, f, c);
    if (n < 0) continue;
    const Real there = filled_[n] >= alpha_known ? volume_ratio(n) : 1;
    grad_J += (there - J) * weight(f, c);
  }
  // At a boundary the slope of d is one-sided, so J rises where d of the cell itself falls. Moved
  // along its normal, d would grow without bound.
  for (const Index f : mesh_.cell_faces[c])
    if (has_one_side(f)) {
      const Vec3 n = mesh_.normal(f);
      grad_J -= dot(grad_J, n) * n;
    }
  const Real courant = dt * courant_rate(snapshot.phi, mesh_, c);
  Vec3 way = (by_flow * courant) * grad_J;
  if (beside_psi_ && snapshot.wave_speed > 0) {
    // B does not depend on J, so no stress resists a change of J. Under a lasting load the normal
    // velocity of the outermost cells would change J without end. In cells with fluid among their
    // vertex neighbours only the part of grad J along the normal counts, since the fluxes place the
    // map along the surface.
    const Vec3 n = inward_normal(filled_, mesh_, c, extension_.symmetry());
    const Vec3 along = n == Vec3{} ? grad_J : dot(grad_J, n) * n;
    way += (by_wave * dt * snapshot.wave_speed / h) * along;
  }
  return (h * h) * dot(gradient_of_map(c), way);
}

Vec3 ReferenceMap::without_alternation(Index c, const FlowSnapshot& snapshot, Real dt) const {
  if (lost_part_[c] == 0) return {};
  const auto known = [&](Index k) { return filled_[k] >= alpha_known; };
  const auto rise = [&](Index k, const Vec3& r) { return dot(slope_[k], r); };
  const Real h = cell_size(mesh_, c);
  const bool in_zone = snapshot.one_sided != nullptr && snapshot.one_sided->zone().has(c);
  const Real least = in_zone ? recall_in_zone(mesh_.dim) : 0;
  return lost_part_[c] * alternating_part(snapshot.wave_speed, snapshot.recovery, h, dt, least) *
         alternation(d, known, rise, mesh_, extension_.symmetry(), c);
}

// (1 - exp(-0.2 Co)) (sum_k w_k (xi_k - grad xi_k . r_k) / sum_k w_k - xi)
Vec3 ReferenceMap::towards_inside(Index c, const FlowSnapshot& snapshot, Real dt) const {
  constexpr Real by_flow = 0.2;
  if (snapshot.inside == nullptr || (*snapshot.inside)[c] >= alpha_known) return {};
  Vec3 sum;
  Real W = 0;
  const SymmetryFaces& symmetry = extension_.symmetry();
  for_neighbours_and_images(c, symmetry, mesh_, [&](Index k, const Vec3& r, const Reflection& n) {
    if ((*snapshot.inside)[k] < alpha_known) return;
    const Real w = 1 / norm2(r);
    W += w, sum += w * (image(d[k], n) - dot(image(slope_[k], n), r));
  });
  if (W == 0) return {};
  const Real courant = dt * courant_rate(snapshot.phi, mesh_, c);
  return (1 - std::exp(-by_flow * courant)) * (sum / W - d[c]);
}

// In the middle of the step, r_f = x_f - x_c,
//   V d xi/dt = -(sum_f phi_f (xi_f - xi_c) - grad xi . o),   xi = x + xihat,   o: off.
// The sum carries xi with (1/V) sum_f phi_f r_f. In a linear u this is wrong by o / V, o = sum_f
// (L . r_f . S_f) r_f, in cells that are not symmetric about their centre.
//
// For the memory, a flux from a known cell to an unknown one mixes solid and fluid. There
// phi_f = (utilde + L . r_f) . S_f, with utilde (`w`) of `velocity_of_fluxes` and L of the known
// cells beyond the other faces. Along the surface, n its normal, the map then moves with utilde,
// which strains psi. Cells at a wall are left out: in a film one cell thick the wall holds the
// velocity of the cells, and a map that moves with it would be held too.
Vec3 ReferenceMap::outflow(Index c, const FlowSnapshot& snapshot, Real dt) const {
  const bool rim = beside_psi_ && in_open_fluid(c);
  const Vec3 w = rim ? velocity_of_fluxes(snapshot, filled_, mesh_, c) : Vec3{};
  const Tensor L = rim ? mean_of_known(snapshot.L, c) : snapshot.L[c];
  Vec3 sum, carried, off;
  for (const Index f : mesh_.cell_faces[c]) {
    const Real side = outward(mesh_, f, c);
    const Vec3 r = mesh_.face_centre(f, c) - mesh_.C[c], of_L = dot(L, r);
    const Real phi =
        side * (rim && leaves_known(f, c) ? dot(w + of_L, mesh_.Sf[f]) : snapshot.phi[f]);
    sum += phi * (r + face_value(f, c, phi >= 0, snapshot, dt) - d[c]);
    carried += phi * r;
    off += (side * dot(of_L, mesh_.Sf[f])) * r;
  }
  if (rim) {
    const Vec3 n = inward_normal(filled_, mesh_, c, extension_.symmetry()),
               more = carried - off - mesh_.V[c] * w;
    off += more - dot(more, n) * n;
  }
  return sum - dot(gradient_of_map(c), off - (dt / 2) * dot(L, off));
}

void ReferenceMap::advance(const FlowSnapshot& snapshot, Real dt) {
  new_.clear();
  for (const Index c : known_.core())
    new_.push_back(d[c] - (dt / mesh_.V[c]) * outflow(c, snapshot, dt) +
                   towards_volume(c, snapshot, dt) + without_alternation(c, snapshot, dt) +
                   towards_inside(c, snapshot, dt));
  const std::vector<Index>& core = known_.core();
  for (std::size_t i = 0; i < core.size(); ++i) d[core[i]] = new_[i];
  extend();
  if (beside_psi_) return refit();
  if (!all_of_ranks(!folded()))
    throw Error(ErrorKind::numerics, "the reference map folds: det grad xi <= 0");
}

Strain ReferenceMap::transport(const CellField<Real>& /*alpha*/, const FlowSnapshot& snapshot,
                               Real dt, CellField<SymGradient>& /*grad*/) {
  Real fastest = 0;
  for (const Index c : known_.core()) fastest = std::max(fastest, shear_rate(snapshot.L[c]));
  return in_parts(
      dt, [&] { return fastest; }, [&](Real part) { return advance(snapshot, part), fastest; });
}

void ReferenceMap::refit() {
  const auto lost = [&](Index c) { return filled_[c] >= alpha_known && !(trust(c) > 0); };
  if (all_of_ranks(std::ranges::none_of(known_.core(), lost))) return;
  kept_.clear();
  for (Index c = 0; c < mesh_.n_cells; ++c)
    if (lost(c)) kept_.emplace_back(c, filled_[c]);
  for (const auto& [c, alpha] : kept_) filled_[c] = 0;
  known_.rebuild(filled_, alpha_known);
  extend();
  for (const auto& [c, alpha] : kept_) filled_[c] = alpha;
  known_.rebuild(filled_, alpha_known);
  extend();
}

bool ReferenceMap::folded() const {
  return std::ranges::any_of(known_.core(), [&](Index c) { return !(volume_ratio(c) > 0); });
}

Real ReferenceMap::update_B(CellField<SymTensor>& B, CellField<Real>& lambda,
                            const CellField<Real>& alpha, const Band& band) const {
  Real least = 1;
  for (const Index c : band.cells()) {
    B[c] = this->B(c, alpha[c]);
    const Eigen e = eigen(B[c]);
    if (alpha[c] >= alpha_min) least = std::min(least, e.value[0]);
    lambda[c] = e.value[2];
  }
  return least;
}

SymTensor ReferenceMap::B(Index c, Real /*alpha*/) const {
  // B = J^(2/dim) (grad xi)^-1 (grad xi)^-T
  const Tensor A = gradient_of_map(c);
  const Real J = det(A);
  if (!(J > 0)) return identity();
  const Tensor F = inverse(A);
  const Vec3 x{F.xx, F.xy, F.xz}, y{F.yx, F.yy, F.yz}, z{F.zx, F.zy, F.zz};
  const SymTensor b{dot(x, x), dot(x, y), dot(x, z), dot(y, y), dot(y, z), dot(z, z)};
  if (mesh_.dim == 2) return {J * b.xx, J * b.xy, 0, J * b.yy, 0, 1};
  return std::cbrt(J * J) * b;
}

}  // namespace fsi::solid
