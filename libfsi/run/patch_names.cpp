#include "libfsi/run/patch_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "libfsi/core/error.hpp"
#include "libfsi/core/option_names.hpp"

namespace fsi {

const std::vector<std::string> patch_types{"wall",       "symmetry",  "pressure", "resistance",
                                           "windkessel", "flow_rate", "velocity"};

namespace {

/// Each key with the types of patch that take it.
const std::vector<std::array<std::string, 2>> keys_known{
    {"type", "wall symmetry pressure resistance windkessel flow_rate velocity"},
    {"wall_velocity", "wall"},
    {"flow_rate", "flow_rate"},
    {"profile", "flow_rate"},
    {"velocity", "velocity"},
    {"velocity_file", "velocity"},
    {"velocity_factor", "velocity"},
    {"pressure", "pressure resistance windkessel"},
    {"period", "pressure resistance windkessel flow_rate velocity"},
    {"resistance", "resistance windkessel"},
    {"distal_resistance", "windkessel"},
    {"capacitance", "windkessel"},
    {"stored_pressure", "windkessel"}};

std::vector<std::string> keys_of(const std::string& type) {
  std::vector<std::string> keys;
  for (const auto& [key, takers] : keys_known)
    if ((" " + takers + " ").find(" " + type + " ") != std::string::npos) keys.push_back(key);
  return keys;
}

bool is_key(const std::string& text) {
  return std::ranges::any_of(keys_known, [&](const auto& known) { return known[0] == text; });
}

/// "; did you mean ...?", where a word, or what it has before an underscore, is near.
std::string meant(const std::string& word, const std::vector<std::string>& valid) {
  const std::string near = nearest_before_underscore(word + "_", valid, 2);
  return near.empty() ? "" : "; did you mean " + near + "?";
}

std::vector<std::string> names_of(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const Patch& patch : mesh.patches) names.push_back(patch.name);
  return names;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// What `text` has after the name of a patch and an underscore; "" where it is not of that patch.
/// Small letters: PETSc finds its options by either case.
std::string key_of(const std::string& text, const std::string& patch) {
  const std::string begin = lower(patch) + "_", whole = lower(text);
  return whole.starts_with(begin) ? whole.substr(begin.size()) : "";
}

/// The longest name of a patch that `text` begins with, of those whose rest is a key if there are
/// any; "" where it is of none.
std::string patch_of(const std::string& text, const Mesh& mesh) {
  std::string found;
  bool sure = false;
  for (const Patch& patch : mesh.patches) {
    const std::string key = key_of(text, patch.name);
    const bool known = is_key(key);
    if (key.empty() || known < sure) continue;
    if (known > sure || patch.name.size() > found.size()) found = patch.name;
    sure = known;
  }
  return found;
}

}  // namespace

void check_patch_names(const Options& options, const Mesh& mesh) {
  for (const std::string& name : names_of(mesh)) {
    const auto fits = [](unsigned char c) {
      return std::isalnum(c) != 0 || c > 127 || c == '_' || c == '-' || c == '.' || c == '+';
    };
    require(std::ranges::all_of(name, fits),
            "patch \"" + name + "\" of the mesh: its name becomes part of options and columns, " +
                "which take letters, digits and _ - + . only; rename its Physical group in gmsh");
  }
  std::map<std::string, std::string> known;  // without capitals
  for (const std::string& name : names_of(mesh)) {
    const auto [other, is_new] = known.emplace(lower(name), name);
    require(is_new, "patches \"" + other->second + "\" and \"" + name +
                        "\" of the mesh differ by capitals alone, which options do not tell apart; "
                        "rename one in gmsh");
  }
  const std::string has = mesh.patches.empty() ? "the mesh has no patch but periodic ones"
                                               : "the mesh has: " + joined(names_of(mesh));
  for (const std::string& name : names_of(mesh))
    require(!options.given("patches_" + name) || is_key(key_of(name, patch_of(name, mesh))),
            "option -patches_" + name + ": a patch takes a type, patches: {" + name +
                ": {type: ...}}; choose from: " + joined(patch_types));
  const auto joined_values = options.values();
  const auto found = joined_values.find("mesh_periodic");
  const std::string joined_patches = found == joined_values.end() ? "" : found->second;
  const auto check = [&](const std::vector<std::string>& given, const std::string& end) {
    for (const std::string& text : given) {
      if (!patch_of(text + end, mesh).empty()) continue;
      const std::string option = "option -patches_" + text + end;
      require(
          ("," + joined_patches + ",").find("," + text + ",") == std::string::npos || end.empty(),
          option + ": -mesh_periodic " + joined_patches +
              " joins this patch with another, and a joined patch takes no condition; " + has);
      throw Error(ErrorKind::input, option + " is of no patch" +
                                        (end.empty() ? "" : ": \"" + text + "\" is unknown") +
                                        "; " + has + meant(text, names_of(mesh)));
    }
  };
  check(options.names("patches_", "_type"), "_type");
  check(options.names("patches_", ""), "");
}

bool patch_takes(const std::string& type, const std::string& key) {
  return std::ranges::count(keys_of(type), key) > 0;
}

void check_patch_keys(const Options& options, const Mesh& mesh,
                      const std::map<std::string, std::string>& types) {
  Options aside(options);
  for (const std::string& text : options.names("patches_", "")) {
    const std::string option = "option -patches_" + text, name = patch_of(text, mesh);
    bool taken = false;
    for (const auto& [patch, type] : types) {
      if (!patch_takes(type, key_of(text, patch))) continue;
      taken = true;
      const auto zero = [&] {
        return aside.text("patches_" + text, "", "").find_first_not_of("0., ") == text.npos;
      };
      require(patch == name || zero(), option + " would be that of patch \"" + patch +
                                           "\" and of patch \"" + name +
                                           "\"; rename one of them in gmsh");
    }
    if (taken) continue;
    const std::string key = text.substr(name.size() + 1);
    const std::string& type = types.at(name);
    throw Error(ErrorKind::input, option + ": a patch of type " + type + " has no " + key +
                                      "; it takes: " + joined(keys_of(type)) +
                                      meant(key, keys_of(type)));
  }
}

}  // namespace fsi
