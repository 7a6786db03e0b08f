#pragma once
// HDF5 files: made in memory by one rank, so that HDF5 itself never meets a full disk, and read
// with every status kept. Nothing here throws: ok() is asked once at the end, then agreed on by all
// ranks.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"

namespace fsi::io {

/// The number of an open HDF5 object.
using Hdf5Id = std::int64_t;

/// A file being made, in memory that only what is written takes up. Invariant: once a call fails,
/// ok() stays false.
class Hdf5Image {
 public:
  Hdf5Image();
  ~Hdf5Image();
  Hdf5Image(const Hdf5Image&) = delete;
  Hdf5Image& operator=(const Hdf5Image&) = delete;

  /// A group.
  void group(const std::string& path);
  /// A dataset of values.size() / width rows; width 1 makes it one-dimensional.
  void dataset(const std::string& path, std::span<const Real> values, int width = 1);
  /// A one-dimensional dataset of whole numbers.
  void dataset(const std::string& path, std::span<const std::int64_t> values);
  /// A one-dimensional dataset of bytes.
  void dataset(const std::string& path, std::span<const std::uint8_t> values);
  /// Room for a dataset of T (Real, std::int64_t, std::uint8_t) that others write: rows, `width` to
  /// a row. Returns where in the file it begins, in bytes.
  template <class T>
  std::uint64_t room(const std::string& path, std::uint64_t rows, int width = 1);
  /// An attribute of the group or dataset `object`; one value is a scalar.
  void attribute(const std::string& object, const std::string& name, Real value);
  /// The same of whole numbers.
  void attribute(const std::string& object, const std::string& name,
                 std::span<const std::int64_t> values);
  /// The same of a text.
  void attribute(const std::string& object, const std::string& name, const std::string& value);
  /// A link: `path` here is the same path in the file named (relative to this one).
  void link(const std::string& path, const std::string& file);

  /// Whether all calls succeeded so far.
  bool ok() const { return ok_; }
  /// Ends the making. Returns whether all succeeded; then size() and read() give the file without
  /// the rooms.
  bool close();
  /// Bytes of the file, once closed.
  std::uint64_t size() const { return size_; }
  /// Its bytes from `offset` on; whether they could be read.
  bool read(std::uint64_t offset, std::span<std::byte> bytes) const;

 private:
  std::uint64_t write(const std::string& path, Hdf5Id type, std::span<const std::uint64_t> extent,
                      const void* data);
  /// Whether one more set of items of this size may be written: HDF5 can neither write nor close a
  /// file that the system stops half-way.
  bool has_room(std::uint64_t size, std::span<const std::uint64_t> extent);
  void attach(const std::string& object, const std::string& name, Hdf5Id type, std::size_t count,
              const void* data);
  int memory_ = -1;
  Hdf5Id file_ = -1;
  std::uint64_t size_ = 0;
  std::uint64_t reserved_ = 0;  // bytes, at least those of the sets so far
  bool refused_ = false;        // there is no room for the next one, and it was not begun
  bool ok_ = true;
};

/// A file opened for reading.
class Hdf5File {
 public:
  /// Opens the file; ok() returns whether that succeeded.
  explicit Hdf5File(const std::string& path);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Whether the file is open.
  bool ok() const { return file_ >= 0; }
  /// Whether there is such a dataset of exactly that many Reals; then it is read.
  bool dataset(const std::string& path, std::span<Real> values) const;
  /// The same of `rows` rows in all, of which those from `first` on are read.
  bool dataset(const std::string& path, std::uint64_t rows, std::uint64_t first,
               std::span<Real> values, int width) const;
  /// Whether there is such a scalar attribute; then it is read.
  bool attribute(const std::string& object, const std::string& name, Real& value) const;
  /// The same of a whole number.
  bool attribute(const std::string& object, const std::string& name, std::int64_t& value) const;
  /// The same of a text.
  bool attribute(const std::string& object, const std::string& name, std::string& value) const;

 private:
  bool fetch(const std::string& object, const std::string& name, Hdf5Id type, void* value) const;
  Hdf5Id file_ = -1;
};

}  // namespace fsi::io
