#include "libfsi/solid/flow_snapshot.hpp"

#include <algorithm>

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

/// The slope of T in a cell at a plane of symmetry, by least squares over its face neighbours and
/// its own image.
SymGradient slope_at_plane(const CellField<SymTensor>& T, const SymmetryFaces& symmetry,
                           const Mesh& mesh, Index c) {
  TensorFit fit;
  for (const Index f : mesh.cell_faces[c]) {
    const Index k = beyond(mesh, f, c);
    if (k >= 0) fit.add(T[k] - T[c], mesh.owner[f] == c ? mesh.d[f] : -mesh.d[f]);
    if (!symmetry.has(f, mesh)) continue;
    const Vec3 n = mesh.Sf[f] / norm(mesh.Sf[f]);
    fit.add(image(T[c], n) - T[c], (2 * dot(mesh.d[f], n)) * n);
  }
  return fit.slope(mesh.dim);
}

}  // namespace

void gradient(CellField<SymGradient>& grad, const CellField<SymTensor>& T,
              const GradientStencil& stencil, const Mesh& mesh, std::span<const Index> cells) {
  gradient_of(
      grad, [&](Index c) { return T[c]; }, stencil, mesh, cells);
}

void gradient(CellField<SymGradient>& grad, const CellField<Real>& alpha,
              const CellField<SymTensor>& T, const GradientStencil& stencil, const Mesh& mesh,
              std::span<const Index> cells) {
  gradient_of(
      grad, [&](Index c) { return alpha[c] * T[c]; }, stencil, mesh, cells);
}

void set_slopes_at_planes(CellField<SymGradient>& grad, const CellField<SymTensor>& T,
                          const SymmetryFaces& symmetry, const Mesh& mesh,
                          std::span<const Index> cells) {
  if (symmetry.is.empty()) return;
  for (const Index c : cells) {
    const auto at_plane = [&](Index f) { return symmetry.has(f, mesh); };
    if (mesh.simplex(c) && std::ranges::any_of(mesh.cell_faces[c], at_plane))
      grad[c] = slope_at_plane(T, symmetry, mesh, c);
  }
}

}  // namespace fsi::solid
