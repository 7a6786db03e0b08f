#include "libfsi/operators/linear_system_options.hpp"

#include <petscksp.h>

#include <cmath>
#include <cstdlib>
#include <optional>

#include "libfsi/core/error.hpp"

namespace fsi {
namespace {

std::optional<std::string> given(const std::string& name) {
  char text[256] = "";
  PetscBool found = PETSC_FALSE;
  FSI_PETSC(
      PetscOptionsGetString(nullptr, nullptr, ("-" + name).c_str(), text, sizeof text, &found));
  return found == PETSC_TRUE ? std::optional<std::string>(text) : std::nullopt;
}

std::string sentence(const std::string& name, const std::string& text) {
  return "option -" + name + ": \"" + text + "\" is not valid; ";
}

void check_type(const std::string& name, PetscFunctionList list) {
  const auto text = given(name);
  if (!text) return;
  const char** names = nullptr;
  int n = 0;
  FSI_PETSC(PetscFunctionListGet(list, &names, &n));
  std::string all;
  bool found = false;
  for (int i = 0; i < n && names[i] != nullptr; ++i) {  // the last one may be null
    found = found || *text == names[i];
    all += (i > 0 ? ", " : "") + std::string(names[i]);
  }
  FSI_PETSC(PetscFree(names));
  require(found, sentence(name, *text) + "there are: " + all);
}

/// Whether the option, where it is given, is a number that `valid` takes.
template <class Valid>
void check_number(const std::string& name, const Valid& valid, const std::string& range) {
  const auto text = given(name);
  if (!text) return;
  char* end = nullptr;
  const double value = std::strtod(text->c_str(), &end);
  const bool number = !text->empty() && *end == '\0' && std::isfinite(value);
  require(number && valid(value), sentence(name, *text) + "expected " + range);
}

}  // namespace

void check_solver_options(const std::string& prefix) {
  check_type(prefix + "ksp_type", KSPList);
  check_type(prefix + "pc_type", PCList);
  check_number(
      prefix + "ksp_rtol", [](double v) { return v > 0 && v < 1; }, "0 < value < 1");
  check_number(
      prefix + "ksp_atol", [](double v) { return v >= 0; }, "value >= 0");
  check_number(
      prefix + "ksp_divtol", [](double v) { return v > 1; }, "value > 1");
  check_number(
      prefix + "ksp_max_it", [](double v) { return v >= 1 && v < 1e9 && v == std::floor(v); },
      "a whole number, value >= 1");
}

}  // namespace fsi
