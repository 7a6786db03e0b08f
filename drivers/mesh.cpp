// Meshes before a run: fsi-mesh COMMAND FILES [options]. -help lists the commands.

#include "libfsi/fsi.hpp"

int main(int argc, char** argv) {
  using Words = std::vector<std::string>;
  return fsi::run(
      argc, argv,
      {{"check", "in.msh", "what a mesh is like, where it is worst and what to change in gmsh",
        [](const Words& words) { return fsi::check_mesh_file(words[0]); }},
       {"convert", "in.msh out.h5", "a mesh that all ranks read side by side",
        [](const Words& words) { return fsi::convert_mesh_file(words[0], words[1]); }}});
}
