#include "libfsi/vof/stencil.hpp"

#include "libfsi/core/eigen.hpp"

namespace fsi::vof {
namespace {

/// visit(d, neighbour) over the vertex neighbours of c, d from c to the neighbour as c sees it.
template <class Visit>
void each_neighbour(const Mesh& mesh, Index c, const Visit& visit) {
  for (Index k = mesh.cell_neighbours.offset[c]; k < mesh.cell_neighbours.offset[c + 1]; ++k) {
    const Index n = mesh.cell_neighbours.index[k];
    visit(mesh.C[n] - mesh.C[c] + mesh.translation[mesh.cell_neighbour_shift[k]], n);
  }
}

SymTensor square(const Vec3& d) {
  return {d.x * d.x, d.x * d.y, d.x * d.z, d.y * d.y, d.y * d.z, d.z * d.z};
}

SymTensor adjugate(const SymTensor& t) {
  return {t.yy * t.zz - t.yz * t.yz, t.xz * t.yz - t.xy * t.zz, t.xy * t.yz - t.xz * t.yy,
          t.xx * t.zz - t.xz * t.xz, t.xz * t.xy - t.xx * t.yz, t.xx * t.yy - t.xy * t.xy};
}

/// Directions with less than this part of the largest spread count as without spread.
constexpr Real flat = 1e-6;

SymTensor pseudo_inverse(const SymTensor& t) {
  const Eigen e = eigen(t);
  SymTensor sum;
  for (int i = 0; i < 3; ++i) {
    if (e.value[i] > flat * e.value[2]) sum += (1 / e.value[i]) * square(e.vector[i]);
  }
  return sum;
}

}  // namespace

SymTensor least_squares(const Mesh& mesh, Index c) {
  SymTensor M;
  each_neighbour(mesh, c, [&](const Vec3& d, Index) { M += (1 / norm2(d)) * square(d); });
  if (mesh.dim == 2) M.zz = 0.5 * trace(M);  // any value: nothing spreads along z
  const Real D = det(M), third = trace(M) / 3;
  return D > flat * third * third * third ? (1 / D) * adjugate(M) : pseudo_inverse(M);
}

Vec3 gradient_at(const CellField<Real>& q, const SymTensor& fit, const Mesh& mesh, Index c) {
  Vec3 sum;
  each_neighbour(mesh, c, [&](const Vec3& d, Index n) { sum += ((q[n] - q[c]) / norm2(d)) * d; });
  return dot(fit, sum);
}

Tensor gradient_at(const CellField<Vec3>& u, const SymTensor& fit, const Mesh& mesh, Index c) {
  Tensor sum;  // row i: of u_i
  each_neighbour(mesh, c, [&](const Vec3& d, Index n) { sum += outer(u[n] - u[c], d / norm2(d)); });
  const auto row = [&](Real x, Real y, Real z) { return dot(fit, Vec3{x, y, z}); };
  const Vec3 a = row(sum.xx, sum.xy, sum.xz), b = row(sum.yx, sum.yy, sum.yz),
             g = row(sum.zx, sum.zy, sum.zz);
  return {a.x, a.y, a.z, b.x, b.y, b.z, g.x, g.y, g.z};
}

}  // namespace fsi::vof
