#include "libfsi/vof/fill.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "libfsi/core/parallel.hpp"
#include "libfsi/geometry/simplex.hpp"

namespace fsi::vof {
namespace {

using shapes::Shape;

/// Signed distance to the shape and its periodic images: f(x) = min_t shape(x + t).
/// `near` holds the images that can matter in the cell at hand.
struct Images {
  const Shape& shape;
  std::vector<Vec3> all;
  std::vector<Vec3> near;
  bool overlap = false;  // whether a point lay in two images, not as deep in both
  bool touch = false;    // whether the surfaces of two images near a point are one
  Real rounding = 0;     // up to which it is as deep: an endless shape is its own image

  Images(const Mesh& mesh, const Shape& of) : shape(of) {
    // A translation that one face needs is needed with the other sign on the other side.
    for (const Vec3& t : mesh.translation) {
      for (const Vec3& image : {t, -t}) {
        if (std::ranges::find(all, image) == all.end()) all.push_back(image);
      }
    }
    near.reserve(all.size());
    for (const Vec3& t : all) rounding = std::max(rounding, 1e-9 * norm(t));
  }

  /// Distance at x. Keeps the images whose surface comes within `radius` of it in `near`.
  Real select(const Vec3& x, Real radius) {
    Real least = shapes::infinity;
    near.clear();
    for (const Vec3& t : all) {
      const Real distance = shape(x + t);
      if (std::abs(distance - least) > rounding) {
        if (distance < 0 && least < 0) overlap = true;
        const bool close = std::max(std::abs(distance), std::abs(least)) <= radius;
        if (close && distance + least <= rounding) touch = true;
      }
      least = std::min(least, distance);
      if (std::abs(distance) <= radius) near.push_back(t);
    }
    return least;
  }

  Real operator()(const Vec3& x) const {
    Real least = shapes::infinity;
    for (const Vec3& t : near) least = std::min(least, shape(x + t));
    return least;
  }
};

struct TriangleRule {
  static constexpr std::size_t corners = 3, middles = 3, children = 4;
  static constexpr auto& edges = geometry::triangle_edges;
  /// Children by node: corners 0-2, then the middle of edge e as 3 + e.
  static constexpr std::array<std::array<std::size_t, 3>, 4> child{
      {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}, {3, 5, 4}}};
};

struct TetrahedronRule {
  static constexpr std::size_t corners = 4, middles = 6, children = 8;
  static constexpr auto& edges = geometry::tetrahedron_edges;
  /// Corners 0-3, middles of (0,1) 4, (0,2) 5, (0,3) 6, (1,2) 7, (1,3) 8, (2,3) 9; four corner
  /// children, and the octahedron between them around its diagonal 5-8.
  static constexpr std::array<std::array<std::size_t, 4>, 8> child{{{0, 4, 5, 6},
                                                                    {4, 1, 7, 8},
                                                                    {5, 7, 2, 9},
                                                                    {6, 8, 9, 3},
                                                                    {5, 8, 4, 6},
                                                                    {5, 8, 6, 9},
                                                                    {5, 8, 9, 7},
                                                                    {5, 8, 7, 4}}};
};

/// A simplex with the distance at its corners and, where the surface may cut it, at its edge
/// middles.
template <class Rule>
struct Sampled {
  std::array<Vec3, Rule::corners> x{};
  std::array<Real, Rule::corners> corner{};
  std::array<Real, Rule::middles> middle{};
  bool cut = false;     ///< the surface may pass through
  bool grazed = false;  ///< and may do so between corners of one sign
  bool bent = false;  ///< it turns within: a sharp edge, or a radius of less than 2.5 longest edges
  Real solid = 0;     ///< area or volume inside the shape
};

/// The piece between these corners. As |f(x) - f_i| <= |x - x_i|, f(x) differs from the mean of f_i
/// by at most the mean of |x - x_i|, which is convex in x and so largest in a corner. Where the
/// mean of f_i is larger than that, the piece is whole or empty.
template <class Rule>
Sampled<Rule> piece(const Images& distance, const std::array<Vec3, Rule::corners>& x,
                    const std::array<Real, Rule::corners>& corner) {
  Sampled<Rule> p{x, corner};
  Real longest = 0, sum = 0;
  std::array<Real, Rule::corners> reach{};  // sums of the edges from each corner
  for (const auto& [i, j] : Rule::edges) {
    const Real edge = norm(x[i] - x[j]);
    longest = std::max(longest, edge);
    reach[i] += edge, reach[j] += edge;
  }
  for (const Real f : corner) sum += f;
  p.cut = std::abs(sum) <= *std::ranges::max_element(reach);
  if (!p.cut) {
    p.solid = sum < 0 ? geometry::measure(x) : 0;
    return p;
  }
  const auto [least, most] = std::ranges::minmax(corner);
  Real bulge = 0;
  for (std::size_t e = 0; e < Rule::middles; ++e) {
    const auto [i, j] = Rule::edges[e];
    p.middle[e] = distance((x[i] + x[j]) / 2);
    bulge = std::max(bulge, std::abs(p.middle[e] - (corner[i] + corner[j]) / 2));
  }
  p.bent = 20 * bulge > longest;  // a circle of radius r bulges by edge^2 / (8 r)
  p.grazed = (least >= 0 && least < bulge) || (most < 0 && -most < bulge);
  p.solid = geometry::negative_measure(x, corner, p.middle);
  return p;
}

/// The change by the last division: with its sign for smooth parts, where it scatters about zero,
/// and its size for bent parts, where it does not.
struct DivisionError {
  Real smooth = 0, bent = 0;
};

/// The piece divided at the middles of its edges.
template <class Rule>
std::array<Sampled<Rule>, Rule::children> children(const Images& distance,
                                                   const Sampled<Rule>& parent) {
  std::array<Vec3, Rule::corners + Rule::middles> x;
  std::array<Real, Rule::corners + Rule::middles> value;
  std::ranges::copy(parent.x, x.begin());
  std::ranges::copy(parent.corner, value.begin());
  std::ranges::copy(parent.middle, value.begin() + Rule::corners);
  for (std::size_t e = 0; e < Rule::middles; ++e) {
    x[Rule::corners + e] = (parent.x[Rule::edges[e][0]] + parent.x[Rule::edges[e][1]]) / 2;
  }
  std::array<Sampled<Rule>, Rule::children> child;
  for (std::size_t k = 0; k < Rule::children; ++k) {
    std::array<Vec3, Rule::corners> corners;
    std::array<Real, Rule::corners> values;
    for (std::size_t i = 0; i < Rule::corners; ++i) {
      corners[i] = x[Rule::child[k][i]], values[i] = value[Rule::child[k][i]];
    }
    child[k] = piece<Rule>(distance, corners, values);
  }
  return child;
}

/// Area or volume of the shape in the piece; `error` gains the change by the last division. A piece
/// that the surface may graze unseen is divided until it is smaller than the tolerance itself.
template <class Rule>
Real divided(const Images& distance, const Sampled<Rule>& parent, Real tolerance, int depth,
             const FillAccuracy& accuracy, DivisionError& error) {
  const auto child = children(distance, parent);
  Real sum = 0;
  bool unseen = false, bent = false;
  for (const Sampled<Rule>& c : child) {
    sum += c.solid;
    unseen |= c.grazed, bent |= c.bent;
  }
  const Real change = sum - parent.solid;
  const bool settled =
      std::abs(change) <= tolerance && !(unseen && geometry::measure(parent.x) > tolerance);
  if ((depth >= accuracy.min_depth && settled) || depth >= accuracy.max_depth) {
    if (bent) {
      error.bent += std::abs(change);
    } else {
      error.smooth += change;
    }
    return sum;
  }
  sum = 0;
  for (const Sampled<Rule>& c : child) {
    sum += c.cut ? divided(distance, c, tolerance, depth + 1, accuracy, error) : c.solid;
  }
  return sum;
}

/// Sums over the simplices of one cell.
struct Parts {
  Real solid = 0, whole = 0;
  DivisionError error;
};

template <class Rule>
void add(Parts& parts, const Images& distance, const std::array<Vec3, Rule::corners>& x,
         Real cell_volume, const FillAccuracy& accuracy) {
  std::array<Real, Rule::corners> corner;
  for (std::size_t i = 0; i < Rule::corners; ++i) corner[i] = distance(x[i]);
  const Sampled<Rule> whole = piece<Rule>(distance, x, corner);
  parts.whole += geometry::measure(x);
  parts.solid += whole.cut ? divided(distance, whole, accuracy.tolerance * cell_volume, 0, accuracy,
                                     parts.error)
                           : whole.solid;
}

/// Divides cell c: a triangle per edge in 2-D, a tetrahedron per triangular face, and one per edge
/// of any other face, about the face centre.
Parts parts_of(const Mesh& mesh, Index c, const Images& distance, const FillAccuracy& accuracy) {
  Parts parts;
  const Vec3 centre = mesh.C[c];
  const Real volume = mesh.V[c];
  for (const Index f : mesh.cell_faces[c]) {
    const auto n = static_cast<Index>(mesh.face_points[f].size());
    const auto at = [&](Index i) { return mesh.corner(f, i % n, c); };
    if (mesh.dim == 2) {
      add<TriangleRule>(parts, distance, {centre, at(0), at(1)}, volume, accuracy);
    } else if (n == 3) {
      add<TetrahedronRule>(parts, distance, {centre, at(0), at(1), at(2)}, volume, accuracy);
    } else {
      const Vec3 middle = mesh.face_centre(f, c);
      for (Index i = 0; i < n; ++i) {
        add<TetrahedronRule>(parts, distance, {centre, middle, at(i), at(i + 1)}, volume, accuracy);
      }
    }
  }
  return parts;
}

/// Largest slope of f between the centres of neighbours, where the surface passes between them or
/// as near to one of them as the other is.
Real steepest(const CellField<Real>& f, const Mesh& mesh) {
  Real most = 0;
  for (Index i = 0; i < mesh.n_internal; ++i) {
    const Real a = f[mesh.owner[i]], b = f[mesh.neighbour[i]], rise = std::abs(a - b);
    const Real apart = norm(mesh.d[i]);
    if ((a < 0) != (b < 0) || std::min(std::abs(a), std::abs(b)) <= apart)
      most = std::max(most, rise / apart);
  }
  return global_max(most);
}

/// Radius about C that holds the whole cell.
Real radius(const Mesh& mesh, Index c) {
  Real square = 0;
  for (const Index f : mesh.cell_faces[c]) {
    for (Index i = 0; i < static_cast<Index>(mesh.face_points[f].size()); ++i) {
      square = std::max(square, norm2(mesh.corner(f, i, c) - mesh.C[c]));
    }
  }
  return std::sqrt(square);
}

Real clearance(const Mesh& mesh, Images& distance, const std::vector<Patch>& mirrors) {
  Real least = shapes::infinity;
  const auto mirrored = [&](Index f) {
    return std::ranges::any_of(mirrors, [&](const Patch& p) { return f >= p.begin && f < p.end; });
  };
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
    if (mirrored(f)) continue;
    least = std::min(least, distance.select(mesh.Cf[f], 0));
    for (const Index p : mesh.face_points[f]) {
      least = std::min(least, distance.select(mesh.points[p], 0));
    }
  }
  return global_min(least);
}

}  // namespace

Filled fill(CellField<Real>& alpha, const Mesh& mesh, const Shape& shape,
            const std::vector<Patch>& mirrors, const FillAccuracy& accuracy) {
  Images distance(mesh, shape);
  CellField<Real> at_centres(mesh);
  std::array<Sum, 4> sums;  // volume; change: of smooth parts, its square, of bent parts
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Real reach = radius(mesh, c);
    const Real at_centre = distance.select(mesh.C[c], reach);
    at_centres[c] = at_centre;
    alpha[c] = at_centre < 0 ? 1 : 0;
    if (at_centre >= -reach && !distance.near.empty()) {
      const Parts parts = parts_of(mesh, c, distance, accuracy);
      alpha[c] = std::clamp(parts.solid / parts.whole, Real{0}, Real{1});
      sums[1].add(parts.error.smooth), sums[2].add(parts.error.smooth * parts.error.smooth);
      sums[3].add(parts.error.bent);
    }
    sums[0].add(alpha[c] * mesh.V[c]);
  }
  mesh.halo.update(alpha);
  mesh.halo.update(at_centres);
  std::array<Real, 4> totals{};
  Sum::totals(totals, sums);
  const Real error = std::abs(totals[1]) + std::sqrt(totals[2]) + totals[3];
  const auto at = [&](const Vec3& x) { return distance.select(x, 0); };
  const bool overlap = !all_of_ranks(!distance.overlap);
  const bool touch = !all_of_ranks(!distance.touch);
  return {.volume = totals[0],
          .estimated_error = error,
          .clearance = clearance(mesh, distance, mirrors),
          .steepest = steepest(at_centres, mesh),
          .cut_by = cutting_planes(at, mesh, mirrors),
          .overlaps_itself = overlap,
          .touches_itself = touch};
}

}  // namespace fsi::vof
