#pragma once
// The centre line of a vessel between two of its openings.

#include <string>
#include <utility>
#include <vector>

#include "libfsi/mesh/mesh.hpp"

namespace fsi::flow {

/// The points of the line are the centres of the surfaces of equal potential q. Here Lap q = 0, q =
/// 1 at the first patch, 0 at the second, and no flux passes through all others. Cells have the
/// weight V |grad q|, and less where |grad q| is below half of its mean on the surface, so that
/// dead ends with constant q do not count. The direction of the line is the mean one of -grad q
/// there.
class CentreLine {
 public:
  /// Collective. Errors: Error{input} where the mesh has no such patches.
  CentreLine(const Mesh& mesh, const std::string& from, const std::string& to);

  /// Its arc length.
  Real length() const { return arc_.back(); }
  /// The point at s along the line, and its direction there (of norm 1).
  std::pair<Vec3, Vec3> at(Real s) const;

 private:
  void add(const Vec3& point, const Vec3& along);

  std::vector<Vec3> points_, along_;
  std::vector<Real> arc_;  // [points]
};

}  // namespace fsi::flow
