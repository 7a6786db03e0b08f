#include "libfsi/run/forewords.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/flow/planes_at.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/mesh/gap.hpp"

namespace fsi {
namespace {

/// Flow through a patch at one time.
struct Flow {
  Real mean = 0, top = 0;  // mean: into the mesh
};

Flow at(const FlowRate& flow, Real t, Real area, const Mesh& mesh) {
  const Real mean = flow.rate(t) / area;
  const Real middle = mesh.dim == 2 ? 1.5 : 2;  // of a parabola, over its mean
  return {mean, std::abs(flow.profile == InflowProfile::plug ? mean : middle * mean)};
}

Flow at(const FixedVelocity& fixed, const Patch& patch, Real t, Real area, const Mesh& mesh) {
  Sum through;
  Real top = 0;
  for (Index f = patch.begin; f < patch.end; ++f) {
    const Vec3 u = fixed.u(mesh.Cf[f], t);
    through.add(dot(u, mesh.Sf[f])), top = std::max(top, norm(u));
  }
  return {-through.total() / area, global_max(top)};
}

}  // namespace

PeakFlow peak_flow(const Conditions& conditions, const Mesh& mesh, Real end) {
  PeakFlow peak;
  std::vector<Patch> mirrors;
  for (const Patch& patch : mesh.patches) {
    const auto found = conditions.find(patch.name);
    if (found != conditions.end() && lets_slip(found->second)) mirrors.push_back(patch);
  }
  for (const Patch& patch : mesh.patches) {
    const auto found = conditions.find(patch.name);
    if (found == conditions.end()) continue;
    const auto* rate = std::get_if<FlowRate>(&found->second);
    const auto* fixed = std::get_if<FixedVelocity>(&found->second);
    if (rate == nullptr && fixed == nullptr) continue;
    const Real A = area_of(patch, mesh).size;
    const Real D = flow::whole_diameter(patch, mirrors, mesh);
    const int times = rate != nullptr ? 4000 : 100;
    for (int i = 0; i <= 2 * times; ++i) {
      // Even times alone may meet a pulse at one phase.
      const Real t = end * (i <= times ? static_cast<Real>(i) / times : golden(i));
      const Flow flow = rate != nullptr ? at(*rate, t, A, mesh) : at(*fixed, patch, t, A, mesh);
      if (std::abs(flow.mean) * D > peak.mean * peak.length)
        peak = {patch.name, t, flow.mean * A, std::abs(flow.mean), flow.top, D};
    }
  }
  return peak;
}

std::string text_of(const PeakFlow& peak, Real nu) {
  return print(
      "peak of the flow: patch %s at t = %.4g, flow rate %.4g%s, Re = %.4g of the mean velocity "
      "%.4g and the diameter %.4g; U = %.4g is the largest velocity there; for a parabola this "
      "takes the section to be a circle, in two dimensions a slit",
      peak.patch.c_str(), peak.t, peak.rate, peak.rate < 0 ? " (out of the mesh)" : "",
      peak.mean * peak.length / nu, peak.mean, peak.length, peak.top);
}

Real largest_force(const OfPlaceAndTime::Function& f, const Mesh& mesh, Real end) {
  if (!f) return 0;
  constexpr int times = 20;
  Real most = 0;
  for (int i = 0; i < times; ++i)
    for (Index c = 0; c < mesh.n_owned; ++c)
      most = std::max(most, norm(f(mesh.C[c], end * golden(i))));
  return global_max(most);
}

void require_period_along_x(const Mesh& mesh) {
  const std::vector<Vec3>& laps = mesh.translation;
  require(
      laps.size() > 1,
      "the mesh has no period, and fsi-pipe holds the mean velocity of a periodic pipe: join its "
      "ends by -mesh_periodic, or take fsi-vessel");
  constexpr Real aslant = 1e-3;  // the error of the flow is of the order of its square
  const auto along_x = [](const Vec3& lap) {
    return norm(lap) > 0 && norm(Vec3{0, lap.y, lap.z}) <= aslant * norm(lap);
  };
  const auto shown = [&](Real part) { return std::abs(part) < aslant ? 0 : part; };
  const Vec3 found = laps[1] / norm(laps[1]);
  require(
      std::ranges::any_of(laps, along_x),
      print("the period of the mesh is along (%.3g, %.3g, %.3g), and fsi-pipe needs one that is "
            "parallel to x: turn the mesh, or take fsi-vessel",
            shown(found.x), shown(found.y), shown(found.z)));
}

Real mean_edge(const shapes::Shape& shape, const Mesh& mesh) {
  std::array<Sum, 4> sums;  // of the edges and the count, within and everywhere
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Real h = edge(mesh, c);
    sums[2].add(h), sums[3].add(1);
    if (shape(mesh.C[c]) < 0) sums[0].add(h), sums[1].add(1);
  }
  std::array<Real, 4> total{};
  Sum::totals(total, sums);
  return total[1] > 0 ? total[0] / total[1] : total[2] / total[3];
}

// sin(lean) = |grad s . n| / |grad s| where s = 0 on the plane, s the distance to the surface
Real lean_at_planes(const shapes::Shape& shape, const std::vector<char>& faces, const Mesh& mesh) {
  constexpr Real step = 1e-3;  // of the width of a face, for central differences
  Real most = 0;
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
    if (faces[f - mesh.n_internal] == 0) continue;
    const Vec3 x = mesh.Cf[f], n = mesh.normal(f);
    const Real area = norm(mesh.Sf[f]), width = mesh.dim == 2 ? area : std::sqrt(area);
    if (std::abs(shape(x)) > width) continue;
    const auto slope = [&](const Vec3& at, const Vec3& e) {
      const Vec3 way = (step * width) * e;
      return (shape(at + way) - shape(at - way)) / (2 * step * width);
    };
    const auto gradient = [&](const Vec3& at) {
      const Real along_z = mesh.dim == 3 ? slope(at, {0, 0, 1}) : 0;
      return Vec3{slope(at, {1, 0, 0}), slope(at, {0, 1, 0}), along_z};
    };
    Vec3 g = gradient(x);
    const Vec3 along = g - dot(g, n) * n;
    if (norm2(along) > 0) g = gradient(x - (shape(x) / norm2(along)) * along);
    const Real across = std::abs(dot(g, n));
    if (across > 0) most = std::max(most, std::asin(std::min(Real{1}, across / norm(g))));
  }
  return global_max(most) * 180 / std::numbers::pi;
}

void tell_of_section(const std::string& name, const std::string& shape, int dim, Real through) {
  if (dim == 2 && shape == "disk")
    std::fprintf(stderr,
                 "fsi: notice: %s: in two dimensions a disk is cut to a rectangle; the shape "
                 "sphere is a disc there\n",
                 name.c_str());
  // With fewer no cell has solid on all sides.
  constexpr Real few = 3.5, too_few = 2.5;  // 4, rounded
  if (through < few)
    std::fprintf(stderr,
                 "fsi: warning: %s: %.2g cells through its thickness are %s; take 4 or more, 6 "
                 "are better (doc/howto/vessel.md)\n",
                 name.c_str(), through,
                 through < too_few ? "too few, its speed and strain are wrong" : "few");
}

void tell_of_viscosity(const std::string& name, Real ratio, Real through) {
  constexpr Real high = 50, few = 40;
  if (ratio < high || through >= few) return;
  std::fprintf(stderr,
               "fsi: notice: %s: with a viscosity ratio of %.3g and %.3g cells through it, its "
               "elastic energy may be several times too large, and its deformation by a half "
               "(doc/verification/README.md)\n",
               name.c_str(), ratio, through);
}

}  // namespace fsi
