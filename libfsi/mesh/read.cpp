#include "libfsi/mesh/read.hpp"

#include <utility>

#include "libfsi/mesh/build.hpp"
#include "libfsi/mesh/check.hpp"
#include "libfsi/mesh/gmsh.hpp"
#include "libfsi/mesh/mesh_file.hpp"
#include "libfsi/mesh/on_first_rank.hpp"
#include "libfsi/mesh/plex.hpp"

namespace fsi {

Mesh read_mesh(const MeshOptions& options) {
  const Division how{options.partitioner, options.along, options.load};
  if (is_mesh_file(options.file))
    return build_mesh(distribute(read_mesh_tables(options.file, options.periodic), how));
  CellList whole;
  on_first_rank([&] { whole = check_mesh(read_gmsh(options.file), options.periodic); });
  return build_mesh(distribute(std::move(whole), how));
}

}  // namespace fsi
