#include "libfsi/operators/stiff_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace fsi {
namespace {

// Part of the diagonal from which a cell is stiff. The matrix of the velocity at a soft torus took
// the least time with 0.3 to 0.5. With less, the sweep has more cells and saves few iterations;
// with 0.8 it saves none.
constexpr Real share = 0.4;

/// What the stiff cells couple to, as StiffSweep keeps it.
struct Rows {
  const std::vector<Index>&cell, &begin, &before;
  const std::vector<Real>& coefficient;
};

// z holds D^-1 r. Forward: z <- D^-1 (r - L z), backward: z <- z - D^-1 L^T z, by columns. A cell
// waits for the one before it: products that do without its value are taken first.
template <int dim>
void sweep(Real* z, const Rows& rows, const Real* inverse) {
  const Index n = static_cast<Index>(rows.cell.size());
  std::array<Real, dim> own{}, scale{};
  for (Index i = 0; i < n; ++i) {
    const Index c = rows.cell[i] * dim;
    for (Index k = 0; k < dim; ++k) own[k] = z[c + k], scale[k] = inverse[c + k];
    for (Index e = rows.begin[i]; e < rows.begin[i + 1]; ++e) {
      const Index b = rows.before[e] * dim;
      for (Index k = 0; k < dim; ++k) own[k] -= (scale[k] * rows.coefficient[e]) * z[b + k];
    }
    for (Index k = 0; k < dim; ++k) z[c + k] = own[k];
  }
  for (Index i = n - 1; i >= 0; --i) {
    const Index c = rows.cell[i] * dim;
    for (Index k = 0; k < dim; ++k) own[k] = z[c + k];
    for (Index e = rows.begin[i]; e < rows.begin[i + 1]; ++e) {
      const Index b = rows.before[e] * dim;
      for (Index k = 0; k < dim; ++k) z[b + k] -= (inverse[b + k] * rows.coefficient[e]) * own[k];
    }
  }
}

}  // namespace

StiffSweep::StiffSweep(const Mesh& mesh) : mesh_(mesh) {}

void StiffSweep::renew(const VectorMatrix& matrix) {
  const Index dim = mesh_.dim;
  inverse_.resize(matrix.diagonal.size());
  marked_.resize(static_cast<std::size_t>(mesh_.n_owned));
  cell_.clear(), begin_.clear(), before_.clear(), coefficient_.clear();
  for (Index i = 0; i < mesh_.n_owned * dim; ++i) inverse_[i] = 1 / matrix.diagonal[i];
  for (Index c = 0; c < mesh_.n_owned; ++c) {
    Real sum = 0;
    const std::span<const Index> faces = mesh_.cell_faces[c];
    for (const Index f : faces)
      if (f < mesh_.n_internal) sum += std::abs(matrix.off_diagonal[f]);
    const auto first = matrix.diagonal.begin() + c * dim;
    marked_[c] = sum > share * *std::min_element(first, first + dim) ? 1 : 0;
    if (marked_[c] == 0) continue;
    cell_.push_back(c);
    begin_.push_back(static_cast<Index>(before_.size()));
    for (const Index f : faces) {
      if (f >= mesh_.n_internal) continue;
      const Index other = mesh_.owner[f] == c ? mesh_.neighbour[f] : mesh_.owner[f];
      if (other >= c || marked_[other] == 0) continue;
      before_.push_back(other);
      coefficient_.push_back(matrix.off_diagonal[f]);
    }
  }
  begin_.push_back(static_cast<Index>(before_.size()));
}

void StiffSweep::apply(Real* z, const Real* r) const {
  for (Index i = 0; i < mesh_.n_owned * mesh_.dim; ++i) z[i] = inverse_[i] * r[i];
  const Rows rows{cell_, begin_, before_, coefficient_};
  (mesh_.dim == 2 ? sweep<2> : sweep<3>)(z, rows, inverse_.data());
}

}  // namespace fsi
