#pragma once
// Faces against planes of the interface.

#include <span>

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/vof/bend.hpp"
#include "libfsi/vof/reconstruct.hpp"

namespace fsi::vof {

/// Mean of the part of face f behind the plane p of cell c, while the plane moves along its normal
/// from distance s0 to s1.
Real swept_part(const Mesh& mesh, Index f, Index c, const Piece& p, Real s0, Real s1);
/// The same for a face of a tetrahedron and the paraboloid about the plane, its middle moved by
/// `aside`. It is the part behind the plane shifted to where the paraboloid stands on the face, by
///   (mean - <x . K . x>) / 2,  x = r - aside.
/// The mean < > is over the line in which the plane cuts the face half-way between s0 and s1, and
/// over the face as far as the plane sweeps all of it.
Real swept_part(const Mesh& mesh, Index f, Index c, const Piece& p, const Bend& bend,
                const Vec3& aside, Real s0, Real s1);

/// alpha_f: the part of solid between the centres of the two cells of a face, in the prism that the
/// face sweeps along d, through which a flux over this distance passes. From the plane of a cell,
/// the mean of both where both have one; without any, alpha_f = (1 - lambda) alpha_P + lambda
/// alpha_N: what interface there is lies on the face. Boundary faces: between the cell's centre and
/// the face; without a plane alpha of the cell. Sets the listed faces. alpha, interface: owned and
/// halo.
void face_fraction(FaceField<Real>& alpha_f, const CellField<Real>& alpha,
                   const Interface& interface, const FaceWeights& weights, const Mesh& mesh,
                   std::span<const Index> faces);

/// The part of solid on the line between the centres of the two cells of a face, each half by the
/// plane of its own cell. Where neither has one, what interface there is lies on the face. Over a
/// flat surface its sum along any way from cell to cell depends on the ends alone, which that of
/// the prism does on quadrilaterals and hexahedra in line with it. Boundary faces: from the centre
/// to the face. Sets the listed faces.
void line_fraction(FaceField<Real>& alpha_f, const CellField<Real>& alpha,
                   const Interface& interface, const FaceWeights& weights, const Mesh& mesh,
                   std::span<const Index> faces);

/// Where the surface runs in a cell, or between it and a neighbour: its normal out of the solid and
/// the height of the cell's centre above it; zero elsewhere. Sets the listed cells.
void cell_plane(CellField<Vec3>& normal, CellField<Real>& height, const CellField<Real>& alpha,
                const Interface& interface, const Mesh& mesh, std::span<const Index> cells);

/// Whether the solid touches the boundary at the centre of boundary face f: whether that lies
/// behind the plane of the face's cell P; without a plane, whether alpha_P >= 1/2.
bool touches(Index f, const CellField<Real>& alpha, const Interface& interface, const Mesh& mesh);

/// alpha_f = (1 - lambda) alpha_P + lambda alpha_N on the listed faces, whatever the planes.
void mean_fraction(FaceField<Real>& alpha_f, const CellField<Real>& alpha,
                   const FaceWeights& weights, const Mesh& mesh, std::span<const Index> faces);
/// Unit normal out of the solid at the listed faces, between those of the planes of the two cells;
/// zero between opposed ones. Without planes: that of the face where the surface lies in it, zero
/// elsewhere. Boundary faces: that of the cell's plane.
void face_normal(FaceField<Vec3>& normal, const CellField<Real>& alpha, const Interface& interface,
                 const Mesh& mesh, std::span<const Index> faces);

}  // namespace fsi::vof
