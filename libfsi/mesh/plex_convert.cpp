#include <petscviewerhdf5.h>

#include <filesystem>
#include <fstream>

#include "libfsi/mesh/check.hpp"
#include "libfsi/mesh/convert.hpp"
#include "libfsi/mesh/gmsh.hpp"
#include "libfsi/mesh/mesh_file.hpp"
#include "libfsi/mesh/on_first_rank.hpp"
#include "libfsi/mesh/plex_dm.hpp"

namespace fsi {
namespace {

std::vector<BoundaryFace> boundary_of(const CellList& whole) {
  std::vector<BoundaryFace> faces;
  for (Index c = 0; c < whole.n_cells(); ++c) {
    const Shape& shape = shape_of(whole.types[c]);
    for (int f = 0; f < shape.faces; ++f) {
      if (whole.face_patch[c][f] < 0) continue;
      BoundaryFace& face = faces.emplace_back(BoundaryFace{whole.face_patch[c][f]});
      std::size_t n = 0;
      for (const std::int8_t i : shape.face_corners(f)) {
        face.vertices[n++] = whole.corners[c][i];
      }
    }
  }
  return faces;
}

/// Collective. PETSc's own part of the file.
void write_plex(const std::string& file, const CellList& whole,
                const std::vector<std::string>& patches) {
  const auto place = [&](Index p) { return whole.points[p]; };
  const Plex plex = interpolated({whole.dim, whole.types, whole.corners},
                                 Stretches::of(static_cast<Index>(whole.points.size())).size(),
                                 place, boundary_of(whole), patches);
  FSI_PETSC(PetscObjectSetName(reinterpret_cast<PetscObject>(static_cast<DM>(plex)), "fsi"));
  Handle<PetscViewer, PetscViewerDestroy> viewer;
  FSI_PETSC(PetscViewerHDF5Open(comm(), file.c_str(), FILE_MODE_WRITE, viewer.out()));
  FSI_PETSC(DMPlexTopologyView(plex, viewer));
  FSI_PETSC(DMPlexCoordinatesView(plex, viewer));
  FSI_PETSC(DMPlexLabelsView(plex, viewer));
}

}  // namespace

std::int64_t convert_mesh(const std::string& from, const std::string& to,
                          const std::vector<std::string>& periodic) {
  require(is_mesh_file(to), "the mesh file to write, \"" + to + "\", must end in .h5");
  require(!is_mesh_file(from),
          "the mesh file \"" + from + "\" is .h5 already; a gmsh file is what becomes one");
  const std::string temporary = to + ".tmp";
  CellList whole;
  on_first_rank([&] {
    whole = check_mesh(read_gmsh(from), periodic);
    if (!std::ofstream(temporary))
      throw Error(ErrorKind::io, "mesh file \"" + to + "\" cannot be written");
  });
  std::int64_t n_cells = whole.n_global;
  std::string names;
  for (const std::string& name : whole.patches) names += name + '\n';
  std::vector<std::string> patches;
  std::string name;
  for (const char c : broadcast(names)) {
    if (c != '\n') name += c;
    if (c == '\n') patches.push_back(std::exchange(name, ""));
  }
  MPI_Bcast(&whole.dim, 1, MPI_INT, 0, comm());
  MPI_Bcast(&n_cells, 1, MPI_INT64_T, 0, comm());
  write_plex(temporary, whole, patches);
  on_first_rank([&] {
    write_mesh_tables(temporary, whole, periodic);
    std::error_code code;
    std::filesystem::rename(temporary, to, code);
    if (code) throw Error(ErrorKind::io, "mesh file \"" + to + "\" cannot be written");
  });
  return n_cells;
}

}  // namespace fsi
