#include "libfsi/field/inflow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/figures.hpp"

namespace fsi {
namespace {

/// A corner of a face. Points joined by a period have the same number.
struct Corner {
  Index number;
  Vec3 x;
};
using Face = std::vector<Corner>;
using Side = std::array<Index, 2>;

Face face_of(Index f, const Mesh& mesh) {
  Face face;
  for (const Index p : mesh.face_points[f]) face.push_back({mesh.vertex_id[p], mesh.points[p]});
  return face;
}

/// The corners of a patch's faces, of all ranks.
std::vector<Face> faces_of(const Patch& patch, const Mesh& mesh) {
  std::vector<Real> mine;
  for (Index f = patch.begin; f < patch.end; ++f) {
    mine.push_back(static_cast<Real>(mesh.face_points[f].size()));
    for (const auto& [number, x] : face_of(f, mesh))
      mine.insert(mine.end(), {static_cast<Real>(number), x.x, x.y, x.z});
  }
  const std::vector<Real> all = gathered(mine);
  std::vector<Face> faces;
  for (std::size_t at = 0; at < all.size();) {
    const auto corners = static_cast<std::size_t>(all[at++]);
    Face& face = faces.emplace_back();
    for (std::size_t i = 0; i < corners; ++i, at += 4)
      face.push_back({static_cast<Index>(all[at]), {all[at + 1], all[at + 2], all[at + 3]}});
  }
  return faces;
}

/// In 2-D the ends of a face, each twice.
std::vector<Side> sides_of(const Face& face) {
  if (face.size() == 2) return {{face[0].number, face[0].number}, {face[1].number, face[1].number}};
  std::vector<Side> sides;
  for (std::size_t i = 0; i < face.size(); ++i) {
    Side side{face[i].number, face[(i + 1) % face.size()].number};
    if (side[1] < side[0]) std::swap(side[0], side[1]);
    sides.push_back(side);
  }
  return sides;
}

/// A segment or a triangle between nodes, its size, and the part of it that counts.
struct Element {
  std::array<int, 3> nodes;
  std::array<Vec3, 3> x;  ///< of the nodes
  int n;
  Real size;
  Real part = 1;
};

/// Linear finite elements of Lap w = -1.
class Section {
 public:
  Section(const std::vector<Face>& faces, const std::set<Side>& free);

  /// w at the nodes by conjugate gradients. Returns false where no node is inside.
  bool solve();
  /// Integral of w over a face.
  Real integral(const Face& face) const {
    Real sum = 0;
    for (const Element& e : elements_of(face))
      for (int i = 0; i < e.n; ++i) sum += e.part * e.size / e.n * w_[e.nodes[i]];
    return sum;
  }

 private:
  std::vector<Element> elements_of(const Face& face) const;
  Element element(const Face& corners) const;
  void multiply(std::vector<Real>& out, const std::vector<Real>& in) const;

  std::map<Index, int> node_;  // by a corner's number
  std::vector<Element> elements_;
  std::vector<std::array<std::array<Real, 3>, 3>> stiffness_;  // [elements]
  std::vector<char> fixed_;
  std::vector<Real> w_;
};

Element Section::element(const Face& corners) const {
  Element e{{}, {}, static_cast<int>(corners.size()), 0};
  for (int i = 0; i < e.n; ++i) e.nodes[i] = node_.at(corners[i].number), e.x[i] = corners[i].x;
  const Vec3 a = e.x[1] - e.x[0];
  e.size = e.n == 2 ? norm(a) : norm(cross(a, e.x[2] - e.x[0])) / 2;
  return e;
}

// A quadrilateral is divided along both diagonals, each counting half, so that the profile does not
// depend on its first corner.
std::vector<Element> Section::elements_of(const Face& face) const {
  if (face.size() < 4) return {element(face)};
  std::vector<Element> parts;
  for (std::size_t i = 0; i < 4; ++i) {
    parts.push_back(element({face[i], face[(i + 1) % 4], face[(i + 2) % 4]}));
    parts.back().part = 0.5;
  }
  return parts;
}

Section::Section(const std::vector<Face>& faces, const std::set<Side>& free) {
  std::map<Side, int> count;
  for (const Face& face : faces) {
    for (const Corner& corner : face) node_.emplace(corner.number, static_cast<int>(node_.size()));
    for (const Side& side : sides_of(face)) ++count[side];
  }
  fixed_.assign(node_.size(), 0), w_.assign(node_.size(), 0);
  for (const auto& [side, times] : count)
    if (times == 1 && !free.contains(side))
      for (const Index number : side) fixed_[node_.at(number)] = 1;
  for (const Face& face : faces)
    for (const Element& e : elements_of(face)) {
      elements_.push_back(e);
      auto& K = stiffness_.emplace_back();
      for (int i = 0; i < e.n; ++i)
        for (int j = 0; j < e.n; ++j) {
          // int grad N_i . grad N_j: e_i . e_j / (4 A), e_i the side across from node i
          const auto across = [&](int k) { return e.x[(k + 2) % 3] - e.x[(k + 1) % 3]; };
          K[i][j] = e.n == 2 ? (i == j ? 1 : -1) / e.size
                             : e.part * dot(across(i), across(j)) / (4 * e.size);
        }
    }
}

void Section::multiply(std::vector<Real>& out, const std::vector<Real>& in) const {
  std::ranges::fill(out, 0.0);
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const Element& e = elements_[k];
    for (int i = 0; i < e.n; ++i)
      for (int j = 0; j < e.n; ++j) out[e.nodes[i]] += stiffness_[k][i][j] * in[e.nodes[j]];
  }
  for (std::size_t i = 0; i < out.size(); ++i)
    if (fixed_[i] != 0) out[i] = 0;
}

bool Section::solve() {
  // Without friction at any rim the flow is the same everywhere.
  if (std::ranges::all_of(fixed_, [](char fixed) { return fixed == 0; }))
    return std::ranges::fill(w_, 1.0), true;
  std::vector<Real> r(w_.size()), Kp(w_.size());
  for (const Element& e : elements_)
    for (int i = 0; i < e.n; ++i) r[e.nodes[i]] += e.part * e.size / e.n;
  for (std::size_t i = 0; i < r.size(); ++i)
    if (fixed_[i] != 0) r[i] = 0;
  const auto product = [](const std::vector<Real>& a, const std::vector<Real>& b) {
    Real sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  };
  std::vector<Real> p = r;
  Real now = product(r, r);
  const Real enough = 1e-24 * now;
  if (now == 0) return false;
  for (std::size_t i = 0; i < 10 * w_.size() && now > enough; ++i) {
    multiply(Kp, p);
    const Real step = now / product(p, Kp), before = now;
    for (std::size_t k = 0; k < w_.size(); ++k) w_[k] += step * p[k], r[k] -= step * Kp[k];
    now = product(r, r);
    for (std::size_t k = 0; k < w_.size(); ++k) p[k] = r[k] + now / before * p[k];
  }
  return true;
}

}  // namespace

std::vector<Vec3> inflow_shape(InflowProfile profile, const Patch& patch, const Mesh& mesh,
                               const std::vector<Patch>& free) {
  const auto [area, size] = area_of(patch, mesh);
  require(norm(area) > 0, "patch \"" + patch.name + "\" has no net area to flow through");
  // A plug may come in through a curved patch.
  const Real flat = profile == InflowProfile::parabola ? 0.9 : 0.5;
  require(norm(area) > flat * size,
          "the faces of patch \"" + patch.name +
              "\" look different ways, so its flow has no direction; give each opening a name of "
              "its own");
  const Vec3 n = area / norm(area);
  std::vector<Real> w(static_cast<std::size_t>(patch.end - patch.begin), 1);
  if (profile == InflowProfile::parabola) {
    std::set<Side> sides;
    for (const Patch& other : free)
      for (const Face& face : faces_of(other, mesh))
        for (const Side& side : sides_of(face)) sides.insert(side);
    Section section(faces_of(patch, mesh), sides);
    require(section.solve(), "patch \"" + patch.name +
                                 "\" is too coarse for a parabola: no corner of its faces lies " +
                                 "inside; refine the mesh or take a plug");
    for (Index f = patch.begin; f < patch.end; ++f)
      w[f - patch.begin] = section.integral(face_of(f, mesh)) / norm(mesh.Sf[f]);
  }
  Sum flow;
  for (Index f = patch.begin; f < patch.end; ++f) flow.add(w[f - patch.begin] * dot(n, mesh.Sf[f]));
  const Real total = flow.total();
  std::vector<Vec3> shape;
  for (const Real value : w) shape.push_back((-value / total) * n);
  return shape;
}

}  // namespace fsi
