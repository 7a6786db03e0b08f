#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>
#include <vector>

#include "libfsi/core/arguments.hpp"

namespace fsi {
namespace {

/// The options of a file by name.
struct Names {
  std::set<std::string> seen;
  std::string twice;  ///< the first that came again

  /// PETSc's options do not distinguish capitals.
  void note(const std::string& name) {
    if (!seen.insert(plain_name(name)).second && twice.empty()) twice = name;
  }
};

bool blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

bool one_of(char c, std::string_view set) { return set.find(c) != std::string_view::npos; }

std::string joined(const std::string& prefix, const std::string& key) {
  return prefix.empty() ? key : prefix + "_" + key;
}

/// Past blanks, ends of lines and comments.
std::size_t past_blank(const std::string& text, std::size_t at) {
  while (at < text.size()) {
    if (text[at] == '#' && (at == 0 || blank(text[at - 1]))) {
      at = std::min(text.find('\n', at), text.size());
    } else if (blank(text[at])) {
      ++at;
    } else {
      break;
    }
  }
  return at;
}

/// Past the quoted text that begins at `at`.
std::size_t past_quoted(const std::string& text, std::size_t at) {
  const char quote = text[at++];
  while (at < text.size() && (text[at] != quote || (quote == '\'' && text[at + 1] == quote)))
    at += quote == '\'' && text[at] == quote ? 2 : text[at] == '\\' && quote == '"' ? 2 : 1;
  return std::min(at + 1, text.size());
}

/// The place behind a word of {...} or [...] that begins at `at`.
std::size_t past_word(const std::string& text, std::size_t at) {
  if (one_of(text[at], "\"'")) return past_quoted(text, at);
  const auto ends = [&](std::size_t i) {
    const char next = i + 1 < text.size() ? text[i + 1] : '\n';
    return one_of(text[i], ",[]{}\n") ||
           (text[i] == ':' && (blank(next) || one_of(next, ",[]{}"))) ||
           (text[i] == '#' && blank(text[i - 1]));
  };
  while (at < text.size() && !ends(at)) ++at;
  return at;
}

/// A key as PETSc reads it: without the blanks behind it and its quotes.
std::string bare(std::string key) {
  while (!key.empty() && blank(key.back())) key.pop_back();
  if (key.size() > 1 && one_of(key[0], "\"'") && key.back() == key[0])
    key = key.substr(1, key.size() - 2);
  return key;
}

/// Past the {...} or [...] that begins at `at` and is the value of `prefix`.
std::size_t past_flow(const std::string& text, std::size_t at, const std::string& prefix,
                      Names& names) {
  const bool map = text[at++] == '{';
  for (;;) {
    at = past_blank(text, at);
    if (at >= text.size()) return at;
    const std::size_t begin = at;
    if (one_of(text[at], "}]")) return at + 1;
    if (one_of(text[at], ",:")) {
      ++at;
    } else if (one_of(text[at], "{[")) {
      at = past_flow(text, at, prefix, names);
    } else {
      at = past_word(text, at);
      const std::string name = joined(prefix, bare(text.substr(begin, at - begin)));
      at = past_blank(text, at);
      const bool valued = at < text.size() && text[at] == ':';
      if (valued) at = past_blank(text, at + 1);
      const bool nested = valued && at < text.size() && text[at] == '{';
      if (!nested && (map || valued)) names.note(name);
      if (!valued || at >= text.size()) continue;
      if (one_of(text[at], "{["))
        at = past_flow(text, at, name, names);
      else if (!one_of(text[at], ",}]"))
        at = past_word(text, at);
    }
  }
}

/// The place of the : that ends the key at `first` of a line; the end of the line without a key.
std::size_t end_of_key(const std::string& text, std::size_t first, std::size_t end) {
  if (text[first] == '#' || (text[first] == '-' && blank(text[first + 1]))) return end;
  std::size_t at = one_of(text[first], "\"'") ? past_quoted(text, first) : first;
  for (; at < end; ++at) {
    if (text[at] == '#' && blank(text[at - 1])) return end;
    if (text[at] == ':' && (at + 1 == end || blank(text[at + 1]))) return at;
  }
  return end;
}

}  // namespace

std::string repeated_key(const std::string& yaml) {
  struct Block {
    std::size_t indent;
    std::string name;
  };
  std::vector<Block> open;
  Names names;
  const auto end_of_line = [&](std::size_t at) {
    return std::min(yaml.find('\n', at), yaml.size());
  };
  for (std::size_t line = 0; line < yaml.size();) {
    const std::size_t end = end_of_line(line);
    const std::size_t first = std::min(yaml.find_first_not_of(' ', line), end);
    const std::size_t indent = first - line;
    line = end + 1;
    if (first == end || blank(yaml[first])) continue;
    const bool flow = one_of(yaml[first], "{[");
    const std::size_t colon = flow ? end : end_of_key(yaml, first, end);
    if (!flow && colon == end) continue;
    while (!open.empty() && open.back().indent >= indent) open.pop_back();
    const std::string prefix = open.empty() ? "" : open.back().name;
    if (flow) {
      line = end_of_line(past_flow(yaml, first, prefix, names)) + 1;
      continue;
    }
    const std::string name = joined(prefix, bare(yaml.substr(first, colon - first)));
    const std::size_t value = yaml.find_first_not_of(" \t\r", colon + 1);
    if (value >= end || yaml[value] == '#') {
      open.push_back({indent, name});  // a block begins
      continue;
    }
    if (yaml[value] != '{') names.note(name);
    if (one_of(yaml[value], "{[")) line = end_of_line(past_flow(yaml, value, name, names)) + 1;
  }
  return names.twice;
}

}  // namespace fsi
