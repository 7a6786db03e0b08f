#include "libfsi/operators/pieces.hpp"

#include <algorithm>
#include <map>

#include "libfsi/core/parallel.hpp"

namespace fsi {
namespace {

bool inside(Real alpha) { return alpha > 0.5; }

}  // namespace

Pieces::Pieces(const Mesh& mesh)
    : mesh_(mesh), parent_(static_cast<std::size_t>(mesh.n_cells)), number_(mesh) {}

Index Pieces::root(Index c) {
  while (parent_[c] != c) c = parent_[c] = parent_[parent_[c]];
  return c;
}

void Pieces::find(const CellField<Real>& alpha) {
  cells_.clear();
  for (Index c = 0; c < mesh_.n_cells; ++c)
    if (inside(alpha[c])) {
      cells_.push_back(c);
      parent_[c] = c, number_[c] = static_cast<Real>(mesh_.global_id[c]);
    }
  for (const Index c : cells_) {
    if (c >= mesh_.n_owned) break;
    for (const Index n : mesh_.cell_neighbours[c])
      if (inside(alpha[n])) parent_[root(c)] = root(n);
  }
  spread();
  Real least = static_cast<Real>(mesh_.n_global), most = -1;
  for (const Index c : cells_)
    least = std::min(least, number_[c]), most = std::max(most, number_[c]);
  several_ = global_min(least) < global_max(most);
}

// Gives every cell inside the least global number of its piece. Each rank first has that of its own
// part. Smaller numbers of neighbours then pass from rank to rank until no number changes.
void Pieces::spread() {
  bool falls = true;
  while (falls) {
    falls = false;
    for (const Index c : cells_) {
      Real& of_set = number_[root(c)];
      of_set = std::min(of_set, number_[c]);
    }
    for (const Index c : cells_) {
      const Real least = number_[root(c)];
      falls = falls || least < number_[c];
      number_[c] = least;
    }
    mesh_.halo.update(number_);
    for (const Index c : cells_)
      falls = falls || (c >= mesh_.n_owned && number_[c] < number_[root(c)]);
    falls = !all_of_ranks(!falls);
  }
}

std::vector<Pieces::Volume> Pieces::volumes(const CellField<Real>& alpha) const {
  std::map<Real, Real> mine, total;  // volume by number
  for (Index c = 0; c < mesh_.n_owned; ++c)
    if (inside(alpha[c])) mine[number_[c]] += alpha[c] * mesh_.V[c];
  std::vector<Real> items;
  for (const auto& [number, volume] : mine) items.push_back(number), items.push_back(volume);
  const std::vector<Real> all = gathered(items);
  for (std::size_t i = 0; i + 1 < all.size(); i += 2) total[all[i]] += all[i + 1];
  std::vector<Volume> found;
  for (const auto& [number, volume] : total) found.push_back({number, volume});
  return found;
}

int Pieces::count(const CellField<Real>& alpha, Real least) const {
  return static_cast<int>(std::ranges::count_if(
      volumes(alpha), [&](const Volume& piece) { return piece.volume >= least; }));
}

void Pieces::mark_crumbs(CellField<Real>& near, const CellField<Real>& alpha, int rings) const {
  constexpr Real part = 0.01;  // of the largest piece
  near.fill(0);
  std::vector<Volume> large = volumes(alpha);
  Real largest = 0;
  for (const Volume& piece : large) largest = std::max(largest, piece.volume);
  std::erase_if(large, [&](const Volume& piece) { return piece.volume < part * largest; });
  const auto small = [&](Index c) {
    return inside(alpha[c]) && std::ranges::find(large, number_[c], &Volume::number) == large.end();
  };
  for (Index c = 0; c < mesh_.n_cells; ++c)
    if (small(c)) near[c] = 1 + rings;
  spread_marks(near, rings, mesh_, [&](Index c) { return !inside(alpha[c]); });
}

}  // namespace fsi
