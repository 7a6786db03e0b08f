#include "libfsi/core/option_names.hpp"

#include <algorithm>
#include <initializer_list>

namespace fsi {
namespace {

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

bool has_prefix(const std::string& name, std::initializer_list<const char*> prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const char* prefix) { return name.starts_with(prefix); });
}

}  // namespace

bool of_petsc(const std::string& name) {
  return has_prefix(name, {"citations",
                           "debug",
                           "device_",
                           "display",
                           "error_output",
                           "fp_trap",
                           "get_total_flops",
                           "help",
                           "history",
                           "info",
                           "log_",
                           "malloc",
                           "memory_",
                           "mpi_",
                           "no_signal",
                           "objects_",
                           "on_error",
                           "options_",
                           "petsc_",
                           "saws",
                           "shared_tmp",
                           "not_shared_tmp",
                           "skip_petscrc",
                           "start_in_debugger",
                           "stop_for_debugger",
                           "tmp",
                           "use_",
                           "version",
                           "viewer_",
                           "x_"});
}

bool of_solver(const std::string& name) {
  return has_prefix(name, {"p_", "u_", "ksp_", "pc_", "mat_", "mumps_", "vec_", "dm_", "sf_", "is_",
                           "dmplex_", "petscpartitioner_", "hypre_"});
}

std::string nearest(const std::string& name, const std::vector<std::string>& valid,
                    std::size_t most) {
  const auto found =
      std::ranges::min_element(valid, {}, [&](const auto& word) { return distance(name, word); });
  return found == valid.end() || distance(name, *found) > most ? "" : *found;
}

std::string nearest_option(const std::string& name, const std::vector<std::string>& valid) {
  const auto head = [](const std::string& option) { return option.substr(0, option.find('_')); };
  const std::vector<std::string> named{"solids", "patches"};
  std::vector<std::string> heads = named;
  for (const std::string& option : valid) heads.push_back(head(option));
  const std::string begin = head(name), near = nearest(begin, heads, begin.size() / 2);
  const bool of_named = near != begin && std::ranges::find(named, near) != named.end();
  if (of_named && nearest(name, valid, begin.size() / 2).empty())
    return near + name.substr(begin.size());
  return nearest(name, valid);
}

std::string nearest_before_underscore(const std::string& name,
                                      const std::vector<std::string>& valid, std::size_t most) {
  std::string found;
  std::size_t least = most + 1;
  for (std::size_t at = name.find('_'); at != std::string::npos; at = name.find('_', at + 1)) {
    const std::string begin = name.substr(0, at), near = nearest(begin, valid, most);
    if (near.empty() || distance(begin, near) >= least) continue;
    found = near, least = distance(begin, near);
  }
  return found;
}

std::string joined(const std::vector<std::string>& words, const char* separator) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : separator) + word;
  return list;
}

}  // namespace fsi
