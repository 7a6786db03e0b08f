#pragma once
// Errors: exceptions inside the library, exit codes outside. fsi::run (core/run.hpp) holds the last
// catch and turns a kind into the exit code of the program.

#include <petscsys.h>

#include <stdexcept>
#include <string>

namespace fsi {

/// The kind of an error, which is the exit code of the program.
enum class ErrorKind : int {
  input = 2,      ///< the user's options, mesh or files: names the culprit and the valid choices
  numerics = 3,   ///< a solve failed or a field is not finite, after all retries
  io = 4,         ///< a file could not be read or written
  internal = 70,  ///< a library call failed or an assumption of the code does not hold
};

/// The one exception type: a sentence for the user and its kind.
class Error : public std::runtime_error {
 public:
  /// what: a whole sentence, as the user reads it.
  Error(ErrorKind kind, const std::string& what) : std::runtime_error(what), kind_(kind) {}
  /// Its kind, which is the exit code of the program.
  ErrorKind kind() const noexcept { return kind_; }

 private:
  ErrorKind kind_;
};

/// User input: throws Error{input} with `sentence` unless ok.
inline void require(bool ok, const std::string& sentence) {
  if (!ok) throw Error(ErrorKind::input, sentence);
}

/// PETSc's own words for its latest failure, which returned `code`.
std::string petsc_text(int code);

/// Throws for a failed PETSc call: Error{input} where a word of the user caused it (no such solver,
/// one that cannot do what is asked, not a number), else Error{internal} that names the call.
[[noreturn]] void petsc_failed(int code, const char* call, const char* file, int line);

}  // namespace fsi

/// Every PETSc call goes through here: a non-zero code becomes an exception.
#define FSI_PETSC(...)                                                                    \
  do {                                                                                    \
    const PetscErrorCode fsi_code_ = __VA_ARGS__;                                         \
    if (fsi_code_ != 0) ::fsi::petsc_failed(fsi_code_, #__VA_ARGS__, __FILE__, __LINE__); \
  } while (false)

#ifdef NDEBUG
#define FSI_ASSERT(condition) static_cast<void>(0)
#else
/// Programming error: checked in debug builds only.
#define FSI_ASSERT(condition)                                                                \
  do {                                                                                       \
    if (!(condition))                                                                        \
      throw ::fsi::Error(::fsi::ErrorKind::internal, std::string(__FILE__) + ":" +           \
                                                         std::to_string(__LINE__) +          \
                                                         ": assertion failed: " #condition); \
  } while (false)
#endif
