#include "libfsi/run/taylor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "libfsi/analysis/motion.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/geometry/moments.hpp"

namespace fsi {
namespace {

/// Of the part of a cell that is solid, about the cell's centroid.
geometry::Moments solid_part(geometry::Polytope& cell, const Body& body, Index c) {
  const Mesh& mesh = body.mesh;
  vof::gather(cell, mesh, c);
  const vof::Piece& piece = body.interface.piece[c];
  if (piece.area > 0)
    return moments_below(cell, {piece.n_hat, dot(piece.n_hat, piece.centre - mesh.C[c])});
  geometry::Moments m = moments(cell);
  m.volume *= body.alpha[c], m.first *= body.alpha[c], m.second *= body.alpha[c];
  return m;
}

/// A part of the solid and what moves it.
struct Part {
  geometry::Moments moments;
  Vec3 flow;
};

void add_images(std::vector<Part>& parts, const geometry::Mirror& mirror) {
  for (std::size_t i = 0, n = parts.size(); i < n; ++i)
    parts.push_back({image(parts[i].moments, mirror), mirror.of_direction(parts[i].flow)});
}

/// Half-axes of the ellipse: a^2 and b^2 are as the eigenvalues of ((xx xy) (xy yy)).
Taylor ellipse(Real xx, Real xy, Real yy) {
  const Real mean = (xx + yy) / 2, half = std::hypot((xx - yy) / 2, xy);
  const Real a = std::sqrt(mean + half), b = std::sqrt(std::max(mean - half, Real{0}));
  if (!(a > 0)) return {};
  return {(a - b) / (a + b), std::atan2(xy, (xx - yy) / 2) * (90 / std::numbers::pi)};
}

}  // namespace

Taylor taylor(const Body& body, const CellField<Vec3>& u, const Vec3& about, Real later) {
  const Mesh& mesh = body.mesh;
  geometry::Polytope cell(mesh.dim);
  std::array<Sum, 11> sums;
  std::vector<Part> parts;  // of a cell: its solid and the images
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (body.alpha[c] == 0) continue;
    const Vec3 x =
        mesh.C[c] + mesh.translation[analysis::nearest_image(mesh, mesh.C[c], about)] - about;
    parts.assign({{shifted(solid_part(cell, body, c), x), later * u[c]}});
    for (const geometry::Mirror& mirror : body.filled.cut_by.planes)
      add_images(parts, {mirror.x - about, mirror.n});
    for (const auto& [m, flow] : parts) {
      const std::array<Real, 11> items{m.volume,
                                       m.first.x,
                                       m.first.y,
                                       m.second.xx,
                                       m.second.xy,
                                       m.second.yy,
                                       m.volume * flow.x,
                                       m.volume * flow.y,
                                       2 * m.first.x * flow.x,
                                       m.first.x * flow.y + m.first.y * flow.x,
                                       2 * m.first.y * flow.y};
      for (std::size_t i = 0; i < items.size(); ++i) sums[i].add(items[i]);
    }
  }
  std::array<Real, 11> t{};
  Sum::totals(t, sums);
  if (!(t[0] > 0)) return {};
  const Real x = t[1] / t[0], y = t[2] / t[0], ux = t[6] / t[0], uy = t[7] / t[0];
  const Real xx = t[3] / t[0] - x * x + t[8] / t[0] - 2 * x * ux;
  const Real xy = t[4] / t[0] - x * y + t[9] / t[0] - x * uy - y * ux;
  const Real yy = t[5] / t[0] - y * y + t[10] / t[0] - 2 * y * uy;
  return ellipse(xx, xy, yy);
}

}  // namespace fsi
