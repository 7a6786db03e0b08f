// The mesh as a DMPlex, and as a file that every rank reads its own part of.

#include <gtest/gtest.h>
#include <petscdmplex.h>
#include <petscsf.h>

#include "libfsi/core/error.hpp"
#include "libfsi/mesh/convert.hpp"
#include "tests/unit/mesh/block.hpp"

namespace fsi::test {
namespace {

/// Points of a label on this rank, halo included.
PetscInt labelled(DM dm, const std::string& name, PetscInt value) {
  PetscInt n = 0;
  FSI_PETSC(DMGetStratumSize(dm, name.c_str(), value, &n));
  return n;
}

void expect_same_cells(const Mesh& mesh, DM dm) {
  PetscInt begin = 0, end = 0;
  FSI_PETSC(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  ASSERT_EQ(begin, 0);
  EXPECT_EQ(end, mesh.n_cells);
  for (Index c = 0; c < mesh.n_owned; ++c) {
    PetscReal V = 0, centre[3] = {0, 0, 0};
    FSI_PETSC(DMPlexComputeCellGeometryFVM(dm, c, &V, centre, nullptr));
    EXPECT_NEAR(V, mesh.V[c], 1e-12 * mesh.V[c]);
    for (int k = 0; k < mesh.dim; ++k) EXPECT_NEAR(centre[k], mesh.C[c][k], 1e-13);
    PetscInt faces = 0;
    FSI_PETSC(DMPlexGetConeSize(dm, c, &faces));
    EXPECT_EQ(faces, static_cast<PetscInt>(mesh.cell_faces[c].size()));
  }
}

TEST(Plex, HoldsTheCellsFacesAndPatchesOfTheMesh) {
  for (const CellType type : all_types) {
    for (const bool periodic : {false, true}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(type) << periodic);
      Block block = block_of(type);
      block.moved = [](const Vec3& x) { return Vec3{x.x + 0.2 * x.y, x.y, x.z}; };  // plane sides
      const TextFile file(BlockText(block).text());
      const std::vector<std::string> pairs{"left", "right"};
      const Mesh mesh = divided(file.path(), periodic ? pairs : std::vector<std::string>{});
      const DM dm = mesh.dm();
      EXPECT_EQ(dm, mesh.dm());
      if (!periodic) expect_same_cells(mesh, dm);
      PetscInt begin = 0, end = 0;
      FSI_PETSC(DMPlexGetHeightStratum(dm, 1, &begin, &end));
      EXPECT_GE(end - begin, mesh.n_faces);
      for (std::size_t i = 0; i < mesh.patches.size(); ++i) {
        const auto value = static_cast<PetscInt>(i) + 1;
        const PetscInt n = labelled(dm, "Face Sets", value);
        EXPECT_GE(n, mesh.patches[i].end - mesh.patches[i].begin);
        EXPECT_EQ(n, labelled(dm, mesh.patches[i].name, value));
        if (ranks() == 1) {
          EXPECT_EQ(n, mesh.patches[i].end - mesh.patches[i].begin);
        }
      }
    }
  }
}

TEST(Plex, CellsAtASeamAreWhole) {
  for (const CellType type : {CellType::quad, CellType::hex, CellType::tet, CellType::prism}) {
    const TextFile file(BlockText(block_of(type)).text());
    const Mesh mesh = divided(file.path(), {"left", "right"});
    for (Index c = 0; c < mesh.n_owned; ++c) {
      PetscBool own = PETSC_FALSE;
      const PetscScalar* array = nullptr;
      PetscScalar* x = nullptr;
      PetscInt n = 0;
      FSI_PETSC(DMPlexGetCellCoordinates(mesh.dm(), c, &own, &n, &array, &x));
      Vec3 mean, expected;
      ASSERT_EQ(n, mesh.dim * static_cast<PetscInt>(mesh.cell_points[c].size()));
      for (PetscInt i = 0; i < n; ++i) mean[i % mesh.dim] += x[i] * mesh.dim / n;
      for (const Index p : mesh.cell_points[c]) {
        expected += mesh.points[p] / static_cast<Real>(mesh.cell_points[c].size());
      }
      for (int k = 0; k < mesh.dim; ++k) EXPECT_NEAR(mean[k], expected[k], 1e-14);
      FSI_PETSC(DMPlexRestoreCellCoordinates(mesh.dm(), c, &own, &n, &array, &x));
    }
  }
}

void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.hash, b.hash);
  EXPECT_EQ(a.n_global, b.n_global);
  EXPECT_EQ(a.n_owned, b.n_owned);
  EXPECT_EQ(a.global_id, b.global_id);
  EXPECT_EQ(a.owner, b.owner);
  EXPECT_EQ(a.neighbour, b.neighbour);
  EXPECT_EQ(a.Sf, b.Sf);
  EXPECT_EQ(a.C, b.C);
  EXPECT_EQ(a.translation, b.translation);
  EXPECT_EQ(a.point_id, b.point_id);
  EXPECT_EQ(a.cell_neighbours.index, b.cell_neighbours.index);
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t i = 0; i < a.patches.size(); ++i) {
    EXPECT_EQ(a.patches[i].name, b.patches[i].name);
    EXPECT_EQ(a.patches[i].end, b.patches[i].end);
  }
}

/// Collective. A file name beside the text's, gone with the object.
struct H5File {
  explicit H5File(const TextFile& text) : path(text.path() + ".h5") {}
  ~H5File() {
    MPI_Barrier(comm());
    std::error_code code;
    if (rank() == 0) std::filesystem::remove(path, code);
  }
  std::string path;
};

TEST(MeshFile, GivesTheMeshOfTheGmshFile) {
  for (const CellType type : all_types) {
    for (int axes = 0; axes <= 2; ++axes) {
      const std::vector<std::string> sides{"left", "right", "bottom", "top"};
      const std::vector<std::string> pairs(sides.begin(), sides.begin() + 2 * axes);
      const TextFile text(BlockText(block_of(type)).text());
      const H5File file(text);
      EXPECT_GT(convert_mesh(text.path(), file.path, pairs), 0);
      for (const auto& partitioner : {"metis", "ptscotch", "simple"}) {
        const Mesh mesh = divided(file.path, pairs, partitioner);
        if (std::string(partitioner) == "metis") {
          expect_same(mesh, divided(text.path(), pairs));
          expect_same(divided(file.path, {}), divided(text.path(), pairs));
        }
        EXPECT_EQ(global_sum(GlobalIndex{mesh.n_owned}), mesh.n_global);
      }
    }
  }
}

TEST(MeshFile, HoldsTheOrderOfTheMeshAsRead) {
  Block block = block_of(CellType::tet);
  block.n = {30, 17, 5};  // so many that cells are numbered anew
  const TextFile text(BlockText(block).text());
  const H5File file(text);
  EXPECT_EQ(convert_mesh(text.path(), file.path, {"left", "right"}), 30 * 17 * 5 * 6);
  expect_same(divided(file.path, {}), divided(text.path(), {"left", "right"}));
}

TEST(MeshFile, IsReadByPetsc) {
  const TextFile text(BlockText(block_of(CellType::hex)).text());
  const H5File file(text);
  convert_mesh(text.path(), file.path, {});
  const Mesh mesh = divided(text.path(), {});
  DM dm = nullptr;
  PetscViewer viewer = nullptr;
  PetscSF sf = nullptr;
  FSI_PETSC(DMCreate(comm(), &dm));
  FSI_PETSC(DMSetType(dm, DMPLEX));
  FSI_PETSC(PetscObjectSetName(reinterpret_cast<PetscObject>(dm), "fsi"));
  FSI_PETSC(PetscViewerCreate(comm(), &viewer));
  FSI_PETSC(PetscViewerSetType(viewer, PETSCVIEWERHDF5));
  FSI_PETSC(PetscViewerFileSetMode(viewer, FILE_MODE_READ));
  FSI_PETSC(PetscViewerFileSetName(viewer, file.path.c_str()));
  FSI_PETSC(DMPlexTopologyLoad(dm, viewer, &sf));
  FSI_PETSC(DMPlexCoordinatesLoad(dm, viewer, sf));
  FSI_PETSC(DMPlexLabelsLoad(dm, viewer, sf));
  FSI_PETSC(DMGetCoordinatesLocalSetUp(dm));
  PetscInt begin = 0, end = 0;
  FSI_PETSC(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  EXPECT_EQ(global_sum(GlobalIndex{end - begin}), mesh.n_global);
  Real volume = 0;
  for (PetscInt c = begin; c < end; ++c) {
    PetscReal V = 0;
    FSI_PETSC(DMPlexComputeCellGeometryFVM(dm, c, &V, nullptr, nullptr));
    volume += V;
  }
  EXPECT_NEAR(exact_sum({&volume, 1}), mesh.total_volume, 1e-3);
  const GlobalIndex left = labelled(dm, "left", 1);
  EXPECT_EQ(global_sum(left), 15);
  FSI_PETSC(PetscSFDestroy(&sf));
  FSI_PETSC(PetscViewerDestroy(&viewer));
  FSI_PETSC(DMDestroy(&dm));
}

void expect_refused(const std::string& file, const std::vector<std::string>& periodic,
                    const std::string& words) {
  try {
    divided(file, periodic);
    ADD_FAILURE() << "no error: " << words;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(MeshFile, SaysWhatIsWrong) {
  const TextFile text(BlockText(block_of(CellType::hex)).text());
  const H5File file(text);
  expect_refused(file.path, {}, "cannot be opened");
  convert_mesh(text.path(), file.path, {"left", "right"});
  expect_refused(file.path, {"bottom", "top"}, "was converted with the periodic patches left");
  // Every 97th byte of the second half another one: the tables are behind PETSc's part.
  MPI_Barrier(comm());
  if (rank() == 0) {
    std::fstream stream(file.path, std::ios::in | std::ios::out | std::ios::binary);
    const auto size = static_cast<long>(std::filesystem::file_size(file.path));
    for (long at = size / 2; at < size; at += 97) {
      stream.seekg(at);
      const auto c = static_cast<char>(stream.get() ^ 4);
      stream.seekp(at);
      stream.put(c);
    }
  }
  MPI_Barrier(comm());
  expect_refused(file.path, {}, file.path);
}

}  // namespace
}  // namespace fsi::test
