#pragma once
// A soft solid: its unknowns and the parts of the scheme that work on them.

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "libfsi/field/band.hpp"
#include "libfsi/io/checkpoint.hpp"
#include "libfsi/operators/pieces.hpp"
#include "libfsi/solid/body_force.hpp"
#include "libfsi/solid/elastic_force.hpp"
#include "libfsi/solid/interface_gradient.hpp"
#include "libfsi/solid/left_cauchy_green.hpp"
#include "libfsi/solid/log_conformation.hpp"
#include "libfsi/solid/reference_map.hpp"
#include "libfsi/solid/semi_implicit.hpp"
#include "libfsi/solid/surface_traction.hpp"
#include "libfsi/solid/wall_film.hpp"
#include "libfsi/solver/physics.hpp"
#include "libfsi/vof/advect.hpp"
#include "libfsi/vof/face_fraction.hpp"
#include "libfsi/vof/fill.hpp"
#include "libfsi/vof/held_shape.hpp"
#include "libfsi/vof/kink_profile.hpp"
#include "libfsi/vof/reconstruct.hpp"

namespace fsi {

/// The kinematics of the solid.
using Kinematics =
    std::variant<solid::LeftCauchyGreen, solid::LogConformation, solid::ReferenceMap>;

/// The name in the options.
std::string name_of(const Kinematics& kinematics);

/// A step with a smaller eigenvalue of B is taken back: there the condition number of B reaches
/// 1e8.
inline constexpr Real eigenvalue_limit = 1e-4;

/// The patches of a mesh, by what they are to a solid; one may be in several lists.
struct SolidPatches {
  std::vector<Patch> mirrors{};   ///< planes of symmetry, which may cut it
  std::vector<Patch> walls{};     ///< whose velocity is given, inlets too
  std::vector<Patch> still{};     ///< those of `walls` that never move
  std::vector<Patch> tight{};     ///< those of `walls` that nothing passes, at rest or sliding
  std::vector<Patch> openings{};  ///< which fluid and solid may pass
};

/// A solid.
struct Body {
  /// Collective. Fills the undeformed shape. If its viscosity is not the fluid's, the surface gets
  /// an explicit traction, but not with left_cauchy_green nor beside a fluid without viscosity.
  Body(const Mesh& mesh, const FaceWeights& weights, const Solid& solid, const Physics& physics,
       const SolidPatches& patches = {});

  /// Collective. Gives the solid a deformation to start from; det B = 1. Errors: Error{input} with
  /// the map kinematics, since the map does not follow from B.
  void set_B(const std::function<SymTensor(const Vec3&)>& B_0);
  /// Collective. The same for the map kinematics: xi_0(x) is the place that the particle at x had
  /// in the undeformed solid. On planes of symmetry that cut the shape it must stay in the plane.
  /// Errors: Error{input} with other kinematics.
  void set_map(const std::function<Vec3(const Vec3&)>& xi_0);
  /// Makes the parts that the law, the kinematics, the viscosity and the weight need.
  void hold_parts(const Physics& physics, const SolidPatches& patches);
  /// Collective. Finds the planes of the tight patches at which the solid is bonded.
  void set_bond_planes(const std::vector<Patch>& tight);
  /// Collective. Takes from `shape` what the mesh cut off, if planes did so; else sets
  /// `cut_by_mesh`.
  void trim_shape(const std::vector<Patch>& mirrors);
  /// [n_boundary] 1 on faces of these patches that the solid touches, in cells that are at least
  /// half full. The planes of alpha must be those of the undeformed solid.
  std::vector<char> bonded(const std::vector<Patch>& patches) const;
  /// Collective. Sets `bond`, `stood_on` and both numbers; at_walls, at_still: `bonded` of all
  /// walls, and of those at rest.
  void set_bond(const std::vector<char>& at_walls, const std::vector<char>& at_still);
  /// Collective. The part of `bond` whose cells are still at least half full; 1 without a bond.
  Real bond_kept() const;
  /// Collective. Sets anew what follows from alpha and the kinematics' unknown.
  void resume();
  /// Adds alpha and the kinematics' unknown to a checkpoint's list.
  void list(io::Snapshot& snapshot);
  /// Collective. Sets the band, B, T, lambda and alpha_f from alpha and the kinematics' unknown.
  /// Errors: Error{numerics} where B is beyond the range of the law.
  void update_B();
  /// Collective. Moves alpha towards the shape of the memory or of the map kinematics, if there is
  /// one; renews the planes.
  void hold_shape();
  /// Sets `trust` in the map's cells and lists the strays. They are crumbs and cells beyond the
  /// map, away from all cells of larger pieces. A solid that had several pieces has none.
  void find_strays();
  /// Collective, after `advect`. Counts the solid that left through the boundary. Once some has
  /// left, it takes out specks: cells with less than a hundredth of solid in themselves and all
  /// around them. It takes out the rest, the residue, if that is less than a hundredth of the
  /// body. It also does so if no cell is half solid any more, so that no cell is known. Both count
  /// as having left. Returns whether alpha was changed.
  bool count_out();
  /// Sets `touched` on the boundary faces of the listed owned cells, for the present solid. open: 1
  /// on faces of openings, which count as not touched.
  void set_touched(std::span<const Index> cells, std::span<const char> open);
  /// Whether elasticity is implicit in part, which it is not with left_cauchy_green.
  bool semi_implicit() const { return extended(); }
  /// Whether the jump of the pressure is moved with the surface. With the map kinematics it is not:
  /// there the errors in dt of both partly cancel.
  bool advects_pressure_jump() const {
    return std::holds_alternative<solid::LogConformation>(kinematics);
  }
  /// Whether the fluxes correct the velocity that strains the solid, in cells off the simplex zone.
  bool strain_by_flux() const {
    return !zone.all() && std::holds_alternative<solid::LogConformation>(kinematics);
  }
  /// The known cells, on which `interface_gradient` works; only if it is there.
  const Band& strain_cells() const { return std::get<solid::LogConformation>(kinematics).known(); }
  /// The part of the step after which the momentum equation takes the solid; 1: its end.
  Real time_offset() const {
    return std::visit([](const auto& k) { return k.time_offset; }, kinematics);
  }
  /// The longest step over the time in which the elastic wave passes a cell.
  Real elastic_number() const {
    return std::visit([](const auto& k) { return k.elastic_number; }, kinematics);
  }
  /// The fraction that decides which cells are known. On meshes that are not of triangles or
  /// tetrahedra alone it is alpha_mid, at the time of the velocity. A cell that the surface reaches
  /// in the second half of the step has the fluid's velocity, and its L an error of (Co / 2) times
  /// the jump. Cells at a film between solid and wall are left out (WallFilm).
  const CellField<Real>& strain_fraction() const {
    return film ? film->fraction() : fraction_of_strain();
  }
  /// The same with the cells at films.
  const CellField<Real>& fraction_of_strain() const { return strain_by_flux() ? alpha_mid : alpha; }
  /// Whether B is set in cells around the solid as well.
  bool extended() const {
    return std::visit([](const auto& k) { return k.extended; }, kinematics);
  }
  /// The map that holds the shape, of the memory or of the map kinematics; null: none.
  const solid::ReferenceMap* map() const {
    return remembers() ? &*memory : std::get_if<solid::ReferenceMap>(&kinematics);
  }
  /// Speed of shear waves at rest, c_s = sqrt(G / rho).
  Real wave_speed() const { return std::sqrt(G / rho); }
  /// Whether the memory is in use.
  bool remembers() const { return memory && held; }
  /// B of any cell, the unit tensor if it has none.
  SymTensor B_of(Index c) const {
    return std::visit([&](const auto& k) { return k.B(c, alpha[c]); }, kinematics);
  }

  /// The accuracy of the planes. With a weight in the fluid on an irregular mesh it is rounding,
  /// since an error of their tilt accelerates the fluid.
  vof::ReconstructAccuracy planes() const {
    vof::ReconstructAccuracy accuracy;
    if (alpha_line) accuracy.max_rounds = 20, accuracy.turn = 0;
    return accuracy;
  }

  /// T of the stress tau = G dev(T): zero away from the band; owned and halo.
  const CellField<SymTensor>& T() const { return T_of_law ? *T_of_law : B; }

  const Mesh& mesh;            ///< of the solver
  const FaceWeights& weights;  ///< of the solver
  solid::SimplexZone zone;     ///< the simplex zone
  std::string name;            ///< "" where there is one solid
  Real G, mu, rho;             ///< shear modulus, dynamic viscosity, density
  Vec3 weight;                 ///< body force per volume: rho a + (rho - rho_fluid) g
  CellField<Real> alpha;       ///< volume fraction of the solid
  vof::Filled filled;          ///< volume, its error, and what cuts it at the start
  SymmetryFaces cut;           ///< planes of symmetry that cut it
  CellField<Real> alpha_mid;   ///< mean of alpha before and after the last step
  CellField<SymTensor> B;      ///< on the band's cells, zero elsewhere; owned and halo
  FaceField<Real> alpha_f;     ///< part of solid at the band's faces
  CellField<Vec3> normal;      ///< m of the surface in the cells at it, zero in the others; where
                               ///< `extended`; owned and halo
  CellField<Real> height;      ///< of the centres of these cells above the surface; owned
  FaceField<Vec3> normal_f;    ///< m at the band's faces, zero away from it; where `extended`
  CellField<Real> lambda;      ///< lambda_B, largest modulus of the law over G; owned and halo
  solid::Law law;              ///< of the material
  std::optional<CellField<SymTensor>> T_of_law;  ///< T, if it is not B itself
  BoundaryField<char> touched;  ///< 1 where the solid touches the boundary, by set_touched
  Real t = 0;                   ///< time of alpha and B
  std::int64_t begun = 0;       ///< step of the flow in which it was put in
  Real t_begun = 0;             ///< time of the flow at which it was put in
  Real dt = 0;                  ///< length of the last step of alpha and B
  solid::Strain strain;         ///< in the last step
  Real eigenvalue_min = 1;      ///< of B on this rank
  bool beyond_law = false;      ///< whether B is beyond the law's range anywhere
  vof::Interface interface;     ///< planes of alpha
  vof::ReconstructScratch reconstruct_scratch;             ///< scratch
  vof::AdvectScratch advect_scratch;                       ///< scratch
  Band band;                                               ///< of the cells with stress
  Kinematics kinematics;                                   ///< how the strain is carried
  solid::ElasticForce elastic_force;                       ///< div tau
  SymmetryFaces mirror;                                    ///< planes of symmetry
  solid::SemiImplicitElasticity semi_implicit_elasticity;  ///< its implicit share
  std::vector<Real> wave_width;                            ///< of owned cells, for the step's limit
  std::optional<solid::SurfaceTraction> traction;          ///< if mu is not that of the fluid
  std::optional<solid::BodyForce> body_force;              ///< with a weight only
  std::optional<solid::WallFilm> film;                     ///< with log_conformation
  std::vector<Index> bond;  ///< boundary faces of walls at rest that the undeformed solid touches
  std::vector<char> stood_on;  ///< [patches] 1: a wall that the undeformed solid touches
  Index bonded_faces = 0;      ///< the number of these, of all ranks
  Index sliding_faces = 0;     ///< of all ranks: those of walls that move and inlets
  Real film_thickness = 0;     ///< least; 0: half a cell
  /// Part of solid on the line between two centres at the band's faces, where the mesh is irregular
  /// and the solid has a weight in the fluid.
  std::optional<FaceField<Real>> alpha_line;
  std::optional<solid::InterfaceGradient>
      interface_gradient;                        ///< with log_conformation in a simplex zone
  std::optional<vof::KinkProfile> kink_profile;  ///< of cut cells, with interface_gradient
  CellField<solid::SymGradient> grad;            ///< scratch of all that strains
  std::optional<solid::ReferenceMap> memory;     ///< the memory of log_conformation
  shapes::Shape shape;                           ///< undeformed
  bool held = false;                             ///< whether alpha is held to the shape of the map
  vof::HoldScratch hold_scratch;                 ///< scratch
  std::optional<vof::BondPlanes> bond_planes;    ///< of a solid that is held and bonded
  Pieces pieces;                                 ///< at the last hold_shape
  std::vector<Index> at_openings;                ///< owned cells
  bool cut_by_mesh = false;   ///< whether `shape` tells of a part that the mesh cut off
  CellField<Real> left_out;   ///< scratch of hold_shape
  std::vector<Real> trust;    ///< scratch of hold_shape
  bool one_piece = false;     ///< whether the undeformed solid is in one piece
  std::vector<Index> strays;  ///< scratch of hold_shape
  Real shape_moved = 0;       ///< volume that the last hold_shape moved, in parts of the solid's
  Real volume_returned = 0;   ///< volume that came off and was taken back, in all
  std::vector<Index> last_cells;  ///< where B was set
  vof::AdvectReport advected;     ///< of the last step
  int interface_parts = 1;        ///< into which the last step was divided for the interface
  std::vector<char> specks;       ///< [n_owned] scratch
  Real volume_out = 0;            ///< volume that left the mesh or was taken out
  Real residue = 0;               ///< the part of it that was taken out at the end
  std::int64_t gone = 0;          ///< 1: nothing is left
};

}  // namespace fsi
