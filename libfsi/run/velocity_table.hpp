#pragma once
// A velocity known at some places.

#include <optional>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// The velocity around the places of a table, such as a measured profile. About the place x_k
/// nearest to x it is linear:
///
///   u(x) = u_k + L_k . (x - x_k),
///
/// L_k by least squares over the eight places nearest to x_k, or as many more as it takes to spread
/// in all directions in which the table does. In the others, across a plane or a line of places,
/// L_k is zero. Exact for a linear velocity, else of second order in the distance of the places.
class VelocityTable {
 public:
  /// A place and the velocity there.
  struct Row {
    Vec3 x;  ///< place
    Vec3 u;  ///< velocity
  };

  /// name: what errors call the table. Errors: Error{input} where it has no row.
  VelocityTable(std::string name, std::vector<Row> rows);

  /// Collective. Errors: Error{input} where the table is that of another patch or in other units.
  /// So it is where a face lies farther from all places than ten times their extent. So it is, too,
  /// where all faces are nearest to the same place of a table a hundred times as wide as the patch.
  /// A table of one place holds everywhere.
  void check(const Mesh& mesh, const Patch& patch) const;

  /// u(x).
  Vec3 operator()(const Vec3& x) const;

 private:
  std::size_t nearest(const Vec3& x) const;
  const Tensor& slope(std::size_t k) const;

  std::string name_;
  std::vector<Row> rows_;
  Real extent_ = 0;                                   // the diagonal of the box around the places
  mutable std::vector<std::optional<Tensor>> slope_;  // [rows], those that were asked for
};

}  // namespace fsi
