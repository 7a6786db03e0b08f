#include "libfsi/solver/side_gradients.hpp"

#include <algorithm>
#include <cmath>

namespace fsi {

void SideGradients::begin(const CellField<Tensor>& L) {
  of_flow_.assign(L);
  sides_.fill(0);  // a step that failed may have left some
}

void SideGradients::keep(CellField<Tensor>& L, const Body& body) {
  if (!body.interface_gradient) return;
  for (const Index c : body.strain_cells().cells()) {
    const bool own = body.fraction_of_strain()[c] >= solid::alpha_known;
    if (!own && L[c] == of_flow_[c]) continue;
    const Real count = sides_[c];
    if (own)  // of several, where they overlap
      of_all_[c] = count < 0 ? of_all_[c] + L[c] : L[c], sides_[c] = std::min(count, 0.0) - 1;
    else if (count >= 0)
      of_all_[c] = count == 0 ? L[c] : of_all_[c] + L[c], sides_[c] += 1;
    L[c] = of_flow_[c];
  }
  body.mesh.halo.update(L);
}

void SideGradients::merge(CellField<Tensor>& L, const std::deque<Body>& bodies) {
  for (const Body& body : bodies) {
    if (!body.interface_gradient) continue;
    for (const Index c : body.strain_cells().cells()) {
      if (sides_[c] == 0) continue;
      const Real count = std::abs(sides_[c]);
      L[c] = count > 1 ? (1 / count) * of_all_[c] : of_all_[c];
      sides_[c] = 0;
    }
  }
  bodies.front().mesh.halo.update(L);
}

}  // namespace fsi
