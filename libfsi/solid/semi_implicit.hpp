#pragma once
// The elastic limit of a step, and two terms that allow steps beyond it.

#include <span>
#include <vector>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/operators/symmetry_faces.hpp"
#include "libfsi/solid/simplex_zone.hpp"

namespace fsi::solid {

/// Width of a cell for a wave. `own`: V / max |Sf|. `of_neighbourhood`: for a triangle or
/// tetrahedron the mean of these over the cells that share a vertex with it and itself, weighted
/// with their volumes; for any other cell its own.
enum class WaveWidth { own, of_neighbourhood };
/// Collective. h_w of the owned cells.
std::vector<Real> wave_widths(const Mesh& mesh, WaveWidth kind);

/// Time in which the elastic shear wave passes a cell: the least h_w (rho / (G lambda_B))^(1/2)
/// over the cells, with lambda_B of at least 1 [Matsumiya25] (15). This rank's cells only. The
/// widths are the cells' own where elasticity is explicit. Where the terms below keep every wave
/// stable, the limit is one of accuracy, and a flat cell among others does not shorten the waves
/// that the mesh resolves.
Real elastic_time(const CellField<Real>& lambda, Real G, Real rho, std::span<const Real> width,
                  std::span<const Index> cells);

/// What a face operator on the solid reads.
struct ElasticTerms {
  const CellField<Real>& lambda;    ///< lambda_B, largest modulus of the law over G, neo-Hookean:
                                    ///< largest eigenvalue of B; on the band's cells and halo
  const FaceField<Real>& alpha;     ///< alpha_f, part of solid at the band's faces
  const CellField<Vec3>& u;         ///< owned and halo
  const CellField<Tensor>& L;       ///< velocity gradient, on the band and halo
  const CellField<Real>& fraction;  ///< alpha; owned and halo
  /// Shear modulus, density, viscosity of the solid; length of the step.
  Real G, rho, mu_s, dt;
  bool kink = false;  ///< whether the mean of L allows for the kink of u
  /// Whether L in the simplex zone is one-sided (InterfaceGradient).
  bool one_sided = false;
  /// The unit normal m of the surface at the band's faces, zero away from it; null: e does not
  /// depend on the direction.
  const FaceField<Vec3>* normal = nullptr;
  Real across = 0;       ///< bound on e across the surface, in parts of alpha_f mu_s
  Real rho_least = rho;  ///< the least density of solid and fluid
};

/// Two terms that keep velocity and strain stable and leave a resolved solution unchanged:
///
///   div(kappa (grad u* - grad u^n + b dt u^n . grad (grad u^n))),
///   kappa = 0.4 dt G alpha_f lambda_B
///
/// It stands for the change of the elastic stress over the step, which by div u = 0 is div(dt G B .
/// grad u) in the leapfrog of velocity and strain. With a share C of it the leapfrog needs
/// w^2 dt^2 / (1 + C w^2 dt^2) <= 4, which C >= 1/4 makes true for any dt. The fastest mode turns
/// by arccos(1 - 1 / (2 C)) in a step. With C = 0.3 that is 132 degrees, and in a thin body the
/// waves persist that the surface excites as it crosses cells. With C = 0.4 it is 104 degrees. The
/// term with b = 1 vanishes with the change of grad u along the path of a particle, so that within
/// a body which passes through the mesh as it is it is zero. With the change at a fixed place, b =
/// 0, a ring turns too far (doc/notebook/2026-11-27-along-the-path.md). The part in b is explicit,
/// and unstable where a stiff body moves by half a cell in a step. b is 1 up to the Courant number
/// 0.3 of the body, and falls to 0 at 0.5. At faces of the boundary b = 0.
/// The rise u_N - u_P of a face changes by dt (L_N - L_P) . u along the path. Where the surface
/// passes between the cells, the kink moves on, and the quasi-Green gradients on both sides differ
/// by half of it (velocity_kink.hpp). There, but in the simplex zone, it is twice as much.
///
///   div(e (grad u^n - avg L^n)),   e = |d| (rho G alpha_f lambda_B)^(1/2) - alpha_f mu_s, >= 0
///
/// It compares the compact gradient with the averaged one. The averaged stress does not act on a
/// velocity that alternates from cell to cell, and this term damps it at the rate at which the
/// elastic wave passes a cell. The compact viscous term of the solid does a part of it, so that e
/// is less by alpha_f mu_s.
///
/// At the surface, with the angle a between d and the normal m,
///
///   e = sin^2 a e_0 + cos^2 a min(e_0, c alpha_f mu_s),   e_0 as above.
///
/// Where the velocity is curved beside its kink, avg L has an error across the surface. The stress
/// of it drags the fluid along, the more the stiffer the solid is. With c = 2 it stays of the size
/// of the error of the viscous stress. Between two viscosities the error is one in the kink itself,
/// and c = 0: there the viscous stress in series damps instead.
///
/// The mean avg L is (L_P + L_N) / 2, exact for a quadratic velocity. At the surface it is
/// alpha_f L_solid + (1 - alpha_f) L_fluid, with L of the cells on either side. That is exact for a
/// linear velocity with a kink, if L is one-sided or the mean of both sides. Without `kink` avg L
/// is linear between the cells.
///
/// The term is explicit, so that kappa is raised to e / 1.5 - mu_rho if it is less, in the simplex
/// zone to e - mu_rho. With 1.5 the strain of stiff spheres bursts there. Here mu_rho =
/// (rho |d|^2 / dt) min(1/8, 1/(2 K)) is the inertia as a viscosity, rho the least density and
/// K = sum_f g |d|^2 / (2 V) the larger one of both cells. A velocity that differs from all its
/// neighbours then changes by at most 1.5, or 1, of the difference in a step, for any shape of
/// cell. K = dim on squares and regular simplices, and 10 or more on slivers. If e were bounded
/// instead, its error at the surface would depend on the step, and with it the way of a body. A
/// raised kappa makes the first term one of first order in dt; as dt goes to 0 no kappa is raised.
///
/// In the simplex zone with a one-sided L, a flux of e that would add energy to the strain is set
/// to 0. Its product with u_N - u_P less the spin of avg L times d is negative. Such fluxes occur
/// since a one-sided L is no mean of the gradients at the faces. There with the map kinematics e is
/// twice the root instead, and kappa grows by e, in steps of any length.
///
/// At a plane of symmetry the neighbour is the image of the cell, so that half of a solid has the
/// terms of the whole.
class SemiImplicitElasticity {
 public:
  /// Collective. mesh and zone must outlive it. symmetry: faces beyond which a cell has an image.
  SemiImplicitElasticity(const Mesh& mesh, const FaceWeights& weights, const SimplexZone& zone,
                         SymmetryFaces symmetry);

  /// kappa / (dt G alpha lambda_B), where e needs no more.
  static constexpr Real implicit_fraction = 0.4;

  /// Sets both to zero on the faces of the last `apply`.
  void clear(FaceField<Real>& kappa, FaceField<Real>& stiffness);

  /// Collective. kappa_f += the implicit coefficient, with what e needs. stiffness_f += dt G
  /// alpha_f lambda_B, with lambda_B linear between the cells. Nothing is added outside the band.
  /// force += the explicit term and the explicit part of the first one, on owned cells and halo.
  void apply(FaceField<Real>& kappa, FaceField<Real>& stiffness, CellField<Vec3>& force,
             const ElasticTerms& solid, const FaceWeights& weights, const Band& band);

 private:
  /// The line through face f between two cells, or between a cell and its image in a plane of
  /// symmetry.
  struct Line {
    Index f;
    Vec3 d;        ///< from the centre of the owner P to that of the neighbour N, or to the image
    Real g;        ///< coefficient of u_N - u_P in the flux
    Vec3 u_N;      ///< velocity of N
    Tensor L_N;    ///< velocity gradient of N
    bool in_zone;  ///< whether P or N is in the simplex zone
  };
  Line line(const ElasticTerms& solid, const FaceWeights& weights, Index f) const;

  /// The flux of the explicit term along a line, l = alpha_f lambda_B. Raises k, kappa of the
  /// face, to what the flux needs.
  Vec3 damping(Real& k, const ElasticTerms& solid, const FaceWeights& weights, const Line& line,
               Real l) const;
  /// How fast the rise u_N - u_P changes along the stream, the part b of it.
  Vec3 change_of_rise(const ElasticTerms& solid, const Line& line) const;

  const Mesh& mesh_;
  const SimplexZone& zone_;
  SymmetryFaces symmetry_;
  std::vector<Real> inertia_;  // [n_faces] mu_rho dt / (rho |d|^2)
  std::vector<Index> last_faces_;
};

}  // namespace fsi::solid
