#include "libfsi/solid/rings.hpp"

namespace fsi::solid {

void Rings::list(std::span<const Index> known, const Csr& around_halo) {
  for (const Index c : cells_) number_[c] = 0;
  before_.swap(cells_);
  cells_.assign(known.begin(), known.end());
  for (const Index c : cells_) number_[c] = 1;
  end_[0] = cells_.size();
  mesh_.halo.update(number_);
  for (int i = 1; i <= count; ++i) {
    list_ring(i, around_halo);
    mesh_.halo.update(number_);
  }
}

void Rings::list_ring(int i, const Csr& around_halo) {
  ++calls_;
  const auto add = [&](Index c) {
    if (c >= mesh_.n_owned || number_[c] > 0 || stamp_[c] == calls_) return;
    stamp_[c] = calls_;
    cells_.push_back(c);
  };
  const std::size_t begin = cells_.size();
  for (std::size_t j = i == 1 ? 0 : end_[i - 2]; j < begin; ++j)
    for (const Index n : mesh_.cell_neighbours[cells_[j]]) add(n);
  for (Index c = mesh_.n_owned; c < mesh_.n_cells; ++c)
    if (number_[c] > 0)
      for (const Index n : around_halo[c - mesh_.n_owned]) add(n);
  end_[i] = cells_.size();
  for (const Index c : ring(i)) number_[c] = 1 + i;
}

}  // namespace fsi::solid
