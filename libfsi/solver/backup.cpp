#include "libfsi/solver/backup.hpp"

#include <algorithm>

#include "libfsi/core/error.hpp"

namespace fsi {

Backup::Backup(const io::Snapshot& what, const Mesh& mesh) : what_(what) {
  for (const io::Snapshot::Values& f : what_.fields()) {
    const Index items = f.on == Location::cells   ? mesh.n_cells
                        : f.on == Location::faces ? mesh.n_faces
                                                  : mesh.n_boundary();
    fields_.emplace_back(static_cast<std::size_t>(items) * static_cast<std::size_t>(f.width));
  }
  for (const auto& item : what_.scalars()) {
    FSI_ASSERT(!std::holds_alternative<std::string*>(item.second));
    scalars_.emplace_back(std::holds_alternative<Real*>(item.second)
                              ? std::variant<Real, std::int64_t>(0.0)
                              : std::variant<Real, std::int64_t>(std::int64_t{0}));
  }
}

void Backup::keep() {
  for (std::size_t i = 0; i < fields_.size(); ++i)
    std::copy_n(what_.fields()[i].values, fields_[i].size(), fields_[i].begin());
  for (std::size_t i = 0; i < scalars_.size(); ++i) {
    const io::Snapshot::Scalar& from = what_.scalars()[i].second;
    if (const auto* real = std::get_if<Real*>(&from)) scalars_[i] = **real;
    if (const auto* whole = std::get_if<std::int64_t*>(&from)) scalars_[i] = **whole;
  }
}

void Backup::restore() const {
  for (std::size_t i = 0; i < fields_.size(); ++i)
    std::ranges::copy(fields_[i], what_.fields()[i].values);
  for (std::size_t i = 0; i < scalars_.size(); ++i) {
    const io::Snapshot::Scalar& to = what_.scalars()[i].second;
    if (const auto* real = std::get_if<Real*>(&to)) **real = std::get<Real>(scalars_[i]);
    if (const auto* whole = std::get_if<std::int64_t*>(&to))
      **whole = std::get<std::int64_t>(scalars_[i]);
  }
}

}  // namespace fsi
