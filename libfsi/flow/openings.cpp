#include "libfsi/flow/openings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/flow/planes_at.hpp"

namespace fsi::flow {

Openings::Openings(const Mesh& mesh, const std::vector<Condition>& conditions, Real rho)
    : mesh_(mesh), rho_(rho) {
  for (std::size_t i = 0; i < conditions.size(); ++i)
    if (const auto* opening = std::get_if<Opening>(&conditions[i])) {
      openings_.push_back({mesh.patches[i], opening->pressure, opening->load,
                           opening->pressure(0) + opening->load.stored, opening->load.stored});
      One& one = openings_.back();
      set_basis(one, conditions);
      one.sums.resize(one.basis.size() + 2), one.totals.resize(one.sums.size());
    }
}

/// Collective. Subtracts from e its part along the basis, twice against rounding, and scales it to
/// norm 1; false if e lies in their span.
bool Openings::orthonormalise(const One& opening, std::vector<Real>& e) const {
  const auto product = [&](const std::vector<Real>& a, const std::vector<Real>& b) {
    Sum sum;
    for (Index j = 0; j < opening.faces(); ++j)
      sum.add(norm(mesh_.Sf[opening.patch.begin + j]) * a[j] * b[j]);
    return sum.total();
  };
  const Real before = product(e, e);
  for (int pass = 0; pass < 2; ++pass)
    for (const std::vector<Real>& o : opening.basis) {
      const Real part = product(o, e);
      for (std::size_t j = 0; j < e.size(); ++j) e[j] -= part * o[j];
    }
  constexpr Real dependent = 1e-8;
  const Real left = product(e, e);
  if (!(left > dependent * before)) return false;
  for (Real& value : e) value /= std::sqrt(left);
  return true;
}

void Openings::set_basis(One& opening, const std::vector<Condition>& conditions) const {
  std::array<Sum, 7> sums;
  for (Index j = 0; j < opening.faces(); ++j) {
    const Vec3 &S = mesh_.Sf[opening.patch.begin + j], &x = mesh_.Cf[opening.patch.begin + j];
    for (int i = 0; i < 3; ++i) sums[i].add(S[i]), sums[3 + i].add(norm(S) * x[i]);
    sums[6].add(norm(S));
  }
  std::array<Real, 7> total{};
  Sum::totals(total, sums);
  const GlobalIndex n = global_sum(opening.faces());
  if (n == 0) return;
  const Vec3 area{total[0], total[1], total[2]},
      centre = Vec3{total[3], total[4], total[5]} / total[6];
  constexpr Real flat = 0.5;  // of the area, that of half a sphere
  require(norm(area) > flat * total[6],
          "the faces of the opening \"" + opening.patch.name +
              "\" face different ways, so no direction is out: give each of its ends a name of "
              "its own");
  opening.normal = area / norm(area);
  const Vec3 other = mesh_.dim == 2                     ? Vec3{0, 0, 1}
                     : std::abs(opening.normal.x) < 0.7 ? Vec3{1, 0, 0}
                                                        : Vec3{0, 1, 0};
  std::vector<Patch> slips;
  for (std::size_t i = 0; i < conditions.size(); ++i)
    if (lets_slip(conditions[i])) slips.push_back(mesh_.patches[i]);
  const std::vector<geometry::Mirror> mirrors = planes_at(opening.patch, slips, mesh_);
  const Vec3 across = cross(opening.normal, other);
  const Vec3 v = mirrors.empty() ? across / norm(across) : mirrors[0].n;
  const Vec3 w = cross(opening.normal, v);
  // Across a plane of symmetry the profile is even about the plane.
  const bool even_v = !mirrors.empty(), even_w = mirrors.size() > 1;
  const Real v_0 = dot(even_v ? mirrors[0].x : centre, v),
             w_0 = dot(even_w ? mirrors[1].x : centre, w);
  const Real size = mesh_.dim == 2 ? total[6] / 2 : std::sqrt(total[6]) / 2;
  constexpr int highest = 4;
  for (int degree = 0; degree <= highest; ++degree) {
    std::vector<std::vector<Real>> of_degree;
    for (int k = mesh_.dim == 2 ? degree : 0; k <= degree; ++k) {
      if ((even_v && k % 2 != 0) || (even_w && (degree - k) % 2 != 0)) continue;
      std::vector<Real>& e = of_degree.emplace_back(static_cast<std::size_t>(opening.faces()));
      for (Index j = 0; j < opening.faces(); ++j) {
        const Vec3& x = mesh_.Cf[opening.patch.begin + j];
        e[j] =
            std::pow((dot(x, v) - v_0) / size, k) * std::pow((dot(x, w) - w_0) / size, degree - k);
      }
    }
    // All terms of a degree or none, so that the directions of v and w do not matter.
    if (degree > 0 && 4 * static_cast<GlobalIndex>(opening.basis.size() + of_degree.size()) > n)
      return;
    for (std::vector<Real>& e : of_degree)
      if (orthonormalise(opening, e)) opening.basis.push_back(std::move(e));
  }
}

void Openings::set_pressure(BoundaryField<Real>& p_b, const CellField<Vec3>& u) {
  for (One& opening : openings_) {
    const auto inward = [&](Index f) { return -dot(u[mesh_.owner[f]], opening.normal); };
    std::vector<Sum>& sums = opening.sums;
    std::vector<Real>& total = opening.totals;
    std::ranges::fill(sums, Sum{});
    for (Index j = 0; j < opening.faces(); ++j) {
      const Real flow = norm(mesh_.Sf[opening.patch.begin + j]) * inward(opening.patch.begin + j);
      for (std::size_t k = 0; k < opening.basis.size(); ++k)
        sums[k].add(flow * opening.basis[k][j]);
      sums.end()[-2].add(flow), sums.back().add(std::max(flow, Real{0}));
    }
    Sum::totals(total, sums);
    const Real net = total.end()[-2], in = total.back();
    const Real s = in > 0 ? std::max(net, Real{0}) / in : 0;
    const Real p = opening.pressure;
    for (Index j = 0; j < opening.faces(); ++j) {
      Real U = 0;
      for (std::size_t k = 0; k < opening.basis.size(); ++k) U += total[k] * opening.basis[k][j];
      const Index f = opening.patch.begin + j;
      const Real u_n = inward(f);
      p_b[f - mesh_.n_internal] = u_n > 0 ? p + rho_ / 2 * (s * U * U - u_n * u_n) : p;
    }
  }
}

void Openings::advance(BoundaryField<Real>& q_b, Real t, Real factor) {
  for (One& opening : openings_) {
    const Real before = opening.pressure;
    if (!opening.load.any()) opening.pressure = opening.given(t);
    const Real rise = factor * (opening.pressure - before);
    for (Index j = 0; j < opening.faces(); ++j)
      q_b[opening.patch.begin + j - mesh_.n_internal] = rise;
  }
}

void Openings::set_velocity(BoundaryField<Vec3>& u_b, const CellField<Vec3>& u,
                            const std::vector<Tensor>& L_f, const FaceWeights& weights) const {
  for (const One& opening : openings_)
    for (Index f = opening.patch.begin; f < opening.patch.end; ++f)
      u_b[f - mesh_.n_internal] = velocity(f, u, L_f, weights);
}

Vec3 Openings::velocity(Index f, const CellField<Vec3>& u, const std::vector<Tensor>& L_f,
                        const FaceWeights& weights) const {
  const Vec3 d = mesh_.d[f], S = mesh_.Sf[f];
  Vec3 u_f = u[mesh_.owner[f]];
  if (const Index i = weights.place[f]; i >= 0) u_f += dot(L_f[i], d - (dot(d, S) / norm2(S)) * S);
  return u_f;
}

void Openings::set_flux_excess(FaceField<Real>& excess, const FaceField<Real>& phi,
                               const CellField<Vec3>& u, const std::vector<Tensor>& L_f,
                               const FaceWeights& weights) const {
  for (const One& opening : openings_)
    for (Index f = opening.patch.begin; f < opening.patch.end; ++f)
      excess[f] = phi[f] - dot(velocity(f, u, L_f, weights), mesh_.Sf[f]);
}

void Openings::set_inflow(BoundaryField<Vec3>& u_b, const FaceField<Real>& phi) const {
  for (const One& opening : openings_)
    for (Index f = opening.patch.begin; f < opening.patch.end; ++f)
      if (phi[f] < 0) u_b[f - mesh_.n_internal] = (phi[f] / norm2(mesh_.Sf[f])) * mesh_.Sf[f];
}

}  // namespace fsi::flow
