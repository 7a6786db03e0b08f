#include "libfsi/run/doctor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "libfsi/core/error.hpp"
#include "libfsi/core/options.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/flow/courant.hpp"
#include "libfsi/io/vtk_file.hpp"
#include "libfsi/mesh/convert.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/mesh/read.hpp"

namespace fsi {
namespace {

void say(const std::string& line) {
  if (rank() == 0) std::printf("%s\n", line.c_str());
}

std::string text_of(const Vec3& x) { return print("(%.5g, %.5g, %.5g)", x.x, x.y, x.z); }

void tell_of_cells(const Mesh& mesh) {
  std::string line = "cells";
  for (std::size_t i = 0; i < names_of_cells.size(); ++i) {
    GlobalIndex n = 0;
    for (Index c = 0; c < mesh.n_owned; ++c) n += mesh.type(c) == static_cast<CellType>(i) ? 1 : 0;
    n = global_sum(n);
    if (n > 0) line += print("  %s %lld", names_of_cells[i], static_cast<long long>(n));
  }
  say(line);
}

void tell_of_patches(const Mesh& mesh) {
  say(print("%-16s %10s %12s %12s  %-34s %-34s %s", "patch", "faces",
            mesh.dim == 2 ? "length" : "area", "diameter", "centre", "mean normal", "shape"));
  for (const Patch& patch : mesh.patches) {
    const PatchFigures p = patch_figures(mesh, patch);
    const std::string shape = p.flat ? "flat"
                              : p.normal == Vec3{}
                                  ? "closed round, or opposite sides"
                                  : print("not flat, to %.1f deg from its mean", p.degrees);
    say(print("%-16s %10lld %12.6g %12.6g  %-34s %-34s %s", patch.name.c_str(),
              static_cast<long long>(p.faces), p.area, p.diameter, text_of(p.centre).c_str(),
              p.normal == Vec3{} ? "none" : text_of(p.normal).c_str(), shape.c_str()));
  }
}

void tell_of_figures(const MeshFigures& figures) {
  const Quality& q = figures.quality;
  const MeshLimits limits;
  say(print("%-26s %9s %9s  %s", "figure", "worst", "limit", "where"));
  const auto row = [&](const char* name, const Worst& w, Real limit) {
    say(print("%-26s %9.4g %9.4g  %s in a %s", name, w.value, limit, text_of(w.x).c_str(),
              name_of(w.type)));
  };
  row("non-orthogonality [deg]", q.non_orthogonality, limits.non_orthogonality);
  say(print("  its mean %19.4g", q.non_orthogonality_mean));
  row("skewness", q.skewness, limits.skewness);
  row("volume ratio", q.volume_ratio, limits.volume_ratio);
  row("aspect ratio", q.aspect_ratio, limits.aspect_ratio);
  const Gap& gap = figures.gap;
  say(gap.cells > 0
          ? print("%-26s %9.4g %9.4g  %s, %.4g wide, from %s to %s", "cells across", gap.cells,
                  limits.gap, text_of(gap.x).c_str(), gap.width, gap.from.c_str(), gap.to.c_str())
          : "cells across: no walls face each other");
  say(print("volumes from %.4g to %.4g; cells close to %.1e", q.volume_min, q.volume_max,
            q.closure_max));
}

void tell_of_solver(const Mesh& mesh, const Treatment& t) {
  const Worst beta = worst(t.beta, mesh, 1).front(), theta = worst(t.theta, mesh, 1).front(),
              rate = worst(t.rate, mesh, 1).front();
  say("what the solver does about it");
  say(
      print("  %lld of %lld inner faces (%.1f %%) are irregular: they take a gradient besides the "
            "values of their two cells",
            static_cast<long long>(t.n_irregular), static_cast<long long>(t.n_internal),
            100 * static_cast<Real>(t.n_irregular) /
                static_cast<Real>(std::max<GlobalIndex>(1, t.n_internal))));
  say(print(
      "  convection is damped by an upwind share beta of %.3f in the mean, at most %.3f at %s",
      t.beta_mean, beta.value, text_of(beta.x).c_str()));
  say(print("  the viscous term is implicit by theta_f = %.3f in the mean, at most %.3f at %s",
            t.theta_mean, theta.value, text_of(theta.x).c_str()));
  say(
      print("  a flow of speed U along an axis may take steps of %.4g / U at a Courant number of "
            "0.5, which the cell at %s sets",
            0.5 / rate.value, text_of(rate.x).c_str()));
}

void tell_of_changes(const std::vector<Finding>& found) {
  if (found.empty()) return say("nothing is past its limit");
  say("past its limit");
  for (const Finding& finding : found)
    say("  " + finding.what + "\n    in gmsh: " + finding.change);
}

/// The figures of a cell over their limits, the largest of the four.
std::vector<Real> severity(const CellQuality& cells) {
  const MeshLimits limits;
  std::vector<Real> values(cells.skewness.size());
  for (std::size_t c = 0; c < values.size(); ++c)
    values[c] = std::max(
        {cells.non_orthogonality[c] / limits.non_orthogonality, cells.skewness[c] / limits.skewness,
         cells.volume_ratio[c] / limits.volume_ratio, cells.aspect_ratio[c] / limits.aspect_ratio});
  return values;
}

void tell_of_worst(const Mesh& mesh, const CellQuality& cells, const std::vector<Worst>& list) {
  constexpr std::size_t lines_max = 20;
  say(print("%-10s %-9s %8s %8s %8s %8s  %s", "worst cell", "kind", "deg", "skewness", "volumes",
            "aspect", "where"));
  for (std::size_t i = 0; i < std::min(list.size(), lines_max); ++i) {
    const Worst& w = list[i];
    const Real angle = value_at(cells.non_orthogonality, w.cell, mesh),
               skewness = value_at(cells.skewness, w.cell, mesh),
               ratio = value_at(cells.volume_ratio, w.cell, mesh),
               aspect = value_at(cells.aspect_ratio, w.cell, mesh);
    say(print("%-10lld %-9s %8.4g %8.4g %8.4g %8.4g  %s", static_cast<long long>(w.cell),
              name_of(w.type), angle, skewness, ratio, aspect, text_of(w.x).c_str()));
  }
}

void write_worst(const std::string& path, const Mesh& mesh, const CellQuality& cells,
                 const Treatment& t, const std::vector<Worst>& list) {
  std::vector<GlobalIndex> ids;
  for (const Worst& w : list) ids.push_back(w.cell);
  std::ranges::sort(ids);
  std::vector<Index> mine;
  for (Index c = 0; c < mesh.n_owned; ++c)
    if (std::ranges::binary_search(ids, mesh.global_id[c])) mine.push_back(c);
  const std::array<io::CellFigure, 6> figures{{{"non_orthogonality", cells.non_orthogonality},
                                               {"skewness", cells.skewness},
                                               {"volume_ratio", cells.volume_ratio},
                                               {"aspect_ratio", cells.aspect_ratio},
                                               {"beta", t.beta},
                                               {"theta", t.theta}}};
  io::write_cells(path, mesh, mine, figures);
  say(print("the %zu worst cells are in %s", list.size(), path.c_str()));
}

/// What the user asked for.
struct Wish {
  std::vector<std::string> periodic, walls, symmetry;
  int worst = 10;
  std::string worst_file;
};

Wish read_wish(Options& options) {
  Wish wish;
  wish.periodic =
      options.list("mesh_periodic", "pairs of patches joined by translation: a,b[,c,d ...]");
  wish.walls = options.list(
      "walls", "patches between which passages are measured; none: all but the planes of symmetry");
  wish.symmetry = options.list(
      "symmetry",
      "planes of symmetry, which mirror a passage; none: the patch of that name, if there is one");
  wish.worst = options.integer(
      "worst", wish.worst,
      {.help = "how many of the worst cells are listed (20 at most) and written", .min = 1});
  wish.worst_file =
      options.text("worst_file", "", "the worst cells for ParaView: NAME.hdf or NAME.vtkhdf");
  const std::string& file = wish.worst_file;
  require(file.empty() || file.ends_with(".hdf") || file.ends_with(".vtkhdf"),
          "option -worst_file: \"" + file + "\" must end in .hdf or .vtkhdf, by which ParaView " +
              "knows it");
  return wish;
}

std::vector<std::string> planes_of_symmetry(const Wish& wish, const Mesh& mesh) {
  if (!wish.symmetry.empty()) return wish.symmetry;
  const bool named =
      std::ranges::any_of(mesh.patches, [](const Patch& p) { return p.name == "symmetry"; });
  return named ? std::vector<std::string>{"symmetry"} : std::vector<std::string>{};
}

}  // namespace

Treatment treatment(const Mesh& mesh, const FaceWeights& weights) {
  const auto n = static_cast<std::size_t>(mesh.n_owned);
  Treatment t{std::vector<Real>(n, 0), std::vector<Real>(n, 0.5), std::vector<Real>(n, 0)};
  std::array<Sum, 2> sums;
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Real beta = weights.damping(f, mesh), theta = weights.implicit(f, mesh);
    for (const Index c : {mesh.owner[f], mesh.neighbour[f]}) {
      if (c >= mesh.n_owned) continue;
      t.beta[c] = std::max(t.beta[c], beta), t.theta[c] = std::max(t.theta[c], theta);
    }
    if (mesh.owner[f] >= mesh.n_owned) continue;
    ++t.n_internal;
    if (weights.place[f] >= 0) ++t.n_irregular;
    sums[0].add(beta), sums[1].add(theta);
  }
  std::vector<Real> swept(static_cast<std::size_t>(mesh.n_owned));
  for (Index c = 0; c < mesh.n_owned; ++c) {
    Vec3 sum;
    for (const Index f : mesh.cell_faces[c])
      for (int k = 0; k < 3; ++k) sum[k] += std::abs(mesh.Sf[f][k]);
    swept[c] = std::max({sum.x, sum.y, sum.z}) / 2;
  }
  t.rate = flow::Courant(mesh).of_neighbourhood(swept);
  t.n_internal = global_sum(t.n_internal), t.n_irregular = global_sum(t.n_irregular);
  std::array<Real, 2> totals{};
  Sum::totals(totals, sums);
  const auto faces = static_cast<Real>(std::max<GlobalIndex>(1, t.n_internal));
  t.beta_mean = totals[0] / faces, t.theta_mean = totals[1] / faces;
  return t;
}

PatchFigures patch_figures(const Mesh& mesh, const Patch& patch) {
  std::array<Sum, 7> sums;
  for (Index f = patch.begin; f < patch.end; ++f) {
    const Real area = norm(mesh.Sf[f]);
    sums[0].add(area);
    for (int k = 0; k < 3; ++k)
      sums[1 + k].add(mesh.Sf[f][k]), sums[4 + k].add(area * mesh.Cf[f][k]);
  }
  std::array<Real, 7> total{};
  Sum::totals(total, sums);
  PatchFigures p;
  p.faces = global_sum(static_cast<GlobalIndex>(patch.end - patch.begin));
  p.area = total[0];
  p.diameter = mesh.dim == 2 ? p.area : std::sqrt(4 * p.area / std::numbers::pi);
  const Vec3 S{total[1], total[2], total[3]}, middle = Vec3{total[4], total[5], total[6]} / p.area;
  constexpr Real negligible = 1e-6, rounding = 1e-12;
  for (int k = 0; k < 3; ++k)
    p.centre[k] = std::abs(middle[k]) < rounding * p.diameter ? 0 : middle[k];
  if (norm(S) > negligible * p.area) p.normal = S / norm(S);
  for (int k = 0; k < 3; ++k)
    if (std::abs(p.normal[k]) < rounding) p.normal[k] = 0;
  Real sine = 0, cosine = 1, away = 0;
  for (Index f = patch.begin; f < patch.end; ++f) {
    const Vec3 n = mesh.normal(f);
    cosine = std::min(cosine, dot(n, p.normal)), sine = std::max(sine, norm(cross(n, p.normal)));
    away = std::max(away, std::abs(dot(mesh.Cf[f] - middle, p.normal)));
  }
  sine = global_max(sine), cosine = global_min(cosine), away = global_max(away);
  const Real size = mesh.dim == 2 ? p.area : std::sqrt(p.area);
  p.degrees = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
  p.flat = p.normal != Vec3{} && cosine > 0 && sine < negligible && away < negligible * size;
  return p;
}

RunStatus check_mesh_file(const std::string& file) {
  Options options("fsi-mesh check " + file, "what a mesh is like and what to change in it");
  const Wish wish = read_wish(options);
  if (options.help()) return RunStatus::complete;
  options.check_unknown();
  const Mesh mesh = read_mesh({file, wish.periodic});
  const MeshFigures figures = mesh_figures(mesh, wish.walls, planes_of_symmetry(wish, mesh));
  const CellQuality cells = cell_quality(mesh);
  const FaceWeights weights(mesh);
  const Treatment treated = treatment(mesh, weights);
  say(summary(file, mesh, figures));
  tell_of_cells(mesh);
  tell_of_patches(mesh);
  tell_of_figures(figures);
  const auto list = worst(severity(cells), mesh, static_cast<std::size_t>(wish.worst));
  tell_of_worst(mesh, cells, list);
  tell_of_solver(mesh, treated);
  tell_of_changes(findings(figures));
  if (!wish.worst_file.empty()) write_worst(wish.worst_file, mesh, cells, treated, list);
  return RunStatus::complete;
}

RunStatus convert_mesh_file(const std::string& from, const std::string& to) {
  Options options("fsi-mesh convert in.msh out.h5", "a mesh that all ranks read side by side");
  const std::vector<std::string> periodic =
      options.list("mesh_periodic", "pairs of patches joined by translation: a,b[,c,d ...]");
  if (options.help()) return RunStatus::complete;
  options.check_unknown();
  const std::int64_t cells = convert_mesh(from, to, periodic);
  if (rank() == 0) std::printf("%s: %lld cells\n", to.c_str(), static_cast<long long>(cells));
  return RunStatus::complete;
}

}  // namespace fsi
