#include "libfsi/core/arguments.hpp"

#include <cctype>
#include <filesystem>
#include <map>

namespace fsi {
namespace {

/// Whether PETSc reads a word as an option: a dash or two, then a letter.
bool is_option(const std::string& word) {
  const std::size_t at = word.starts_with("--") ? 2 : 1;
  return word.starts_with("-") && word.size() > at &&
         std::isalpha(static_cast<unsigned char>(word[at])) != 0;
}

bool is_yaml(const std::string& name) { return name.ends_with(".yaml") || name.ends_with(".yml"); }

bool names_file(const std::string& plain) {
  return plain == "-options_file" || plain == "-options_file_yaml";
}

}  // namespace

std::string plain_name(const std::string& option) {
  std::string name = option.substr(option.starts_with("--") ? 1 : 0);
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

Arguments read_arguments(int argc, char** argv) {
  Arguments result;
  for (int i = 0; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "-help" || word == "--help" || word == "-h") {
      result.help = true;
    } else if (word == "-version" || word == "--version") {
      result.version = true;
    } else if (i > 0 && is_yaml(word) && result.file.empty() &&
               !names_file(plain_name(argv[i - 1]))) {
      result.file = word;
      // First of all, so that the words of the command line hold where both name an option. PETSc
      // forgets the name; files that the case names may lie beside it.
      const std::string folder = std::filesystem::path(word).parent_path().string();
      result.words.insert(result.words.begin() + 1, {"-options_file_yaml", word, "-case_folder",
                                                     folder.empty() ? "." : folder});
    } else {
      result.words.push_back(word);
    }
  }
  return result;
}

std::string fault_of(const Arguments& arguments) {
  std::map<std::string, std::string> seen;  // the words by their plain names
  bool value_may_follow = false;
  for (std::size_t i = 1; i < arguments.words.size(); ++i) {
    const std::string& word = arguments.words[i];
    const bool option = is_option(word);
    if (option) {
      const auto [first, is_new] = seen.emplace(plain_name(word), word);
      if (!is_new)
        return "option " + word + " is given twice on the command line" +
               (first->second == word ? ""
                                      : ", first as " + first->second +
                                            ": capitals and a second dash make no other option");
      if (names_file(first->first) &&
          (i + 1 == arguments.words.size() || arguments.words[i + 1].starts_with("-")))
        return "option " + word + " needs the name of a file";
    }
    const std::size_t first = arguments.file.empty() ? 1 : 5;  // behind the file and its folder
    if (!option && !value_may_follow)
      return "argument \"" + word + "\" belongs to no option" +
             (is_yaml(word) ? "; the options file is \"" + arguments.file + "\""
              : i > first
                  ? "; it follows \"" + arguments.words[i - 1] + "\" (a list is one word: a,b,c)"
                  : "; an options file ends in .yaml or .yml");
    value_may_follow = option;
  }
  return "";
}

std::vector<OptionsFile> options_files(const Arguments& arguments) {
  std::vector<OptionsFile> files;
  for (std::size_t i = 1; i + 1 < arguments.words.size(); ++i) {
    const std::string option = plain_name(arguments.words[i]), &name = arguments.words[i + 1];
    if (names_file(option)) files.push_back({name, option.ends_with("_yaml") || is_yaml(name)});
  }
  return files;
}

}  // namespace fsi
