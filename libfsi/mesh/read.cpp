#include "libfsi/mesh/read.hpp"

#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/build.hpp"
#include "libfsi/mesh/check.hpp"
#include "libfsi/mesh/gmsh.hpp"
#include "libfsi/mesh/plex.hpp"

namespace fsi {
namespace {

/// Collective. Runs `work` on rank 0; where it throws, every rank throws the same Error.
template <class Work>
void on_first_rank(const Work& work) {
  std::string fault;
  auto kind = static_cast<int>(Kind::internal);
  if (rank() == 0) {
    try {
      work();
    } catch (const Error& error) {
      kind = static_cast<int>(error.kind()), fault = error.what();
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
  on_first_rank([&] { whole = check_mesh(read_gmsh(options.file), options.periodic); });
  return build_mesh(
      distribute(std::move(whole), {options.partitioner, options.along, options.load}));
}

}  // namespace fsi
