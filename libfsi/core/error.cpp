#include "libfsi/core/error.hpp"

namespace fsi {

void petsc_failed(int code, const char* call, const char* file, int line) {
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);  // NOLINT: the failure at hand is the one to report
  throw Error(Kind::internal, std::string(file) + ":" + std::to_string(line) + ": " + call +
                                  " failed: " + (text != nullptr ? text : "unknown error"));
}

}  // namespace fsi
