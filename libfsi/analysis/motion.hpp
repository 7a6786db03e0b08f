#pragma once
// Where the solid is and how it moves.

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::analysis {

/// Follows a solid across periodic seams: its centroid is home + travelled. `home` is the image
/// that lies in the mesh; it says next to which point the parts of the solid belong. A checkpoint
/// keeps all of it, and the record goes on without a jump.
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
/// shorter than half a period, and move by less than that between calls. Without any solid the
/// centroid stays and the velocity is zero. On return `tracker` stands at the new centroid.
/// ahead: the time of u less that of alpha. The solid has gone on by u_c ahead when it has u. The
/// velocity is that at its new place, u_c + ahead sum alpha V (L . u_c) / sum alpha V. Without this
/// term a solid that turns while it moves seems to move aside.
Motion motion(Tracker& tracker, const CellField<Real>& alpha, const CellField<Vec3>& u,
              const Mesh& mesh, Real ahead = 0);

/// The image of x nearest to `about`, as a row of mesh.translation: x + translation[row].
Index nearest_image(const Mesh& mesh, const Vec3& x, const Vec3& about);

}  // namespace fsi::analysis
