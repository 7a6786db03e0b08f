#include "libfsi/mesh/plex_dm.hpp"

#include <algorithm>

namespace fsi {
namespace {

using LocalVec = Handle<Vec, VecDestroy>;

/// A local vector of `count` values a point, as the section lays them out, named as PETSc's own.
LocalVec coordinates(PetscSection section, int dim, std::vector<Real>& values) {
  PetscInt size = 0;
  FSI_PETSC(PetscSectionGetStorageSize(section, &size));
  LocalVec x;
  FSI_PETSC(VecCreate(PETSC_COMM_SELF, x.out()));
  FSI_PETSC(PetscObjectSetName(reinterpret_cast<PetscObject>(static_cast<Vec>(x)), "coordinates"));
  FSI_PETSC(VecSetSizes(x, size, PETSC_DETERMINE));
  FSI_PETSC(VecSetBlockSize(x, dim));
  FSI_PETSC(VecSetType(x, VECSTANDARD));
  PetscScalar* array = nullptr;
  FSI_PETSC(VecGetArray(x, &array));
  std::ranges::copy(values, array);
  FSI_PETSC(VecRestoreArray(x, &array));
  return x;
}

void set_coordinates(DM plex, int dim, const std::vector<Index>& vertices,
                     const std::function<Vec3(Index)>& x) {
  PetscSection section = nullptr;
  PetscInt begin = 0, end = 0;
  FSI_PETSC(DMPlexGetDepthStratum(plex, 0, &begin, &end));
  FSI_PETSC(DMSetCoordinateDim(plex, dim));
  FSI_PETSC(DMGetCoordinateSection(plex, &section));
  FSI_PETSC(PetscSectionSetNumFields(section, 1));
  FSI_PETSC(PetscSectionSetFieldComponents(section, 0, dim));
  FSI_PETSC(PetscSectionSetChart(section, begin, end));
  for (PetscInt v = begin; v < end; ++v) {
    FSI_PETSC(PetscSectionSetDof(section, v, dim));
    FSI_PETSC(PetscSectionSetFieldDof(section, v, 0, dim));
  }
  FSI_PETSC(PetscSectionSetUp(section));
  std::vector<Real> values;
  for (const Index v : vertices) {
    const Vec3 place = x(v);
    for (int k = 0; k < dim; ++k) values.push_back(place[k]);
  }
  FSI_PETSC(DMSetCoordinatesLocal(plex, coordinates(section, dim, values)));
}

void set_labels(DM plex, PetscInt first_vertex, const std::vector<Index>& vertices,
                const std::vector<BoundaryFace>& faces, const std::vector<std::string>& patches) {
  FSI_PETSC(DMCreateLabel(plex, "Face Sets"));
  for (const std::string& name : patches) FSI_PETSC(DMCreateLabel(plex, name.c_str()));
  for (const BoundaryFace& face : faces) {
    std::array<PetscInt, max_face_corners> points{};
    PetscInt n = 0, found = 0;
    for (const Index v : face.vertices) {
      if (v < 0) continue;
      const auto at = std::ranges::lower_bound(vertices, v) - vertices.begin();
      points[n++] = first_vertex + static_cast<PetscInt>(at);
    }
    const PetscInt* join = nullptr;
    FSI_PETSC(DMPlexGetFullJoin(plex, n, points.data(), &found, &join));
    const PetscInt point = found == 1 ? join[0] : -1;
    FSI_PETSC(DMPlexRestoreJoin(plex, n, points.data(), &found, &join));
    if (point < 0)
      throw Error(ErrorKind::internal, "mesh: a boundary face is no face of the DMPlex");
    FSI_PETSC(DMSetLabelValue(plex, "Face Sets", point, 1 + face.patch));
    FSI_PETSC(DMSetLabelValue(plex, patches[face.patch].c_str(), point, 1 + face.patch));
  }
}

/// The numbers of a cell's vertices in the order of the DMPlex.
std::vector<Index> closure(DM plex, PetscInt cell, const std::vector<Index>& vertices) {
  PetscInt begin = 0, end = 0, n = 0, *points = nullptr;
  FSI_PETSC(DMPlexGetDepthStratum(plex, 0, &begin, &end));
  FSI_PETSC(DMPlexGetTransitiveClosure(plex, cell, PETSC_TRUE, &n, &points));
  std::vector<Index> result;
  for (PetscInt i = 0; i < n; ++i) {
    if (points[2 * i] >= begin && points[2 * i] < end)
      result.push_back(vertices[points[2 * i] - begin]);
  }
  FSI_PETSC(DMPlexRestoreTransitiveClosure(plex, cell, PETSC_TRUE, &n, &points));
  return result;
}

/// Cells at a seam get coordinates of their own, in which they are whole.
void set_cell_coordinates(DM plex, const Mesh& mesh, const std::vector<Index>& vertices,
                          const std::vector<Index>& point_of) {
  PetscSection section = nullptr;
  DM plain = nullptr;
  FSI_PETSC(DMGetCoordinateDM(plex, &plain));
  Plex own;
  FSI_PETSC(DMClone(plain, own.out()));
  FSI_PETSC(DMSetCellCoordinateDM(plex, own));
  FSI_PETSC(PetscSectionCreate(comm(), &section));
  FSI_PETSC(PetscSectionSetNumFields(section, 1));
  FSI_PETSC(PetscSectionSetFieldComponents(section, 0, mesh.dim));
  FSI_PETSC(PetscSectionSetChart(section, 0, mesh.n_owned));
  std::vector<Real> values;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const auto corners = mesh.cell_points[c];
    const auto moved = [&](Index p) {
      const auto at = std::ranges::lower_bound(vertices, mesh.vertex_id[p]) - vertices.begin();
      return point_of[static_cast<std::size_t>(at)] != p;
    };
    if (std::ranges::none_of(corners, moved)) continue;
    const auto n = static_cast<PetscInt>(corners.size()) * mesh.dim;
    FSI_PETSC(PetscSectionSetDof(section, c, n));
    FSI_PETSC(PetscSectionSetFieldDof(section, c, 0, n));
    for (const Index v : closure(plex, c, vertices)) {
      const auto here = [&](Index p) { return mesh.vertex_id[p] == v; };
      const Vec3& place = mesh.points[*std::ranges::find_if(corners, here)];
      for (int k = 0; k < mesh.dim; ++k) values.push_back(place[k]);
    }
  }
  FSI_PETSC(PetscSectionSetUp(section));
  FSI_PETSC(DMSetCellCoordinateSection(plex, mesh.dim, section));
  FSI_PETSC(DMSetCellCoordinatesLocal(plex, coordinates(section, mesh.dim, values)));
  FSI_PETSC(PetscSectionDestroy(&section));
}

std::vector<BoundaryFace> boundary_of(const Mesh& mesh) {
  std::vector<BoundaryFace> faces;
  for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
    for (Index f = mesh.patches[p].begin; f < mesh.patches[p].end; ++f) {
      BoundaryFace& face = faces.emplace_back(BoundaryFace{static_cast<Index>(p)});
      std::size_t n = 0;
      for (const Index point : mesh.face_points[f]) face.vertices[n++] = mesh.vertex_id[point];
    }
  }
  return faces;
}

}  // namespace

Plex interpolated(const NumberedCells& cells, Index n_vertices, const std::function<Vec3(Index)>& x,
                  const std::vector<BoundaryFace>& faces, const std::vector<std::string>& patches) {
  std::vector<Index> vertices;
  const Plex flat = plex_of(cells, n_vertices, vertices);
  Plex plex;
  FSI_PETSC(DMPlexInterpolate(flat, plex.out()));
  FSI_PETSC(DMPlexDistributeSetDefault(plex, PETSC_FALSE));
  set_coordinates(plex, cells.dim, vertices, x);
  set_labels(plex, static_cast<PetscInt>(cells.types.size()), vertices, faces, patches);
  return plex;
}

std::shared_ptr<_p_DM> make_dm(const Mesh& mesh) {
  NumberedCells cells{mesh.dim, {}, {}};
  std::vector<CellType> types;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    types.push_back(type_of(mesh.dim, mesh.cell_points[c].size()));
    for (const Index p : mesh.cell_points[c]) cells.vertices.index.push_back(mesh.vertex_id[p]);
    cells.vertices.offset.push_back(static_cast<Index>(cells.vertices.index.size()));
  }
  cells.types = types;
  // Each vertex lies where the first of its points lies.
  std::vector<Index> vertices = cells.vertices.index;
  vertices = compress(vertices);
  std::vector<Index> point_of(vertices.size(), -1);
  for (Index i = static_cast<Index>(mesh.points.size()) - 1; i >= 0; --i) {
    const auto at = std::ranges::lower_bound(vertices, mesh.vertex_id[i]);
    if (at != vertices.end() && *at == mesh.vertex_id[i]) point_of[at - vertices.begin()] = i;
  }
  const auto place = [&](Index v) {
    return mesh.points[point_of[std::ranges::lower_bound(vertices, v) - vertices.begin()]];
  };
  Index highest = vertices.empty() ? 0 : vertices.back() + 1;
  MPI_Allreduce(MPI_IN_PLACE, &highest, 1, MPI_INT32_T, MPI_MAX, comm());
  std::vector<std::string> names;
  for (const Patch& patch : mesh.patches) names.push_back(patch.name);
  Plex plex = interpolated(cells, highest, place, boundary_of(mesh), names);
  if (mesh.translation.size() > 1) set_cell_coordinates(plex, mesh, vertices, point_of);
  FSI_PETSC(DMSetBasicAdjacency(plex, PETSC_TRUE, PETSC_TRUE));
  if (ranks() > 1) {
    Plex wider;
    FSI_PETSC(DMPlexDistributeOverlap(plex, 1, nullptr, wider.out()));
    plex = std::move(wider);
  }
  FSI_PETSC(PetscObjectSetName(reinterpret_cast<PetscObject>(static_cast<DM>(plex)), "fsi"));
  const auto let_go = [](DM dm) { static_cast<void>(DMDestroy(&dm)); };
  return {plex.release(), let_go};
}

_p_DM* Mesh::dm() const {
  if (plex_ == nullptr) plex_ = make_dm(*this);
  return plex_.get();
}

}  // namespace fsi
