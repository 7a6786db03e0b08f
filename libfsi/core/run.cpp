#include "libfsi/core/run.hpp"

#include <petscsys.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <thread>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/core/signals.hpp"

namespace fsi {
namespace {

/// PETSc reports through its codes, which FSI_PETSC turns into exceptions; it prints nothing.
PetscErrorCode quiet(MPI_Comm, int, const char*, const char*, PetscErrorCode code, PetscErrorType,
                     const char*, void*) {
  return code;
}

bool is_yaml(const std::string& name) { return name.ends_with(".yaml") || name.ends_with(".yml"); }

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

int failed(MPI_Comm rim, int code, const char* sentence) {
  const bool alike = ranks() == 1 || all_ranks_failed(rim);
  if (!alike || rank() == 0) std::fprintf(stderr, "fsi: error: %s\n", sentence);
  if (!alike) MPI_Abort(comm(), code);
  return code;
}

void read_yaml(const std::string& file, int* argc, char*** argv) {
  require(static_cast<bool>(std::ifstream(file)), "options file \"" + file + "\" cannot be opened");
  const PetscErrorCode code = PetscOptionsInsertFileYAML(comm(), nullptr, file.c_str(), PETSC_TRUE);
  require(code == 0, "options file \"" + file + "\" is not valid YAML");
  FSI_PETSC(PetscOptionsInsert(nullptr, argc, argv, nullptr));  // the command line wins
}

}  // namespace

int run(int argc, char** argv, const std::function<Ending()>& body) {
  std::string yaml;
  if (argc > 1 && is_yaml(argv[1])) {
    yaml = argv[1];
    argv[1] = argv[0];
    --argc, ++argv;
  }
  if (PetscInitialize(&argc, &argv, nullptr, nullptr) != 0) {
    std::fprintf(stderr, "fsi: error: PETSc or MPI could not be started\n");
    return static_cast<int>(Kind::internal);
  }
  MPI_Comm rim = MPI_COMM_NULL;
  MPI_Comm_dup(comm(), &rim);
  int code = 0;
  try {
    FSI_PETSC(PetscPushErrorHandler(quiet, nullptr));
    FSI_PETSC(PetscPopSignalHandler());
    watch_signals();
    if (!yaml.empty()) read_yaml(yaml, &argc, &argv);
    code = static_cast<int>(body());
  } catch (const Error& error) {
    code = failed(rim, static_cast<int>(error.kind()), error.what());
  } catch (const std::bad_alloc&) {
    code = failed(rim, static_cast<int>(Kind::internal), "out of memory");
  } catch (const std::exception& error) {
    code = failed(rim, static_cast<int>(Kind::internal), error.what());
  }
  MPI_Comm_free(&rim);
  const PetscErrorCode finalized = PetscFinalize();
  return code == 0 && finalized != 0 ? static_cast<int>(Kind::internal) : code;
}

}  // namespace fsi
