#include "libfsi/mesh/read.hpp"

#include <filesystem>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/memory.hpp"
#include "libfsi/mesh/build.hpp"
#include "libfsi/mesh/check.hpp"
#include "libfsi/mesh/gmsh.hpp"
#include "libfsi/mesh/mesh_file.hpp"
#include "libfsi/mesh/on_first_rank.hpp"
#include "libfsi/mesh/plex.hpp"

namespace fsi {
namespace {

Error beyond_memory(const std::string& file) {
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(file, code);
  return {ErrorKind::input, "mesh file \"" + file + "\" of " + text_of_bytes(code ? 0 : size) +
                                " does not fit into the " + text_of_bytes(memory_limit()) +
                                " of memory that this process can have"};
}

/// `work` on a file, whose size is to blame where memory runs out.
template <class Work>
auto within_memory(const std::string& file, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw beyond_memory(file);
  }
}

}  // namespace

Mesh read_mesh(const MeshOptions& options) {
  const Division how{options.partitioner, options.along, options.load, options.loads};
  if (is_mesh_file(options.file))
    return build_mesh(distribute(read_mesh_tables(options.file, options.periodic), how));
  CellList whole;
  on_first_rank([&] {
    whole = within_memory(options.file,
                          [&] { return check_mesh(read_gmsh(options.file), options.periodic); });
  });
  return within_memory(options.file, [&] { return build_mesh(distribute(std::move(whole), how)); });
}

}  // namespace fsi
