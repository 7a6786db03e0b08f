#include "libfsi/mesh/read.hpp"

#include <filesystem>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/memory.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/build.hpp"
#include "libfsi/mesh/check.hpp"
#include "libfsi/mesh/gmsh.hpp"
#include "libfsi/mesh/plex.hpp"

namespace fsi {
namespace {

Error beyond_memory(const std::string& file) {
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(file, code);
  return {Kind::input, "mesh file \"" + file + "\" of " + text_of_bytes(code ? 0 : size) +
                           " does not fit into the " + text_of_bytes(memory_limit()) +
                           " of memory that this process can have"};
}

/// Collective. Runs `work` on rank 0; where it throws, every rank throws the same Error.
template <class Work>
void on_first_rank(const std::string& file, const Work& work) {
  std::string fault;
  auto kind = static_cast<int>(Kind::internal);
  if (rank() == 0) {
    try {
      work();
    } catch (const Error& error) {
      kind = static_cast<int>(error.kind()), fault = error.what();
    } catch (const std::bad_alloc&) {
      kind = static_cast<int>(Kind::input), fault = beyond_memory(file).what();
    } catch (const std::exception& error) {
      fault = std::string("reading the mesh: ") + error.what();
    }
  }
  fault = broadcast(fault);
  MPI_Bcast(&kind, 1, MPI_INT, 0, comm());
  if (!fault.empty()) throw Error(static_cast<Kind>(kind), fault);
}

}  // namespace

Mesh read_mesh(const MeshOptions& options) {
  CellList whole;
  on_first_rank(options.file,
                [&] { whole = check_mesh(read_gmsh(options.file), options.periodic); });
  try {
    return build_mesh(distribute(std::move(whole), options.partitioner, options.along));
  } catch (const std::bad_alloc&) {
    throw beyond_memory(options.file);
  }
}

}  // namespace fsi
