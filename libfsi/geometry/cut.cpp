#include "libfsi/geometry/cut.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/core/error.hpp"

namespace fsi::geometry {
namespace {

/// Twice the area vector of a polygon, about its first corner.
Vec3 double_area(const Polygon& p) {
  Vec3 sum;
  for (int i = 2; i < p.n; ++i) sum += cross(p.x[i - 1] - p.x[0], p.x[i] - p.x[0]);
  return sum;
}

/// The part of a face below the plane (Sutherland and Hodgman), and the two points where the plane
/// crosses its rim, in the order leaving, entering; `crossings` counts them.
struct Clipped {
  Polygon part;
  std::array<Vec3, 2> crossing;
  int crossings = 0;
};

void clip(Clipped& out, const Polygon& face, const Vec3& n, Real s) {
  out.part.n = 0;
  out.crossings = 0;
  const int last = face.n == 2 ? 1 : face.n;  // an edge is not closed
  Real here = dot(n, face.x[0]) - s;
  for (int i = 0; i < last; ++i) {
    const Vec3 &a = face.x[i], &b = face.x[i + 1 == face.n ? 0 : i + 1];
    const Real there = dot(n, b) - s;
    if (here <= 0) out.part.x[out.part.n++] = a;
    if ((here <= 0) != (there <= 0)) {
      const Vec3 x = a + (here / (here - there)) * (b - a);
      out.part.x[out.part.n++] = x;
      // A face that is not convex can be crossed more often; the first two are kept.
      if (out.crossings < 2) out.crossing[out.crossings++] = x;
    }
    here = there;
  }
  if (face.n == 2 && here <= 0) out.part.x[out.part.n++] = face.x[1];
}

Real length_ratio(const Polygon& part, const Polygon& edge) {
  return part.n < 2 ? 0 : norm(part.x[1] - part.x[0]) / norm(edge.x[1] - edge.x[0]);
}

/// Extremes of n . x over the corners.
std::array<Real, 2> extent(const Cell& cell, const Vec3& n) {
  std::array<Real, 2> e{1e300, -1e300};
  for (int f = 0; f < cell.n; ++f)
    for (int i = 0; i < cell.face[f].n; ++i) {
      const Real s = dot(n, cell.face[f].x[i]);
      e = {std::min(e[0], s), std::max(e[1], s)};
    }
  return e;
}

/// Sorted values of n . x at the corners, equal ones once.
int sorted_corners(std::array<Real, Cell::capacity * Polygon::capacity>& value, const Cell& cell,
                   const Vec3& n, Real tolerance) {
  int count = 0;
  for (int f = 0; f < cell.n; ++f)
    for (int i = 0; i < cell.face[f].n; ++i) value[count++] = dot(n, cell.face[f].x[i]);
  std::sort(value.begin(), value.begin() + count);
  int kept = 1;
  for (int i = 1; i < count; ++i)
    if (value[i] - value[kept - 1] > tolerance) value[kept++] = value[i];
  return kept;
}

/// Centroid and area of the plane's polygon from the segments in which it crosses the faces.
void set_polygon(Cut& cut, const Cell& cell, const Vec3& n) {
  std::array<std::array<Vec3, 2>, Cell::capacity> segment;
  int count = 0;
  Clipped clipped;
  Vec3 mean;
  for (int f = 0; f < cell.n; ++f) {
    clip(clipped, cell.face[f], n, cut.s);
    if (cell.dim == 2 && clipped.crossings == 1)
      segment[count++] = {clipped.crossing[0], clipped.crossing[0]};
    if (cell.dim == 3 && clipped.crossings == 2) segment[count++] = clipped.crossing;
  }
  if (count == 0) return;
  for (int i = 0; i < count; ++i) mean += 0.5 * (segment[i][0] + segment[i][1]);
  mean *= 1.0 / count;
  cut.centre = mean;
  if (cell.dim == 2) {
    cut.area = count == 2 ? norm(segment[1][0] - segment[0][0]) : 0;
    return;
  }
  Vec3 moment;
  Real area = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 a = segment[i][0] - mean, b = segment[i][1] - mean;
    const Real t = std::abs(dot(cross(a, b), n)) / 2;
    area += t;
    moment += (t / 3) * (a + b);
  }
  cut.area = area;
  if (area > 0) cut.centre = mean + moment / area;
}

}  // namespace

void add_face(Cell& cell, const Polygon& face, const Vec3& outward) {
  const auto push = [&](const Polygon& p) {
    FSI_ASSERT(cell.n < Cell::capacity);
    cell.face[cell.n] = p;
    cell.area[cell.n++] = outward;
  };
  if (cell.dim == 2 || face.n == 3) return push(face);
  Vec3 mean;
  for (int i = 0; i < face.n; ++i) mean += face.x[i];
  mean *= 1.0 / face.n;
  const Vec3 n = outward / norm(outward);
  Real off = 0;
  for (int i = 0; i < face.n; ++i) off = std::max(off, std::abs(dot(face.x[i] - mean, n)));
  if (off * off < 1e-24 * norm(outward)) return push(face);
  for (int i = 0; i < face.n; ++i) {
    Polygon triangle;
    triangle.n = 3;
    triangle.x[0] = face.x[i], triangle.x[1] = face.x[(i + 1) % face.n], triangle.x[2] = mean;
    push(triangle);
  }
}

Real volume_below(const Cell& cell, const Vec3& n, Real s) {
  // V = (1/dim) sum_f (x_f - x_0) . A_f over the clipped faces, x_0 on the plane
  const Vec3 x_0 = s * n;
  Clipped clipped;
  Real sum = 0;
  for (int f = 0; f < cell.n; ++f) {
    clip(clipped, cell.face[f], n, s);
    const Polygon& part = clipped.part;
    if (part.n < 2) continue;
    const Vec3 area =
        cell.dim == 2 ? length_ratio(part, cell.face[f]) * cell.area[f] : 0.5 * double_area(part);
    sum += dot(part.x[0] - x_0, area);
  }
  return sum / cell.dim;
}

Cut cut_at_fraction(const Cell& cell, const Vec3& n, Real alpha) {
  const auto [low_s, high_s] = extent(cell, n);
  const Real V = volume_below(cell, n, high_s + (high_s - low_s)), target = alpha * V;
  std::array<Real, Cell::capacity * Polygon::capacity> corner{};
  const int count = sorted_corners(corner, cell, n, 1e-13 * (high_s - low_s));
  int a = 0, b = count - 1;
  Real V_a = 0, V_b = V;
  while (b - a > 1) {
    const int middle = (a + b) / 2;
    const Real v = volume_below(cell, n, corner[middle]);
    (v <= target ? a : b) = middle;
    (v <= target ? V_a : V_b) = v;
  }
  // Between two corners V(s) is a cubic (2-D: a parabola): Newton's divided differences through
  // four points give it exactly; then a bracketed root.
  const Real h = corner[b] - corner[a];
  const Real v1 = volume_below(cell, n, corner[a] + h / 3) - V_a;
  const Real v2 = volume_below(cell, n, corner[a] + 2 * h / 3) - V_a;
  const Real v3 = V_b - V_a, t = target - V_a;
  const Real c1 = 9 * v1 - 4.5 * v2 + v3, c2 = -22.5 * v1 + 18 * v2 - 4.5 * v3,
             c3 = 13.5 * v1 - 13.5 * v2 + 4.5 * v3;
  Real low = 0, high = 1, x = v3 > 0 ? std::clamp(t / v3, 0.0, 1.0) : 0.5;
  for (int i = 0; i < 60; ++i) {
    const Real value = x * (c1 + x * (c2 + x * c3)) - t;
    (value > 0 ? high : low) = x;
    const Real slope = c1 + x * (2 * c2 + 3 * c3 * x);
    Real next = slope > 0 ? x - value / slope : -1;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) < 1e-15) break;
    x = next;
  }
  Cut cut;
  cut.s = corner[a] + x * h;
  set_polygon(cut, cell, n);
  if (cut.area == 0) cut.centre = cut.s * n;
  return cut;
}

Real part_below(const Polygon& face, const Vec3& n, Real s) {
  Clipped clipped;
  clip(clipped, face, n, s);
  if (face.n == 2) return length_ratio(clipped.part, face);
  const Vec3 whole = double_area(face);
  return clipped.part.n < 3 ? 0 : dot(double_area(clipped.part), whole) / norm2(whole);
}

Real mean_part_below(const Polygon& face, const Vec3& n, Real s, Real speed, Real dt) {
  std::array<Real, Polygon::capacity + 2> at;
  Real low = 1e300, high = -1e300;
  for (int i = 0; i < face.n; ++i) {
    at[i] = dot(n, face.x[i]);
    low = std::min(low, at[i]), high = std::max(high, at[i]);
  }
  const Real s_end = s + speed * dt, from = std::min(s, s_end), to = std::max(s, s_end);
  if (from >= high) return 1;
  if (to <= low) return 0;
  if (to - from <= 1e-12 * (high - low) || high == low)
    return part_below(face, n, 0.5 * (s + s_end));
  int count = 0;
  std::array<Real, Polygon::capacity + 2> knot;
  knot[count++] = from;
  std::sort(at.begin(), at.begin() + face.n);
  for (int i = 0; i < face.n; ++i)
    if (at[i] > from && at[i] < to) knot[count++] = at[i];
  knot[count++] = to;
  Real sum = 0, left = part_below(face, n, from);
  for (int i = 1; i < count; ++i) {
    const Real middle = part_below(face, n, 0.5 * (knot[i - 1] + knot[i]));
    const Real right = part_below(face, n, knot[i]);
    sum += (knot[i] - knot[i - 1]) / 6 * (left + 4 * middle + right);
    left = right;
  }
  return sum / (to - from);
}

}  // namespace fsi::geometry
