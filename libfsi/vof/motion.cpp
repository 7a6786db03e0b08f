#include "libfsi/vof/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi::vof {
namespace {

constexpr Real pi = std::numbers::pi;

Real square(Real x) { return x * x; }
/// sin^2(pi x) and sin(2 pi x).
Real s2(Real x) { return square(std::sin(pi * x)); }
Real sd(Real x) { return std::sin(2 * pi * x); }

std::function<Real(Real)> reversed(Real T) {
  return [T](Real t) { return std::cos(pi * t / T); };
}

Motion vortex() {
  // stream function s = s2(x) s2(y) / pi, u = (-ds/dy, ds/dx): A.z = -s
  return {[](const Vec3& x) {
            return Vec3{-s2(x.x) * sd(x.y), sd(x.x) * s2(x.y), 0};
          },
          [](const Vec3& x) {
            return Vec3{0, 0, -s2(x.x) * s2(x.y) / pi};
          },
          reversed(8), 8};
}

Motion deformation() {
  // A = (0, -s2(x) sin(2 pi y) s2(z), s2(x) s2(y) sin(2 pi z)) / pi
  return {[](const Vec3& x) {
            return Vec3{2 * s2(x.x) * sd(x.y) * sd(x.z), -sd(x.x) * s2(x.y) * sd(x.z),
                        -sd(x.x) * sd(x.y) * s2(x.z)};
          },
          [](const Vec3& x) {
            return Vec3{0, -s2(x.x) * sd(x.y) * s2(x.z) / pi, s2(x.x) * s2(x.y) * sd(x.z) / pi};
          },
          reversed(3), 3};
}

Motion rotation() {
  return {[](const Vec3& x) {
            return Vec3{0.5 - x.y, x.x - 0.5, 0};
          },
          [](const Vec3& x) {
            return Vec3{0, 0, -(square(x.x - 0.5) + square(x.y - 0.5)) / 2};
          },
          [](Real) { return 1.0; }, 2 * pi};
}

/// Integral of A along the edge from a to b.
Real along(const Motion& motion, const Vec3& a, const Vec3& b) {
  const Vec3 middle = (a + b) / 2, half = (b - a) / 2;
  const Real g = std::sqrt(0.6);
  const Vec3 sum = 5 * motion.potential(middle - g * half) + 8 * motion.potential(middle) +
                   5 * motion.potential(middle + g * half);
  return dot(sum, b - a) / 18;
}

}  // namespace

const std::vector<std::string>& motion_names() {
  static const std::vector<std::string> names{"vortex", "deformation", "rotation"};
  return names;
}

Motion motion(const std::string& name) {
  if (name == "vortex") return vortex();
  if (name == "deformation") return deformation();
  require(name == "rotation",
          "motion \"" + name + "\" unknown; there are: vortex, deformation, rotation");
  return rotation();
}

void set_flux(FaceField<Real>& phi, const Motion& motion, const Mesh& mesh) {
  for (Index f = 0; f < mesh.n_faces; ++f) {
    const auto points = mesh.face_points[f];
    if (mesh.dim == 2) {
      // Right-handed about Sf: the cell on the left of the edge.
      phi[f] =
          motion.potential(mesh.points[points[1]]).z - motion.potential(mesh.points[points[0]]).z;
      continue;
    }
    phi[f] = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      phi[f] += along(motion, mesh.points[points[i]], mesh.points[points[(i + 1) % points.size()]]);
  }
}

Real interface_dt(const CellField<Real>& alpha, const FaceField<Real>& phi, Real courant,
                  const Mesh& mesh) {
  constexpr Real part = 0.01;  // of a cell, from which on it counts as one of the interface
  Real rate = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (alpha[c] <= part || alpha[c] >= 1 - part) continue;
    rate = std::max(rate, courant_rate(phi, mesh, c));
  }
  rate = global_max(rate);
  return rate > 0 ? courant / rate : std::numeric_limits<Real>::max();
}

Real difference(const CellField<Real>& a, const CellField<Real>& b, const Mesh& mesh) {
  Sum sum;
  for (Index c = 0; c < mesh.n_owned; ++c) sum.add(std::abs(a[c] - b[c]) * mesh.V[c]);
  return sum.total();
}

}  // namespace fsi::vof
