#include "libfsi/core/types.hpp"

#include <gtest/gtest.h>

namespace fsi {
namespace {

TEST(Types, DeviatorIsTraceFree) {
  const SymTensor a{1, 2, 3, 4, 5, 7};
  EXPECT_EQ(trace(dev(a)), 0);
  EXPECT_EQ(dev(a).xy, a.xy);
}

TEST(Types, DeterminantOfAKnownTensor) {
  EXPECT_EQ(det(SymTensor{2, 0, 0, 3, 0, 4}), 24);
  EXPECT_EQ(det(SymTensor{2, 1, 0, 2, 0, 1}), 3);
}

TEST(Types, VelocityGradientConvention) {
  // L.xy = du_x/dy: L . (0, 1, 0) is the change of u along y.
  Tensor L;
  L.xy = 5;
  EXPECT_EQ(dot(L, Vec3{0, 1, 0}), (Vec3{5, 0, 0}));
}

}  // namespace
}  // namespace fsi
