#pragma once
// The flow that carries and strains the solid, as every kinematics reads it.

#include <span>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/gradient.hpp"
#include "libfsi/operators/least_squares.hpp"
#include "libfsi/operators/symmetry_faces.hpp"

namespace fsi::solid {

/// Derivatives of a symmetric tensor along x, y, z.
struct SymGradient {
  /// Derivative along that axis.
  SymTensor x, y, z;

  ///@{
  /// Component by component.
  SymGradient& operator+=(const SymGradient& b) { return x += b.x, y += b.y, z += b.z, *this; }
  friend SymGradient operator*(Real s, const SymGradient& g) { return {s * g.x, s * g.y, s * g.z}; }
  ///@}
};
/// The gradient that is g.x T along x, and so on.
inline SymGradient outer(const SymTensor& T, const Vec3& g) { return {g.x * T, g.y * T, g.z * T}; }
/// Change along the vector d.
inline SymTensor along(const SymGradient& g, const Vec3& d) {
  return d.x * g.x + d.y * g.y + d.z * g.z;
}

/// Image of the gradient of a tensor field in a plane with unit normal n.
inline SymGradient image(const SymGradient& g, const Vec3& n) {
  SymGradient of{image(g.x, n), image(g.y, n), image(g.z, n)};
  return of += outer(-2 * along(of, n), n);
}

/// The slope Gamma of T by a least-squares fit: T rises by `rise` over the vector r, with the
/// weight 1 / |r|^2.
struct TensorFit {
  /// Adds one value.
  void add(const SymTensor& rise, const Vec3& r) {
    const Real w = 1 / norm2(r);
    M += w * square(r);
    R += w * outer(rise, r);
  }
  /// The slope, zero without values. In directions that the vectors r do not span it tends to zero
  /// (`raised_inverse`).
  SymGradient slope(int dim) const {
    if (M == SymTensor{}) return {};
    const SymTensor K = raised_inverse(M, dim);
    return {along(R, {K.xx, K.xy, K.xz}), along(R, {K.xy, K.yy, K.yz}),
            along(R, {K.xz, K.yz, K.zz})};
  }

  SymTensor M;    ///< sum of w r r
  SymGradient R;  ///< sum of w rise r
};

/// Gradient of T on the listed owned cells. stencil: without given boundary values, so that the
/// gradient of a linear field is exact at boundaries too. symmetry: planes beyond which the images
/// of the cells count as neighbours.
void gradient(CellField<SymGradient>& grad, const CellField<SymTensor>& T,
              const GradientStencil& stencil, const SymmetryFaces& symmetry, const Mesh& mesh,
              std::span<const Index> cells);
/// The same of alpha T.
void gradient(CellField<SymGradient>& grad, const CellField<Real>& alpha,
              const CellField<SymTensor>& T, const GradientStencil& stencil,
              const SymmetryFaces& symmetry, const Mesh& mesh, std::span<const Index> cells);

/// The boundary faces that the solid touches.
struct Contact {
  const BoundaryField<Vec3>& u_b;      ///< velocity of the boundary
  const BoundaryField<char>& touched;  ///< 1 on faces that the solid touches, but for openings
};

/// How the surface cuts the faces, for a force that depends on it (alpha_f).
struct CutFaces {
  const FaceField<Real>& alpha_f;  ///< part of solid between the centres of the two cells
  const FaceField<Vec3>& normal;   ///< of the surface
  const CellField<Real>& alpha;    ///< fractions of the cells
};

class InterfaceGradient;
class ReferenceMap;

/// The flow, frozen over a step of the solid.
struct FlowSnapshot {
  const FaceField<Real>& phi;      ///< volume flux
  const CellField<Vec3>& u;        ///< velocity
  const CellField<Tensor>& L;      ///< velocity gradient
  const GradientStencil& stencil;  ///< without given boundary values
  const FaceWeights& weights;      ///< of the faces
  /// The L that strains the solid in the simplex zone; null: L, u and phi strain it in all cells.
  const InterfaceGradient* one_sided = nullptr;
  const Contact* contact = nullptr;  ///< null: the solid touches no boundary
  const CutFaces* cuts = nullptr;    ///< null: L is not bounded by the work
  Real in_series = 1;                ///< mu_s / mu_f of the traction in series; 1: there is none
  Real wave_speed = 0;               ///< c_s of shear waves at rest, sqrt(G / rho)
  Real recovery = 0;  ///< G / mu_s, rate of an elastic recovery that viscosity slows down
  /// The memory, at the end of the step; null: the solid has none.
  const ReferenceMap* memory = nullptr;
  /// For the memory: alpha, 0 in cells that are left out at films; null: no wall has a film.
  const CellField<Real>* inside = nullptr;
};

}  // namespace fsi::solid
