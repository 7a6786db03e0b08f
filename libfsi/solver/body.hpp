#pragma once
// A soft solid and what moves it: everything a scene without solid does not have.

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "libfsi/field/band.hpp"
#include "libfsi/io/checkpoint.hpp"
#include "libfsi/solid/body_force.hpp"
#include "libfsi/solid/elastic_force.hpp"
#include "libfsi/solid/interface_gradient.hpp"
#include "libfsi/solid/left_cauchy_green.hpp"
#include "libfsi/solid/log_conformation.hpp"
#include "libfsi/solid/reference_map.hpp"
#include "libfsi/solid/semi_implicit.hpp"
#include "libfsi/solid/surface_traction.hpp"
#include "libfsi/solver/physics.hpp"
#include "libfsi/vof/advect.hpp"
#include "libfsi/vof/face_fraction.hpp"
#include "libfsi/vof/fill.hpp"
#include "libfsi/vof/held_shape.hpp"
#include "libfsi/vof/kink_profile.hpp"
#include "libfsi/vof/reconstruct.hpp"

namespace fsi {

/// How the deformation of the solid is tracked.
using Kinematics =
    std::variant<solid::LeftCauchyGreen, solid::LogConformation, solid::ReferenceMap>;

/// As the options have it.
std::string name_of(const Kinematics& kinematics);

/// A step must not leave a smaller eigenvalue of B: its condition number reaches 1e8.
inline constexpr Real eigenvalue_limit = 1e-4;

/// What the surface between two viscosities needs.
struct TwoViscosities {
  /// Collective. mesh and weights must outlive it.
  TwoViscosities(const Mesh& mesh, const FaceWeights& weights, Real G, const solid::Viscosities& mu)
      : traction(mesh, weights, G, mu), normal(mesh), height(mesh) {}
  solid::SurfaceTraction traction;  ///< the stress at the surface
  CellField<Vec3> normal;           ///< of the surface in a cell, out of the solid
  CellField<Real> height;           ///< of the cell's centre above the surface
};

/// The fraction without the cells at a wall, which do not know their strain: between the wall and
/// the solid is a film thinner than they are. On tetrahedra the velocity of such a cell, held by
/// the wall on one side alone, strains it the wrong way, and the edge of a flow divider crushes
/// what is pressed on it.
struct OffWalls {
  /// Collective. walls: their patches; the cells of the zone count. mesh must outlive it.
  OffWalls(const Mesh& mesh, const std::vector<Patch>& walls, const solid::SimplexZone& zone);
  /// Collective. Sets `alpha` from that of the solid.
  void set(const CellField<Real>& fraction, const Mesh& mesh);
  CellField<Real> at_wall;        ///< 1 in cells of the zone with a face on a wall; owned and halo
  CellField<Real> known;          ///< 1 in cells off the walls, beside them, that know their strain
  CellField<Real> alpha;          ///< 0 in cells at a wall with such a cell beside them
  std::vector<Index> at, beside;  ///< owned: at a wall, and off it with a vertex of such a cell
};

/// The solid's unknowns and the parts of the scheme that work on them.
struct Body {
  /// Collective. Fills the undeformed shape; mirrors: planes of symmetry, which may cut it; walls:
  /// what has a velocity of its own, which may also be an inlet. A viscosity that is not the
  /// fluid's gets a traction of its own at the surface, but for ratios past
  /// SurfaceTraction::ratio_max and for the paper's kinematics.
  Body(const Mesh& mesh, const FaceWeights& weights, const Solid& solid, const Physics& physics,
       const std::vector<Patch>& mirrors = {}, const std::vector<Patch>& walls = {});

  /// Collective. Gives the solid a deformation to start from; det B = 1. Errors: Error{input} with
  /// a reference map, which B alone does not tell.
  void set_B(const std::function<SymTensor(const Vec3&)>& B_0);
  /// Collective. The same for a reference map: xi_0(x) is where the particle at x came from.
  /// On planes of symmetry that cut the shape it must stay in the plane. Errors: Error{input} with
  /// other kinematics.
  void set_map(const std::function<Vec3(const Vec3&)>& xi_0);
  /// Makes the parts that the law, the kinematics, the viscosity and the weight ask for.
  void hold_parts(const Physics& physics, const std::vector<Patch>& walls);
  /// Collective. Renews what follows from alpha and the kinematics' unknown.
  void resume();
  /// Adds alpha and the kinematics' unknown to a checkpoint's list.
  void list(io::Snapshot& snapshot);
  /// Collective. Sets the band, B, T, lambda and alpha_f from alpha and the kinematics' unknown.
  /// Errors: Error{numerics} where B is beyond the range of the law.
  void update_B();
  /// Collective. Holds alpha to the shape that the map tells, where there is one; renews the
  /// planes.
  void hold_shape();
  /// Collective, after `advect`. Counts what left through the boundary. Once something has, takes
  /// out specks, cells with less than a hundredth of solid in themselves and all around them. It
  /// takes out the rest, the residue, where that is less than a thousandth of the body or where no
  /// cell is half solid any more, so that no strain of it is known. Both count as having left.
  /// Returns whether alpha was changed.
  bool count_out();
  /// Sets `touched` on the boundary faces of the listed owned cells, as the solid stands now. open:
  /// 1 on faces of openings, which count as not touched.
  void set_touched(std::span<const Index> cells, std::span<const char> open);
  /// Whether elasticity may be treated implicitly: the paper's scheme does not.
  bool semi_implicit() const { return extended(); }
  /// Whether the jump of the pressure goes on with the surface. With a reference map it does not:
  /// its own error in dt takes off a part of what that mends (doc/verification/torus.md).
  bool advects_pressure_jump() const {
    return std::holds_alternative<solid::LogConformation>(kinematics);
  }
  /// Whether the face flux takes part in the solid's strain, in the cells off the zone.
  bool strain_by_flux() const {
    return !zone.all() && std::holds_alternative<solid::LogConformation>(kinematics);
  }
  /// The cells that `interface_gradient` works on; with that only.
  const Band& strain_cells() const { return std::get<solid::LogConformation>(kinematics).known(); }
  /// Where in a step the solid stands when the momentum equation is solved: 1 at its end.
  Real time_offset() const {
    return std::visit([](const auto& k) { return k.time_offset; }, kinematics);
  }
  /// The longest step in units of the time in which the elastic wave passes a cell.
  Real elastic_number() const {
    return std::visit([](const auto& k) { return k.elastic_number; }, kinematics);
  }
  /// The fraction that tells which cells know their strain. Where the flux takes part in it, it is
  /// that in the middle of the solid's step, the time of the velocity. A cell that the surface
  /// reaches in the second half has the fluid's velocity, and its L an error of (Co / 2) times the
  /// jump. On tetrahedra, cells at a wall do not.
  const CellField<Real>& strain_fraction() const {
    return off_walls ? off_walls->alpha : fraction_of_strain();
  }
  /// The same, with the cells at walls.
  const CellField<Real>& fraction_of_strain() const { return strain_by_flux() ? alpha_mid : alpha; }
  /// The fraction that tells which cells carry the map beside psi: as psi, off the walls of
  /// tetrahedra.
  const CellField<Real>& fraction_of_memory() const { return off_walls ? off_walls->alpha : alpha; }
  /// Whether B is known around the solid as well.
  bool extended() const {
    return std::visit([](const auto& k) { return k.extended; }, kinematics);
  }
  /// The map to the undeformed solid that the shape is held to; none: nothing remembers it.
  const solid::ReferenceMap* map() const {
    return remembers() ? &*memory : std::get_if<solid::ReferenceMap>(&kinematics);
  }
  /// Of shear in the solid at rest: c = sqrt(G / rho).
  Real wave_speed() const { return std::sqrt(G / rho); }
  /// Whether a map beside psi takes part.
  bool remembers() const { return memory && held; }
  /// B of any cell, the unit tensor where there is none.
  SymTensor B_of(Index c) const {
    return std::visit([&](const auto& k) { return k.B(c, alpha[c]); }, kinematics);
  }

  /// How well planes are to be known: where a weight is borne on an irregular mesh to round-off, as
  /// what they tilt by accelerates the fluid.
  vof::ReconstructAccuracy planes() const {
    vof::ReconstructAccuracy accuracy;
    if (alpha_line) accuracy.max_rounds = 20, accuracy.turn = 0;
    return accuracy;
  }

  /// What the elastic stress is made of, tau = G dev(T): zero away from the band; owned and halo.
  const CellField<SymTensor>& T() const { return T_of_law ? *T_of_law : B; }

  const Mesh& mesh;            ///< of the solver
  const FaceWeights& weights;  ///< of the solver
  solid::SimplexZone zone;     ///< the cells with the rules of triangles and tetrahedra
  std::string name;            ///< "" where there is one solid
  Real G, mu, rho;             ///< shear modulus, dynamic viscosity, density
  Vec3 weight;                 ///< body force per volume: rho a + (rho - rho_fluid) g
  CellField<Real> alpha;       ///< volume fraction of the solid
  vof::Filled filled;          ///< volume, its error, and what cuts it at the start
  CellField<Real> alpha_mid;   ///< mean of it and of that before the last step
  CellField<SymTensor> B;      ///< on the band's cells, zero elsewhere; owned and halo
  FaceField<Real> alpha_f;     ///< part of solid at the band's faces
  FaceField<Vec3> normal_f;    ///< of the interface there, zero away from it; where B is extended
  CellField<Real> lambda;      ///< largest modulus of the law over G, neo-Hookean: eigenvalue of
                               ///< B; owned and halo
  solid::Law law;              ///< of the material
  std::optional<CellField<SymTensor>> T_of_law;  ///< where it is not B itself
  BoundaryField<char> touched;  ///< 1 where the solid touches the boundary, by set_touched
  Real t = 0;                   ///< time of alpha and B
  Real dt = 0;                  ///< length of the last step of alpha and B
  solid::Strain strain;         ///< in the last step
  Real eigenvalue_min = 1;      ///< of B on this rank
  bool beyond_law = false;      ///< whether B is beyond the law's range anywhere
  vof::Interface interface;     ///< planes of alpha
  vof::ReconstructScratch reconstruct_scratch;             ///< scratch
  vof::AdvectScratch advect_scratch;                       ///< scratch
  Band band;                                               ///< of the cells that carry stress
  Kinematics kinematics;                                   ///< how strain is tracked
  solid::ElasticForce elastic_force;                       ///< div tau
  solid::SemiImplicitElasticity semi_implicit_elasticity;  ///< its implicit share
  std::optional<TwoViscosities> two_viscosities;           ///< where they differ
  std::optional<solid::BodyForce> body_force;              ///< where there is one
  std::optional<OffWalls> off_walls;                       ///< on tetrahedra
  /// Part of solid on the line between two centres at the band's faces, where the mesh is irregular
  /// and the solid has a weight in the fluid.
  std::optional<FaceField<Real>> alpha_line;
  std::optional<solid::InterfaceGradient>
      interface_gradient;                        ///< where the velocity gradient needs it
  std::optional<vof::KinkProfile> kink_profile;  ///< of cut cells, beside it
  CellField<solid::SymGradient> grad;            ///< scratch of both
  std::optional<solid::ReferenceMap> memory;     ///< of the undeformed solid, beside psi
  shapes::Shape shape;                           ///< undeformed
  bool held = false;                             ///< whether alpha is held to the map's shape
  vof::HoldScratch hold_scratch;                 ///< scratch
  std::vector<Real> trust;                       ///< scratch of that
  Real shape_moved = 0;  ///< volume that the last hold_shape moved, in parts of the solid's
  std::vector<Index> last_cells;  ///< where B was set
  vof::AdvectReport advected;     ///< of the last step
  SymmetryFaces mirror;           ///< planes of symmetry
  std::vector<char> specks;       ///< [n_owned] scratch
  Real volume_out = 0;            ///< what left the mesh or was taken out after it
  Real residue = 0;               ///< of this: what was taken out at the end, by this program
  std::int64_t gone = 0;          ///< 1: nothing is left
};

}  // namespace fsi
