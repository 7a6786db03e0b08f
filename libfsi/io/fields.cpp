#include "libfsi/io/fields.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/io/file.hpp"
#include "libfsi/io/hdf5.hpp"
#include "libfsi/io/shared_file.hpp"
#include "libfsi/io/vtk_file.hpp"
#include "libfsi/io/vtk_mesh.hpp"

namespace fsi::io {
namespace {

constexpr const char* mesh_file = "fields_mesh.hdf";
constexpr const char* series_file = "/fields.hdf.series";
constexpr const char* entry_text = "{\"name\": \"%63[^\"]\", \"time\": %lf}";

/// xx xy xz yy yz zz -> xx yy zz xy yz xz, as ParaView names the components. values: room for
/// them, or where they are already.
std::span<const Real> ordered_as_paraview(std::span<const Real> from, std::vector<Real>& values) {
  if (from.data() != values.data()) values.assign(from.begin(), from.end());
  for (std::size_t i = 0; i + 6 <= values.size(); i += 6) {
    const std::array v{values[i],     values[i + 3], values[i + 5],
                       values[i + 1], values[i + 4], values[i + 2]};
    std::copy(v.begin(), v.end(), values.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return values;
}

/// Collective. The ranks' parts of an array, one after the other, in a room of the file.
template <class T>
void put_parts(SharedFile& file, std::uint64_t room, const std::vector<T>& part) {
  auto n = static_cast<std::uint64_t>(part.size());
  std::uint64_t first = 0;
  MPI_Exscan(&n, &first, 1, MPI_UINT64_T, MPI_SUM, comm());
  file.write(room + sizeof(T) * (rank() == 0 ? 0 : first), std::as_bytes(std::span(part)));
}

}  // namespace

FieldWriter::FieldWriter(std::string directory, const Mesh& mesh, Real resume_at)
    : directory_(std::move(directory)), mesh_(mesh), cells_(mesh, Location::cells) {
  take_up(resume_at);
  write_mesh();
}

void FieldWriter::write_mesh() const {
  const VtkMesh mesh = vtk_mesh(mesh_);
  const std::string path = directory_ + "/" + mesh_file;
  std::array<std::int64_t, 3> count{};
  std::size_t i = 0;
  for (const std::size_t mine : {mesh.points.size(), mesh.types.size(), mesh.connectivity.size()})
    count[i++] = global_sum(static_cast<GlobalIndex>(mine));
  std::optional<Hdf5Image> image;
  std::array<std::uint64_t, 4> room{};
  if (rank() == 0) {
    image.emplace();
    head_vtk(*image);
    const auto rows = [&](std::size_t k) { return static_cast<std::uint64_t>(count[k]); };
    image->dataset("/VTKHDF/NumberOfPoints", std::array{count[0] / 3});
    image->dataset("/VTKHDF/NumberOfCells", std::array{count[1]});
    image->dataset("/VTKHDF/NumberOfConnectivityIds", std::array{count[2]});
    room[0] = image->room<Real>("/VTKHDF/Points", rows(0) / 3, 3);
    room[1] = image->room<std::int64_t>("/VTKHDF/Connectivity", rows(2));
    room[2] = image->room<std::int64_t>("/VTKHDF/Offsets", rows(1) + 1);
    room[3] = image->room<std::uint8_t>("/VTKHDF/Types", rows(1));
    image->close();
  }
  MPI_Bcast(room.data(), static_cast<int>(room.size()), MPI_UINT64_T, 0, comm());
  SharedFile file(path);
  if (all_of_ranks(rank() != 0 || image->ok())) {
    put_parts(file, room[0], mesh.points), put_parts(file, room[1], mesh.connectivity);
    put_parts(file, room[2], mesh.offsets), put_parts(file, room[3], mesh.types);
  }
  agree(path, file.finish(image ? &*image : nullptr, Durable::no, nullptr));
}

void FieldWriter::take_up(Real resume_at) {
  if (rank() != 0) return;
  std::ifstream stream(directory_ + series_file);
  for (std::string line; std::getline(stream, line);) {
    std::array<char, 64> name{};
    Real t = 0;
    const std::size_t at = line.find('{');
    // NOLINTNEXTLINE: the format is the constant above
    if (at == std::string::npos || std::sscanf(line.c_str() + at, entry_text, name.data(), &t) != 2)
      continue;
    std::error_code code;
    if (t <= resume_at * (1 + 1e-12))
      entries_.push_back({name.data(), t});
    else
      std::filesystem::remove(directory_ + "/" + name.data(), code);
  }
}

std::string FieldWriter::series() const {
  std::string text = "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n";
  for (const Entry& entry : entries_) {
    std::array<char, 128> line{};
    std::snprintf(line.data(), line.size(), "    {\"name\": \"%s\", \"time\": %.17g}%s\n",
                  entry.file.c_str(), entry.t, &entry == &entries_.back() ? "" : ",");
    text += line.data();
  }
  return text + "  ]\n}\n";
}

std::string FieldWriter::write_cells(const std::string& path, std::span<const NamedField> fields,
                                     const Hdf5Image* image,
                                     std::vector<std::uint64_t>& offset) const {
  MPI_Bcast(offset.data(), static_cast<int>(offset.size()), MPI_UINT64_T, 0, comm());
  int good = image != nullptr && image->ok() ? 1 : 0;
  MPI_Bcast(&good, 1, MPI_INT, 0, comm());
  SharedFile file(path);
  for (std::size_t i = 0; i < offset.size() && good != 0; ++i) {
    const NamedField& f = fields[i];
    std::vector<Real> room;
    std::span<const Real> mine = cells_.gather(f.values, f.width, room);
    if (f.width == 6) mine = ordered_as_paraview(mine, room);
    const auto first = static_cast<std::uint64_t>(cells_.first() * f.width);
    file.write(offset[i] + sizeof(Real) * first, std::as_bytes(mine));
  }
  return file.finish(image, Durable::no, nullptr);
}

void FieldWriter::write(Real t, std::span<const NamedField> fields) {
  for (const NamedField& f : fields)
    require_finite(f.name, f.values, f.width, Location::cells, mesh_);
  std::optional<Hdf5Image> image;
  std::vector<std::uint64_t> offset(fields.size(), 0);
  const bool anew = !entries_.empty() && entries_.back().t == t;
  std::array<char, 48> name{};
  std::snprintf(name.data(), name.size(), "fields_%04zu.hdf", entries_.size() - (anew ? 1 : 0));
  const std::string path = directory_ + "/" + broadcast(name.data());
  if (rank() == 0) {
    image.emplace();
    head_vtk(*image);
    for (const char* part : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds", "Points",
                             "Connectivity", "Offsets", "Types"})
      image->link(std::string("/VTKHDF/") + part, mesh_file);
    image->group("/VTKHDF/CellData");
    for (std::size_t i = 0; i < offset.size(); ++i)
      offset[i] = image->room<Real>("/VTKHDF/CellData/" + fields[i].name,
                                    static_cast<std::uint64_t>(cells_.size()), fields[i].width);
    image->close();
  }
  std::string reason = write_cells(path, fields, image ? &*image : nullptr, offset);
  if (rank() == 0 && reason.empty() && !anew) {
    entries_.push_back({name.data(), t});
    const std::string text = series();
    reason = replace_file(directory_ + series_file, {std::as_bytes(std::span(text))}, Durable::no);
  }
  agree(path, reason);
}

}  // namespace fsi::io
