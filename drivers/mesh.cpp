// Meshes before a run: fsi-mesh COMMAND FILES [options]. -help lists the commands.

#include "libfsi/fsi.hpp"

int main(int argc, char** argv) {
  return fsi::run(
      argc, argv,
      {{"check", "in.msh", "what a mesh is like, where it is worst and what to change in gmsh",
        [](const std::vector<std::string>& words) { return fsi::check_mesh_file(words[0]); }}});
}
