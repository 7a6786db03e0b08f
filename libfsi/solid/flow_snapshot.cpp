#include "libfsi/solid/flow_snapshot.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/operators/stencil.hpp"

namespace fsi::solid {
namespace {

/// grad_c = sum_f (T_n - T_c) (x) g_f over the inner faces of the cell.
template <class Value>
void gradient_of(CellField<SymGradient>& grad, const Value& value, const GradientStencil& stencil,
                 const Mesh& mesh, std::span<const Index> cells) {
  for (const Index c : cells) {
    SymGradient sum;
    const SymTensor own = value(c);
    for (const Index f : mesh.cell_faces[c]) {
      const Index n = beyond(mesh, f, c);
      if (n >= 0) sum += outer(value(n) - own, stencil.weight(f, mesh.owner[f] == c));
    }
    grad[c] = sum;
  }
}

/// M^-1 . R on the side of the derivatives.
SymGradient solved(const Tensor& M, const SymGradient& R) {
  const Tensor K = inverse(M);
  return {along(R, {K.xx, K.xy, K.xz}), along(R, {K.yx, K.yy, K.yz}), along(R, {K.zx, K.zy, K.zz})};
}

/// Sets grad anew in cells at planes of symmetry: the quasi-Green gradient (GradientStencil) with
/// the image beyond the plane as a neighbour, and without it on the stencil's other planes. The
/// stencil itself takes the values there as the cell's own, as is right for a pressure. A cell with
/// too few neighbours keeps its grad.
template <class Value>
void set_gradient_at_planes(CellField<SymGradient>& grad, const Value& value,
                            const GradientStencil& stencil, const SymmetryFaces& symmetry,
                            const Mesh& mesh, std::span<const Index> cells) {
  constexpr Real no_inverse = 0.05;  // of the determinant of M, 1 on a good cell
  const std::vector<Real>& lambda = stencil.weights.lambda;
  const auto on_plane = [&](Index f) {
    return f >= mesh.n_internal &&
           (stencil.mirror[f - mesh.n_internal] != 0 || symmetry.has(f, mesh));
  };
  for (const Index c : cells) {
    if (std::ranges::none_of(mesh.cell_faces[c], on_plane)) continue;
    Tensor M;
    SymGradient R;
    const auto add = [&](const SymTensor& rise, const Vec3& g0, const Vec3& d) {
      M += outer(g0, d);
      R += outer(rise, g0);
    };
    for (const Index f : mesh.cell_faces[c]) {
      const Index k = beyond(mesh, f, c);
      const bool owner = mesh.owner[f] == c;
      const Vec3 S = (outward(mesh, f, c) / mesh.V[c]) * mesh.Sf[f];
      if (k >= 0) {
        const Real part = owner ? lambda[f] : 1 - lambda[f];
        add(value(k) - value(c), part * S, owner ? mesh.d[f] : -mesh.d[f]);
      } else if (symmetry.has(f, mesh)) {
        add(image(value(c), S / norm(S)) - value(c), 0.5 * S, to_image(mesh, f));
      }
    }
    if (mesh.dim == 2) M.zz = 1;
    if (std::abs(det(M)) >= no_inverse) grad[c] = solved(M, R);
  }
}

}  // namespace

void gradient(CellField<SymGradient>& grad, const CellField<SymTensor>& T,
              const GradientStencil& stencil, const SymmetryFaces& symmetry, const Mesh& mesh,
              std::span<const Index> cells) {
  const auto value = [&](Index c) { return T[c]; };
  gradient_of(grad, value, stencil, mesh, cells);
  set_gradient_at_planes(grad, value, stencil, symmetry, mesh, cells);
}

void gradient(CellField<SymGradient>& grad, const CellField<Real>& alpha,
              const CellField<SymTensor>& T, const GradientStencil& stencil,
              const SymmetryFaces& symmetry, const Mesh& mesh, std::span<const Index> cells) {
  const auto value = [&](Index c) { return alpha[c] * T[c]; };
  gradient_of(grad, value, stencil, mesh, cells);
  set_gradient_at_planes(grad, value, stencil, symmetry, mesh, cells);
}

}  // namespace fsi::solid
