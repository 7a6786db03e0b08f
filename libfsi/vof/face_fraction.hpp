#pragma once
// Parts of faces, and of the space between cells, that lie behind planes of the interface.

#include <span>

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/operators/symmetry_faces.hpp"
#include "libfsi/vof/bend.hpp"
#include "libfsi/vof/reconstruct.hpp"

namespace fsi::vof {

/// Mean of the part of face f behind the plane p of cell c, while the plane moves along its normal
/// from distance s0 to s1.
Real swept_part(const Mesh& mesh, Index f, Index c, const Piece& p, Real s0, Real s1);
/// The same for a face of a tetrahedron and the paraboloid about the plane, whose middle is moved
/// by `aside`. It is the part behind the plane, shifted to where the paraboloid meets the face, by
///   (mean - <x . K . x>) / 2,  x = r - aside.
/// The mean < > is that over the line in which the plane cuts the face half-way between s0 and s1.
/// As the plane sweeps more of the face, < > changes linearly to the mean over the face.
Real swept_part(const Mesh& mesh, Index f, Index c, const Piece& p, const Bend& bend,
                const Vec3& aside, Real s0, Real s1);

/// alpha_f: the part of solid between the centres of the two cells of a face, in the prism that the
/// face sweeps along d. A flux over this distance passes through this prism. alpha_f follows from
/// the plane of a cell, and is the mean of both if both cells have one. Without planes it is
/// (1 - lambda) alpha_P + lambda alpha_N: any interface then lies on the face. For a boundary face
/// it is the part between the cell's centre and the face, on a plane of symmetry between the centre
/// and its image, without a plane alpha of the cell. Sets the listed faces. alpha, interface: owned
/// and halo.
void face_fraction(FaceField<Real>& alpha_f, const CellField<Real>& alpha,
                   const Interface& interface, const FaceWeights& weights, const Mesh& mesh,
                   std::span<const Index> faces, const SymmetryFaces& symmetry = {});

/// The part of solid on the line between the centres of the two cells of a face, each half by the
/// plane of its own cell. Without planes any interface lies on the face. Over a flat surface, the
/// sum of these parts along a path from cell to cell depends on the ends of the path alone. For the
/// prism this is true only on aligned quadrilaterals and hexahedra. Boundary faces: from the centre
/// to the face. Sets the listed faces.
void line_fraction(FaceField<Real>& alpha_f, const CellField<Real>& alpha,
                   const Interface& interface, const FaceWeights& weights, const Mesh& mesh,
                   std::span<const Index> faces);

/// The normal of the surface, out of the solid, and the height of the cell's centre above it. Set
/// in listed cells that the surface cuts or that it separates from a neighbour, zero in the other
/// ones.
void cell_plane(CellField<Vec3>& normal, CellField<Real>& height, const CellField<Real>& alpha,
                const Interface& interface, const Mesh& mesh, std::span<const Index> cells);

/// Whether the solid touches the boundary at the centre of boundary face f, that is, whether this
/// point lies behind the plane of the face's cell P. Without a plane, whether alpha_P >= 1/2.
bool touches(Index f, const CellField<Real>& alpha, const Interface& interface, const Mesh& mesh);

/// alpha_f = (1 - lambda) alpha_P + lambda alpha_N on the listed faces, without the planes.
void mean_fraction(FaceField<Real>& alpha_f, const CellField<Real>& alpha,
                   const FaceWeights& weights, const Mesh& mesh, std::span<const Index> faces);
/// Unit normal m out of the solid at the listed faces, the mean of the normals of both cells from
/// `cell_plane`. So a face between a cell at the surface and the next one has the normal too. It is
/// zero where neither has one, and between opposed ones. Boundary faces: that of the cell; on a
/// plane of symmetry the mean with its image. normal: owned and halo.
void face_normal(FaceField<Vec3>& normal_f, const CellField<Vec3>& normal, const Mesh& mesh,
                 std::span<const Index> faces, const SymmetryFaces& symmetry = {});

}  // namespace fsi::vof
