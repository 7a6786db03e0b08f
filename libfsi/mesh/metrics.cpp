#include "libfsi/mesh/metrics.hpp"

#include <array>

namespace fsi {
namespace {

Vec3 mean(std::span<const Vec3> points) {
  Vec3 sum;
  for (const Vec3& x : points) sum += x;
  return sum / static_cast<Real>(points.size());
}

CellMetrics polygon_metrics(std::span<const Vec3> corners) {
  // V = sum_i ((x_i - m) x (x_i+1 - m)).z / 2, centroid of each triangle (m, x_i, x_i+1) by area
  const Vec3 m = mean(corners);
  CellMetrics cell;
  Vec3 moment;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = corners[i] - m, b = corners[(i + 1) % corners.size()] - m;
    const Real area = cross(a, b).z / 2;
    cell.V += area;
    moment += area * (a + b);
  }
  cell.centre = m + moment / (3 * cell.V);
  return cell;
}

}  // namespace

FaceMetrics face_metrics(std::span<const Vec3> corners) {
  if (corners.size() == 2) {
    const Vec3 edge = corners[1] - corners[0];
    return {{edge.y, -edge.x, 0}, 0.5 * (corners[0] + corners[1])};
  }
  const Vec3 m = mean(corners);
  std::array<Vec3, max_face_corners> areas;
  Vec3 Sf;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    areas[i] = 0.5 * cross(corners[i] - m, corners[(i + 1) % corners.size()] - m);
    Sf += areas[i];
  }
  // Cf = sum_i w_i (m + x_i + x_i+1) / 3 / sum_i w_i with w_i the triangle's area along Sf
  Vec3 moment;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    moment += dot(areas[i], Sf) * (corners[i] - m + (corners[(i + 1) % corners.size()] - m));
  }
  return {Sf, m + moment / (3 * norm2(Sf))};
}

CellMetrics cell_metrics(CellType type, std::span<const Vec3> corners) {
  if (shape_of(type).dim == 2) return polygon_metrics(corners);
  const Vec3 m = mean(corners);
  CellMetrics cell;
  Vec3 moment;
  for (int f = 0; f < shape_of(type).faces; ++f) {
    std::array<Vec3, max_face_corners> x;
    std::size_t n = 0;
    for (const std::int8_t i : shape_of(type).face_corners(f)) {
      x[n++] = corners[static_cast<std::size_t>(i)] - m;
    }
    const Vec3 top = mean({x.data(), n});
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 &a = x[i], &b = x[(i + 1) % n];
      const Real volume = dot(top, cross(a, b)) / 6;
      cell.V += volume;
      moment += volume * (top + a + b);
    }
  }
  cell.centre = m + moment / (4 * cell.V);
  return cell;
}

}  // namespace fsi
