#include "libfsi/mesh/figures.hpp"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>

#include "libfsi/core/parallel.hpp"

namespace fsi {
namespace {

bool simplex(CellType type) { return type == CellType::tet || type == CellType::triangle; }

/// What helps against badly shaped cells, by the kind of the worst.
std::string better_cells(CellType type) {
  if (type == CellType::tet)
    return "let gmsh optimise the tets (Mesh.Optimize = 1; Mesh.OptimizeThreshold = 0.5; in a .geo "
           "file, or gmsh -optimize), or try the other algorithm (Mesh.Algorithm3D = 1 for "
           "Delaunay, 10 for HXT); what stays comes from the geometry: look there for surfaces "
           "that "
           "touch along a line, tiny faces and tiny edges";
  if (simplex(type))
    return "smooth the triangles (Mesh.Smoothing = 5;) or try the other algorithm (Mesh.Algorithm "
           "= 6 for Frontal-Delaunay)";
  return "even out the counts and progressions of the Transfinite Curves there, or divide the "
         "block where its sides are oblique";
}

std::string slower_growth(CellType type) {
  return simplex(type)
             ? "a sliver beside a sound cell goes with Mesh.Optimize = 1; otherwise let the "
               "size change more slowly (Threshold fields: a larger DistMax - DistMin)"
             : "use a progression nearer to 1 on the Transfinite Curves there";
}

std::string flatter_cells(CellType type) {
  return simplex(type) ? better_cells(type)
                       : "put more cells along the long edges there, or fewer across";
}

std::string place(const Worst& w) {
  return print(" in a %s at (%.4g, %.4g, %.4g)", name_of(w.type), w.x.x, w.x.y, w.x.z);
}

}  // namespace

std::string print(const char* format, ...) {
  std::array<char, 512> text{};
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  return text.data();
}

MeshFigures mesh_figures(const Mesh& mesh, const std::vector<std::string>& walls,
                         const std::vector<std::string>& mirrors) {
  return {quality(mesh), narrowest_gap(mesh, walls, mirrors), extent(mesh)};
}

Box extent(const Mesh& mesh) {
  constexpr Real far = std::numeric_limits<Real>::max();
  Box box{{far, far, far}, {-far, -far, -far}};
  for (const Vec3& point : mesh.points)
    for (int i = 0; i < 3; ++i) {
      box.low[i] = std::min(box.low[i], point[i]);
      box.high[i] = std::max(box.high[i], point[i]);
    }
  for (int i = 0; i < 3; ++i) {
    box.low[i] = global_min(box.low[i]);
    box.high[i] = global_max(box.high[i]);
  }
  return box;
}

Real width_across(const Mesh& mesh, int axis) {
  const Box box = extent(mesh);
  Real most = 0;
  for (int k = 0; k < mesh.dim; ++k)
    if (k != axis) most = std::max(most, box.high[k] - box.low[k]);
  return most;
}

PatchArea area_of(const Patch& patch, const Mesh& mesh) {
  std::array<Sum, 4> sums;
  for (Index f = patch.begin; f < patch.end; ++f) {
    for (int i = 0; i < 3; ++i) sums[static_cast<std::size_t>(i)].add(mesh.Sf[f][i]);
    sums[3].add(norm(mesh.Sf[f]));
  }
  std::array<Real, 4> total{};
  Sum::totals(total, sums);
  return {{total[0], total[1], total[2]}, total[3]};
}

std::string text_of(const Box& box) {
  return print("from (%.4g, %.4g, %.4g) to (%.4g, %.4g, %.4g)", box.low.x, box.low.y, box.low.z,
               box.high.x, box.high.y, box.high.z);
}

std::vector<Finding> findings(const MeshFigures& figures, const MeshLimits& limits) {
  const Quality& q = figures.quality;
  std::vector<Finding> found;
  const auto judge = [&](const char* name, const Worst& w, Real limit, const char* unit,
                         std::string (*change)(CellType)) {
    if (w.value <= limit) return;
    found.push_back(
        {print("%s %.3g%s (limit %g)", name, w.value, unit, limit) + place(w), change(w.type)});
  };
  judge("non-orthogonality", q.non_orthogonality, limits.non_orthogonality, " deg", better_cells);
  judge("skewness", q.skewness, limits.skewness, "", better_cells);
  judge("volume ratio of neighbours", q.volume_ratio, limits.volume_ratio, "", slower_growth);
  judge("aspect ratio", q.aspect_ratio, limits.aspect_ratio, "", flatter_cells);
  const Gap& gap = figures.gap;
  constexpr Real rounding = 1e-6;  // of the count, which is a sum over edges
  if (gap.cells > 0 && gap.cells < (1 - rounding) * limits.gap)
    found.push_back(
        {print("%.1f cells (at least %g wanted) across a passage of width %.4g from %s to %s at "
               "(%.4g, %.4g, %.4g)",
               gap.cells, limits.gap, gap.width, gap.from.c_str(), gap.to.c_str(), gap.x.x, gap.x.y,
               gap.x.z),
         print(
             "give gmsh a smaller size, %.2g or less, for all cells or for those there alone: a "
             "field of type Ball or Box with VIn = %.2g about that place as Background Field; "
             "these are in the unit of the mesh: divide them by the Mesh.ScalingFactor of the .geo "
             "file, if it has one",
             gap.width / 12, gap.width / 12)});
  return found;
}

std::string summary(const std::string& file, const Mesh& mesh, const MeshFigures& figures) {
  const Quality& q = figures.quality;
  std::string line =
      "mesh " + file +
      print(
          ": %lld cells in %d-D on %d %s, %s; non-orthogonality max %.1f mean %.1f deg, skewness "
          "max %.3f, volume ratio max %.1f, aspect ratio max %.1f",
          static_cast<long long>(mesh.n_global), mesh.dim, ranks(), ranks() == 1 ? "rank" : "ranks",
          text_of(figures.box).c_str(), q.non_orthogonality.value, q.non_orthogonality_mean,
          q.skewness.value, q.volume_ratio.value, q.aspect_ratio.value);
  if (figures.gap.cells > 0) line += print(", %.1f cells across", figures.gap.cells);
  return line;
}

Real curvature(const Patch& patch, const Mesh& mesh) {
  constexpr Real edge = 30;
  std::map<Index, std::vector<Vec3>> around;  // a point: the normals there
  Real most = 0;
  for (Index f = patch.begin; f < patch.end; ++f) {
    const Vec3 n = mesh.normal(f);
    for (const Index p : mesh.face_points[f]) {
      std::vector<Vec3>& there = around[mesh.vertex[p]];
      for (const Vec3& other : there) {
        const Real angle =
            std::atan2(norm(cross(n, other)), dot(n, other)) * 180 / std::numbers::pi;
        if (angle < edge) most = std::max(most, angle);
      }
      there.push_back(n);
    }
  }
  return global_max(most);
}

std::string warning(const std::string& file, const std::vector<Finding>& found) {
  if (found.empty()) return "";
  std::string text = "mesh " + file + ": ";
  for (const Finding& finding : found) text += finding.what + "; ";
  return text + "fsi-mesh check tells more";
}

}  // namespace fsi
