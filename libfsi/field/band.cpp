#include "libfsi/field/band.hpp"

#include <algorithm>

namespace fsi {

Csr cells_around_halo(const Mesh& mesh) {
  std::vector<std::vector<Index>> around(static_cast<std::size_t>(mesh.n_cells - mesh.n_owned));
  for (Index c = 0; c < mesh.n_owned; ++c)
    for (const Index n : mesh.cell_neighbours[c])
      if (n >= mesh.n_owned) around[n - mesh.n_owned].push_back(c);
  Csr rows;
  for (const auto& row : around) {
    rows.index.insert(rows.index.end(), row.begin(), row.end());
    rows.offset.push_back(static_cast<Index>(rows.index.size()));
  }
  return rows;
}

std::vector<Index> faces_between_ranks(const Mesh& mesh) {
  std::vector<Index> faces;
  for (Index f = 0; f < mesh.n_internal; ++f)
    if (std::max(mesh.owner[f], mesh.neighbour[f]) >= mesh.n_owned) faces.push_back(f);
  return faces;
}

Band::Band(const Mesh& mesh)
    : mesh_(mesh),
      halo_neighbours_(cells_around_halo(mesh)),
      between_ranks_(faces_between_ranks(mesh)),
      cell_stamp_(static_cast<std::size_t>(mesh.n_owned), 0),
      face_stamp_(static_cast<std::size_t>(mesh.n_faces), 0),
      listed_(mesh) {}

void Band::rebuild(const CellField<Real>& q, Real threshold) {
  for (const Index c : cells_) listed_[c] = 0;
  last_core_.swap(core_);
  core_.clear(), cells_.clear(), faces_.clear();
  ++calls_;
  const auto list = [&](Index c) {
    if (c >= mesh_.n_owned || cell_stamp_[c] == calls_) return;
    cell_stamp_[c] = calls_;
    listed_[c] = 1;
    cells_.push_back(c);
  };
  const auto list_face = [&](Index f) {
    if (face_stamp_[f] == calls_) return;
    face_stamp_[f] = calls_;
    faces_.push_back(f);
  };
  for (Index c = 0; c < mesh_.n_owned; ++c)
    if (q[c] >= threshold) core_.push_back(c);
  for (const Index c : core_) list(c);
  for (const Index c : core_)
    for (const Index n : mesh_.cell_neighbours[c]) list(n);
  for (Index c = mesh_.n_owned; c < mesh_.n_cells; ++c)
    if (q[c] >= threshold)
      for (const Index n : halo_neighbours_[c - mesh_.n_owned]) list(n);
  for (const Index c : cells_)
    for (const Index f : mesh_.cell_faces[c]) list_face(f);
  // The halo cell may be in the other rank's band although the owned one is not in this one's.
  for (const Index f : between_ranks_) list_face(f);
  mesh_.halo.update(listed_);
}

}  // namespace fsi
