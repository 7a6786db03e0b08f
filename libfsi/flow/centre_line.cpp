#include "libfsi/flow/centre_line.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libfsi/core/parallel.hpp"
#include "libfsi/field/boundary.hpp"
#include "libfsi/flow/projection.hpp"
#include "libfsi/mesh/quality.hpp"

namespace fsi::flow {
namespace {

/// Collective. Sums of `size` values of the cells over slices of equal steps of q: value(c, slice,
/// i). Between the middles of two slices a cell passes from one to the other, so that the line is
/// continuous in q.
template <class Value>
std::vector<Real> over_slices(int slices, int size, const CellField<Real>& q, const Mesh& mesh,
                              const Value& value) {
  std::vector<Sum> sums(static_cast<std::size_t>(slices) * size);
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Real at = std::clamp((1 - q[c]) * slices - 0.5, Real{0}, static_cast<Real>(slices - 1));
    const int k = std::min(static_cast<int>(at), slices - 2);
    const Real share = at - k;
    for (const auto& [slice, part] : {std::pair{k, 1 - share}, std::pair{k + 1, share}})
      for (int i = 0; i < size; ++i) sums[slice * size + i].add(part * value(c, slice, i));
  }
  std::vector<Real> total(sums.size());
  Sum::totals(total, sums);
  return total;
}

}  // namespace

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
  // By |grad q| V the slices of a bend have their centre in its middle: there grad q is larger at
  // the inner side. Where it is below half of its mean, as in dead ends, cells count less.
  const auto mean = over_slices(slices, 2, q, mesh, [&](Index c, int, int i) {
    return mesh.V[c] * (i == 0 ? norm(grad[c]) : norm2(grad[c]));
  });
  const auto total = over_slices(slices, 7, q, mesh, [&](Index c, int slice, int i) {
    const Real size = norm(grad[c]), of_slice = mean[2 * slice + 1];
    const Real twice = of_slice > 0 ? 2 * size * mean[2 * slice] / of_slice : 0;
    const Real weight = mesh.V[c] * std::min(twice * twice, Real{1});
    if (i > 3) return -weight * grad[c][i - 4];
    return weight * size * (i < 3 ? mesh.C[c][i] : 1);
  });
  const auto vector = [&](int i) { return Vec3{total[i], total[i + 1], total[i + 2]}; };
  const Vec3 begin = centre(mesh, from), end = centre(mesh, to);
  for (int k = 0; k < slices; ++k)
    if (const Real weight = total[7 * k + 3]; weight > 0) {
      if (points_.empty()) add(begin, vector(7 * k + 4));
      add(vector(7 * k) / weight, vector(7 * k + 4));
    }
  if (points_.empty()) add(begin, end - begin);
  add(end, along_.back());
}

void CentreLine::add(const Vec3& point, const Vec3& along) {
  arc_.push_back(points_.empty() ? 0 : arc_.back() + norm(point - points_.back()));
  points_.push_back(point);
  along_.push_back(along / norm(along));
}

std::pair<Vec3, Vec3> CentreLine::at(Real s) const {
  const auto next = std::ranges::upper_bound(arc_, s);
  const auto i = std::clamp<std::ptrdiff_t>(next - arc_.begin(), 1,
                                            static_cast<std::ptrdiff_t>(arc_.size()) - 1);
  const Vec3 step = points_[i] - points_[i - 1];
  const Real share = (s - arc_[i - 1]) / (arc_[i] - arc_[i - 1]);
  const Vec3 along = along_[i - 1] + share * (along_[i] - along_[i - 1]);
  return {points_[i - 1] + share * step, along / norm(along)};
}

}  // namespace fsi::flow
