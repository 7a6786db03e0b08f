#include "libfsi/core/arguments.hpp"

#include <filesystem>

#include <cctype>
#include <set>

namespace fsi {
namespace {

/// Whether PETSc takes a word for an option: a dash or two, then a letter.
bool is_option(const std::string& word) {
  const std::size_t at = word.starts_with("--") ? 2 : 1;
  return word.starts_with("-") && word.size() > at &&
         std::isalpha(static_cast<unsigned char>(word[at])) != 0;
}

bool is_yaml(const std::string& name) { return name.ends_with(".yaml") || name.ends_with(".yml"); }

}  // namespace

Arguments read_arguments(int argc, char** argv) {
  Arguments result;
  for (int i = 0; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "-help" || word == "--help" || word == "-h") {
      result.help = true;
    } else if (word == "-version" || word == "--version") {
      result.version = true;
    } else if (i == 1 && is_yaml(word)) {
      result.file = word;
      result.words.insert(result.words.end(), {"-options_file_yaml", word});
      // PETSc forgets the name; files that the case names may lie beside it.
      const std::string folder = std::filesystem::path(word).parent_path().string();
      result.words.insert(result.words.end(), {"-case_folder", folder.empty() ? "." : folder});
    } else {
      result.words.push_back(word);
    }
  }
  return result;
}

std::string fault_of(const Arguments& arguments) {
  std::set<std::string> seen;
  bool value_may_follow = false;
  for (std::size_t i = 1; i < arguments.words.size(); ++i) {
    const std::string& word = arguments.words[i];
    const bool option = is_option(word);
    if (option && !seen.insert(word).second)
      return "option " + word + " is given twice on the command line";
    if (!option && !value_may_follow)
      return "argument \"" + word + "\" belongs to no option" +
             (i > 1 ? "; it follows \"" + arguments.words[i - 1] + "\" (a list is one word: a,b,c)"
                    : "; an options file ends in .yaml or .yml");
    value_may_follow = option;
  }
  return "";
}

}  // namespace fsi
