#include "libfsi/operators/vertex_mean.hpp"

#include <algorithm>

#include "libfsi/operators/stencil.hpp"
#include "libfsi/operators/symmetry_faces.hpp"

namespace fsi {
template <class Gradient>
VertexMean<Gradient>::VertexMean(const Mesh& mesh, const GradientStencil& stencil)
    : mesh_(mesh), weights_(stencil.weights), weight_(mesh) {
  const std::vector<Index> row = number_vertices();
  list_cells(row);
  set_weights(stencil);
  list_planes(stencil, row);
}

template <class Gradient>
std::vector<Index> VertexMean<Gradient>::number_vertices() {
  std::vector<Index> row(mesh_.points.size(), -1);
  Index n = 0;
  for (const Index f : weights_.irregular) {
    const bool bricks =
        mesh_.brick(mesh_.owner[f]) && (f >= mesh_.n_internal || mesh_.brick(mesh_.neighbour[f]));
    for (const Index p : mesh_.face_points[f]) {
      if (bricks) break;
      Index& r = row[mesh_.vertex[p]];
      if (r < 0) r = n++;
      face_rows_.index.push_back(r);
    }
    face_rows_.offset.push_back(static_cast<Index>(face_rows_.index.size()));
  }
  mean_.resize(static_cast<std::size_t>(n));
  stamp_.assign(mean_.size(), 0);
  return row;
}

template <class Gradient>
void VertexMean<Gradient>::list_cells(const std::vector<Index>& row) {
  if (mean_.empty()) return;
  const auto each = [&](auto&& visit) {
    for (Index c = 0; c < mesh_.n_cells; ++c)
      for (const Index p : mesh_.cell_points[c])
        if (const Index r = row[mesh_.vertex[p]]; r >= 0) visit(c, r);
  };
  std::vector<Index>& begin = row_cells_.offset;
  begin.assign(mean_.size() + 1, 0);
  each([&](Index, Index r) { ++begin[r + 1]; });
  for (std::size_t r = 1; r < begin.size(); ++r) begin[r] += begin[r - 1];
  row_cells_.index.resize(static_cast<std::size_t>(begin.back()));
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  each([&](Index c, Index r) { row_cells_.index[next[r]++] = c; });
  for (std::size_t r = 0; r + 1 < begin.size(); ++r)
    std::ranges::sort(row_cells_.index.begin() + begin[r], row_cells_.index.begin() + begin[r + 1],
                      {}, [&](Index c) { return mesh_.global_id[c]; });
}

template <class Gradient>
void VertexMean<Gradient>::set_weights(const GradientStencil& stencil) {
  for (Index f = 0; f < mesh_.n_faces; ++f) {
    const bool mirror = f >= mesh_.n_internal && stencil.mirror[f - mesh_.n_internal] != 0;
    weight_[mesh_.owner[f]] +=
        norm2(mirror ? stencil.image[f - mesh_.n_internal] : stencil.owner[f]);
    if (f < mesh_.n_internal) weight_[mesh_.neighbour[f]] += norm2(stencil.neighbour[f]);
  }
  for (Real& w : weight_.owned()) w = w > 0 ? 1 / w : 0;
  constexpr Real last_resort = 1e-30;
  for (const Index c : stencil.unfit) weight_[c] *= last_resort;
  mesh_.halo.update(weight_);
  for (Index r = 0; r < row_cells_.rows(); ++r) {
    Real sum = 0;
    for (const Index c : row_cells_[r]) sum += weight_[c];
    share_.push_back(sum > 0 ? 1 / sum : 0);
  }
}

template <class Gradient>
void VertexMean<Gradient>::list_planes(const GradientStencil& stencil,
                                       const std::vector<Index>& row) {
  planes_.assign(mean_.size(), -1);
  for (const auto& [vertex, planes] : planes_through_vertices(stencil.mirror, mesh_)) {
    const Index r = row[vertex];
    if (r < 0 || !at_right_angles(planes)) continue;
    planes_[r] = static_cast<Index>(reflections_.size());
    Reflection& reflection = reflections_.emplace_back();
    for (const geometry::Mirror& plane : planes) reflection.normals[reflection.count++] = plane.n;
  }
}

template <class Gradient>
void VertexMean<Gradient>::set_row(Index r, const CellField<Gradient>& of_cells) {
  Gradient sum;
  for (const Index c : row_cells_[r]) sum += weight_[c] * of_cells[c];
  mean_[r] = share_[r] * sum;
  if (planes_[r] < 0) return;
  const Reflection& planes = reflections_[planes_[r]];
  for (int i = 0; i < planes.count; ++i)
    mean_[r] = 0.5 * (mean_[r] + image(mean_[r], planes.normals[i]));
}

template <class Gradient>
Gradient VertexMean<Gradient>::at_face(Index i, const CellField<Gradient>& of_cells) const {
  const auto rows = face_rows_[i];
  if (rows.empty()) {
    const Index f = weights_.irregular[i];
    if (f >= mesh_.n_internal) return of_cells[mesh_.owner[f]];
    return face_mean(of_cells, f, weights_, mesh_);
  }
  Gradient sum;
  for (const Index r : rows) sum += mean_[r];
  return (1 / static_cast<Real>(rows.size())) * sum;
}

template <class Gradient>
void VertexMean<Gradient>::set(std::vector<Gradient>& g, const CellField<Gradient>& of_cells) {
  for (Index r = 0; r < row_cells_.rows(); ++r) set_row(r, of_cells);
  for (Index i = 0; i < face_rows_.rows(); ++i) g[i] = at_face(i, of_cells);
}

template <class Gradient>
void VertexMean<Gradient>::set(std::vector<Gradient>& g, const CellField<Gradient>& of_cells,
                               const Band& band) {
  ++calls_;
  for (const Index f : band.faces()) {
    const Index i = weights_.place[f];
    if (i < 0) continue;
    for (const Index r : face_rows_[i]) {
      if (stamp_[r] == calls_) continue;
      stamp_[r] = calls_;
      set_row(r, of_cells);
    }
    g[i] = at_face(i, of_cells);
  }
}

template class VertexMean<Vec3>;
template class VertexMean<Tensor>;

}  // namespace fsi
