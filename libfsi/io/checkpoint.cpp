#include "libfsi/io/checkpoint.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/io/crc.hpp"
#include "libfsi/io/file.hpp"
#include "libfsi/io/hdf5.hpp"
#include "libfsi/io/shared_file.hpp"

namespace fsi::io {
namespace {

constexpr std::int64_t format = 3;

/// The text behind the HDF5 file: its length and check. HDF5 does not read it.
constexpr std::size_t trailer_size = 96;

std::string trailer(std::uint64_t length, std::uint64_t crc) {
  std::array<char, trailer_size> text{};
  std::snprintf(text.data(), text.size(), "\nfsi checkpoint %lld\nbytes %llu\ncrc64 %016llx\n",
                static_cast<long long>(format), static_cast<unsigned long long>(length),
                static_cast<unsigned long long>(crc));
  return {text.begin(), text.end()};
}

/// "" if the file is as it was written, else the reason why not.
std::string damage(const std::string& path) {
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  std::ifstream stream(path, std::ios::binary);
  if (code || !stream) return "it cannot be opened";
  std::string found(trailer_size, '\0');
  if (size < found.size()) return "it is too short";
  const std::size_t length = size - found.size();
  std::vector<char> chunk(1 << 20);
  std::uint64_t crc = 0;
  for (std::size_t at = 0; at < length && stream; at += chunk.size()) {
    const std::size_t n = std::min(chunk.size(), length - at);
    stream.read(chunk.data(), static_cast<std::streamsize>(n));
    crc = crc64(std::as_bytes(std::span(chunk).first(n)), crc);
  }
  stream.read(found.data(), trailer_size);
  return stream && found == trailer(length, crc) ? "" : "its length or checksum is wrong";
}

/// Numbers of the checkpoints in a directory, ascending; files that only look alike are left alone.
std::vector<std::int64_t> numbers_in(const std::string& directory) {
  std::vector<std::int64_t> numbers;
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator(directory, code)) {
    const std::string name = entry.path().filename().string();
    long long number = 0;
    int end = 0;
    if (std::sscanf(name.c_str(), "checkpoint_%lld.h5%n", &number, &end) == 1 &&
        end == static_cast<int>(name.size()) && number > 0)
      numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::string path_in(const std::string& directory, std::int64_t number) {
  char name[48];
  std::snprintf(name, sizeof name, "/checkpoint_%04lld.h5", static_cast<long long>(number));
  return directory + name;
}

/// The newest checkpoint of a directory that is sound; "": none. Tells damaged(file, reason) of
/// those that are not, newest first.
template <class Damaged>
std::string newest_sound(const std::string& directory, const Damaged& damaged) {
  std::vector<std::int64_t> numbers = numbers_in(directory);
  for (; !numbers.empty(); numbers.pop_back()) {
    std::string candidate = path_in(directory, numbers.back());
    const std::string reason = damage(candidate);
    if (reason.empty()) return candidate;
    damaged(candidate, reason);
  }
  return "";
}

void warn(const std::string& sentence) {
  if (rank() == 0) std::fprintf(stderr, "fsi: warning: %s\n", sentence.c_str());
}

void write_scalars(Hdf5Image& image, const Snapshot& snapshot) {
  image.group("/scalars");
  for (const auto& [name, scalar] : snapshot.scalars()) {
    if (const auto* real = std::get_if<Real*>(&scalar)) image.attribute("/scalars", name, **real);
    if (const auto* whole = std::get_if<std::int64_t*>(&scalar))
      image.attribute("/scalars", name, std::span<const std::int64_t>(*whole, 1));
    if (const auto* text = std::get_if<std::string*>(&scalar))
      image.attribute("/scalars", name, **text);
  }
}

/// Rank 0 reads; "" or the name of the first scalar that is not there.
std::string read_scalars(const Hdf5File& file, const Snapshot& snapshot) {
  for (const auto& [name, scalar] : snapshot.scalars()) {
    const bool good = std::visit(
        [&, &key = name](auto* value) { return file.attribute("/scalars", key, *value); }, scalar);
    if (!good && !snapshot.optional(name)) return name;
  }
  return "";
}

void share_scalars(const Snapshot& snapshot) {
  for (const auto& item : snapshot.scalars()) {
    const Snapshot::Scalar& scalar = item.second;
    if (const auto* real = std::get_if<Real*>(&scalar)) MPI_Bcast(*real, 1, MPI_DOUBLE, 0, comm());
    if (const auto* whole = std::get_if<std::int64_t*>(&scalar))
      MPI_Bcast(*whole, 1, MPI_INT64_T, 0, comm());
    if (const auto* text = std::get_if<std::string*>(&scalar)) **text = broadcast(**text);
  }
}

}  // namespace

std::vector<Real> solid_fractions(const std::string& directory,
                                  const std::vector<std::string>& solids, Index first,
                                  Index count) {
  const auto skip = [](const std::string&, const std::string&) {};
  const std::string file = broadcast(rank() == 0 ? newest_sound(directory, skip) : "");
  const auto total = static_cast<std::uint64_t>(global_sum(static_cast<GlobalIndex>(count)));
  std::vector<Real> sum(static_cast<std::size_t>(count), 0), one(sum);
  bool found = false;
  if (!file.empty()) {
    const Hdf5File fields(file);
    for (const std::string& solid : solids) {
      const std::string name = "/fields/" + (solid.empty() ? "" : solid + "_") + "alpha";
      if (!fields.ok() || !fields.dataset(name, total, static_cast<std::uint64_t>(first), one, 1))
        continue;
      found = true;
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += one[c];
    }
  }
  return all_of_ranks(found) ? sum : std::vector<Real>{};
}

Checkpoint::Checkpoint(std::string directory, const Mesh& mesh)
    : directory_(std::move(directory)),
      mesh_(mesh),
      cells_(mesh, Location::cells),
      faces_(mesh, Location::faces),
      boundary_(mesh, Location::boundary) {
  if (rank() == 0) {
    const std::vector<std::int64_t> numbers = numbers_in(directory_);
    if (!numbers.empty()) next_ = numbers.back() + 1;
    std::error_code code;
    std::filesystem::remove(temporary_of(path(next_)), code);
  }
  MPI_Bcast(&next_, 1, MPI_INT64_T, 0, comm());
}

const Layout& Checkpoint::layout(Location on) const {
  return on == Location::cells ? cells_ : on == Location::faces ? faces_ : boundary_;
}

std::string Checkpoint::path(std::int64_t number) const { return path_in(directory_, number); }

void Checkpoint::keep_two() const {
  const std::vector<std::int64_t> numbers = numbers_in(directory_);
  std::error_code code;
  for (std::size_t i = 0; i + 2 < numbers.size(); ++i)
    std::filesystem::remove(path(numbers[i]), code);
}

std::string Checkpoint::clear(bool keep) const {
  if (rank() != 0) return "";
  const std::vector<std::int64_t> numbers = numbers_in(directory_);
  std::string kept;
  std::error_code code;
  if (keep && !numbers.empty()) {
    const std::string newest = path(numbers.back());
    std::filesystem::rename(newest, newest + ".before", code);
    if (!code) kept = newest + ".before";
  }
  for (const std::int64_t number : numbers) std::filesystem::remove(path(number), code);
  return kept;
}

std::uint64_t Checkpoint::rows(Location on) const {
  return static_cast<std::uint64_t>(layout(on).size());
}

std::string Checkpoint::write_fields(const Snapshot& snapshot, const Hdf5Image* image,
                                     std::vector<std::uint64_t>& offset) const {
  MPI_Bcast(offset.data(), static_cast<int>(offset.size()), MPI_UINT64_T, 0, comm());
  int good = image != nullptr && image->ok() ? 1 : 0;
  MPI_Bcast(&good, 1, MPI_INT, 0, comm());
  SharedFile file(path(next_));
  for (std::size_t i = 0; i < offset.size() && good != 0; ++i) {
    const Snapshot::Values& f = snapshot.fields()[i];
    std::vector<Real> room;
    const std::span<const Real> mine = layout(f.on).gather(f.values, f.width, room);
    const auto first = static_cast<std::uint64_t>(layout(f.on).first() * f.width);
    file.write(offset[i] + sizeof(Real) * first, std::as_bytes(mine));
  }
  return file.finish(image, Durable::yes, trailer);
}

bool Checkpoint::write(const Snapshot& snapshot) {
  for (const Snapshot::Values& f : snapshot.fields())
    require_finite(f.name, f.values, f.width, f.on, mesh_);
  std::optional<Hdf5Image> image;
  std::vector<std::uint64_t> offset(snapshot.fields().size(), 0);
  if (rank() == 0) {
    image.emplace();
    image->group("/fields");
    for (std::size_t i = 0; i < offset.size(); ++i) {
      const Snapshot::Values& f = snapshot.fields()[i];
      offset[i] = image->room<Real>("/fields/" + f.name, rows(f.on), f.width);
    }
    write_scalars(*image, snapshot);
    const std::array<std::int64_t, 1> cells{mesh_.n_global}, count{ranks()}, version{format},
        done{1}, hash{static_cast<std::int64_t>(mesh_.hash)};
    image->attribute("/", "format", version);
    image->attribute("/", "mesh", hash);
    image->attribute("/", "cells", cells);
    image->attribute("/", "ranks", count);
    image->attribute("/", "identity", snapshot.identity());
    image->attribute("/", "complete", done);
    image->close();
  }
  const std::string reason = write_fields(snapshot, image ? &*image : nullptr, offset);
  if (rank() == 0 && reason.empty()) keep_two();
  if (!reason.empty()) {
    warn("checkpoint \"" + path(next_) + "\" could not be written: " + reason +
         "; what was there before stays");
    return false;
  }
  file_ = path(next_++);
  return true;
}

std::string Checkpoint::rejection_reason(const Hdf5File& file, const Snapshot& snapshot) const {
  std::int64_t hash = 0, version = 0, cells = 0;
  std::string identity;
  if (!file.ok() || !file.attribute("/", "format", version) || version != format)
    return "is of another version of the program";
  if (!file.attribute("/", "cells", cells) || !file.attribute("/", "mesh", hash) ||
      cells != mesh_.n_global || static_cast<std::uint64_t>(hash) != mesh_.hash)
    return "is of another mesh: that one has " + std::to_string(cells) + " cells, this one " +
           std::to_string(mesh_.n_global) + ", or they differ in geometry, patches or periods";
  if (!file.attribute("/", "identity", identity) || identity != snapshot.identity())
    return "is of another run: it says \"" + identity + "\", and here it must be \"" +
           snapshot.identity() + "\"";
  const std::string name = read_scalars(file, snapshot);
  return name.empty() ? "" : "holds no \"" + name + "\"";
}

void Checkpoint::load(const std::string& file, const Snapshot& snapshot) const {
  const auto agree = [&](const std::string& reason) {
    const std::string shared = broadcast(reason);
    require(shared.empty(), "checkpoint \"" + file + "\" " + shared);
  };
  std::optional<Hdf5File> source;
  if (rank() == 0) source.emplace(file);
  agree(source ? rejection_reason(*source, snapshot) : "");
  const Hdf5File fields(file);
  for (const Snapshot::Values& f : snapshot.fields()) {
    const Layout& where = layout(f.on);
    std::vector<Real> mine(static_cast<std::size_t>(where.mine() * f.width));
    const auto found = [&](const std::string& name) {
      return fields.ok() &&
             fields.dataset("/fields/" + name, rows(f.on),
                            static_cast<std::uint64_t>(where.first()), mine, f.width);
    };
    const bool good = found(f.name) || (!f.instead.empty() && found(f.instead));
    require(all_of_ranks(good),
            "checkpoint \"" + file + "\" holds no field \"" + f.name + "\" of this size");
    where.scatter(mine, f.width, f.values);
    if (f.on == Location::cells) mesh_.halo.update(f.values, f.width);
  }
  share_scalars(snapshot);
}

void Checkpoint::read(const Snapshot& snapshot, const std::string& advice) {
  std::string sound, damaged;
  if (rank() == 0)
    sound = newest_sound(directory_, [&](const std::string& file, const std::string& reason) {
      damaged += (damaged.empty() ? "" : ", ") + file;
      std::error_code code;
      if (std::ifstream(file)) std::filesystem::rename(file, file + ".damaged", code);
      warn("checkpoint \"" + file + "\" is damaged (" + reason + "); passed over");
    });
  sound = broadcast(sound);
  damaged = broadcast(damaged);
  if (sound.empty() && !damaged.empty())
    throw Error(ErrorKind::io, "all checkpoints are damaged: " + damaged);
  require(!sound.empty(),
          "there is no checkpoint in \"" + directory_ + "\" to go on from; " + advice);
  load(sound, snapshot);
  file_ = sound;
}

}  // namespace fsi::io
