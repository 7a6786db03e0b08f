#pragma once
// How stiff the solid is to a step, and what makes a step larger than that stable.

#include <span>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/solid/simplex_zone.hpp"

namespace fsi::solid {

/// Time in which the elastic shear wave passes a cell: the least h (rho / (G lambda))^(1/2) over
/// the cells, h = V / max |Sf|, lambda at least 1. [Matsumiya25] (15) This rank's cells only.
Real elastic_time(const CellField<Real>& lambda, Real G, Real rho, const Mesh& mesh,
                  std::span<const Index> cells);

/// What a face operator on the solid reads.
struct ElasticTerms {
  const CellField<Real>& lambda;    ///< largest modulus of the law over G, neo-Hookean: eigenvalue
                                    ///< of B; on the band's cells and halo
  const FaceField<Real>& alpha;     ///< part of solid at the band's faces
  const CellField<Vec3>& u;         ///< owned and halo
  const CellField<Tensor>& L;       ///< velocity gradient, on the band and halo
  const CellField<Real>& fraction;  ///< alpha; owned and halo
  /// Shear modulus, density, viscosity of the solid; length of the step.
  Real G, rho, mu_s, dt;
  bool kink = false;  ///< the mean of L allows for a kink of u at the surface
  /// In the zone L is that of the cell's own side of the surface (InterfaceGradient).
  bool one_sided = false;
  /// Of a surface between two viscosities, in cells at it, else zero; none: one viscosity.
  const CellField<Vec3>* normal = nullptr;
  Real rho_least = rho;  ///< of the solid and what is beside it
};

/// Two terms that leave a resolved solution alone and keep the pair of velocity and strain stable:
///
///   div(kappa grad (u* - u^n)),   kappa = 0.4 dt G alpha_f lambda_B
///
/// stands in for the change of the elastic stress over the step, which with leapfrog is div(dt G
/// B . grad u) by div u = 0. Of another law G lambda_B is its largest modulus (law/law.hpp). A
/// share of 1/4 of it or more makes the pair stable for any dt, w^2 dt^2 / (1 + c w^2 dt^2) <= 4.
/// The fastest mode turns by arccos(1 - 1 / (2 c)) a step. With c = 0.3 that is 132 degrees, and
/// what the surface excites on its way through the cells stays in a thin body. With 0.4 it is 104.
/// The term vanishes with the change of u over a step.
///
///   div(e (grad u^n - avg L^n)),   e = |d| (rho G alpha_f lambda_B)^(1/2) - alpha_f mu_s, >= 0
///
/// compares the compact gradient with the averaged one. The averaged stress does not see what
/// alternates from cell to cell. This term damps it at the rate of the elastic wave through a cell.
/// Where the solid's own viscosity does the same by its compact term, only the rest is left to it.
///
/// At a surface between two viscosities (normal) the part of it along the surface alone is left, e
/// sin^2 of the angle between d and the normal. Across the surface the mean is off by a part of the
/// kink of u, a stress of first order, and the viscous stress in series damps instead.
///
/// The mean is (L_P + L_N) / 2, exact for a quadratic velocity. At the surface u has a kink, and
/// the mean is alpha_f L_s + (1 - alpha_f) L_f, s and f the cells on either side. That is exact for
/// two linear pieces if L is the mean of the gradients to both sides of its cell, or that of the
/// cell's own. Without `kink` the mean is that of the face.
///
/// The term is explicit, and so e is at most 1.5 (kappa + m) with m = rho |d|^2 / dt min(1 / 8,
/// 1 / (2 K)). rho is the least density around, K = sum_f g |d|^2 / (2 V) the larger of the two
/// cells. A velocity that differs from all neighbours' then changes by no more than 1.5 of itself
/// in a step, whatever the shape of its cell. K = dim on squares and regular simplices, 10 and more
/// on slivers. Triangles and tetrahedra, whose gradient has more such modes, need all of it.
///
/// With L from the cell's own side (sided) kappa grows by what makes all of e stable,
/// i = e / 1.5 - kappa - m where that is positive. Otherwise mu_s counts as 0 and u* stands in
/// place of the first u^n. Either costs an error of first order in dt. With L of one side a face
/// has no flux that would give energy to the strain: such an L is no mean of the faces' gradients.
/// Left out is a flux whose part along u_N - u_P less the spin of avg L times d is negative. A map
/// on triangles and tetrahedra needs twice the root.
class SemiImplicitElasticity {
 public:
  /// Collective. mesh and zone must outlive it.
  SemiImplicitElasticity(const Mesh& mesh, const FaceWeights& weights, const SimplexZone& zone);

  /// kappa / (dt G alpha lambda_B).
  static constexpr Real implicit_fraction = 0.4;

  /// Takes out what the last `apply` added.
  void clear(FaceField<Real>& kappa);

  /// Collective. kappa_f += the implicit coefficient, at faces of the zone with i or e
  /// added; lambda_B linear between the cells, times the face's alpha; nothing outside the band.
  /// force += the explicit rest of the second.
  void apply(FaceField<Real>& kappa, CellField<Vec3>& force, const ElasticTerms& solid,
             const FaceWeights& weights, const Band& band);

 private:
  const Mesh& mesh_;
  const SimplexZone& zone_;
  std::vector<Real> inertia_;  // [n_internal] m dt / (rho |d|^2)
  std::vector<Index> last_faces_;
};

}  // namespace fsi::solid
