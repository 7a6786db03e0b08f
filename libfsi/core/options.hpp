#pragma once
// The options of a run: typed, ranged, documented where they are read, and never silently ignored.

#include <initializer_list>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"

namespace fsi {

/// What -help prints and what a value must satisfy.
struct Spec {
  std::string help{};  ///< what -help prints of the option
  std::string unit{};  ///< e.g. "mass / (length time)"; "" where none
  Real min = -std::numeric_limits<Real>::infinity();  ///< least valid value
  Real max = std::numeric_limits<Real>::infinity();   ///< largest valid value
  bool positive = false;                              ///< strictly > 0
};

/// Gives an option for the Options that are made after it, in place of what the user gave.
void set_option(const std::string& name, const std::string& value);

/// Reads options by name (without the dash) from PETSc's database: command line, YAML file,
/// PETSC_OPTIONS. Every reader records name, resolved value and spec; with -help it prints them.
/// Errors: Error{input} naming the option, the value found and the valid ones, for NaN, infinity,
/// out of range, a wrong type, a missing value, a list of wrong length. All ranks throw alike.
class Options {
 public:
  /// `program` and `purpose` head the -help text.
  Options(std::string program, const std::string& purpose);

  /// fallback: not a number where the user must give the option.
  Real real(const std::string& name, Real fallback, const Spec& spec);
  /// A whole number.
  int integer(const std::string& name, int fallback, const Spec& spec);
  /// true or false.
  bool flag(const std::string& name, bool fallback, const std::string& help);
  /// A word.
  std::string text(const std::string& name, const std::string& fallback, const std::string& help);
  /// A file's name, or any other word: where no such file is in the working directory but one
  /// beside the case file, that one. Recorded so that run.yaml finds it too.
  std::string text_or_file(const std::string& name, const std::string& fallback,
                           const std::string& help);
  /// One of the words `valid`.
  std::string choice(const std::string& name, const std::string& fallback,
                     const std::vector<std::string>& valid, const std::string& help);
  /// Three numbers, x,y,z.
  Vec3 vec3(const std::string& name, const Vec3& fallback, const Spec& spec);
  /// Words with commas between them; none where the option is not given or the word is "none".
  std::vector<std::string> list(const std::string& name, const std::string& help);
  /// Whether the user gave this option.
  bool given(const std::string& name) const;
  /// The names NAME of the options beginNAMEend that the user gave, in alphabetical order.
  std::vector<std::string> names(const std::string& begin, const std::string& end) const;

  /// True when the user asked for -help: the driver reads its options, then ends.
  bool help() const { return help_; }
  /// Unknown options of ours and of PETSc: Error{input} naming each with its nearest valid name.
  /// Call it before the first step for names that nothing reads, and after it for solver options.
  void check_unknown() const;
  /// Options that nothing has read, but for the general ones of PETSc: Error{input}.
  void check_unused() const;
  /// Names and values of the options read, as resolved; without those that are empty.
  std::map<std::string, std::string> values() const;
  /// Every option as resolved, as YAML that repeats the run.
  std::string yaml() const;

 private:
  struct Entry {
    std::string name, value, fallback, help, range;
  };
  void record(Entry entry);
  std::string program_, case_folder_;
  std::vector<Entry> entries_;
  bool help_ = false;
};

}  // namespace fsi
