#include "libfsi/io/hdf5.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <type_traits>

namespace fsi::io {
namespace {

static_assert(std::is_same_v<Hdf5Id, std::int64_t> && sizeof(hid_t) == sizeof(Hdf5Id));

/// An open HDF5 thing, closed at the end of its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool ok() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// HDF5 prints its stack of errors by itself; within a scope of this it does not.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// A text of fixed length; HDF5 knows none of length zero.
hid_t text_type(std::size_t length) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  if (type < 0 || H5Tset_size(type, std::max<std::size_t>(1, length)) < 0) return -1;
  return type;
}

}  // namespace

Hdf5Image::Hdf5Image(std::size_t expected) {
  const Quiet quiet;
  access_ = H5Pcreate(H5P_FILE_ACCESS);
  constexpr std::size_t spare = 1 << 16;  // for what is not data
  ok_ = access_ >= 0 && H5Pset_fapl_core(access_, expected + spare, 0) >= 0;
  if (ok_) file_ = H5Fcreate("image", H5F_ACC_TRUNC, H5P_DEFAULT, access_);
  ok_ = ok_ && file_ >= 0;
}

Hdf5Image::~Hdf5Image() {
  const Quiet quiet;
  if (file_ >= 0) H5Fclose(file_);
  if (access_ >= 0) H5Pclose(access_);
}

void Hdf5Image::group(const std::string& path) {
  if (!ok_) return;
  const Quiet quiet;
  const Handle made(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                    H5Gclose);
  ok_ = made.ok();
}

void Hdf5Image::write(const std::string& path, Hdf5Id type, std::span<const std::uint64_t> extent,
                      const void* data) {
  if (!ok_) return;
  const Quiet quiet;
  std::array<hsize_t, 2> dims{};
  std::copy(extent.begin(), extent.end(), dims.begin());
  const Handle space(H5Screate_simple(static_cast<int>(extent.size()), dims.data(), nullptr),
                     H5Sclose);
  ok_ = space.ok();
  if (!ok_) return;
  // No time of writing: the same values give the same bytes.
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  ok_ = creation.ok() && H5Pset_obj_track_times(creation, 0) >= 0;
  if (!ok_) return;
  const Handle set(H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                   H5Dclose);
  ok_ = set.ok();
  if (ok_ && dims[0] > 0) ok_ = H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0;
}

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
  if (!ok_) return;
  const Handle type(text_type(value.size()), H5Tclose);
  ok_ = type.ok();
  attach(object, name, type, 1, value.c_str());
}

void Hdf5Image::link(const std::string& path, const std::string& file) {
  if (!ok_) return;
  const Quiet quiet;
  ok_ = H5Lcreate_external(file.c_str(), path.c_str(), file_, path.c_str(), H5P_DEFAULT,
                           H5P_DEFAULT) >= 0;
}

std::span<const std::byte> Hdf5Image::bytes() {
  if (!ok_) return {};
  const Quiet quiet;
  void* handle = nullptr;
  ok_ = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
  // The handle of a file in memory is the address of its memory.
  ok_ = ok_ && size > 0 && H5Fget_vfd_handle(file_, access_, &handle) >= 0 && handle != nullptr;
  if (!ok_) return {};
  return {*static_cast<const std::byte**>(handle), static_cast<std::size_t>(size)};
}

Hdf5File::Hdf5File(const std::string& path) {
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
  const Handle held(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                    H5Aclose);
  if (!held.ok()) return false;
  const Handle type(H5Aget_type(held), H5Tclose);
  if (!type.ok() || H5Tget_class(type) != H5T_STRING) return false;
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(held, type, text.data()) < 0) return false;
  value = text.substr(0, text.find('\0'));
  return true;
}

}  // namespace fsi::io
