#include "libfsi/io/file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"

namespace fsi::io {
namespace {

bool write_all(int descriptor, Bytes bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return true;
}

}  // namespace

std::string temporary_of(const std::string& path) { return path + ".tmp"; }

void synchronise_directory(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

std::string replace_file(const std::string& path, std::initializer_list<Bytes> parts,
                         Durable durable) {
  const std::string temporary = temporary_of(path);
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) return std::strerror(errno);
  int reason = 0;
  const auto check = [&reason](bool good) {
    if (!good && reason == 0) reason = errno != 0 ? errno : EIO;
  };
  for (const Bytes part : parts)
    if (reason == 0) check(write_all(descriptor, part));
  if (reason == 0 && durable == Durable::yes) check(::fsync(descriptor) == 0);
  check(::close(descriptor) == 0);
  if (reason == 0) check(std::rename(temporary.c_str(), path.c_str()) == 0);
  if (reason != 0) {
    ::unlink(temporary.c_str());
    return std::strerror(reason);
  }
  if (durable == Durable::yes) synchronise_directory(path);
  return "";
}

Lock::Lock(const std::string& directory) {
  bool taken = false;
  if (rank() == 0) {
    const std::string file = directory + "/.lock";
    descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    taken =
        descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (taken) ::close(descriptor_), descriptor_ = -1;
  }
  require(all_of_ranks(!taken), "output directory \"" + directory +
                                    "\" is in use by another run; wait for its end or choose "
                                    "another -output_dir");
}

Lock::~Lock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace fsi::io
