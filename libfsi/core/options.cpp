#include "libfsi/core/options.hpp"

#include <petscsys.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "libfsi/core/arguments.hpp"
#include "libfsi/core/error.hpp"
#include "libfsi/core/option_names.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/core/version.hpp"

namespace fsi {
namespace {

/// The shortest text that reads back to the same value; without an exponent where it is of an
/// everyday size.
std::string number(Real value) {
  const Real size = std::abs(value);
  const bool everyday = size == 0 || (size >= 1e-4 && size < 1e16);
  std::array<char, 64> text{};
  const auto [end, error] =
      std::to_chars(text.begin(), text.end(), value,
                    everyday ? std::chars_format::fixed : std::chars_format::scientific);
  FSI_ASSERT(error == std::errc{});
  return {text.data(), end};
}

/// The options that were given, from all sources: name and value.
std::vector<std::pair<std::string, std::string>> all_given() {
  char* text = nullptr;
  FSI_PETSC(PetscOptionsGetAll(nullptr, &text));
  std::istringstream stream(text);
  FSI_PETSC(PetscFree(text));
  std::vector<std::pair<std::string, std::string>> list;
  for (std::string word; stream >> word;) {
    const bool name =
        word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])) != 0;
    if (name)
      list.emplace_back(word.substr(1), "");
    else if (!list.empty())
      list.back().second += (list.back().second.empty() ? "" : " ") + word;
  }
  return list;
}

/// Whether the option of that very name was given. PETSc finds -a_b where it looks for -a_2_b.
bool stands(const std::string& name) {
  const std::string plain = plain_name(name);
  return std::ranges::any_of(all_given(),
                             [&](const auto& one) { return plain_name(one.first) == plain; });
}

/// The raw text of an option; nothing when it is not given.
std::optional<std::string> raw(const std::string& name) {
  if (!stands(name)) return std::nullopt;
  char text[4096] = "";
  PetscBool given = PETSC_FALSE;
  FSI_PETSC(
      PetscOptionsGetString(nullptr, nullptr, ("-" + name).c_str(), text, sizeof text, &given));
  if (given == PETSC_FALSE) return std::nullopt;
  require(std::strlen(text) + 1 < sizeof text,
          "option -" + name + " has more than 4094 characters; give a shorter value");
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

std::string with_unit(const Spec& spec) {
  return spec.help + (spec.unit.empty() ? "" : " [" + spec.unit + "]");
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

/// Names that nobody has read yet, from the database.
std::vector<std::string> unread() {
  PetscInt n = 0;
  char **names = nullptr, **values = nullptr;
  FSI_PETSC(PetscOptionsLeftGet(nullptr, &n, &names, &values));
  std::vector<std::string> list(names, names + n);
  FSI_PETSC(PetscOptionsLeftRestore(nullptr, &n, &names, &values));
  return list;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

}  // namespace

void set_option(const std::string& name, const std::string& value) {
  FSI_PETSC(PetscOptionsSetValue(nullptr, ("-" + name).c_str(), value.c_str()));
}

Options::Options(std::string program, const std::string& purpose) : program_(std::move(program)) {
  PetscBool help = PETSC_FALSE;
  FSI_PETSC(PetscOptionsHasName(nullptr, nullptr, "-help", &help));
  help_ = help == PETSC_TRUE;
  case_folder_ = raw("case_folder").value_or("");
  if (help_)
    FSI_PETSC(
        PetscPrintf(comm(),
                    "%s: %s\n\n  %s%s [-OPTION VALUE ...]\n\n"
                    "Keys of the file join with _; the command line wins. Solvers take PETSc's "
                    "options:\n-p_ksp_monitor, -u_ksp_rtol 1e-9, -log_view ...\n"
                    "-version tells version and commit.\n\n",
                    program_.c_str(), purpose.c_str(), program_.c_str(),
                    // What comes with a command and its file takes no case besides.
                    program_.find(' ') == std::string::npos ? " [CASE.yaml]" : ""));
}

void Options::record(Entry entry) {
  const auto same = [&](const Entry& other) { return other.name == entry.name; };
  if (std::any_of(entries_.begin(), entries_.end(), same)) return;
  if (help_)
    FSI_PETSC(PetscPrintf(comm(), "  -%-27s %s\n%30s %s%sdefault %s\n", entry.name.c_str(),
                          entry.help.c_str(), "", entry.range.c_str(),
                          entry.range.empty() ? "" : "; ",
                          entry.fallback.empty() ? "none" : entry.fallback.c_str()));
  entries_.push_back(std::move(entry));
}

Real Options::real(const std::string& name, Real fallback, const Spec& spec) {
  const auto text = raw(name);
  const auto shown = [](Real value) { return std::isnan(value) ? "" : number(value); };
  require(text || help_ || !std::isnan(fallback),
          "option -" + name + " is missing: " + with_unit(spec));
  const Real value = text ? parse(name, *text, spec) : fallback;
  record({name, shown(value), shown(fallback), with_unit(spec), range(spec)});
  return value;
}

int Options::integer(const std::string& name, int fallback, const Spec& spec) {
  const auto text = raw(name);
  const Real value = text ? parse(name, *text, spec) : fallback;
  require(value == std::floor(value) && std::abs(value) <= std::numeric_limits<int>::max(),
          "option -" + name + ": \"" + text.value_or("") + "\" is not a whole number");
  record({name, number(value), number(fallback), with_unit(spec), "whole number, " + range(spec)});
  return static_cast<int>(value);
}

bool Options::flag(const std::string& name, bool fallback, const std::string& help) {
  const auto text = raw(name);
  std::string word = text.value_or("");  // in small letters: YAML has True and FALSE too
  std::ranges::transform(word, word.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto one_of = [&](std::initializer_list<const char*> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  const bool yes = text ? one_of({"", "true", "yes", "on", "1"}) : fallback;
  require(
      !text || yes || one_of({"false", "no", "off", "0"}),
      "option -" + name + ": \"" + text.value_or("") + "\" is not valid; choose from: true, false");
  record({name, yes ? "true" : "false", fallback ? "true" : "false", help, "true or false"});
  return yes;
}

std::string Options::text(const std::string& name, const std::string& fallback,
                          const std::string& help) {
  const auto text = raw(name);
  require(!text || !text->empty(), "option -" + name + " needs a value: " + help);
  record({name, text.value_or(fallback), fallback, help, ""});
  return text.value_or(fallback);
}

std::string Options::text_or_file(const std::string& name, const std::string& fallback,
                                  const std::string& help) {
  const auto given = raw(name);
  require(!given || !given->empty(), "option -" + name + " needs a value: " + help);
  std::string value = given.value_or(fallback);
  const std::filesystem::path folder(case_folder_);
  for (const auto& place : {std::filesystem::path(value), folder / value})
    if (std::filesystem::is_regular_file(place)) {
      value = std::filesystem::absolute(place).lexically_normal().string();
      break;
    }
  record({name, value, fallback, help, ""});
  return value;
}

std::string Options::choice(const std::string& name, const std::string& fallback,
                            const std::vector<std::string>& valid, const std::string& help) {
  std::string value = raw(name).value_or(fallback);
  if (std::ranges::find(valid, value) == valid.end()) {
    const std::string near = nearest(value, valid, value.size() / 2);
    throw Error(ErrorKind::input, "option -" + name + ": \"" + value + "\" is not valid; " +
                                      (near.empty() ? "" : "nearest is " + near + "; ") +
                                      "choose from: " + joined(valid));
  }
  record({name, value, fallback, help, "one of " + joined(valid)});
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
  const auto list = [](const Vec3& v) {
    return number(v.x) + "," + number(v.y) + "," + number(v.z);
  };
  record({name, list(value), list(fallback), with_unit(spec), "x,y,z, each " + range(spec)});
  return value;
}

std::vector<std::string> Options::list(const std::string& name, const std::string& help) {
  const auto text = raw(name);
  std::vector<std::string> items = text ? split(*text) : std::vector<std::string>{};
  require(!text || !items.empty(), "option -" + name + " needs a value: " + help);
  // The word that -help has for an empty list.
  if (items == std::vector<std::string>{"none"}) items.clear();
  for (const std::string& item : items)
    require(!item.empty(), "option -" + name + ": \"" + *text + "\" has an empty item");
  record({name, items.empty() ? "" : *text, "", help, "a list: a,b,..."});
  return items;
}

bool Options::given(const std::string& name) const {
  if (!stands(name)) return false;
  PetscBool has = PETSC_FALSE;
  FSI_PETSC(PetscOptionsHasName(nullptr, nullptr, ("-" + name).c_str(), &has));
  return has == PETSC_TRUE;
}

std::vector<std::string> Options::names(const std::string& begin, const std::string& end) const {
  std::set<std::string> found;
  for (const auto& [name, value] : all_given())
    if (name.starts_with(begin) && name.ends_with(end) && name.size() > begin.size() + end.size())
      found.insert(name.substr(begin.size(), name.size() - begin.size() - end.size()));
  return {found.begin(), found.end()};
}

void Options::check_unknown() const {
  std::vector<std::string> valid;
  for (const Entry& entry : entries_) valid.push_back(entry.name);
  std::string sentence;
  for (const std::string& name : unread()) {
    if (of_petsc(name) || of_solver(name)) continue;
    sentence += (sentence.empty() ? "unknown option -" : ", -") + name;
    const bool block = std::ranges::any_of(
        valid, [&, &key = name](const std::string& v) { return v.starts_with(key + "_"); });
    if (block)
      sentence += " (a block of a case file takes options, " + name + ": {...})";
    else if (!valid.empty())
      sentence += " (nearest is -" + nearest_option(name, valid) + ")";
  }
  require(sentence.empty(), sentence + "; " + program_ + " -help lists all");
}

void Options::check_unused() const {
  std::string list;
  for (const std::string& name : unread())
    if (!of_petsc(name)) list += (list.empty() ? "-" : ", -") + name;
  require(list.empty(), "option " + list +
                            " was read by nobody: no such solver option, or it does not apply "
                            "to this run");
}

std::map<std::string, std::string> Options::values() const {
  std::map<std::string, std::string> values;
  for (const Entry& entry : entries_)
    if (!entry.value.empty()) values[entry.name] = entry.value;
  return values;
}

std::string Options::yaml() const {
  std::string text = "# " + program_ + ": every option as resolved; this file repeats the run\n";
  text += "# libfsi " + version() + ", commit " + commit() + "\n";
  for (const Entry& entry : entries_) {
    const bool went_on = entry.name == "restart";  // that run is repeated from its start
    if (!entry.value.empty())
      text += entry.name + ": " + quoted(went_on ? "false" : entry.value) + "\n";
  }
  bool headed = false;
  for (const auto& [name, value] : all_given()) {
    const std::string plain = plain_name(name);  // a solid may have capitals in its name
    const auto same = [&](const Entry& entry) { return plain_name(entry.name) == plain; };
    if (std::any_of(entries_.begin(), entries_.end(), same) || plain.starts_with("options_file") ||
        plain == "help" || plain == "case_folder")
      continue;
    if (!headed) text += "# options of PETSc\n";
    headed = true;
    text += name + ": " + quoted(value) + "\n";
  }
  for (const char* file : {"petscrc", ".petscrc"})
    if (std::filesystem::exists(file))
      text += "# with those of the file " + std::string(file) + " in the working directory\n";
  return text;
}

}  // namespace fsi
