#include "libfsi/flow/centre_line.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libfsi/core/parallel.hpp"
#include "libfsi/field/boundary.hpp"
#include "libfsi/flow/projection.hpp"
#include "libfsi/mesh/quality.hpp"

namespace fsi::flow {

CentreLine::CentreLine(const Mesh& mesh, const std::string& from, const std::string& to) {
  Conditions conditions;
  for (const Patch& patch : mesh.patches) conditions[patch.name] = Slip{};
  conditions[mesh.patch(from).name] = conditions[mesh.patch(to).name] = Opening{};
  const FaceWeights weights(mesh);
  Projection projection(mesh, weights, resolve(conditions, mesh), Method::multigrid, 1);
  FaceField<Real> phi(mesh);
  CellField<Real> q(mesh);
  CellField<Vec3> grad(mesh);
  BoundaryField<Real> q_b(mesh);
  const Patch& first = mesh.patch(from);
  for (Index f = first.begin; f < first.end; ++f) q_b[f - mesh.n_internal] = 1;
  projection.project(phi, q, grad, q_b, 0);

  // Slices of about two cells at least, by volume: the potential falls faster in narrow parts.
  const Real across = std::cbrt(static_cast<Real>(mesh.n_global));
  const int slices = std::clamp(static_cast<int>(across), 4, 200);
  std::vector<Sum> sums(4 * static_cast<std::size_t>(slices));
  for (Index c = 0; c < mesh.n_owned; ++c) {
    // Between the middles of two slices a cell passes from one to the other, so that the line is
    // continuous in q.
    const Real at = std::clamp((1 - q[c]) * slices - 0.5, Real{0}, static_cast<Real>(slices - 1));
    const int k = std::min(static_cast<int>(at), slices - 2);
    const Real share = at - k, weight = mesh.V[c] * norm2(grad[c]);
    for (const auto& [slice, w] :
         {std::pair{k, (1 - share) * weight}, std::pair{k + 1, share * weight}}) {
      for (int i = 0; i < 3; ++i) sums[4 * slice + i].add(w * mesh.C[c][i]);
      sums[4 * slice + 3].add(w);
    }
  }
  std::vector<Real> total(sums.size());
  Sum::totals(total, sums);
  add(centre(mesh, from));
  for (int k = 0; k < slices; ++k)
    if (const Real weight = total[4 * k + 3]; weight > 0)
      add(Vec3{total[4 * k], total[4 * k + 1], total[4 * k + 2]} / weight);
  add(centre(mesh, to));
}

void CentreLine::add(const Vec3& point) {
  arc_.push_back(points_.empty() ? 0 : arc_.back() + norm(point - points_.back()));
  points_.push_back(point);
}

std::pair<Vec3, Vec3> CentreLine::at(Real s) const {
  const auto next = std::ranges::upper_bound(arc_, s);
  const auto i = std::clamp<std::ptrdiff_t>(next - arc_.begin(), 1,
                                            static_cast<std::ptrdiff_t>(arc_.size()) - 1);
  const Vec3 step = points_[i] - points_[i - 1];
  const Real share = (s - arc_[i - 1]) / (arc_[i] - arc_[i - 1]);
  // The direction over a few slices: the distance of single ones is as small as their errors.
  const std::ptrdiff_t low = std::max<std::ptrdiff_t>(0, i - 3),
                       high = std::min<std::ptrdiff_t>(
                           static_cast<std::ptrdiff_t>(points_.size()) - 1, i + 2);
  const Vec3 along = points_[high] - points_[low];
  return {points_[i - 1] + share * step, along / norm(along)};
}

}  // namespace fsi::flow
