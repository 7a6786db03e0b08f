#pragma once
// A velocity given at some points.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/run/spline.hpp"

namespace fsi {

/// The velocity between the points of a table, such as a measured profile: a `Spline` through the
/// 24 points around x. More points are taken where 24 do not tell the slope in all directions that
/// the table spans. In other directions, across a plane or a line of points, the velocity is
/// constant, and points that differ in them alone count as one. A direction is spanned if the
/// points reach more than a fiftieth of their width along it; in the plane of a flat patch a
/// thousandth is enough. It is exact for a linear velocity and, with enough points, for a parabola.
class VelocityTable {
 public:
  /// A point and the velocity there.
  struct Row {
    Vec3 x;  ///< point
    Vec3 u;  ///< velocity
  };

  /// name: what errors call the table. Errors: Error{input} where it has no row, or two velocities
  /// at one point.
  VelocityTable(std::string name, std::vector<Row> rows);

  /// Collective. Keeps the points that lie at the patch, since one table may hold those of several
  /// patches, and the directions that they span. Errors: Error{input} if the table seems to be that
  /// of another patch or in other units. That is so if a face lies farther from all points than ten
  /// times their extent. It is also so if the table is a hundred times as wide as the patch and all
  /// faces are nearest to the same point. A table of one point holds everywhere. Returns a notice
  /// if the points at the patch, or all of them where fewer than two fifths lie there, span less
  /// than half or more than twice its width in a direction; else "".
  std::string fit_to(const Mesh& mesh, const Patch& patch);

  /// u(x). What was computed for a point is kept.
  Vec3 operator()(const Vec3& x) const;

 private:
  /// x in the directions that the table spans.
  Vec3 local(const Vec3& x) const;
  /// Sets all that follows from the points. normal: of a flat patch; zero: not known.
  void set_directions(const Vec3& normal, int dim);
  void merge_layers();
  Real least_distance(const Vec3& low, const Vec3& high) const;
  std::size_t nearest(const Vec3& x) const;
  /// The spline of the points around the k-th.
  const Spline& around(std::size_t k) const;
  std::string tell_of_width(const Mesh& mesh, const Patch& patch) const;

  std::string name_;
  std::vector<Row> given_, rows_;                       // all; those in use, sorted
  std::vector<Vec3> axes_;                              // that the table spans, orthonormal
  Real extent_ = 0;                                     // the diagonal of the points' box
  mutable std::vector<std::optional<Spline>> splines_;  // [rows], those computed so far
  mutable std::map<std::array<Real, 3>, Vec3> known_;   // results so far
};

}  // namespace fsi
