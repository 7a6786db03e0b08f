#include "libfsi/io/hdf5.hpp"

#include <fcntl.h>
#include <hdf5.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <type_traits>

#include "libfsi/core/hdf5_handle.hpp"

namespace fsi::io {
namespace {

static_assert(std::is_same_v<Hdf5Id, std::int64_t> && sizeof(hid_t) == sizeof(Hdf5Id));

using Handle = Hdf5Handle;
using Quiet = Hdf5Quiet;

/// A text of fixed length; HDF5 has none of length zero.
hid_t text_type(std::size_t length) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  if (type < 0 || H5Tset_size(type, std::max<std::size_t>(1, length)) < 0) return -1;
  return type;
}

/// An attribute has less than 64 KiB, so a longer text is several: NAME, NAME.1, NAME.2 ...
constexpr std::size_t longest = 60'000;

std::string name_of_part(const std::string& name, std::size_t i) {
  return i == 0 ? name : name + "." + std::to_string(i);
}

/// At the end of the program HDF5 would tidy up what a failed write left open, and falls over it.
void leave_the_end_alone() { H5dont_atexit(); }

}  // namespace

Hdf5Image::Hdf5Image() {
  leave_the_end_alone();
  const Quiet quiet;
  memory_ = ::memfd_create("fsi", MFD_CLOEXEC);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // The driver of C streams: the other one looks for the name of a file in memory on the disk.
  ok_ = memory_ >= 0 && access.ok() && H5Pset_fapl_stdio(access) >= 0 &&
        H5Pset_file_locking(access, 0, 1) >= 0;
  const std::string path = "/proc/self/fd/" + std::to_string(memory_);
  if (ok_) file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  ok_ = ok_ && file_ >= 0;
}

Hdf5Image::~Hdf5Image() {
  const Quiet quiet;
  if (file_ >= 0 && (ok_ || refused_))
    H5Fclose(file_);  // what a failed write left is not to be written again
  if (memory_ >= 0) ::close(memory_);
}

void Hdf5Image::group(const std::string& path) {
  if (!ok_) return;
  const Quiet quiet;
  const Handle made(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                    H5Gclose);
  ok_ = made.ok();
}

bool Hdf5Image::has_room(std::uint64_t size, std::span<const std::uint64_t> extent) {
  constexpr std::uint64_t beside = 2048;  // what HDF5 writes of a set itself
  for (const std::uint64_t n : extent) size *= n;
  reserved_ += size + beside;
  refused_ = ::ftruncate(memory_, static_cast<off_t>(reserved_)) != 0;
  return !refused_;
}

std::uint64_t Hdf5Image::write(const std::string& path, Hdf5Id type,
                               std::span<const std::uint64_t> extent, const void* data) {
  if (!ok_) return 0;
  const Quiet quiet;
  std::array<hsize_t, 2> dims{};
  std::copy(extent.begin(), extent.end(), dims.begin());
  const Handle space(H5Screate_simple(static_cast<int>(extent.size()), dims.data(), nullptr),
                     H5Sclose);
  ok_ = space.ok() && has_room(H5Tget_size(type), extent);
  if (!ok_) return 0;
  // No time of writing: the same values give the same bytes. Nothing but the values is written.
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  ok_ = creation.ok() && H5Pset_obj_track_times(creation, 0) >= 0 &&
        H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY) >= 0 &&
        H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER) >= 0;
  if (!ok_) return 0;
  const Handle set(H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                   H5Dclose);
  ok_ = set.ok();
  if (!ok_ || dims[0] == 0) return 0;
  if (data != nullptr) ok_ = H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0;
  const haddr_t offset = H5Dget_offset(set);
  ok_ = ok_ && offset != HADDR_UNDEF;
  return ok_ ? offset : 0;
}

template <class T>
std::uint64_t Hdf5Image::room(const std::string& path, std::uint64_t rows, int width) {
  const std::array<std::uint64_t, 2> extent{rows, static_cast<std::uint64_t>(width)};
  const hid_t type = std::is_same_v<T, Real>           ? H5T_NATIVE_DOUBLE
                     : std::is_same_v<T, std::int64_t> ? H5T_NATIVE_INT64
                                                       : H5T_NATIVE_UINT8;
  return write(path, type, {extent.data(), width > 1 ? 2U : 1U}, nullptr);
}
template std::uint64_t Hdf5Image::room<Real>(const std::string&, std::uint64_t, int);
template std::uint64_t Hdf5Image::room<std::int64_t>(const std::string&, std::uint64_t, int);
template std::uint64_t Hdf5Image::room<std::uint8_t>(const std::string&, std::uint64_t, int);

void Hdf5Image::dataset(const std::string& path, std::span<const Real> values, int width) {
  const auto w = static_cast<std::uint64_t>(width);
  const std::array<std::uint64_t, 2> extent{values.size() / w, w};
  write(path, H5T_NATIVE_DOUBLE, {extent.data(), width > 1 ? 2U : 1U}, values.data());
}

void Hdf5Image::dataset(const std::string& path, std::span<const std::int64_t> values) {
  write(path, H5T_NATIVE_INT64, std::array<std::uint64_t, 1>{values.size()}, values.data());
}

void Hdf5Image::dataset(const std::string& path, std::span<const std::uint8_t> values) {
  write(path, H5T_NATIVE_UINT8, std::array<std::uint64_t, 1>{values.size()}, values.data());
}

void Hdf5Image::attach(const std::string& object, const std::string& name, Hdf5Id type,
                       std::size_t count, const void* data) {
  if (!ok_) return;
  const Quiet quiet;
  const hsize_t dim = count;
  const Handle space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &dim, nullptr),
                     H5Sclose);
  const Handle owner(H5Oopen(file_, object.c_str(), H5P_DEFAULT), H5Oclose);
  ok_ = space.ok() && owner.ok();
  if (!ok_) return;
  const Handle made(H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                    H5Aclose);
  ok_ = made.ok() && H5Awrite(made, type, data) >= 0;
}

void Hdf5Image::attribute(const std::string& object, const std::string& name, Real value) {
  attach(object, name, H5T_NATIVE_DOUBLE, 1, &value);
}

void Hdf5Image::attribute(const std::string& object, const std::string& name,
                          std::span<const std::int64_t> values) {
  attach(object, name, H5T_NATIVE_INT64, values.size(), values.data());
}

void Hdf5Image::attribute(const std::string& object, const std::string& name,
                          const std::string& value) {
  for (std::size_t i = 0; ok_ && (i == 0 || i * longest < value.size()); ++i) {
    const std::string part = value.substr(i * longest, longest);
    const Handle type(text_type(part.size()), H5Tclose);
    ok_ = type.ok();
    attach(object, name_of_part(name, i), type, 1, part.c_str());
  }
}

void Hdf5Image::link(const std::string& path, const std::string& file) {
  if (!ok_) return;
  const Quiet quiet;
  ok_ = H5Lcreate_external(file.c_str(), path.c_str(), file_, path.c_str(), H5P_DEFAULT,
                           H5P_DEFAULT) >= 0;
}

bool Hdf5Image::close() {
  const Quiet quiet;
  // A file that cannot be flushed cannot be closed either.
  ok_ = ok_ && file_ >= 0 && H5Fflush(file_, H5F_SCOPE_LOCAL) >= 0 && H5Fclose(file_) >= 0;
  if (refused_) H5Fclose(file_);
  file_ = -1;
  const off_t end = ::lseek(memory_, 0, SEEK_END);
  ok_ = ok_ && end > 0;
  size_ = ok_ ? static_cast<std::uint64_t>(end) : 0;
  return ok_;
}

bool Hdf5Image::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  return ::pread(memory_, bytes.data(), bytes.size(), static_cast<off_t>(offset)) ==
         static_cast<ssize_t>(bytes.size());
}

Hdf5File::Hdf5File(const std::string& path) {
  leave_the_end_alone();
  const Quiet quiet;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Not every shared file system has locks, and nobody changes a file once it has its name.
  if (!access.ok() || H5Pset_file_locking(access, 0, 1) < 0) return;
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
}

Hdf5File::~Hdf5File() {
  const Quiet quiet;
  if (file_ >= 0) H5Fclose(file_);
}

bool Hdf5File::dataset(const std::string& path, std::span<Real> values) const {
  const Quiet quiet;
  const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.ok()) return false;
  const Handle space(H5Dget_space(set), H5Sclose);
  if (!space.ok() || H5Sget_simple_extent_npoints(space) != static_cast<hssize_t>(values.size()))
    return false;
  return values.empty() ||
         H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0;
}

bool Hdf5File::dataset(const std::string& path, std::uint64_t rows, std::uint64_t first,
                       std::span<Real> values, int width) const {
  const Quiet quiet;
  const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.ok()) return false;
  const Handle space(H5Dget_space(set), H5Sclose);
  const auto w = static_cast<hsize_t>(width);
  const int rank = width > 1 ? 2 : 1;
  std::array<hsize_t, 2> dims{0, 1};
  if (!space.ok() || H5Sget_simple_extent_ndims(space) != rank ||
      H5Sget_simple_extent_dims(space, dims.data(), nullptr) != rank || dims[0] != rows ||
      dims[1] != w)
    return false;
  if (values.empty()) return true;
  const std::array<hsize_t, 2> start{first, 0}, count{values.size() / w, w};
  const Handle memory(H5Screate_simple(rank, count.data(), nullptr), H5Sclose);
  return memory.ok() &&
         H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >=
             0 &&
         H5Dread(set, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()) >= 0;
}

bool Hdf5File::fetch(const std::string& object, const std::string& name, Hdf5Id type,
                     void* value) const {
  const Quiet quiet;
  const Handle attribute(
      H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute.ok() && H5Aread(attribute, type, value) >= 0;
}

bool Hdf5File::attribute(const std::string& object, const std::string& name, Real& value) const {
  return fetch(object, name, H5T_NATIVE_DOUBLE, &value);
}

bool Hdf5File::attribute(const std::string& object, const std::string& name,
                         std::int64_t& value) const {
  return fetch(object, name, H5T_NATIVE_INT64, &value);
}

bool Hdf5File::attribute(const std::string& object, const std::string& name,
                         std::string& value) const {
  const Quiet quiet;
  std::string all;
  for (std::size_t i = 0;; ++i) {
    const Handle held(H5Aopen_by_name(file_, object.c_str(), name_of_part(name, i).c_str(),
                                      H5P_DEFAULT, H5P_DEFAULT),
                      H5Aclose);
    if (!held.ok() && i > 0) break;
    if (!held.ok()) return false;
    const Handle type(H5Aget_type(held), H5Tclose);
    if (!type.ok() || H5Tget_class(type) != H5T_STRING) return false;
    std::string text(H5Tget_size(type), '\0');
    if (H5Aread(held, type, text.data()) < 0) return false;
    all += text.substr(0, text.find('\0'));
  }
  value = all;
  return true;
}

}  // namespace fsi::io
