#pragma once
// What every kinematics of the solid is carried and strained by.

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
/// That of T along g: the derivative along x is g.x T.
inline SymGradient outer(const SymTensor& T, const Vec3& g) { return {g.x * T, g.y * T, g.z * T}; }
/// Change along the vector d.
inline SymTensor along(const SymGradient& g, const Vec3& d) {
  return d.x * g.x + d.y * g.y + d.z * g.z;
}

/// The slope of T by least squares over places r at which it is more by `rise`, w = 1 / |r|^2.
struct TensorFit {
  /// One place.
  void add(const SymTensor& rise, const Vec3& r) {
    const Real w = 1 / norm2(r);
    M += w * square(r);
    R += w * outer(rise, r);
  }
  /// The slope; none of no places. Along directions that these do not tell it tends to zero
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

/// Gradient of T on the listed owned cells. stencil: without given boundary values, so that linear
/// fields are exact beside boundaries as well.
void gradient(CellField<SymGradient>& grad, const CellField<SymTensor>& T,
              const GradientStencil& stencil, const Mesh& mesh, std::span<const Index> cells);
/// The same of alpha T.
void gradient(CellField<SymGradient>& grad, const CellField<Real>& alpha,
              const CellField<SymTensor>& T, const GradientStencil& stencil, const Mesh& mesh,
              std::span<const Index> cells);

/// Sets grad T anew in the listed triangles and tetrahedra at planes of symmetry: by least squares
/// over the face neighbours and the cell's own image. An extrapolation to the
/// plane from the others alone answers to the cell's own T several times as strongly.
void set_slopes_at_planes(CellField<SymGradient>& grad, const CellField<SymTensor>& T,
                          const SymmetryFaces& symmetry, const Mesh& mesh,
                          std::span<const Index> cells);

/// The boundary where the solid touches it.
struct Contact {
  const BoundaryField<Vec3>& u_b;      ///< velocity of the boundary
  const BoundaryField<char>& touched;  ///< 1 on faces that it touches, openings apart
};

/// How the surface cuts the faces, where the elastic force knows it.
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
  /// What strains the solid's cells in its zone; none, and in other cells: L, u and phi do.
  const InterfaceGradient* one_sided = nullptr;
  const Contact* contact = nullptr;  ///< none: nowhere
  const CutFaces* cuts = nullptr;    ///< none: the strain is not bounded by the work of the force
  Real in_series = 1;   ///< mu_s / mu_f of the surface's traction; 1: of the elastic force alone
  Real wave_speed = 0;  ///< of shear in the solid at rest, sqrt(G / rho)
  Real recovery = 0;    ///< rate against the solid's viscosity, G / mu_s
  /// What remembers the undeformed solid, at the end of the step; none: nothing does.
  const ReferenceMap* memory = nullptr;
};

}  // namespace fsi::solid
