// One half of a checkpoint test: other_ranks write|read FOLDER, so that another count of ranks
// reads than wrote.

#include <petscsys.h>

#include <cstdio>

#include "tests/unit/io/support.hpp"
#include "tests/unit/support/box_file.hpp"

namespace {

int half(const std::string& action, const std::string& folder) {
  const fsi::Mesh mesh = fsi::test::read_box(
      {.n = {4, 3, 3}, .simplex = true, .periodic = {"left", "right", "back", "front"}});
  fsi::test::Sample state(mesh);
  if (action == "write") {
    if (fsi::rank() == 0) std::filesystem::create_directories(folder);
    state.fill();
    return fsi::io::Checkpoint(folder, mesh).write(state.snapshot()) ? 0 : 1;
  }
  fsi::io::Checkpoint(folder, mesh).read(state.snapshot());
  const int wrong = state.wrong();
  if (wrong != 0) std::fprintf(stderr, "rank %d: %d values are wrong\n", fsi::rank(), wrong);
  return fsi::all_of_ranks(wrong == 0) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 || PetscInitialize(&argc, &argv, nullptr, nullptr) != 0) return 1;
  const int failed = half(argv[1], argv[2]);
  return PetscFinalize() == 0 ? failed : 1;
}
