#include "libfsi/io/shared_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "libfsi/core/parallel.hpp"
#include "libfsi/io/collect.hpp"
#include "libfsi/io/crc.hpp"

namespace fsi::io {

SharedFile::SharedFile(std::string path) : path_(std::move(path)) {
  const std::string temporary = temporary_of(path_);
  // Rank 0 makes it, then all open it.
  for (const bool first : {true, false}) {
    if ((rank() == 0) == first) {
      descriptor_ =
          ::open(temporary.c_str(), O_RDWR | O_CLOEXEC | (first ? O_CREAT | O_TRUNC : 0), 0666);
      if (descriptor_ < 0) fail();
    }
    MPI_Barrier(comm());
  }
}

SharedFile::~SharedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void SharedFile::fail() {
  if (reason_ == 0) reason_ = errno != 0 ? errno : EIO;
}

void SharedFile::put(std::uint64_t offset, Bytes bytes) {
  while (reason_ == 0 && !bytes.empty()) {
    const ssize_t n = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return fail();
    bytes = bytes.subspan(static_cast<std::size_t>(n));
    offset += static_cast<std::uint64_t>(n);
  }
}

void SharedFile::write(std::uint64_t offset, Bytes bytes) {
  put(offset, bytes);
  pieces_.push_back({offset, bytes.size(), crc64(bytes)});
}

std::uint64_t SharedFile::write_rest(const Hdf5Image& image, std::vector<Piece> pieces) {
  std::ranges::sort(pieces, {}, &Piece::offset);
  pieces.push_back({image.size(), 0, 0});
  std::uint64_t at = 0, crc = 0;
  std::vector<std::byte> chunk(1 << 16);
  for (const Piece& piece : pieces) {
    while (at < piece.offset) {
      const auto n = std::min<std::uint64_t>(chunk.size(), piece.offset - at);
      const auto part = std::span(chunk).first(static_cast<std::size_t>(n));
      if (!image.read(at, part)) return fail(), crc;
      put(at, part);
      crc = crc64(part, crc), at += n;
    }
    crc = crc64_joined(crc, piece.crc, piece.length), at += piece.length;
  }
  return crc;
}

std::string SharedFile::finish(const Hdf5Image* image, Durable durable, const Trailer& trailer) {
  std::vector<Piece> all;
  for (const auto& pieces : collect(pieces_)) all.insert(all.end(), pieces.begin(), pieces.end());
  std::string reason;
  if (rank() == 0) {
    if (image == nullptr || !image->ok()) reason = "HDF5 could not make it";
    if (reason.empty()) {
      const std::uint64_t crc = write_rest(*image, std::move(all));
      const std::string tail = trailer ? trailer(image->size(), crc) : "";
      put(image->size(), std::as_bytes(std::span(tail)));
    }
  }
  const auto check = [this](bool good) {
    if (!good) fail();
  };
  if (descriptor_ >= 0) {
    if (reason_ == 0 && durable == Durable::yes) check(::fsync(descriptor_) == 0);
    check(::close(descriptor_) == 0);
    descriptor_ = -1;
  }
  if (reason_ != 0 && reason.empty()) reason = std::strerror(reason_);
  // The reason of the lowest rank that has one.
  int teller = reason.empty() ? ranks() : rank();
  MPI_Allreduce(MPI_IN_PLACE, &teller, 1, MPI_INT, MPI_MIN, comm());
  if (teller < ranks()) reason = broadcast(reason, teller);
  if (rank() == 0) {
    const std::string temporary = temporary_of(path_);
    if (reason.empty() && std::rename(temporary.c_str(), path_.c_str()) != 0)
      reason = std::strerror(errno);
    if (!reason.empty()) ::unlink(temporary.c_str());
    if (reason.empty() && durable == Durable::yes) synchronise_directory(path_);
  }
  return broadcast(reason);
}

}  // namespace fsi::io
