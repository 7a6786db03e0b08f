#include "libfsi/io/fields.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "libfsi/core/error.hpp"
#include "libfsi/io/collect.hpp"
#include "libfsi/io/hdf5.hpp"
#include "libfsi/io/vtk_mesh.hpp"
#include "tests/unit/io/support.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

using io::FieldWriter;
using io::Hdf5File;
using io::NamedField;
using io::VtkMesh;
using test::Folder;

/// Corners of the faces of VTK's cells, right-handed about the outward normal [VTK].
std::vector<std::vector<int>> faces_of(std::uint8_t type) {
  switch (type) {
    case 10:
      return {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
    case 12:
      return {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
    case 13:
      return {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
    case 14:
      return {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    default:
      return {};
  }
}

Vec3 point(const VtkMesh& mesh, std::int64_t cell, int corner) {
  const auto p = static_cast<std::size_t>(
      mesh.connectivity[static_cast<std::size_t>(mesh.offsets[static_cast<std::size_t>(cell)]) +
                        static_cast<std::size_t>(corner)]);
  return {mesh.points[3 * p], mesh.points[3 * p + 1], mesh.points[3 * p + 2]};
}

/// Volume by the divergence theorem over flat faces; positive where they look outward.
Real volume(const VtkMesh& mesh, std::int64_t cell) {
  Real six = 0;
  for (const auto& face : faces_of(mesh.types[static_cast<std::size_t>(cell)]))
    for (std::size_t k = 1; k + 1 < face.size(); ++k)
      six += dot(point(mesh, cell, face[0]),
                 cross(point(mesh, cell, face[k]), point(mesh, cell, face[k + 1])));
  return six / 6;
}

/// Collective. All ranks' stretches on rank 0, nothing on the others.
VtkMesh whole(const Mesh& mesh) {
  const VtkMesh mine = io::vtk_mesh(mesh);
  VtkMesh all;
  const auto join = [](const auto& part, auto& items) {
    for (const auto& other : io::collect(part))
      items.insert(items.end(), other.begin(), other.end());
  };
  join(mine.points, all.points), join(mine.connectivity, all.connectivity);
  join(mine.offsets, all.offsets), join(mine.types, all.types);
  return all;
}

/// One prism or pyramid as a mesh.
Mesh single(std::vector<Vec3> points) {
  Mesh mesh;
  mesh.n_owned = mesh.n_cells = 1, mesh.n_global = ranks();
  mesh.global_id = {rank()};
  for (Index i = 0; i < static_cast<Index>(points.size()); ++i) mesh.cell_points.index.push_back(i);
  mesh.cell_points.offset.push_back(static_cast<Index>(points.size()));
  for (const Index i : mesh.cell_points.index)
    mesh.point_id.push_back(i + rank() * static_cast<Index>(points.size()));
  mesh.points = std::move(points);
  return mesh;
}

TEST(VtkMesh, FacesLookOutward) {
  const Real z = rank();
  const std::array meshes{
      std::pair(
          single({{0, 0, z}, {1, 0, z}, {0, 1, z}, {0, 0, z + 1}, {1, 0, z + 1}, {0, 1, z + 1}}),
          0.5),
      std::pair(single({{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}, {0.5, 0.5, z + 1}}), 1. / 3)};
  for (const auto& [mesh, V] : meshes) {
    const VtkMesh vtk = whole(mesh);
    for (std::size_t c = 0; c < vtk.types.size(); ++c)
      EXPECT_NEAR(volume(vtk, static_cast<std::int64_t>(c)), V, 1e-15);
  }
  for (const bool simplex : {false, true}) {
    const Mesh mesh = test::read_box({.n = {3, 2, 2}, .simplex = simplex});
    const VtkMesh vtk = whole(mesh);
    Real total = 0;
    for (std::size_t c = 0; c < vtk.types.size(); ++c) {
      const Real V = volume(vtk, static_cast<std::int64_t>(c));
      EXPECT_GT(V, 0);
      total += V;
    }
    EXPECT_NEAR(total, rank() == 0 ? 1 : 0, 1e-14);
  }
}

TEST(VtkMesh, PointsAreSharedAndEachIsThereOnce) {
  const Mesh mesh = test::read_box({.n = {3, 2, 2}, .periodic = {"left", "right"}});
  const VtkMesh vtk = whole(mesh);
  EXPECT_EQ(vtk.points.size(), rank() == 0 ? 3U * 4 * 3 * 3 : 0U);
  EXPECT_EQ(vtk.types.size(), rank() == 0 ? 12U : 0U);
  const Mesh plane = test::read_box({.n = {3, 2, 0}, .simplex = true});
  const VtkMesh flat = whole(plane);
  EXPECT_EQ(flat.types, std::vector<std::uint8_t>(rank() == 0 ? 12 : 0, 5));
}

/// Collective; true on the other ranks.
bool holds(const std::string& file, const std::string& path, const std::vector<Real>& expected) {
  if (rank() != 0) return true;
  std::vector<Real> found(expected.size(), -1);
  return Hdf5File(file).dataset(path, found) && found == expected;
}

TEST(Fields, ValuesStandInTheOrderOfTheMeshFile) {
  const Mesh mesh = test::read_box({.n = {3, 2, 0}});
  const Folder folder;
  CellField<Real> p(mesh);
  CellField<SymTensor> B(mesh);
  std::vector<Real> expected_p, expected_B;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    p[c] = std::sqrt(static_cast<Real>(mesh.global_id[c]));
    B[c] = {p[c] + 1, p[c] + 2, p[c] + 3, p[c] + 4, p[c] + 5, p[c] + 6};
  }
  for (int i = 0; i < 6; ++i) {
    const Real value = std::sqrt(static_cast<Real>(i));
    expected_p.push_back(value);
    for (const int k : {1, 4, 6, 2, 5, 3}) expected_B.push_back(value + k);  // XX YY ZZ XY YZ XZ
  }
  FieldWriter writer(folder.path(), mesh);
  writer.write(0.5, std::array{io::named("p", p), io::named("B", B)});
  const std::string file = folder / "fields_0000.hdf";
  EXPECT_TRUE(holds(file, "/VTKHDF/CellData/p", expected_p));
  EXPECT_TRUE(holds(file, "/VTKHDF/CellData/B", expected_B));
  // Through the links: the mesh.
  EXPECT_TRUE(holds(file, "/VTKHDF/NumberOfCells", {6}));
  EXPECT_TRUE(holds(file, "/VTKHDF/NumberOfPoints", {12}));
  EXPECT_TRUE(holds(file, "/VTKHDF/Offsets", {0, 4, 8, 12, 16, 20, 24}));
  EXPECT_TRUE(holds(file, "/VTKHDF/Types", std::vector<Real>(6, 9)));
  EXPECT_EQ(test::content(folder / "fields.hdf.series"),
            "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n"
            "    {\"name\": \"fields_0000.hdf\", \"time\": 0.5}\n  ]\n}\n");
}

bool exists(const std::string& path) {
  return all_of_ranks(rank() != 0 || std::filesystem::exists(path));
}

TEST(Fields, ARestartTakesUpTheSeries) {
  const Mesh mesh = test::read_box({.n = {3, 2, 0}});
  const Folder folder;
  const CellField<Real> p(mesh, 1);
  const std::array fields{io::named("p", p)};
  {
    FieldWriter writer(folder.path(), mesh);
    for (const Real t : {0.0, 0.1, 0.2, 0.3}) writer.write(t, fields);
  }
  {
    FieldWriter writer(folder.path(), mesh, 0.1);
    EXPECT_FALSE(exists(folder / "fields_0002.hdf"));
    writer.write(0.25, fields);
  }
  {
    FieldWriter writer(folder.path(), mesh, 0.25);
    writer.write(0.25, fields);
  }
  EXPECT_EQ(test::content(folder / "fields.hdf.series"),
            "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n"
            "    {\"name\": \"fields_0000.hdf\", \"time\": 0},\n"
            "    {\"name\": \"fields_0001.hdf\", \"time\": 0.10000000000000001},\n"
            "    {\"name\": \"fields_0002.hdf\", \"time\": 0.25}\n  ]\n}\n");
  const FieldWriter fresh(folder.path(), mesh);
  EXPECT_FALSE(exists(folder / "fields_0000.hdf"));
}

TEST(Fields, WhatIsNotFiniteIsNotWritten) {
  const Mesh mesh = test::read_box({.n = {3, 2, 0}});
  const Folder folder;
  CellField<Vec3> u(mesh);
  for (Index c = 0; c < mesh.n_owned; ++c)
    if (mesh.global_id[c] >= 2) u[c].z = std::numeric_limits<Real>::infinity();
  FieldWriter writer(folder.path(), mesh);
  try {
    writer.write(0, std::array{io::named("u", u)});
    ADD_FAILURE() << "written";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::numerics);
    EXPECT_STREQ(error.what(), "field \"u\" is not finite in cell 2 at (0.833333, 0.25, 0)");
  }
  EXPECT_FALSE(exists(folder / "fields_0000.hdf"));
}

TEST(Fields, AFailedWriteIsAnErrorOnAllRanks) {
  const Mesh mesh = test::read_box({.n = {3, 2, 0}});
  const Folder folder;
  try {
    const FieldWriter writer(folder / "none", mesh);
    ADD_FAILURE() << "written";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
  }
}

}  // namespace
}  // namespace fsi
