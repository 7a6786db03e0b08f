#include "libfsi/core/run.hpp"

#include <petscmat.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "libfsi/core/arguments.hpp"
#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/core/signals.hpp"
#include "libfsi/core/version.hpp"

namespace fsi {
namespace {

/// PETSc reports through its codes, which FSI_PETSC turns into exceptions; it prints nothing.
PetscErrorCode quiet(MPI_Comm, int, const char*, const char*, PetscErrorCode code, PetscErrorType,
                     const char*, void*) {
  return code;
}

/// Whether every rank comes here within two seconds: then all failed alike and may end in order.
bool all_ranks_failed(MPI_Comm rim) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(rim, &request);
  for (int tries = 0; tries < 200; ++tries) {
    int done = 0;
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// Says it once where all ranks failed alike; where one did, ends the others.
int failed(MPI_Comm rim, ErrorKind kind, const char* sentence) {
  const int code = static_cast<int>(kind);
  int mine = 0;
  MPI_Comm_rank(rim, &mine);
  const bool alike = all_ranks_failed(rim);
  if (!alike || mine == 0) std::fprintf(stderr, "fsi: error: %s\n", sentence);
  if (!alike) MPI_Abort(rim, code);
  return code;
}

/// Collective. The text of the options file as rank 0 reads it. Errors: Error{input}.
std::string text_of(const std::string& file) {
  int mine = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &mine);
  std::string text;
  std::int64_t size = -1;
  if (mine == 0) {
    std::ifstream stream(file);
    std::ostringstream content;
    if (stream && content << stream.rdbuf()) text = content.str(), size = std::ssize(text);
  }
  MPI_Bcast(&size, 1, MPI_INT64_T, 0, MPI_COMM_WORLD);
  require(size >= 0, "options file \"" + file + "\" cannot be opened or is empty");
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), static_cast<int>(size), MPI_CHAR, 0, MPI_COMM_WORLD);
  return text;
}

/// Collective. Errors: Error{input} where a file cannot be read, or holds what PETSc would take
/// silently.
void check_file(const OptionsFile& file) {
  if (file.name.find('$') != std::string::npos) return;  // a folder that PETSc knows
  // PETSc takes the ending ":yaml" for the kind of the file, not for a part of its name.
  constexpr std::string_view kind = ":yaml";
  const bool told = !file.yaml && file.name.ends_with(kind);
  const std::string name = told ? file.name.substr(0, file.name.size() - kind.size()) : file.name;
  const std::string text = text_of(name);
  if (!file.yaml && !told) return;
  const std::string wrong = yaml_fault(text), twice = repeated_key(text);
  require(wrong.empty(), "options file \"" + name + "\" is not valid YAML of options: " + wrong);
  require(twice.empty(), "options file \"" + name + "\" gives " + twice + " twice");
}

/// A notice that a petscrc of the folder is used, which the command line does not show.
void tell_of_petscrc() {
  const auto given = [](const char* name) {
    PetscBool found = PETSC_FALSE;
    FSI_PETSC(PetscOptionsHasName(nullptr, nullptr, name, &found));
    return found == PETSC_TRUE;
  };
  int mine = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &mine);
  if (given("-skip_petscrc") || mine != 0) return;
  for (const char* file : {".petscrc", "petscrc"})
    if (std::filesystem::exists(file))
      std::fprintf(stderr,
                   "fsi: notice: the options in \"%s\" are taken as well; -skip_petscrc "
                   "leaves them out\n",
                   file);
}

/// Gives PETSc its options: petscrc, PETSC_OPTIONS, options file, command line; the last wins.
void start_petsc(Arguments& arguments) {
  const std::string fault = fault_of(arguments);
  require(fault.empty(), fault);
  const std::vector<OptionsFile> files = options_files(arguments);
  for (const OptionsFile& file : files) check_file(file);
  std::vector<char*> words;
  for (std::string& word : arguments.words) words.push_back(word.data());
  int count = static_cast<int>(words.size());
  words.push_back(nullptr);
  char** list = words.data();
  FSI_PETSC(PetscPushErrorHandler(quiet, nullptr));
  const PetscErrorCode code = PetscInitialize(&count, &list, nullptr, nullptr);
  // The options are all of it that depends on the user.
  std::string names;
  for (const OptionsFile& file : files) names += (names.empty() ? "\"" : ", \"") + file.name + "\"";
  require(code == 0,
          (names.empty() ? "the options" : "the options, with those of the file " + names + ",") +
              " cannot be read: " + petsc_text(code));
  FSI_PETSC(PetscPopSignalHandler());
  // PETSc numbers its events as classes are first used, and -log_view joins ranks by number. Rank 0
  // orders the cells by a matrix before the others use any.
  FSI_PETSC(ISInitializePackage());
  FSI_PETSC(MatInitializePackage());
  tell_of_petscrc();
  if (arguments.help) FSI_PETSC(PetscOptionsSetValue(nullptr, "-help", ""));
}

/// The text of -version: the program and the libraries that it is built with.
void print_version(const char* program) {
  int mine = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &mine);
  if (mine != 0) return;
  std::printf("%s %s, commit %s; PETSc %d.%d.%d\n",
              std::filesystem::path(program).filename().c_str(), version().c_str(),
              commit().c_str(), PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR);
}

/// Calls the body, and once more as long as it asks for that. The option -restart_again is what a
/// body gives to the next one. Errors: Error{input} if the user gave it.
RunStatus call(const std::function<RunStatus()>& body) {
  PetscBool given = PETSC_FALSE;
  FSI_PETSC(PetscOptionsHasName(nullptr, nullptr, "-restart_again", &given));
  require(given == PETSC_FALSE, "option -restart_again is set by the program itself; leave it out");
  RunStatus status = body();
  while (status == RunStatus::again) status = body();
  return status;
}

/// That the output could not be written is told, but not where its reader left. PETSc would fail on
/// it.
int close_output(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  const bool left = poll(&output, 1, 0) > 0 && (output.revents & POLLERR) != 0;
  if (std::freopen("/dev/null", "w", stdout) == nullptr || left || code != 0) return code;
  std::fprintf(stderr, "fsi: error: the standard output could not be written\n");
  return static_cast<int>(ErrorKind::io);
}

int end_petsc(int code) {
  PetscBool begun = PETSC_FALSE;
  PetscErrorCode ended = PetscInitialized(&begun);
  if (begun == PETSC_TRUE) ended = PetscFinalize();
  return code == 0 && ended != 0 ? static_cast<int>(ErrorKind::internal) : code;
}

/// "check in.msh (what it does)", one after the other.
std::string list_of(const std::vector<Command>& commands, const char* separator) {
  std::string text;
  for (const Command& command : commands)
    text += (text.empty() ? "" : separator) + command.name + " " + command.operands + " (" +
            command.purpose + ")";
  return text;
}

RunStatus run_command(const std::vector<Command>& commands, const std::vector<std::string>& words,
                      bool help) {
  if (words.empty() && help) {
    int mine = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &mine);
    if (mine == 0) std::printf("commands:\n  %s\n", list_of(commands, "\n  ").c_str());
    return RunStatus::complete;
  }
  require(!words.empty(), "a command is missing; there are: " + list_of(commands, ", "));
  for (const Command& command : commands) {
    if (command.name != words.front()) continue;
    std::istringstream stream(command.operands);
    const std::vector<std::string> expected{std::istream_iterator<std::string>(stream), {}};
    if (help) return command.body(expected);
    require(words.size() == 1 + expected.size(),
            "command \"" + command.name + "\" is written " + command.name + " " + command.operands +
                " [options]; given after it: " + std::to_string(words.size() - 1) +
                (words.size() == 2 ? " word" : " words"));
    return command.body({words.begin() + 1, words.end()});
  }
  throw Error(ErrorKind::input, "command \"" + words.front() +
                                    "\" is not known; there are: " + list_of(commands, ", "));
}

}  // namespace

int run(int argc, char** argv, const std::vector<Command>& commands) {
  std::vector<std::string> words;
  std::vector<char*> rest{argv[0]};
  for (int i = 1; i < argc; ++i) {
    if (rest.size() == 1 && argv[i][0] != '-')
      words.emplace_back(argv[i]);
    else
      rest.push_back(argv[i]);
  }
  const bool help = read_arguments(argc, argv).help;
  const auto count = static_cast<int>(rest.size());
  rest.push_back(nullptr);
  return run(count, rest.data(), [&] { return run_command(commands, words, help); });
}

int run(int argc, char** argv, const std::function<RunStatus()>& body) {
  int threads = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads);
  MPI_Comm rim = MPI_COMM_NULL;
  MPI_Comm_dup(MPI_COMM_WORLD, &rim);
  Arguments arguments = read_arguments(argc, argv);
  int code = 0;
  try {
    start_petsc(arguments);
    watch_signals();
    if (arguments.version) {
      print_version(argv[0]);
    } else {
      code = static_cast<int>(call(body));
    }
  } catch (const Error& error) {
    code = failed(rim, error.kind(), error.what());
  } catch (const std::bad_alloc&) {
    code = failed(rim, ErrorKind::internal, "out of memory");
  } catch (const std::exception& error) {
    code = failed(rim, ErrorKind::internal, error.what());
  }
  code = end_petsc(close_output(code));
  MPI_Comm_free(&rim);
  MPI_Finalize();
  return code;
}

}  // namespace fsi
