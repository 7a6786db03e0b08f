#include "libfsi/io/vtk_file.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/io/collect.hpp"
#include "libfsi/io/file.hpp"
#include "libfsi/io/shared_file.hpp"

namespace fsi::io {
namespace {

/// Collective. Rank 0: the values of all ranks' cells in the order of the mesh as read.
std::vector<Real> in_file_order(const Mesh& mesh, std::span<const Index> cells,
                                std::span<const Real> values) {
  std::vector<std::pair<GlobalIndex, Real>> mine, all;
  for (const Index c : cells)
    mine.emplace_back(mesh.global_id[c], values[static_cast<std::size_t>(c)]);
  for (const auto& part : collect(mine)) all.insert(all.end(), part.begin(), part.end());
  std::ranges::sort(all, {}, &std::pair<GlobalIndex, Real>::first);
  std::vector<Real> ordered;
  for (const auto& item : all) ordered.push_back(item.second);
  return ordered;
}

}  // namespace

void head_vtk(Hdf5Image& image) {
  image.group("/VTKHDF");
  image.attribute("/VTKHDF", "Version", std::array<std::int64_t, 2>{1, 0});
  image.attribute("/VTKHDF", "Type", std::string("UnstructuredGrid"));
}

void add(Hdf5Image& image, const VtkMesh& mesh) {
  const auto count = [](std::size_t n) { return std::array{static_cast<std::int64_t>(n)}; };
  image.dataset("/VTKHDF/NumberOfPoints", count(mesh.points.size() / 3));
  image.dataset("/VTKHDF/NumberOfCells", count(mesh.types.size()));
  image.dataset("/VTKHDF/NumberOfConnectivityIds", count(mesh.connectivity.size()));
  image.dataset("/VTKHDF/Points", mesh.points, 3);
  image.dataset("/VTKHDF/Connectivity", mesh.connectivity);
  image.dataset("/VTKHDF/Offsets", mesh.offsets);
  image.dataset("/VTKHDF/Types", mesh.types);
}

void agree(const std::string& file, const std::string& reason) {
  const std::string shared = broadcast(reason);
  if (!shared.empty())
    throw Error(ErrorKind::io, "file \"" + file + "\" could not be written: " + shared);
}

void write_cells(const std::string& path, const Mesh& mesh, std::span<const Index> cells,
                 std::span<const CellFigure> figures) {
  const VtkMesh part = vtk_cells(mesh, cells);
  std::vector<Real> ids(static_cast<std::size_t>(mesh.n_owned));
  for (Index c = 0; c < mesh.n_owned; ++c) ids[c] = static_cast<Real>(mesh.global_id[c]);
  std::vector<CellFigure> all{{"cell", ids}};
  all.insert(all.end(), figures.begin(), figures.end());
  std::optional<Hdf5Image> image;
  if (rank() == 0) {
    image.emplace();
    head_vtk(*image);
    add(*image, part);
    image->group("/VTKHDF/CellData");
  }
  for (const CellFigure& figure : all) {
    const std::vector<Real> values = in_file_order(mesh, cells, figure.values);
    if (rank() == 0) image->dataset("/VTKHDF/CellData/" + figure.name, values);
  }
  if (rank() == 0) image->close();
  SharedFile file(path);
  agree(path, file.finish(image ? &*image : nullptr, Durable::no, nullptr));
}

}  // namespace fsi::io
