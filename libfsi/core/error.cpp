#include "libfsi/core/error.hpp"

#include <string_view>

namespace fsi {

std::string petsc_text(int code) {
  const char* general = nullptr;
  char* particular = nullptr;
  // The failure at hand is the one to report.
  PetscErrorMessage(code, &general, &particular);  // NOLINT: as above
  const bool said = particular != nullptr && *particular != '\0';
  std::string text = said ? particular : general != nullptr ? general : "unknown error";
  while (text.ends_with('\n') || text.ends_with(' ') || text.ends_with('.')) text.pop_back();
  return text;
}

void petsc_failed(int code, const char* call, const char* file, int line) {
  if (code == PETSC_ERR_MEM) throw std::bad_alloc();
  const std::string text = petsc_text(code);
  const bool of_user = std::string_view(call).find("FromOptions") != std::string_view::npos ||
                       code == PETSC_ERR_ARG_UNKNOWN_TYPE || code == PETSC_ERR_MISSING_FACTOR ||
                       code == PETSC_ERR_USER_INPUT || code == PETSC_ERR_SUP;
  if (of_user) throw Error(ErrorKind::input, "an option of PETSc is not valid: " + text);
  throw Error(ErrorKind::internal,
              std::string(file) + ":" + std::to_string(line) + ": " + call + " failed: " + text);
}

}  // namespace fsi
