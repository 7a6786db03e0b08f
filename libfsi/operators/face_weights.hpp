#pragma once
// What every face operator needs of the mesh, computed once.

#include <algorithm>
#include <vector>

#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// Geometric factors of the faces. For an internal face P | N, for a boundary face P | b:
///   lambda  q_f = (1 - lambda) q_P + lambda q_N at the point where PN crosses the face plane
///   skew    Cf minus that point
///   g       |Sf|^2 / (Sf . d): over-relaxed coefficient of (q_N - q_P)           [Jasak96] (3.32)
///   k       Sf - g d: what is left for the explicit non-orthogonal correction
///
/// A face is irregular where the mean of its two cells and the difference along d do not do. Cf is
/// not the midpoint of PN or k is not zero, in parts of 1e-8, or the face lies at the boundary and
/// its cell is neither a quadrilateral nor a hexahedron. What it needs besides comes from the
/// gradient there (VertexMean), in proportion to these offsets. The limit decides what work is
/// done. A change of the mesh across it changes the results in the eighth digit.
struct FaceWeights {
  /// Collective.
  explicit FaceWeights(const Mesh& mesh);

  std::vector<Real> lambda;      ///< [n_internal]
  std::vector<Vec3> skew;        ///< [n_internal]
  std::vector<Real> g;           ///< [n_faces]
  std::vector<Vec3> k;           ///< [n_faces]
  std::vector<Index> irregular;  ///< faces, ascending
  std::vector<Index> place;  ///< [n_faces] where a face stands in `irregular`; -1: it is regular
  bool uneven = false;       ///< there are irregular faces on some rank

  /// Cf - (C_P + d / 2) of an internal face: from the midpoint of the centres.
  Vec3 from_midpoint(Index f, const Mesh& mesh) const {
    return skew[f] + (lambda[f] - 0.5) * mesh.d[f];
  }
  /// Cf - (C_P + (1 - lambda) d): from the point where the value lambda q_P + (1 - lambda) q_N is.
  Vec3 from_mirror(Index f, const Mesh& mesh) const {
    return skew[f] + (2 * lambda[f] - 1) * mesh.d[f];
  }
  /// tan of the angle between d and Sf.
  Real tangent(Index f, const Mesh& mesh) const { return norm(k[f]) / norm(mesh.Sf[f]); }
  /// beta = |m| / (4 |d|), at most 1, m from the midpoint: the share of the upwind value that damps
  /// what the correction by m costs (flow/convection.hpp).
  Real damping(Index f, const Mesh& mesh) const {
    return std::min(Real{1}, norm(from_midpoint(f, mesh)) / (4 * norm(mesh.d[f])));
  }
  /// theta_f = (1 + tangent) / 2, at most 1: the share of the compact viscous term that is implicit
  /// (flow/momentum.hpp).
  Real implicit(Index f, const Mesh& mesh) const {
    return std::min(Real{1}, (1 + tangent(f, mesh)) / 2);
  }
};

}  // namespace fsi
