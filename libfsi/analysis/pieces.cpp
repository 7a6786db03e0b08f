#include "libfsi/analysis/pieces.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "libfsi/core/parallel.hpp"

namespace fsi::analysis {
namespace {

/// The sets of a rank's cells, owned and halo, that were found to hang together.
class Sets {
 public:
  explicit Sets(Index n) : parent_(static_cast<std::size_t>(n)) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  /// The cell that represents the set of c.
  Index root(Index c) {
    while (parent_[c] != c) c = parent_[c] = parent_[parent_[c]];
    return c;
  }
  void join(Index a, Index b) { parent_[root(a)] = root(b); }

 private:
  std::vector<Index> parent_;
};

bool inside(Real alpha) { return alpha > 0.5; }

/// Collective. Gives every cell inside the least global number of its piece. Each rank first has
/// that of its own part. Smaller numbers of neighbours then pass from rank to rank until no number
/// changes.
void spread(CellField<Real>& number, Sets& sets, const CellField<Real>& alpha, const Mesh& mesh) {
  bool falls = true;
  while (falls) {
    falls = false;
    for (Index c = 0; c < mesh.n_cells; ++c) {
      if (!inside(alpha[c])) continue;
      Real& of_set = number[sets.root(c)];
      of_set = std::min(of_set, number[c]);
    }
    for (Index c = 0; c < mesh.n_cells; ++c) {
      if (!inside(alpha[c])) continue;
      const Real least = number[sets.root(c)];
      falls = falls || least < number[c];
      number[c] = least;
    }
    mesh.halo.update(number);
    for (Index c = mesh.n_owned; c < mesh.n_cells; ++c)
      falls = falls || (inside(alpha[c]) && number[c] < number[sets.root(c)]);
    falls = !all_of_ranks(!falls);
  }
}

}  // namespace

int pieces(const CellField<Real>& alpha, Real least, const Mesh& mesh) {
  Sets sets(mesh.n_cells);
  CellField<Real> number(mesh);
  for (Index c = 0; c < mesh.n_cells; ++c) number[c] = static_cast<Real>(mesh.global_id[c]);
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (!inside(alpha[c])) continue;
    for (const Index n : mesh.cell_neighbours[c])
      if (inside(alpha[n])) sets.join(c, n);
  }
  spread(number, sets, alpha, mesh);
  std::map<Real, Real> mine, total;  // volume by number
  for (Index c = 0; c < mesh.n_owned; ++c)
    if (inside(alpha[c])) mine[number[c]] += alpha[c] * mesh.V[c];
  std::vector<Real> items;
  for (const auto& [piece, volume] : mine) items.push_back(piece), items.push_back(volume);
  const std::vector<Real> all = gathered(items);
  for (std::size_t i = 0; i + 1 < all.size(); i += 2) total[all[i]] += all[i + 1];
  return static_cast<int>(
      std::ranges::count_if(total, [&](const auto& piece) { return piece.second >= least; }));
}

}  // namespace fsi::analysis
