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
#include "libfsi/io/vtk_file.hpp"

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

}  // namespace

FieldWriter::FieldWriter(std::string directory, const Mesh& mesh, Real resume_at)
    : directory_(std::move(directory)), mesh_(mesh), cells_(mesh, On::cells) {
  take_up(resume_at);
  write_mesh();
}

void FieldWriter::write_mesh() const {
  const VtkMesh mesh = vtk_mesh(mesh_);
  const std::string path = directory_ + "/" + mesh_file;
  std::string reason;
  if (rank() == 0) {
    Hdf5Image image(bytes_of(mesh));
    head_vtk(image);
    add(image, mesh);
    reason = put(path, image);
  }
  agree(path, reason);
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

void FieldWriter::write(Real t, std::span<const NamedField> fields) {
  std::size_t width = 0;
  for (const NamedField& f : fields) {
    require_finite(f.name, f.values, f.width, On::cells, mesh_);
    width += static_cast<std::size_t>(f.width);
  }
  std::optional<Hdf5Image> image;
  if (rank() == 0) {
    image.emplace(8 * width * static_cast<std::size_t>(mesh_.n_global));
    head_vtk(*image);
    for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds", "Points",
                             "Connectivity", "Offsets", "Types"})
      image->link(std::string("/VTKHDF/") + name, mesh_file);
    image->group("/VTKHDF/CellData");
  }
  for (const NamedField& f : fields) {
    std::vector<Real> room;
    std::span<const Real> all = cells_.gather(f.values, f.width, room);
    if (f.width == 6 && image) all = ordered_as_paraview(all, room);
    if (image) image->dataset("/VTKHDF/CellData/" + f.name, all, f.width);
  }
  std::string path, reason;
  if (rank() == 0) {
    const bool anew = !entries_.empty() && entries_.back().t == t;
    std::array<char, 48> name{};
    std::snprintf(name.data(), name.size(), "fields_%04zu.hdf", entries_.size() - (anew ? 1 : 0));
    path = directory_ + "/" + name.data();
    reason = put(path, *image);
    if (reason.empty() && !anew) {
      entries_.push_back({name.data(), t});
      const std::string text = series();
      reason =
          replace_file(directory_ + series_file, {std::as_bytes(std::span(text))}, Durable::no);
    }
  }
  agree(broadcast(path), reason);
}

}  // namespace fsi::io
