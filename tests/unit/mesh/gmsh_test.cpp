// The shipped geometries, meshed by gmsh and written in each format it knows.

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "libfsi/core/error.hpp"
#include "tests/unit/mesh/block.hpp"

namespace fsi::test {
namespace {

Mesh built(const std::string& name, const std::vector<std::string>& periodic = {}) {
  return divided(std::string(FSI_TEST_MESHES) + "/" + name + ".msh", periodic);
}

std::vector<std::string> patch_names(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const Patch& patch : mesh.patches) names.push_back(patch.name);
  return names;
}

GlobalIndex faces_of(const Mesh& mesh, const std::string& name) {
  const Patch& patch = mesh.patch(name);
  return global_sum(patch.end - patch.begin);
}

const char* const formats[] = {"22_ascii", "22_bin", "40_ascii", "41_ascii", "41_bin"};

TEST(Gmsh, FormatsAgree) {
  for (const std::string format : formats) {
    const Mesh mesh = built("pipe_" + format, {"inlet", "outlet"});
    EXPECT_EQ(mesh.n_global, 384);
    EXPECT_EQ(patch_names(mesh), std::vector<std::string>{"wall"});
    EXPECT_EQ(faces_of(mesh, "wall"), 128);
    // 16 equal sides inscribed in the circle of diameter 1, length 1
    EXPECT_NEAR(mesh.total_volume, 2 * std::sin(std::numbers::pi / 8), 1e-12);
    EXPECT_LE(quality(mesh).closure_max, 1e-12);
    ASSERT_EQ(mesh.translation.size(), 3u);
    EXPECT_NEAR(std::abs(mesh.translation[1].x), 1, 1e-12);
  }
  EXPECT_EQ(built("pipe_22_ascii").hash, built("pipe_41_ascii").hash);
  EXPECT_EQ(built("pipe_22_bin").hash, built("pipe_41_bin").hash);
}

TEST(Gmsh, PeriodicSectionOfEachFormat) {
  for (const std::string format : formats) {
    testing::internal::CaptureStderr();  // the named sides of a seam are no faces inside
    const Mesh mesh = built("periodic_" + format);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_TRUE(mesh.patches.empty());
    EXPECT_EQ(mesh.n_boundary(), 0);
    EXPECT_NEAR(mesh.total_volume, 1, 1e-12);
    EXPECT_LE(quality(mesh).closure_max, 1e-12);
    EXPECT_EQ(mesh.translation.size(), 9u);
  }
}

TEST(Gmsh, CutBinaryFile) {
  for (const std::string format : {"22_bin", "41_bin"}) {
    std::ifstream in(std::string(FSI_TEST_MESHES) + "/pipe_" + format + ".msh", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    ASSERT_GT(text.size(), 1000u);
    for (std::size_t length = 1; length + 14 < text.size(); length += text.size() / 89) {
      EXPECT_THROW(check_mesh(parse_gmsh("cut", text.substr(0, length)), {}), Error) << length;
    }
  }
}

TEST(Gmsh, PipeCellsAndPatches) {
  for (const std::string cells : {"prism", "simplex", "half", "half_simplex"}) {
    const Mesh mesh = built("pipe_" + cells, {"inlet", "outlet"});
    const bool half = cells.rfind("half", 0) == 0;
    EXPECT_EQ(patch_names(mesh).size(), half ? 2u : 1u);
    EXPECT_NEAR(mesh.total_volume, std::numbers::pi / 4 / (half ? 2 : 1), 0.02);
    EXPECT_LE(quality(mesh).closure_max, 1e-12);
    EXPECT_LT(quality(mesh).non_orthogonality.value, 50);
    if (!half) continue;
    const Patch& symmetry = mesh.patch("symmetry");
    for (Index f = symmetry.begin; f < symmetry.end; ++f) EXPECT_NEAR(mesh.Cf[f].z, 0.5, 1e-12);
  }
}

TEST(Gmsh, SharesOfARoundPipe) {
  // Every wall node lies on the cylinder, and no cell of the O-grid is much smaller than another.
  const Mesh mesh = built("pipe_22_ascii");
  const Patch& wall = mesh.patch("wall");
  for (Index f = wall.begin; f < wall.end; ++f) {
    for (const Index p : mesh.face_points[f]) {
      EXPECT_NEAR(std::hypot(mesh.points[p].y - 0.5, mesh.points[p].z - 0.5), 0.5, 1e-12);
    }
  }
  const Quality q = quality(mesh);
  EXPECT_LT(q.volume_max, 3 * q.volume_min);
  EXPECT_LT(q.non_orthogonality.value, 35);
}

TEST(Gmsh, StenosisWallLiesOnTheCosine) {
  std::map<std::string, Real> volume;
  for (const std::string name : {"stenosis", "stenosis_short", "stenosis_simplex", "stenosis_half",
                                 "stenosis_half_simplex"}) {
    const Mesh mesh = built(name);
    const bool half = name.find("half") != std::string::npos;
    std::vector<std::string> patches{"inlet", "outlet", "wall"};
    if (half) patches.emplace_back("symmetry");
    EXPECT_EQ(patch_names(mesh), patches);
    volume[name] = mesh.total_volume;
    const Real throat = name == "stenosis_short" ? 2 : 6;
    const Patch& wall = mesh.patch("wall");
    for (Index f = wall.begin; f < wall.end; ++f) {
      for (const Index i : mesh.face_points[f]) {
        const Vec3 x = mesh.points[i];
        Real R = 0.5;
        if (std::abs(x.x - 3) < throat / 2) {
          R -= 0.125 * (1 + std::cos(2 * std::numbers::pi * (x.x - 3) / throat));
        }
        EXPECT_NEAR(std::hypot(x.y - 0.5, x.z - 0.5), R, 1e-6);
      }
    }
    EXPECT_LE(quality(mesh).closure_max, 1e-12);
    if (!half) continue;
    const Patch& symmetry = mesh.patch("symmetry");
    for (Index f = symmetry.begin; f < symmetry.end; ++f) EXPECT_NEAR(mesh.Cf[f].z, 0.5, 1e-9);
  }
  // the walls of both are divided alike, of tetrahedra nearly so
  EXPECT_NEAR(2 * volume["stenosis_half"] / volume["stenosis"], 1, 1e-12);
  EXPECT_NEAR(2 * volume["stenosis_half_simplex"] / volume["stenosis_simplex"], 1, 5e-3);
}

TEST(Gmsh, CavityAndBox) {
  EXPECT_EQ(patch_names(built("cavity")), (std::vector<std::string>{"top", "wall"}));
  EXPECT_EQ(built("cavity").n_global, 64);
  EXPECT_EQ(faces_of(built("cavity_simplex"), "top"), 8);
  const std::vector<std::string> sides{"left", "right", "bottom", "top", "back", "front"};
  const Mesh box = built("box");
  EXPECT_EQ(patch_names(box), sides);
  EXPECT_EQ(box.n_global, 4 * 8 * 3);
  EXPECT_NEAR(box.total_volume, 1.5, 1e-10);  // gmsh places nodes to 1e-12
  EXPECT_EQ(built("box", sides).n_boundary(), 0);
  EXPECT_EQ(faces_of(built("box"), "back"), 32);
  for (const std::string name : {"left", "right", "bottom", "top", "back", "front"}) {
    const Patch& patch = box.patch(name);
    const int axis = name == "left" || name == "right"   ? 0
                     : name == "back" || name == "front" ? 2
                                                         : 1;
    const bool high = name == "right" || name == "top" || name == "front";
    const Vec3 length{1, 2, 0.75};
    for (Index f = patch.begin; f < patch.end; ++f) {
      EXPECT_NEAR(box.Cf[f][axis], high ? length[axis] : 0, 1e-9);
    }
  }
  const Mesh flat = built("box_flat", {"left", "right", "bottom", "top"});
  EXPECT_EQ(flat.dim, 2);
  EXPECT_EQ(flat.n_boundary(), 0);
}

TEST(Gmsh, SidesWhoseTrianglesDoNotMatch) {
  EXPECT_EQ(faces_of(built("box_tets", {"left", "right"}), "top"), 2 * 4 * 3);
  try {
    built("box_tets", {"bottom", "top"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_NE(std::string(error.what()).find("of periodic patch \"bottom\" has no counterpart"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace fsi::test
