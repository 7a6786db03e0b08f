#pragma once
// HDF5 files by one rank: made in memory, so that HDF5 itself never meets a full disk, and read
// with every status kept. Nothing here throws: ok() is asked once at the end, then agreed on by all
// ranks.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"

namespace fsi::io {

/// The number HDF5 knows an open thing by.
using Hdf5Id = std::int64_t;

/// A file being made. Invariant: once a call fails, ok() stays false.
class Hdf5Image {
 public:
  /// expected: about the bytes it will hold.
  explicit Hdf5Image(std::size_t expected);
  ~Hdf5Image();
  Hdf5Image(const Hdf5Image&) = delete;
  Hdf5Image& operator=(const Hdf5Image&) = delete;

  void group(const std::string& path);
  /// A dataset of values.size() / width rows; width 1 makes it one-dimensional.
  void dataset(const std::string& path, std::span<const Real> values, int width = 1);
  void dataset(const std::string& path, std::span<const std::int64_t> values);
  void dataset(const std::string& path, std::span<const std::uint8_t> values);
  /// An attribute of the group or dataset `object`; one value is a scalar.
  void attribute(const std::string& object, const std::string& name, Real value);
  void attribute(const std::string& object, const std::string& name,
                 std::span<const std::int64_t> values);
  void attribute(const std::string& object, const std::string& name, const std::string& value);
  /// `path` here stands for the same path in the file named (relative to this one).
  void link(const std::string& path, const std::string& file);

  bool ok() const { return ok_; }
  /// The file as it stands; empty unless ok. Valid while this lives and nothing is added.
  std::span<const std::byte> bytes();

 private:
  void write(const std::string& path, Hdf5Id type, std::span<const std::uint64_t> extent,
             const void* data);
  void attach(const std::string& object, const std::string& name, Hdf5Id type, std::size_t count,
              const void* data);
  Hdf5Id access_ = -1, file_ = -1;
  bool ok_ = true;
};

/// A file opened for reading.
class Hdf5File {
 public:
  explicit Hdf5File(const std::string& path);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  bool ok() const { return file_ >= 0; }
  /// Whether there is such a dataset of exactly that many Reals; then it is read.
  bool dataset(const std::string& path, std::span<Real> values) const;
  /// Whether there is such a scalar attribute; then it is read.
  bool attribute(const std::string& object, const std::string& name, Real& value) const;
  bool attribute(const std::string& object, const std::string& name, std::int64_t& value) const;
  bool attribute(const std::string& object, const std::string& name, std::string& value) const;

 private:
  bool fetch(const std::string& object, const std::string& name, Hdf5Id type, void* value) const;
  Hdf5Id file_ = -1;
};

}  // namespace fsi::io
