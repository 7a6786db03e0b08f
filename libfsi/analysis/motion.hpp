#pragma once
// Place and motion of a solid.

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::analysis {

/// Follows a solid across periodic seams: its centroid is home + travelled. `home` is its image in
/// the mesh, next to which the parts of the solid are placed. All of this is part of a checkpoint,
/// so the record continues without a jump.
struct Tracker {
  Vec3 home;             ///< a point next to the solid, in the mesh
  Vec3 travelled;        ///< whole periods
  Vec3 middle;           ///< of the mesh, once started
  bool started = false;  ///< whether there was a solid yet
};

/// Volume (area in 2-D), centroid without jumps, velocity.
struct Motion {
  Real volume = 0;  ///< of the solid
  Vec3 centroid;    ///< of the solid, with the periods it has travelled
  Vec3 velocity;    ///< mean of the solid
};

/// Collective. x_c = sum alpha x V / sum alpha V, [Matsumiya25] (18), u_c = sum alpha u V / sum
/// alpha V, (22), over owned cells, each at its image nearest to the solid. The solid must be
/// shorter than a period, and move by less than half of one between calls. Without any solid the
/// centroid stays and the velocity is zero. On return `tracker` holds the new centroid. ahead: the
/// time of u less that of alpha. At the time of u the solid has moved by u_c ahead. The velocity is
/// that at its new place, u_c + ahead sum alpha V (L . u_c) / sum alpha V. Without this term a
/// solid that turns while it moves seems to move sideways.
Motion motion(Tracker& tracker, const CellField<Real>& alpha, const CellField<Vec3>& u,
              const Mesh& mesh, Real ahead = 0);

/// The image of x nearest to `about`, as a row of mesh.translation: x + translation[row].
Index nearest_image(const Mesh& mesh, const Vec3& x, const Vec3& about);

}  // namespace fsi::analysis
