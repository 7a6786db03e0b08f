// The images of cells beyond planes of symmetry are the cells of the mesh that they complete.

#include "libfsi/operators/symmetry_faces.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "libfsi/core/parallel.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

constexpr Index n = 4;  // cells across the whole box

/// A box, periodic along x, or the quarter of it with the least y and z. It is turned about x, and
/// the places of its points have six decimals.
Mesh box(Index across, bool simplex) {
  const Real part = static_cast<Real>(across) / n;
  const auto digits = [](Real x) { return std::round(1e6 * x) / 1e6; };
  return test::read_box(
      {.n = {n, across, across},
       .length = {1, part, part},
       .simplex = simplex,
       .periodic = {"left", "right"},
       .moved =
           [=](const Vec3& x) {
             const Real c = std::cos(0.5), s = std::sin(0.5);
             return Vec3{x.x, digits(c * x.y - s * x.z), digits(s * x.y + c * x.z)};
           },
       .mirrored = across == n ? "yz" : ""});
}

std::vector<char> faces_of(const std::vector<std::string>& names, const Mesh& mesh) {
  std::vector<char> faces(static_cast<std::size_t>(mesh.n_boundary()), 0);
  for (const std::string& name : names)
    for (const Patch& patch : mesh.patches)
      for (Index f = patch.begin; f < patch.end; ++f)
        if (patch.name == name) faces[f - mesh.n_internal] = 1;
  return faces;
}

/// Sums of 1 and of |r| over the neighbours and images of all cells.
std::array<Real, 2> neighbours(const SymmetryFaces& symmetry, const Mesh& mesh) {
  Sum count, way;
  for (Index c = 0; c < mesh.n_owned; ++c)
    for_neighbours_and_images(c, symmetry, mesh, [&](Index, const Vec3& r, const Reflection&) {
      count.add(1), way.add(norm(r));
    });
  return {count.total(), way.total()};
}

TEST(SymmetryFaces, CompleteAQuarterOfATurnedMeshOfSixDecimals) {
  for (const bool simplex : {false, true}) {
    const Mesh whole = box(n, simplex), quarter = box(n / 2, simplex);
    const auto [count, way] = neighbours({}, whole);
    const auto of_quarter =
        neighbours(SymmetryFaces(faces_of({"top", "front"}, quarter), quarter), quarter);
    EXPECT_EQ(4 * of_quarter[0], count);
    EXPECT_NEAR(4 * of_quarter[1], way, 1e-6 * way);
  }
}

// The corners of a warped face lie off its plane.
TEST(SymmetryFaces, ACellAtAWarpedFaceSeesItsImage) {
  const Mesh mesh = test::read_box({.n = {n, n, n}, .moved = [](const Vec3& x) {
                                      return Vec3{x.x, x.y, x.z * (1 + 0.3 * x.x * x.y)};
                                    }});
  const SymmetryFaces symmetry(faces_of({"front"}, mesh), mesh);
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
    if (!symmetry.has(f, mesh)) continue;
    bool found = false;
    symmetry.for_images(mesh.owner[f], [&](Index k, const Vec3& r, const Reflection&) {
      found = found || (k == mesh.owner[f] && norm(r - to_image(mesh, f)) < 1e-9);
    });
    EXPECT_TRUE(found) << f;
  }
}

}  // namespace
}  // namespace fsi
