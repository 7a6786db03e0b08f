#include "libfsi/mesh/quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/cells.hpp"
#include "libfsi/mesh/metrics.hpp"

namespace fsi {
namespace {

/// theta = acos(d . Sf / |d||Sf|), in degrees.
Real angle_of(const Mesh& mesh, Index f) {
  const Vec3 &d = mesh.d[f], &Sf = mesh.Sf[f];
  return std::acos(std::clamp(dot(d, Sf) / (norm(d) * norm(Sf)), -1.0, 1.0)) * 180 /
         std::numbers::pi;
}

/// The line C_P + t d crosses the plane of the face at t = (Cf - C_P) . Sf / d . Sf.
Real skewness_of(const Mesh& mesh, Index f) {
  const Vec3 &d = mesh.d[f], &Sf = mesh.Sf[f], r = mesh.Cf[f] - mesh.C[mesh.owner[f]];
  return norm(r - (dot(r, Sf) / dot(d, Sf)) * d) / norm(d);
}

/// Each internal face of the mesh once: those whose owner is owned.
Real mean_angle(const Mesh& mesh) {
  Sum angles;
  GlobalIndex n = 0;
  for (Index f = 0; f < mesh.n_internal; ++f)
    if (mesh.owner[f] < mesh.n_owned) angles.add(angle_of(mesh, f)), ++n;
  const Real total = angles.total();
  n = global_sum(n);
  return n > 0 ? total / static_cast<Real>(n) : 0;
}

Real closure(const Mesh& mesh) {
  Real worst = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    Vec3 sum;
    Real area = 0;
    for (const Index f : mesh.cell_faces[c]) {
      sum += mesh.owner[f] == c ? mesh.Sf[f] : -mesh.Sf[f];
      area += norm(mesh.Sf[f]);
    }
    worst = std::max(worst, norm(sum) / area);
  }
  return global_max(worst);
}

/// Longest edge over thickness of the cell with equal edges: a triangle has the height sqrt(3)/2, a
/// tet sqrt(2/3), a prism is thinnest across its triangle, a pyramid from base to apex, sqrt(1/2).
constexpr std::array<Real, 6> regular{2 / std::numbers::sqrt3, 1,
                                      1.2247448713915890,      1,
                                      2 / std::numbers::sqrt3, std::numbers::sqrt2};

bool larger(const Worst& a, const Worst& b) {
  return a.value > b.value || (a.value == b.value && a.cell < b.cell);
}

}  // namespace

Real aspect_ratio(CellType type, std::span<const Vec3> corners) {
  const Shape& shape = shape_of(type);
  Real longest = 0, thickness = std::numeric_limits<Real>::max();
  std::array<Vec3, max_face_corners> x;
  for (int f = 0; f < shape.faces; ++f) {
    std::size_t n = 0;
    for (const std::int8_t i : shape.face_corners(f)) x[n++] = corners[static_cast<std::size_t>(i)];
    for (std::size_t i = 0; i < n; ++i) longest = std::max(longest, norm(x[(i + 1) % n] - x[i]));
    const FaceMetrics face = face_metrics({x.data(), n});
    Real farthest = 0;
    for (const Vec3& corner : corners)
      farthest = std::max(farthest, std::abs(dot(corner - face.centre, face.Sf)));
    thickness = std::min(thickness, farthest / norm(face.Sf));
  }
  return longest / thickness / regular[static_cast<std::size_t>(type)];
}

Real aspect_ratio(const Mesh& mesh, Index c) {
  std::array<Vec3, max_corners> x;
  std::size_t n = 0;
  for (const Index p : mesh.cell_points[c]) x[n++] = mesh.points[static_cast<std::size_t>(p)];
  return aspect_ratio(mesh.type(c), {x.data(), n});
}

CellQuality cell_quality(const Mesh& mesh) {
  const auto n = static_cast<std::size_t>(mesh.n_owned);
  CellQuality q{std::vector<Real>(n, 0), std::vector<Real>(n, 0), std::vector<Real>(n, 1),
                std::vector<Real>(n, 1)};
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    const Real angle = angle_of(mesh, f), skewness = skewness_of(mesh, f),
               ratio = std::max(mesh.V[P] / mesh.V[N], mesh.V[N] / mesh.V[P]);
    for (const Index c : {P, N}) {
      if (c >= mesh.n_owned) continue;
      q.non_orthogonality[c] = std::max(q.non_orthogonality[c], angle);
      q.skewness[c] = std::max(q.skewness[c], skewness);
      q.volume_ratio[c] = std::max(q.volume_ratio[c], ratio);
    }
  }
  for (Index c = 0; c < mesh.n_owned; ++c) q.aspect_ratio[c] = aspect_ratio(mesh, c);
  return q;
}

std::vector<Worst> worst(std::span<const Real> values, const Mesh& mesh, std::size_t most) {
  std::vector<Index> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  const auto item = [&](Index c) {
    return Worst{values[static_cast<std::size_t>(c)], mesh.C[c], mesh.global_id[c], mesh.type(c)};
  };
  most = std::min(most, static_cast<std::size_t>(mesh.n_global));
  const auto mine = static_cast<std::ptrdiff_t>(std::min(most, values.size()));
  std::partial_sort(order.begin(), order.begin() + mine, order.end(),
                    [&](Index a, Index b) { return larger(item(a), item(b)); });
  // What each rank has to offer; cell -1 where it has less.
  std::vector<Worst> offered(most), all(most * static_cast<std::size_t>(ranks()));
  for (std::ptrdiff_t i = 0; i < mine; ++i) offered[i] = item(order[i]);
  const int bytes = static_cast<int>(most * sizeof(Worst));
  MPI_Allgather(offered.data(), bytes, MPI_BYTE, all.data(), bytes, MPI_BYTE, comm());
  std::erase_if(all, [](const Worst& w) { return w.cell < 0; });
  std::ranges::sort(all, larger);
  all.resize(std::min(all.size(), most));
  return all;
}

Real value_at(std::span<const Real> values, GlobalIndex cell, const Mesh& mesh) {
  const auto end = mesh.global_id.begin() + mesh.n_owned;
  const auto found = std::lower_bound(mesh.global_id.begin(), end, cell);
  const bool mine = found != end && *found == cell;
  return global_max(mine ? values[static_cast<std::size_t>(found - mesh.global_id.begin())] : 0);
}

Quality quality(const Mesh& mesh) { return quality(mesh, cell_quality(mesh)); }

Quality quality(const Mesh& mesh, const CellQuality& cells) {
  Quality q;
  q.non_orthogonality = worst(cells.non_orthogonality, mesh, 1).front();
  q.skewness = worst(cells.skewness, mesh, 1).front();
  q.volume_ratio = worst(cells.volume_ratio, mesh, 1).front();
  q.aspect_ratio = worst(cells.aspect_ratio, mesh, 1).front();
  q.non_orthogonality_mean = mean_angle(mesh);
  q.closure_max = closure(mesh);
  const auto owned = mesh.V.begin() + mesh.n_owned;
  const auto [low, high] = std::minmax_element(mesh.V.begin(), owned);
  constexpr Real none = std::numeric_limits<Real>::infinity();
  q.volume_min = global_min(mesh.n_owned > 0 ? *low : none);
  q.volume_max = global_max(mesh.n_owned > 0 ? *high : -none);
  return q;
}

Vec3 centre(const Mesh& mesh, const std::string& patch) {
  const Patch& faces = mesh.patch(patch);
  std::array<Sum, 4> sums;
  for (Index f = faces.begin; f < faces.end; ++f) {
    const Real area = norm(mesh.Sf[f]);
    for (int i = 0; i < 3; ++i) sums[i].add(area * mesh.Cf[f][i]);
    sums[3].add(area);
  }
  std::array<Real, 4> total{};
  Sum::totals(total, sums);
  return Vec3{total[0], total[1], total[2]} / total[3];
}

}  // namespace fsi
