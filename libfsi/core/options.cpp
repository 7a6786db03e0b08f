#include "libfsi/core/options.hpp"

#include <petscsys.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <sstream>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"

namespace fsi {
namespace {

std::string number(Real value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  if (std::strtod(text, nullptr) == value) {
    for (int digits = 1; digits < 17; ++digits) {
      char shorter[32];
      std::snprintf(shorter, sizeof shorter, "%.*g", digits, value);
      if (std::strtod(shorter, nullptr) == value) return shorter;
    }
  }
  return text;
}

/// The raw text of an option; nothing when it is not given.
std::optional<std::string> raw(const std::string& name) {
  char text[4096] = "";
  PetscBool given = PETSC_FALSE;
  FSI_PETSC(
      PetscOptionsGetString(nullptr, nullptr, ("-" + name).c_str(), text, sizeof text, &given));
  if (given == PETSC_FALSE) return std::nullopt;
  return std::string(text);
}

std::string range(const Spec& spec) {
  if (spec.positive)
    return spec.max < std::numeric_limits<Real>::infinity() ? "0 < value <= " + number(spec.max)
                                                            : "value > 0";
  const bool low = std::isfinite(spec.min), high = std::isfinite(spec.max);
  if (low && high) return number(spec.min) + " <= value <= " + number(spec.max);
  if (low) return "value >= " + number(spec.min);
  if (high) return "value <= " + number(spec.max);
  return "any finite number";
}

Real parse(const std::string& name, const std::string& text, const Spec& spec) {
  const std::string sentence = "option -" + name + ": \"" + text + "\" is not valid; expected " +
                               range(spec) + (spec.unit.empty() ? "" : " [" + spec.unit + "]");
  char* end = nullptr;
  const Real value = std::strtod(text.c_str(), &end);
  require(!text.empty() && *end == '\0' && std::isfinite(value), sentence);
  require(value >= spec.min && value <= spec.max && (!spec.positive || value > 0), sentence);
  return value;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> items;
  std::stringstream stream(text);
  for (std::string item; std::getline(stream, item, ',');) {
    const auto blank = [](unsigned char c) { return std::isspace(c) != 0; };
    item.erase(item.begin(), std::find_if_not(item.begin(), item.end(), blank));
    item.erase(std::find_if_not(item.rbegin(), item.rend(), blank).base(), item.end());
    items.push_back(item);
  }
  return items;
}

/// Edit distance [Levenshtein66].
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t up = row[j];
      row[j] = std::min({up + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = up;
    }
  }
  return row[b.size()];
}

std::string joined(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : ", ") + item;
  return text;
}

/// Names that nobody has read yet, from the database.
std::vector<std::string> unread() {
  PetscInt n = 0;
  char **names = nullptr, **values = nullptr;
  FSI_PETSC(PetscOptionsLeftGet(nullptr, &n, &names, &values));
  std::vector<std::string> list(names, names + n);
  FSI_PETSC(PetscOptionsLeftRestore(nullptr, &n, &names, &values));
  return list;
}

/// Options of PETSc itself, which it reads when it needs them: solver prefixes, logging, memory.
bool of_petsc(const std::string& name) {
  for (const char* prefix : {"p_",
                             "u_",
                             "ksp_",
                             "pc_",
                             "mat_",
                             "vec_",
                             "log_",
                             "malloc",
                             "options_",
                             "petsc",
                             "use_",
                             "fp_trap",
                             "on_error",
                             "start_in_debugger",
                             "info",
                             "citations",
                             "error_output",
                             "memory_",
                             "viewer_",
                             "skip_petscrc",
                             "help",
                             "dm_",
                             "sf_",
                             "mumps_",
                             "history",
                             "debug_",
                             "stop_for_debugger",
                             "display",
                             "version"})
    if (name.starts_with(prefix)) return true;
  return false;
}

}  // namespace

Options::Options(std::string program, std::string purpose) : program_(std::move(program)) {
  PetscBool help = PETSC_FALSE;
  FSI_PETSC(PetscOptionsHasName(nullptr, nullptr, "-help", &help));
  help_ = help == PETSC_TRUE;
  if (help_)
    FSI_PETSC(
        PetscPrintf(comm(), "%s: %s\n\noptions (default):\n", program_.c_str(), purpose.c_str()));
}

const Options::Entry& Options::record(Entry entry) {
  if (help_)
    FSI_PETSC(PetscPrintf(comm(), "  -%-28s (%s)\n      %s\n", entry.name.c_str(),
                          entry.value.c_str(), entry.help.c_str()));
  return entries_.emplace_back(std::move(entry));
}

Real Options::real(const std::string& name, Real fallback, const Spec& spec) {
  const auto text = raw(name);
  const Real value = text ? parse(name, *text, spec) : fallback;
  record({name, number(value),
          spec.help + (spec.unit.empty() ? "" : " [" + spec.unit + "]") + "; " + range(spec)});
  return value;
}

int Options::integer(const std::string& name, int fallback, const Spec& spec) {
  const auto text = raw(name);
  const Real value = text ? parse(name, *text, spec) : fallback;
  require(value == std::floor(value) && std::abs(value) < 2e9,
          "option -" + name + ": \"" + text.value_or("") + "\" is not a whole number");
  record({name, number(value), spec.help + "; whole number, " + range(spec)});
  return static_cast<int>(value);
}

bool Options::flag(const std::string& name, bool fallback, const std::string& help) {
  const std::string value = choice(name, fallback ? "true" : "false",
                                   {"true", "false", "1", "0", "yes", "no", "on", "off", ""}, help);
  return value == "true" || value == "1" || value == "yes" || value == "on" || value.empty();
}

std::string Options::text(const std::string& name, const std::string& fallback,
                          const std::string& help) {
  const auto given = raw(name);
  require(!given || !given->empty(), "option -" + name + " needs a value: " + help);
  record({name, given.value_or(fallback), help});
  return given.value_or(fallback);
}

std::string Options::choice(const std::string& name, const std::string& fallback,
                            const std::vector<std::string>& valid, const std::string& help) {
  const std::string value = raw(name).value_or(fallback);
  require(std::find(valid.begin(), valid.end(), value) != valid.end(),
          "option -" + name + ": \"" + value + "\" is not valid; choose from: " + joined(valid));
  record({name, value, help + "; one of " + joined(valid)});
  return value;
}

Vec3 Options::vec3(const std::string& name, const Vec3& fallback, const Spec& spec) {
  const auto text = raw(name);
  Vec3 value = fallback;
  if (text) {
    const std::vector<std::string> items = split(*text);
    require(items.size() == 3, "option -" + name + ": \"" + *text + "\" has " +
                                   std::to_string(items.size()) +
                                   " numbers; expected three, x,y,z");
    for (int i = 0; i < 3; ++i) value[i] = parse(name, items[static_cast<std::size_t>(i)], spec);
  }
  record({name, number(value.x) + "," + number(value.y) + "," + number(value.z),
          spec.help + (spec.unit.empty() ? "" : " [" + spec.unit + "]")});
  return value;
}

std::vector<std::string> Options::list(const std::string& name, const std::string& help) {
  const auto text = raw(name);
  const std::vector<std::string> items = text ? split(*text) : std::vector<std::string>{};
  for (const std::string& item : items)
    require(!item.empty(), "option -" + name + ": \"" + *text + "\" has an empty item");
  record({name, text.value_or(""), help});
  return items;
}

bool Options::given(const std::string& name) const {
  PetscBool has = PETSC_FALSE;
  FSI_PETSC(PetscOptionsHasName(nullptr, nullptr, ("-" + name).c_str(), &has));
  return has == PETSC_TRUE;
}

void Options::check_unknown() const {
  std::string sentence;
  for (const std::string& name : unread()) {
    if (of_petsc(name)) continue;
    const auto nearest =
        std::min_element(entries_.begin(), entries_.end(), [&](const Entry& a, const Entry& b) {
          return distance(name, a.name) < distance(name, b.name);
        });
    sentence += (sentence.empty() ? "unknown option -" : ", -") + name;
    if (nearest != entries_.end()) sentence += " (nearest is -" + nearest->name + ")";
  }
  require(sentence.empty(), sentence + "; " + program_ + " -help lists all");
}

void Options::check_unused() const {
  const std::vector<std::string> names = unread();
  std::string list;
  for (const std::string& name : names)
    if (!name.starts_with("log_") && !name.starts_with("malloc") &&
        !name.starts_with("options_left"))
      list += (list.empty() ? "-" : ", -") + name;
  require(list.empty(), "option " + list +
                            " was read by nobody: no such solver option, or it does not apply "
                            "to this run");
}

std::string Options::yaml() const {
  std::string text = "# " + program_ + ": every option as resolved; this file repeats the run\n";
  for (const Entry& entry : entries_)
    if (!entry.value.empty()) text += entry.name + ": \"" + entry.value + "\"\n";
  return text;
}

}  // namespace fsi
