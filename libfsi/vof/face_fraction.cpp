#include "libfsi/vof/face_fraction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libfsi/geometry/cut.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi::vof {

Real swept_part(const Mesh& mesh, Index f, Index c, const Piece& p, Real s0, Real s1) {
  const auto n = static_cast<Index>(mesh.face_points[f].size());
  const auto corner = [&](Index i) { return mesh.corner(f, i % n, c) - p.centre; };
  if (n == 2) {
    geometry::Levels<2> q{dot(p.n_hat, corner(0)), dot(p.n_hat, corner(1))};
    std::ranges::sort(q);
    return geometry::mean_part_below(q, s0, s1);
  }
  if (n == 3) {
    geometry::Levels<3> q{dot(p.n_hat, corner(0)), dot(p.n_hat, corner(1)),
                          dot(p.n_hat, corner(2))};
    std::ranges::sort(q);
    return geometry::mean_part_below(q, s0, s1);
  }
  Vec3 middle;
  for (Index i = 0; i < n; ++i) middle += corner(i);
  middle = middle / n;
  Real sum = 0, whole = 0;
  for (Index i = 0; i < n; ++i) {
    const Vec3 a = corner(i), b = corner(i + 1);
    const Real area = norm(cross(a - middle, b - middle));
    geometry::Levels<3> q{dot(p.n_hat, middle), dot(p.n_hat, a), dot(p.n_hat, b)};
    std::ranges::sort(q);
    sum += area * geometry::mean_part_below(q, s0, s1);
    whole += area;
  }
  return sum / whole;
}

namespace {

/// The ends of the line at level s on a triangle whose corners x have the levels q, both sorted; if
/// s is out of range, twice the nearest corner.
std::array<Vec3, 2> line_at(const std::array<Vec3, 3>& x, const geometry::Levels<3>& q, Real s) {
  if (s <= q[0]) return {x[0], x[0]};
  if (s >= q[2]) return {x[2], x[2]};
  const auto between = [&](std::size_t a, std::size_t b) {
    return x[a] + (s - q[a]) / (q[b] - q[a]) * (x[b] - x[a]);
  };
  return {between(0, 2), s <= q[1] ? between(0, 1) : between(1, 2)};
}

}  // namespace

Real swept_part(const Mesh& mesh, Index f, Index c, const Piece& p, const Bend& bend,
                const Vec3& aside, Real s0, Real s1) {
  std::array<Vec3, 3> x;
  for (Index i = 0; i < 3; ++i) x[i] = mesh.corner(f, i, c) - p.centre;
  std::ranges::sort(x, {}, [&](const Vec3& r) { return dot(p.n_hat, r); });
  const geometry::Levels<3> q{dot(p.n_hat, x[0]), dot(p.n_hat, x[1]), dot(p.n_hat, x[2])};
  const auto product = [&](const Vec3& a, const Vec3& b) {
    return dot(a - aside, dot(bend.K, b - aside));
  };
  const auto [a, b] = line_at(x, q, (s0 + s1) / 2);
  const Real on_line = (product(a, a) + product(a, b) + product(b, b)) / 3;
  const Real on_face = (product(x[0], x[0]) + product(x[1], x[1]) + product(x[2], x[2]) +
                        product(x[0], x[1]) + product(x[1], x[2]) + product(x[2], x[0])) /
                       6;
  const Real range = q[2] - q[0], way = std::abs(s1 - s0);
  const Real whole = way < range ? way / range : 1;
  const Real shift = (bend.mean - on_line - whole * (on_face - on_line)) / 2;
  return geometry::mean_part_below(q, s0 + shift, s1 + shift);
}

void face_fraction(FaceField<Real>& alpha_f, const CellField<Real>& alpha,
                   const Interface& interface, const FaceWeights& weights, const Mesh& mesh,
                   std::span<const Index> faces, const SymmetryFaces& symmetry) {
  for (const Index f : faces) {
    const Index P = mesh.owner[f];
    if (f >= mesh.n_internal) {
      const Piece& p = interface.piece[P];
      const Vec3& S = mesh.Sf[f];
      const bool mirror = symmetry.has(f, mesh);
      const Vec3 d = mirror ? (dot(mesh.d[f], S) / norm2(S)) * S : mesh.d[f];
      const Real to_face = dot(p.n_hat, d), beyond_it = mirror ? -to_face : 0;
      alpha_f[f] = p.area > 0 ? swept_part(mesh, f, P, p, to_face, beyond_it) : alpha[P];
      continue;
    }
    const Index N = mesh.neighbour[f];
    const Real lambda = weights.lambda[f];
    Real sum = 0;
    int planes = 0;
    for (const Index c : {P, N}) {
      const Piece& p = interface.piece[c];
      if (!(p.area > 0)) continue;
      // The face moves from P to N through -lambda to 1 - lambda of d, the plane the other way.
      const Real d = dot(p.n_hat, mesh.d[f]);
      sum += swept_part(mesh, f, c, p, lambda * d, (lambda - 1) * d);
      ++planes;
    }
    alpha_f[f] = planes > 0 ? sum / planes : alpha[P] + lambda * (alpha[N] - alpha[P]);
  }
}

void line_fraction(FaceField<Real>& alpha_f, const CellField<Real>& alpha,
                   const Interface& interface, const FaceWeights& weights, const Mesh& mesh,
                   std::span<const Index> faces) {
  // Part behind the plane of c between heights a and b above it; without a plane the cell is full
  // or empty.
  const auto part = [&](Index c, const Vec3& from, const Vec3& to) -> Real {
    const Piece& p = interface.piece[c];
    if (!(p.area > 0)) return alpha[c];
    Real a = dot(p.n_hat, from - p.centre), b = dot(p.n_hat, to - p.centre);
    if (a > b) std::swap(a, b);
    return b <= 0 ? 1 : a >= 0 ? 0 : -a / (b - a);
  };
  for (const Index f : faces) {
    const Index P = mesh.owner[f];
    const Vec3 x = mesh.C[P];
    if (f >= mesh.n_internal) {
      alpha_f[f] = part(P, x, x + mesh.d[f]);
      continue;
    }
    const Index N = mesh.neighbour[f];
    const Real lambda = weights.lambda[f];
    const Vec3 y = mesh.C[N];
    alpha_f[f] = lambda * part(P, x, x + lambda * mesh.d[f]) +
                 (1 - lambda) * part(N, y - (1 - lambda) * mesh.d[f], y);
  }
}

bool touches(Index f, const CellField<Real>& alpha, const Interface& interface, const Mesh& mesh) {
  const Index P = mesh.owner[f];
  const Piece& p = interface.piece[P];
  return p.area > 0 ? dot(p.n_hat, mesh.face_centre(f, P) - p.centre) < 0 : alpha[P] >= 0.5;
}

void cell_plane(CellField<Vec3>& normal, CellField<Real>& height, const CellField<Real>& alpha,
                const Interface& interface, const Mesh& mesh, std::span<const Index> cells) {
  for (const Index c : cells) {
    const Piece& p = interface.piece[c];
    normal[c] = p.area > 0 ? p.n_hat : Vec3{};
    height[c] = p.area > 0 ? dot(p.n_hat, mesh.C[c] - p.centre) : 0;
    if (p.area > 0) continue;
    Vec3 sum, on_surface;
    int faces = 0;
    for (const Index f : mesh.cell_faces[c]) {
      const Index n = beyond(mesh, f, c);
      if (n < 0 || interface.piece[n].area > 0 || !(std::abs(alpha[n] - alpha[c]) > 0.5)) continue;
      sum += (alpha[c] > alpha[n] ? 1 : -1) * outward(mesh, f, c) * mesh.Sf[f];
      on_surface += mesh.face_centre(f, c);
      ++faces;
    }
    if (norm2(sum) == 0) continue;
    normal[c] = sum / norm(sum);
    height[c] = dot(normal[c], mesh.C[c] - on_surface / faces);
  }
}

void mean_fraction(FaceField<Real>& alpha_f, const CellField<Real>& alpha,
                   const FaceWeights& weights, const Mesh& mesh, std::span<const Index> faces) {
  for (const Index f : faces) {
    const Real a_P = alpha[mesh.owner[f]];
    alpha_f[f] =
        f < mesh.n_internal ? a_P + weights.lambda[f] * (alpha[mesh.neighbour[f]] - a_P) : a_P;
  }
}

void face_normal(FaceField<Vec3>& normal_f, const CellField<Vec3>& normal, const Mesh& mesh,
                 std::span<const Index> faces, const SymmetryFaces& symmetry) {
  constexpr Real opposed = 0.1;
  const auto mean = [](const Vec3& sum) {
    const Real size = norm(sum);
    return size > opposed ? sum / size : Vec3{};
  };
  for (const Index f : faces) {
    const Vec3& n = normal[mesh.owner[f]];
    if (f < mesh.n_internal)
      normal_f[f] = mean(n + normal[mesh.neighbour[f]]);
    else
      normal_f[f] = symmetry.has(f, mesh) ? mean(n + image(n, mesh.normal(f))) : n;
  }
}

}  // namespace fsi::vof
