#pragma once
// A velocity given at some points.

#include <optional>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// The velocity around the points of a table, such as a measured profile. About the point x_k
/// nearest to x it is linear:
///
///   u(x) = u_k + L_k . (x - x_k).
///
/// L_k is a least-squares fit over the eight points nearest to x_k, or over as many more as are
/// needed to span all directions that the table spans. In other directions, across a plane or a
/// line of points, L_k is zero. It is exact for a linear velocity, and of second order in the
/// distance of the points.
class VelocityTable {
 public:
  /// A point and the velocity there.
  struct Row {
    Vec3 x;  ///< point
    Vec3 u;  ///< velocity
  };

  /// name: what errors call the table. Errors: Error{input} where it has no row.
  VelocityTable(std::string name, std::vector<Row> rows);

  /// Collective. Errors: Error{input} if the table seems to be that of another patch or in other
  /// units. That is so if a face lies farther from all points than ten times their extent. It is
  /// also so if the table is a hundred times as wide as the patch and all faces are nearest to the
  /// same point. A table of one point holds everywhere.
  void check(const Mesh& mesh, const Patch& patch) const;

  /// u(x).
  Vec3 operator()(const Vec3& x) const;

 private:
  std::size_t nearest(const Vec3& x) const;
  const Tensor& slope(std::size_t k) const;

  std::string name_;
  std::vector<Row> rows_;
  Real extent_ = 0;                                   // the diagonal of the box around the points
  mutable std::vector<std::optional<Tensor>> slope_;  // [rows], those computed so far
};

}  // namespace fsi
