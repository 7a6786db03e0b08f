#pragma once
// A file that all ranks write side by side, whole or not there.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "libfsi/io/file.hpp"
#include "libfsi/io/hdf5.hpp"

namespace fsi::io {

/// The HDF5 file of an image on rank 0, whose large datasets every rank fills with its own part. No
/// rank holds more of it than it brings. Invariant: once a call fails on a rank, the file it was to
/// replace stays as it was.
class SharedFile {
 public:
  /// Collective. Opens a temporary file beside `path`.
  explicit SharedFile(std::string path);
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  /// This rank's bytes from `offset` on, which no other call and no other rank writes.
  void write(std::uint64_t offset, Bytes bytes);

  /// The text behind the HDF5 file, from its length and CRC-64; may be empty.
  using Trailer = std::function<std::string(std::uint64_t length, std::uint64_t crc)>;
  /// Collective. Rank 0 adds the rest of its image and puts the file where `path` is. Returns, the
  /// same on every rank, the reason it failed, "" when it did not.
  std::string finish(const Hdf5Image* image, Durable durable, const Trailer& trailer);

 private:
  struct Piece {
    std::uint64_t offset, length, crc;
  };
  void fail();
  void put(std::uint64_t offset, Bytes bytes);
  std::uint64_t write_rest(const Hdf5Image& image, std::vector<Piece> pieces);

  std::string path_;
  int descriptor_ = -1;
  int reason_ = 0;  ///< errno of the first call that failed
  std::vector<Piece> pieces_;
};

}  // namespace fsi::io
