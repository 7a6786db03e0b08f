#pragma once
// What every face operator needs of the mesh, computed once.

#include <vector>

#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// Geometric factors of the faces. For an internal face P | N, for a boundary face P | b:
///   lambda  q_f = (1 - lambda) q_P + lambda q_N at the point where PN crosses the face plane
///   skew    Cf minus that point; zero on a mesh without skewness
///   g       |Sf|^2 / (Sf . d): over-relaxed coefficient of (q_N - q_P)           [Jasak96] (3.32)
///   k       Sf - g d: what is left for the explicit non-orthogonal correction
struct FaceWeights {
  /// Collective.
  explicit FaceWeights(const Mesh& mesh);

  std::vector<Real> lambda;     ///< [n_internal]
  std::vector<Vec3> skew;       ///< [n_internal]
  std::vector<Real> g;          ///< [n_faces]
  std::vector<Vec3> k;          ///< [n_faces]
  bool skewed = false;          ///< any |skew| above round-off, on any rank
  bool non_orthogonal = false;  ///< any |k| above round-off, on any rank
};

}  // namespace fsi
