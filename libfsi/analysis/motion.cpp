#include "libfsi/analysis/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi::analysis {
namespace {

struct Moments {
  Real volume = 0;
  Vec3 arm, momentum;  ///< sum alpha V (x - about), sum alpha V u
  Real square = 0;     ///< sum alpha V |x - about|^2
};

Moments moments(const CellField<Real>& alpha, const CellField<Vec3>& u, const Mesh& mesh,
                const Vec3& about) {
  std::array<Sum, 8> sums;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (alpha[c] == 0) continue;
    const Real volume = alpha[c] * mesh.V[c];
    const Vec3 x = mesh.C[c] + mesh.translation[nearest_image(mesh, mesh.C[c], about)] - about;
    sums[0].add(volume), sums[7].add(volume * norm2(x));
    for (int i = 0; i < 3; ++i) sums[1 + i].add(volume * x[i]), sums[4 + i].add(volume * u[c][i]);
  }
  std::array<Real, 8> total{};
  Sum::totals(total, sums);
  return {total[0], {total[1], total[2], total[3]}, {total[4], total[5], total[6]}, total[7]};
}

/// Moves `home` to the mean over nearest images, until it stays. A solid of length l departs from a
/// place half a period L off by L / l in a round, so one that is almost as long needs many.
Moments settle(Vec3& home, const CellField<Real>& alpha, const CellField<Vec3>& u,
               const Mesh& mesh) {
  constexpr int most = 200;
  constexpr Real still = 1e-12;  // of the solid's size
  Moments sum;
  for (int round = 0; round < most; ++round) {
    sum = moments(alpha, u, mesh, home);
    if (sum.volume == 0) break;
    const Vec3 move = sum.arm / sum.volume;
    home += move;
    const Real size = std::pow(sum.volume, Real{1} / mesh.dim);
    if (mesh.translation.size() == 1 || norm(move) <= still * size) break;
  }
  return sum;
}

/// Of the places where the mean may stay, that about which the solid is most compact.
void settle_at_first(Vec3& home, const CellField<Real>& alpha, const CellField<Vec3>& u,
                     const Mesh& mesh) {
  constexpr Real nearer = 1 - 1e-9;
  Real least = settle(home, alpha, u, mesh).square;
  const Vec3 first = home;
  for (std::size_t row = 1; row < mesh.translation.size(); ++row) {
    Vec3 other = first + mesh.translation[row] / 2;
    const Real square = settle(other, alpha, u, mesh).square;
    if (square < nearer * least) least = square, home = other;
  }
}

/// sum alpha V L . way, L = (1/V) sum_f u_f (x) S_f: how the mean of u changes along a way that all
/// of the solid goes. At the boundary u_f is that of the cell.
Vec3 change_along(const Vec3& way, const CellField<Real>& alpha, const CellField<Vec3>& u,
                  const Mesh& mesh) {
  std::array<Sum, 3> sums;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (alpha[c] == 0) continue;
    Vec3 change;
    for (const Index f : mesh.cell_faces[c]) {
      const Index n = beyond(mesh, f, c);
      const Vec3 u_f = n < 0 ? u[c] : (u[c] + u[n]) / 2;
      change += (outward(mesh, f, c) * dot(mesh.Sf[f], way)) * u_f;
    }
    for (int i = 0; i < 3; ++i) sums[i].add(alpha[c] * change[i]);
  }
  std::array<Real, 3> total{};
  Sum::totals(total, sums);
  return {total[0], total[1], total[2]};
}

/// Centre of the fullest cell, of equals the first in the mesh as read: a point in the solid.
Vec3 point_inside(const CellField<Real>& alpha, const Mesh& mesh) {
  Real most = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) most = std::max(most, alpha[c]);
  most = global_max(most);
  Index best = -1;  // cells are sorted by global_id
  for (Index c = mesh.n_owned - 1; c >= 0; --c) {
    if (alpha[c] == most) best = c;
  }
  const Real id =
      best < 0 ? std::numeric_limits<Real>::infinity() : static_cast<Real>(mesh.global_id[best]);
  const Real first = global_min(id);
  std::array<Sum, 3> sums;
  if (best >= 0 && id == first) {
    for (int i = 0; i < 3; ++i) sums[i].add(mesh.C[best][i]);
  }
  std::array<Real, 3> x{};
  Sum::totals(x, sums);
  return {x[0], x[1], x[2]};
}

Vec3 middle(const Mesh& mesh) {
  std::array<Sum, 3> sums;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    for (int i = 0; i < 3; ++i) sums[i].add(mesh.V[c] * mesh.C[c][i]);
  }
  std::array<Real, 3> x{};
  Sum::totals(x, sums);
  return Vec3{x[0], x[1], x[2]} / mesh.total_volume;
}

}  // namespace

Index nearest_image(const Mesh& mesh, const Vec3& x, const Vec3& about) {
  Index best = 0;
  Real least = norm2(x - about);
  for (Index row = 1; row < static_cast<Index>(mesh.translation.size()); ++row) {
    const Real square = norm2(x + mesh.translation[row] - about);
    if (square < least) least = square, best = row;
  }
  return best;
}

Motion motion(Tracker& tracker, const CellField<Real>& alpha, const CellField<Vec3>& u,
              const Mesh& mesh, Real ahead) {
  if (!tracker.started) {
    tracker.home = point_inside(alpha, mesh), tracker.middle = middle(mesh);
    settle_at_first(tracker.home, alpha, u, mesh);
  }
  const Moments sum = settle(tracker.home, alpha, u, mesh);
  if (sum.volume == 0) return {0, tracker.home + tracker.travelled, {}};
  const bool first = !tracker.started;
  tracker.started = true;
  const Vec3 jump = mesh.translation[nearest_image(mesh, tracker.home, tracker.middle)];
  tracker.home += jump;
  if (!first) tracker.travelled -= jump;  // at first it is the image that lies in the mesh
  const Vec3 centroid = tracker.home + tracker.travelled;
  Vec3 velocity = sum.momentum / sum.volume;
  if (ahead != 0) velocity += change_along(ahead * velocity, alpha, u, mesh) / sum.volume;
  return {sum.volume, centroid, velocity};
}

}  // namespace fsi::analysis
