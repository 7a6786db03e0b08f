#pragma once
// Files that are whole or not there, and a directory that one run has for itself.

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>

namespace fsi::io {

/// A stretch of bytes.
using Bytes = std::span<const std::byte>;

/// Whether a file must survive a crash of the machine, or only of the program.
enum class Durable : bool { no, yes };

/// One rank. Puts `parts`, one after the other, where `path` is: through a temporary file beside it
/// and a rename, so that a reader sees the old content or the new. Durable: synchronised with the
/// disk, the directory too. Returns the reason it failed, "" when it did not; then `path` is as it
/// was and the temporary file is gone.
std::string replace_file(const std::string& path, std::initializer_list<Bytes> parts,
                         Durable durable);

/// The name of the temporary file of replace_file.
std::string temporary_of(const std::string& path);

/// Makes a rename in the directory of `path` last. A file system that cannot is left alone.
void synchronise_directory(const std::string& path);

/// An output directory held by this run. Invariant: no other Lock holds it; the kernel releases it
/// when the program ends in any way.
class Lock {
 public:
  /// Collective. Errors: Error{input} when another run writes to the directory. A file system
  /// without locks is taken as it is.
  explicit Lock(const std::string& directory);
  ~Lock();
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace fsi::io
