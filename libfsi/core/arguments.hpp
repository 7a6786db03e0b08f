#pragma once
// The command line and the options file, as the user typed them: what PETSc would take silently.

#include <string>
#include <vector>

namespace fsi {

/// A command line as PETSc is to get it.
struct Arguments {
  std::vector<std::string>
      words;             ///< the program first; an options file as -options_file_yaml FILE
  std::string file;      ///< the options file; "" where there is none
  bool help = false;     ///< -help was among the words; it is no longer
  bool version = false;  ///< -version was, likewise
};

/// The first word that ends in .yaml or .yml is the options file, wherever it stands, but for one
/// that -options_file or -options_file_yaml names. Of an option that it and the command line give,
/// that of the command line holds.
Arguments read_arguments(int argc, char** argv);

/// The name of an option as PETSc compares it: without capitals, and with one dash where it has
/// two.
std::string plain_name(const std::string& option);

/// What is wrong with the words: an option given twice, be it with other capitals, a word that
/// belongs to no option, an options file without a name. "" where nothing is.
std::string fault_of(const Arguments& arguments);

/// A file of options that the words name.
struct OptionsFile {
  std::string name;   ///< as the user typed it
  bool yaml = false;  ///< whether PETSc reads it as YAML
};

/// Those of -options_file and -options_file_yaml, in the order of the words.
std::vector<OptionsFile> options_files(const Arguments& arguments);

/// The first option that an options file gives twice, in blocks or in braces (nested keys join
/// with _); "" where none is.
std::string repeated_key(const std::string& yaml);

/// The line and the reason where a text is no YAML, as libyaml tells them, or where it holds what
/// no options file does: a block without keys within another, or a list of blocks. "" where it is
/// right.
std::string yaml_fault(const std::string& yaml);

}  // namespace fsi
