#include "libfsi/vof/interface.hpp"

#include <algorithm>

namespace fsi::vof {

void gather(geometry::Polygon& face, const Mesh& mesh, Index f, Index c) {
  face.n = mesh.face_points.offset[f + 1] - mesh.face_points.offset[f];
  for (int i = 0; i < face.n; ++i)
    face.x[static_cast<std::size_t>(i)] = mesh.corner(f, i, c) - mesh.C[c];
}

void gather(geometry::Cell& cell, const Mesh& mesh, Index c) {
  cell.n = 0;
  cell.dim = mesh.dim;
  geometry::Polygon face;
  for (const Index f : mesh.cell_faces[c]) {
    gather(face, mesh, f, c);
    const bool outward = mesh.owner[f] == c;
    if (!outward) std::reverse(face.x.begin(), face.x.begin() + face.n);
    geometry::add_face(cell, face, outward ? mesh.Sf[f] : -mesh.Sf[f]);
  }
}

}  // namespace fsi::vof
