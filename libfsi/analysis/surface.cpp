#include "libfsi/analysis/surface.hpp"

#include <algorithm>
#include <array>

#include "libfsi/analysis/motion.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/geometry/simplex.hpp"
#include "libfsi/operators/least_squares.hpp"

namespace fsi::analysis {
namespace {

constexpr Real level = 0.5;

/// Sums over the cells that touch a vertex, r = C - x: count, sum r, sum r r, sum alpha, sum r
/// alpha; extremes of alpha.
struct Stencil {
  Real count = 0;
  Vec3 r;
  SymTensor rr;
  Real alpha = 0;
  Vec3 r_alpha;
  Real least = 1, most = 0;

  void add(const Vec3& arm, Real value) {
    least = std::min(least, value), most = std::max(most, value);
    count += 1, r += arm, alpha += value, r_alpha += value * arm;
    rr += square(arm);
  }

  /// Weights w = 1 + lambda . r with sum w r = 0: exact for linear functions   [Holmes89]
  ///   lambda = -(sum r r)^-1 sum r,  value = sum w alpha / sum w,
  /// kept between the extremes. The plain mean where the cells lie on one side (walls) or on a
  /// line.
  Real value(int dim) const {
    const Vec3 lambda = solve(dim);
    const Real weight = count + dot(lambda, r);
    const Real linear =
        weight > count / 2 ? (alpha + dot(lambda, r_alpha)) / weight : alpha / count;
    return std::clamp(linear, least, most);
  }

 private:
  /// -(sum r r)^-1 sum r, zero where the matrix is close to singular.
  Vec3 solve(int dim) const {
    constexpr Real flat = 1e-6;  // of the determinant of a round cloud of cells
    if (!tells(rr, dim, flat)) return {};
    SymTensor m = rr;
    if (dim == 2) m.zz = trace(m) / 2;
    return (-1 / det(m)) * dot(adjugate(m), r);
  }
};

/// alpha at the corners of the cells that may hold a part of the surface.
class Corners {
 public:
  Corners(const CellField<Real>& alpha, const Mesh& mesh,
          const std::vector<geometry::Mirror>& mirrors)
      : mesh_(mesh), mirrors_(mirrors), slot_(mesh.points.size(), outside) {
    find_cells(alpha);
    for (const Index c : cells) {
      for (const Index p : mesh.cell_points[c]) {
        Index& slot = slot_[mesh.vertex[p]];
        if (slot < 0) slot = n_slots_++;
      }
    }
    gather(alpha);
  }

  /// Owned cells whose own or neighbours' alpha lie on both sides of the level.
  std::vector<Index> cells;

  Real operator[](Index point) const { return value_[slot_[mesh_.vertex[point]]]; }

 private:
  /// Marks the vertices of the cells inside. A cell outside is listed if it touches one of them. A
  /// cell inside is listed if it has a neighbour outside.
  void find_cells(const CellField<Real>& alpha) {
    const auto inside = [&](Index c) { return alpha[c] > level; };
    for (Index c = 0; c < mesh_.n_cells; ++c)
      if (inside(c))
        for (const Index p : mesh_.cell_points[c]) slot_[mesh_.vertex[p]] = touched;
    for (Index c = 0; c < mesh_.n_owned; ++c) {
      const bool listed = inside(c) ? !std::ranges::all_of(mesh_.cell_neighbours[c], inside)
                                    : std::ranges::any_of(mesh_.cell_points[c], [this](Index p) {
                                        return slot_[mesh_.vertex[p]] == touched;
                                      });
      if (listed) cells.push_back(c);
    }
  }

  /// All cells that touch a marked vertex, halo cells too, add themselves to it.
  void gather(const CellField<Real>& alpha) {
    std::vector<Stencil> stencil(n_slots_);
    for (Index c = 0; c < mesh_.n_cells; ++c) {
      for (const Index p : mesh_.cell_points[c]) {
        const Index slot = slot_[mesh_.vertex[p]];
        if (slot >= 0)
          add_images(stencil[slot], mesh_.points[p], mesh_.C[c] - mesh_.points[p], alpha[c], 0);
      }
    }
    value_.resize(n_slots_);
    std::ranges::transform(stencil, value_.begin(),
                           [this](const Stencil& s) { return s.value(mesh_.dim); });
  }

  /// The cell and its images in the planes of symmetry that the vertex lies in.
  void add_images(Stencil& stencil, const Vec3& x, const Vec3& arm, Real value,
                  std::size_t first) const {
    constexpr Real in_plane = 1e-3;
    for (std::size_t i = first; i < mirrors_.size(); ++i)
      if (std::abs(dot(x - mirrors_[i].x, mirrors_[i].n)) < in_plane * norm(arm)) {
        add_images(stencil, x, arm, value, i + 1);
        return add_images(stencil, x, mirrors_[i].of_direction(arm), value, i + 1);
      }
    stencil.add(arm, value);
  }

  const Mesh& mesh_;
  const std::vector<geometry::Mirror>& mirrors_;
  static constexpr Index outside = -1, touched = -2;  // below 0: no value is wanted
  std::vector<Index> slot_;                           // [vertices]
  Index n_slots_ = 0;
  std::vector<Real> value_;  // [slots]
};

/// Adds the facets of one simplex; phi is negative in the solid.
template <std::size_t n>
void add(Surface& surface, const std::array<Vec3, n>& x, const std::array<Real, n>& phi) {
  const geometry::Section cut = geometry::section(phi);
  if (cut.n == 0) return;
  std::array<Vec3, 4> at;
  for (std::size_t k = 0; k < static_cast<std::size_t>(cut.n); ++k) {
    at[k] = (1 - cut.at[k].s) * x[cut.at[k].from] + cut.at[k].s * x[cut.at[k].to];
  }
  const Vec3 outward = x[cut.at[0].to] - x[cut.at[0].from];
  if constexpr (n == 3) {
    const Vec3 t = at[1] - at[0];
    if (t.y * outward.x - t.x * outward.y < 0) std::swap(at[0], at[1]);
    surface.points.insert(surface.points.end(), {at[0], at[1]});
  } else {
    for (std::size_t k = 2; k < static_cast<std::size_t>(cut.n); ++k) {
      const bool turned = dot(cross(at[k - 1] - at[0], at[k] - at[0]), outward) < 0;
      surface.points.insert(surface.points.end(),
                            {at[0], at[turned ? k : k - 1], at[turned ? k - 1 : k]});
    }
  }
}

struct Corner {
  Vec3 x;
  Real phi;
};

Corner mean(const Corner* first, std::size_t n) {
  Corner m{};
  for (std::size_t i = 0; i < n; ++i) m.x += first[i].x, m.phi += first[i].phi;
  return {m.x / static_cast<Real>(n), m.phi / static_cast<Real>(n)};
}

/// Facets of one cell, moved by `shift`.
void add_cell(Surface& surface, const Corners& corners, const Mesh& mesh, Index c,
              const Vec3& shift) {
  constexpr std::size_t most = 8;
  std::array<Corner, most> all{};
  std::size_t n_cell = 0;
  bool inside = false, outside = false;
  for (const Index p : mesh.cell_points[c]) {
    all[n_cell] = {mesh.points[p] + shift, level - corners[p]};
    (all[n_cell++].phi < 0 ? inside : outside) = true;
  }
  if (!(inside && outside)) return;
  const Corner centre = mean(all.data(), n_cell);
  for (const Index f : mesh.cell_faces[c]) {
    const auto points = mesh.face_points[f];
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i) {
      all[i] = {mesh.corner(f, static_cast<Index>(i), c) + shift, level - corners[points[i]]};
    }
    if (mesh.dim == 2) {
      add<3>(surface, {centre.x, all[0].x, all[1].x}, {centre.phi, all[0].phi, all[1].phi});
    } else if (n == 3) {
      add<4>(surface, {centre.x, all[0].x, all[1].x, all[2].x},
             {centre.phi, all[0].phi, all[1].phi, all[2].phi});
    } else {
      const Corner face = mean(all.data(), n);
      for (std::size_t i = 0; i < n; ++i) {
        const Corner& a = all[i];
        const Corner& b = all[(i + 1) % n];
        add<4>(surface, {centre.x, face.x, a.x, b.x}, {centre.phi, face.phi, a.phi, b.phi});
      }
    }
  }
}

}  // namespace

Surface isosurface(const CellField<Real>& alpha, const Mesh& mesh, const Vec3& about,
                   const std::vector<geometry::Mirror>& mirrors) {
  Surface surface{mesh.dim, {}};
  const Corners corners(alpha, mesh, mirrors);
  for (const Index c : corners.cells) {
    const Vec3 shift = mesh.translation[nearest_image(mesh, mesh.C[c], about)];
    add_cell(surface, corners, mesh, c, shift);
  }
  return surface;
}

Surface with_images(Surface surface, const std::vector<geometry::Mirror>& mirrors) {
  for (const geometry::Mirror& mirror : mirrors) {
    const Index n = surface.size();
    for (Index k = 0; k < n; ++k) {
      // the other way round, so that the normal of the image points outward too
      std::array<Vec3, 3> corners{};
      std::copy_n(surface.facet(k), surface.dim, corners.begin());
      for (int i = surface.dim; i-- > 0;) surface.points.push_back(mirror.of_point(corners[i]));
    }
  }
  return surface;
}

Real area(const Surface& surface) {
  Sum sum;
  for (Index k = 0; k < surface.size(); ++k) sum.add(surface.measure(k));
  return sum.total();
}

Real enclosed(const Surface& surface) {
  Sum sum;
  for (Index k = 0; k < surface.size(); ++k) {
    const Vec3* x = surface.facet(k);
    sum.add(surface.dim == 2 ? (x[0].x * x[1].y - x[0].y * x[1].x) / 2
                             : dot(x[0], cross(x[1], x[2])) / 6);
  }
  return sum.total();
}

}  // namespace fsi::analysis
