#pragma once
// Geometric factors of the faces, computed once for all face operators.

#include <algorithm>
#include <vector>

#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// Geometric factors of the faces. For an internal face P | N, for a boundary face P | b:
///   lambda  q_f = (1 - lambda) q_P + lambda q_N at the point where PN crosses the face plane
///   skew    delta_lambda, Cf minus that point
///   g       |Sf|^2 / (Sf . d): over-relaxed coefficient of (q_N - q_P)           [Jasak96] (3.32)
///   k       Sf - g d: the rest, for the explicit non-orthogonal correction
///
/// A face is irregular if Cf is off the midpoint of PN, or k is not zero, by more than 1e-8 of the
/// cell. A boundary face is irregular unless its cell is a quadrilateral or hexahedron. Irregular
/// faces need a gradient (VertexMean) in addition to the values of both cells, in proportion to
/// these offsets. The limit decides which work is done. A mesh that changes across it changes the
/// results in the eighth digit.
struct FaceWeights {
  /// Collective.
  explicit FaceWeights(const Mesh& mesh);

  std::vector<Real> lambda;      ///< [n_internal]
  std::vector<Vec3> skew;        ///< [n_internal]
  std::vector<Real> g;           ///< [n_faces]
  std::vector<Vec3> k;           ///< [n_faces]
  std::vector<Index> irregular;  ///< faces, ascending
  std::vector<Index> place;      ///< [n_faces] place of a face in `irregular`; -1: it is regular
  bool uneven = false;           ///< whether some rank has irregular faces

  /// delta_1/2 = Cf - (C_P + d / 2) of an internal face.
  Vec3 from_midpoint(Index f, const Mesh& mesh) const {
    return skew[f] + (lambda[f] - 0.5) * mesh.d[f];
  }
  /// delta_1-lambda = Cf - (C_P + (1 - lambda) d), the place of lambda q_P + (1 - lambda) q_N.
  Vec3 from_mirror(Index f, const Mesh& mesh) const {
    return skew[f] + (2 * lambda[f] - 1) * mesh.d[f];
  }
  /// tan of the angle between d and Sf.
  Real tangent(Index f, const Mesh& mesh) const { return norm(k[f]) / norm(mesh.Sf[f]); }
  /// beta = |delta_1/2| / (4 |d|), at most 1: the upwind share, which damps the modes that the term
  /// in delta_1/2 lets grow (flow/convection.hpp).
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
