#include "libfsi/solid/flow_snapshot.hpp"

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

}  // namespace fsi::solid
