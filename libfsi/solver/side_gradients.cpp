#include "libfsi/solver/side_gradients.hpp"

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
    if (own)
      of_all_[c] = L[c], sides_[c] = -1;
    else if (sides_[c] >= 0)
      of_all_[c] = sides_[c] == 0 ? L[c] : of_all_[c] + L[c], sides_[c] += 1;
    L[c] = of_flow_[c];
  }
  body.mesh.halo.update(L);
}

void SideGradients::merge(CellField<Tensor>& L, const std::deque<Body>& bodies) {
  for (const Body& body : bodies) {
    if (!body.interface_gradient) continue;
    for (const Index c : body.strain_cells().cells()) {
      if (sides_[c] == 0) continue;
      L[c] = sides_[c] > 1 ? (1 / sides_[c]) * of_all_[c] : of_all_[c];
      sides_[c] = 0;
    }
  }
  bodies.front().mesh.halo.update(L);
}

}  // namespace fsi
