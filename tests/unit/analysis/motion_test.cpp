#include "libfsi/analysis/motion.hpp"

#include <gtest/gtest.h>

#include "libfsi/shapes/shapes.hpp"
#include "libfsi/vof/fill.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi::analysis {
namespace {

using namespace shapes;

TEST(Motion, CentroidVelocityAndVolume) {
  const Mesh mesh = test::read_box({{20, 20, 20}});
  CellField<Real> alpha(mesh);
  CellField<Vec3> u(mesh);
  const Vec3 x{0.45, 0.5, 0.55};
  vof::fill(alpha, mesh, translate(sphere(0.25), x));
  // A rotation about the centroid adds nothing to the mean velocity.
  for (Index c = 0; c < mesh.n_cells; ++c) {
    u[c] = Vec3{1, -2, 3} + cross({0, 1, 2}, mesh.C[c] - x);
  }
  Tracker tracker;
  const Motion m = motion(tracker, alpha, u, mesh);
  EXPECT_NEAR(m.volume, sphere_volume(0.25), 1e-7);
  EXPECT_LE(norm(m.centroid - x), 1e-6);
  EXPECT_LE(norm(m.velocity - Vec3{1, -2, 3}), 1e-5);
  EXPECT_LE(norm(tracker.home + tracker.travelled - m.centroid), 1e-15);
}

TEST(Motion, VelocityOfALaterTimeThanTheSolids) {
  const Mesh mesh = test::read_box({{20, 20, 20}});
  CellField<Real> alpha(mesh);
  CellField<Vec3> u(mesh);
  const Vec3 x{0.45, 0.5, 0.55}, speed{1, -2, 3}, spin{0, 1, 2};
  vof::fill(alpha, mesh, translate(sphere(0.25), x));
  // The solid turns about its centroid, which has gone on by the time of u.
  constexpr Real ahead = 0.01;
  for (Index c = 0; c < mesh.n_cells; ++c)
    u[c] = speed + cross(spin, mesh.C[c] - (x + ahead * speed));
  Tracker tracker;
  const Motion m = motion(tracker, alpha, u, mesh, ahead);
  const Vec3 aside = cross(spin, ahead * speed);
  EXPECT_GT(norm(aside), 0.05);
  EXPECT_LE(norm(m.velocity - speed), 1.01 * norm(cross(spin, ahead * aside)));
}

TEST(Motion, NoJumpAcrossPeriodicSeams) {
  const Mesh mesh =
      test::read_box({{32, 16, 0}, {2, 1, 1}, false, {"left", "right", "bottom", "top"}});
  CellField<Real> alpha(mesh);
  const CellField<Vec3> u(mesh);
  const Vec3 start{1.96, 0.52, 0}, stride = Vec3{3, -2, 0} / 16;  // whole cells
  Tracker tracker;
  Vec3 first;
  for (int k = 0; k < 40; ++k) {
    Vec3 x = start + k * stride;
    x.x -= 2 * std::floor(x.x / 2), x.y -= std::floor(x.y);
    vof::fill(alpha, mesh, translate(sphere(0.2), x));
    const Motion m = motion(tracker, alpha, u, mesh);
    if (k == 0) {
      first = m.centroid;
      EXPECT_LE(norm(first - start), 2e-4) << "of its images that in the mesh";
    }
    EXPECT_LE(norm(m.centroid - first - k * stride), 1e-12);
  }
}

// Seen only every few steps, a block that is nearly as long as a period has cells on the far side
// of where it was.
TEST(Motion, OfASolidAlmostAsLongAsAPeriod) {
  const Mesh mesh = test::read_box({{32, 32, 0}, {1, 1, 1}, false, {"left", "right"}});
  CellField<Real> alpha(mesh);
  const CellField<Vec3> u(mesh);
  for (const Real length : {0.8, 0.9, 0.95}) {
    Tracker tracker;
    for (int k = 0; k < 20; ++k) {
      const Real x = 0.5 + 3 * k / 32.0;  // whole cells
      vof::fill(alpha, mesh, translate(box({length, 0.3, 9}), {x - std::floor(x), 0.5, 0}));
      EXPECT_NEAR(motion(tracker, alpha, u, mesh).centroid.x, x, 1e-9) << length << ' ' << k;
    }
  }
}

TEST(Motion, WithoutSolidItStands) {
  const Mesh mesh = test::read_box({{4, 4, 0}});
  const CellField<Real> alpha(mesh);
  const CellField<Vec3> u(mesh, Vec3{1, 0, 0});
  Tracker tracker{{0.3, 0.4, 0}, {2, 0, 0}, {}, true};
  const Motion m = motion(tracker, alpha, u, mesh);
  EXPECT_EQ(m.volume, 0);
  EXPECT_EQ(m.velocity, Vec3{});
  EXPECT_LE(norm(m.centroid - Vec3{2.3, 0.4, 0}), 1e-15);
}

}  // namespace
}  // namespace fsi::analysis
