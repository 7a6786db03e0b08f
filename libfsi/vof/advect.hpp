#pragma once
// isoAdvector: geometric transport of the volume fraction on any cells [Roenby16].

#include <vector>

#include "libfsi/vof/interface.hpp"

namespace fsi::vof {

/// What an advection step left behind.
struct Advected {
  Real overshoot = 0;  ///< largest distance of alpha from [0, 1], all ranks
  int passes = 0;      ///< of the redistribution
};

/// Moves alpha with the face flux: d alpha / dt + div(alpha u) = 0   [Matsumiya25] (5).
/// Through a face whose upwind cell holds a plane flows
///   dV_f = phi_f int_0^dt (part of the face below the moving plane) dt   [Roenby16] (12),
/// the plane moving with the velocity at its centre; elsewhere dV_f = alpha_upwind phi_f dt.
/// What over- or underfills a cell is passed on downwind, so alpha stays in [0, 1] without clipping
/// and volume is kept to round-off. Only faces of cells with alpha > 0 are touched.
class Advect {
 public:
  explicit Advect(const Mesh& mesh);

  /// Collective. alpha, interface, u: owned and halo; L: velocity gradient on owned interface
  /// cells. phi must be divergence-free. On return alpha is set, halo included; the planes are out
  /// of date.
  Advected operator()(CellField<Real>& alpha, const Interface& interface,
                      const FaceField<Real>& phi, const CellField<Vec3>& u,
                      const CellField<Tensor>& L, Real dt);

 private:
  void set_speed(const Interface& interface, const CellField<Vec3>& u, const CellField<Tensor>& L);
  void list_faces(const CellField<Real>& alpha);
  void set_fluxes(const CellField<Real>& alpha, const Interface& interface,
                  const FaceField<Real>& phi, Real dt);
  void apply(CellField<Real>& alpha);
  Real worst(const CellField<Real>& alpha) const;
  void redistribute(CellField<Real>& alpha, const FaceField<Real>& phi, Real dt);
  void pass_on(Index c, Real excess, bool solid, const FaceField<Real>& phi, Real dt);

  const Mesh& mesh_;
  CellField<Real> speed_;     // of the plane along its normal
  FaceField<Real> volume_;    // of solid through the face in this step; valid on faces_
  CellField<Real> received_;  // volume that redistribution moves into a cell
  std::vector<Index> faces_;  // faces of cells with alpha > 0
  std::vector<Index> cells_;  // owned cells beside them
  std::vector<std::int32_t> face_stamp_, cell_stamp_;
  std::int32_t calls_ = 0;
  std::vector<Index> between_ranks_;  // internal faces with a halo cell on one side
};

}  // namespace fsi::vof
