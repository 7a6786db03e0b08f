#pragma once
// Images of cells beyond planes of symmetry, and of their values.

#include <array>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "libfsi/geometry/mirror.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi {

/// Image of a vector in a plane with unit normal n: R v, R = I - 2 n (x) n.
inline Vec3 image(const Vec3& v, const Vec3& n) { return geometry::Mirror{{}, n}.of_direction(v); }
/// Image of the gradient of a field of vectors: R g R.
inline Tensor image(const Tensor& g, const Vec3& n) {
  const Vec3 x = image(Vec3{g.xx, g.xy, g.xz}, n), y = image(Vec3{g.yx, g.yy, g.yz}, n),
             z = image(Vec3{g.zx, g.zy, g.zz}, n);  // rows of g R
  const Tensor gR{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z};
  return gR + outer(-2 * n, n.x * x + n.y * y + n.z * z);
}

/// Image of a tensor: R T R.
inline SymTensor image(const SymTensor& T, const Vec3& n) {
  const Vec3 t = dot(T, n), s = 2 * (dot(n, t) * n - t);  // R T R = T + s n + n s
  return {T.xx + 2 * s.x * n.x, T.xy + s.x * n.y + n.x * s.y, T.xz + s.x * n.z + n.x * s.z,
          T.yy + 2 * s.y * n.y, T.yz + s.y * n.z + n.y * s.z, T.zz + 2 * s.z * n.z};
}

/// Images in up to three planes of symmetry at right angles, one after the other; in none: the
/// value itself.
struct Reflection {
  std::array<Vec3, 3> normals{};  ///< unit normals of the planes
  int count = 0;                  ///< of the planes
};
/// Image of a vector or tensor.
template <class T>
T image(const T& value, const Reflection& reflection) {
  T of = value;
  for (int i = 0; i < reflection.count; ++i) of = image(of, reflection.normals[i]);
  return of;
}

/// The neighbour at internal face f; at the boundary the owner itself, whose image is there.
inline Index second_cell(const Mesh& mesh, Index f) {
  return f < mesh.n_internal ? mesh.neighbour[f] : mesh.owner[f];
}

/// From the centre of the cell at boundary face f to that of its image in the plane of the face.
inline Vec3 to_image(const Mesh& mesh, Index f) {
  const Vec3& S = mesh.Sf[f];
  return (2 * dot(mesh.d[f], S) / norm2(S)) * S;
}

/// Collective. The planes of the listed boundary faces through the vertices (Mesh::vertex) of owned
/// cells. faces: [n_boundary] 1 for these, else 0.
std::unordered_map<Index, std::vector<geometry::Mirror>> planes_through_vertices(
    const std::vector<char>& faces, const Mesh& mesh);
/// Whether planes through a vertex, each listed once, are at right angles to each other.
bool at_right_angles(const std::vector<geometry::Mirror>& planes);

/// The boundary faces on planes of symmetry beyond which the images of cells count as neighbours.
class SymmetryFaces {
 public:
  /// None.
  SymmetryFaces() = default;
  /// Collective. faces: [n_boundary] 1 for these, else 0. A cell whose corner lies on such a plane
  /// sees the images of itself and of its neighbours about that corner, as in the mesh that the
  /// images complete. Where two or three planes at right angles meet, it sees images of images too.
  SymmetryFaces(std::vector<char> faces, const Mesh& mesh);

  /// Whether f is one of them.
  bool has(Index f, const Mesh& mesh) const {
    return lists_ && f >= mesh.n_internal && lists_->is[f - mesh.n_internal] != 0;
  }
  /// Whether there are none on any rank.
  bool empty() const { return lists_ == nullptr; }

  /// Calls f(k, r, n) for the images k of owned cell c and of its vertex neighbours. r leads from
  /// the centre of c to that of the image, and image(q, n) is the value there.
  template <class Function>
  void for_images(Index c, Function&& f) const {
    if (!lists_) return;
    for (Index i = lists_->begin[c]; i < lists_->begin[c + 1]; ++i) {
      const Image& image = lists_->images[i];
      f(image.k, image.r, lists_->reflections[image.reflection]);
    }
  }

 private:
  struct Image {
    Index k, reflection;
    Vec3 r;
  };
  struct Lists {
    std::vector<char> is{};      // [n_boundary]
    std::vector<Index> begin{};  // [n_owned + 1] images of a cell
    std::vector<Image> images{};
    std::vector<Reflection> reflections{};
  };
  static void list_images_of(Lists& lists, Index c, const std::vector<geometry::Mirror>& planes,
                             const Mesh& mesh);

  std::shared_ptr<const Lists> lists_;  // null: there are none on any rank; copies share them
};

/// Calls f(k, r, n) for the vertex neighbours k of owned cell c, with a reflection n in no plane,
/// and for its images. image(q, n) is then the value that c sees: q itself of a neighbour.
template <class Function>
void for_neighbours_and_images(Index c, const SymmetryFaces& symmetry, const Mesh& mesh,
                               Function&& f) {
  for_vertex_neighbours(c, mesh, [&](Index k, const Vec3& r) { f(k, r, Reflection{}); });
  symmetry.for_images(c, f);
}

}  // namespace fsi
