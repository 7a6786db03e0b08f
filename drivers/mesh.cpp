// What is done to meshes before a run: fsi-mesh convert in.msh out.h5 [options]. -help

#include <cstdio>
#include <string>
#include <string_view>

#include "libfsi/fsi.hpp"

namespace fsi {

/// fsi-mesh convert IN.msh OUT.h5 [-mesh_periodic a,b]
Ending convert(const char* from, const char* to) {
  Options options("fsi-mesh convert", "in.msh out.h5: a mesh that all ranks read side by side");
  const auto periodic =
      options.list("mesh_periodic", "pairs of patches joined by translation: a,b[,c,d ...]");
  if (options.help()) return Ending::complete;
  options.check_unknown();
  const std::int64_t cells = convert_mesh(from, to, periodic);
  if (rank() == 0) std::printf("%s: %lld cells\n", to, static_cast<long long>(cells));
  return Ending::complete;
}

constexpr const char* commands = "fsi-mesh convert in.msh out.h5 [-mesh_periodic a,b]";

Ending usage(bool asked) {
  require(asked, std::string("fsi-mesh: say what to do: ") + commands);
  if (rank() == 0) std::printf("%s\n", commands);
  return Ending::complete;
}

}  // namespace fsi

int main(int argc, char** argv) {
  const std::string_view command = argc > 1 ? argv[1] : "";
  if (command == "convert" && argc > 3)
    return fsi::run(argc - 3, argv + 3, [&] { return fsi::convert(argv[2], argv[3]); });
  const bool asked = command == "-help" || command == "--help" || command == "-h";
  return fsi::run(1, argv, [&] { return fsi::usage(asked); });
}
