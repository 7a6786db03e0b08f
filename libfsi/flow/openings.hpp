#pragma once
// Pressure and velocity at the openings of the boundary.

#include <cstdint>
#include <vector>

#include "libfsi/core/parallel.hpp"
#include "libfsi/field/boundary.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"

namespace fsi::flow {

/// The openings of a mesh.
///
/// A given static pressure sets no bound on the kinetic energy that enters with the flow. A faster
/// inflow brings more energy, and on tetrahedra the inflow through single faces grows without bound
/// at Reynolds numbers of some hundred. The given pressure therefore acts as a total pressure for
/// the part of the inflow that departs from a smooth profile,
///
///   p_b = p + rho / 2 (epsilon uhat_n^2 - u_n^2)     where u_n = u_P . n < 0.
///
/// uhat_n is the least-squares fit of u_n over the opening by polynomials in its plane, at most one
/// for four faces. They are of fourth degree, of a lower one where the faces are few, and even
/// about planes of symmetry. epsilon is the net inflow over the inflow, and 0 if the
/// net flow is outward. A smooth inlet thus keeps its static pressure. Backflow into an outlet
/// costs its own dynamic pressure, as with the directional do-nothing condition [Braack14].
class Openings {
 public:
  /// Collective.
  Openings(const Mesh& mesh, const std::vector<Condition>& conditions, Real rho);

  /// Collective. Pressure on the faces of openings. u: owned.
  void set_pressure(BoundaryField<Real>& p_b, const CellField<Vec3>& u);
  /// Takes `pressure` of openings without a load to time t; q_b = factor times its change.
  void advance(BoundaryField<Real>& q_b, Real t, Real factor);
  /// Velocity on the faces of openings: no gradient along the normal,
  ///   u_b = u_P + L_f . t,  t the part of d along the face.
  /// L_f: at irregular faces.
  void set_velocity(BoundaryField<Vec3>& u_b, const CellField<Vec3>& u,
                    const std::vector<Tensor>& L_f, const FaceWeights& weights) const;
  /// e_f = phi_f - u_b . S of that velocity, on the faces of openings.
  void set_flux_excess(FaceField<Real>& excess, const FaceField<Real>& phi,
                       const CellField<Vec3>& u, const std::vector<Tensor>& L_f,
                       const FaceWeights& weights) const;
  /// Inflow enters along the normal: u_b = phi S / |S|^2 where phi < 0.
  void set_inflow(BoundaryField<Vec3>& u_b, const FaceField<Real>& phi) const;

  /// An opening.
  struct One {
    Patch patch;   ///< its faces
    OfTime given;  ///< the pressure that is given
    Load load;     ///< between the given pressure and the opening
    // part of a checkpoint:
    Real pressure = 0;            ///< in the middle of the last step
    Real stored = 0;              ///< of the load's capacitance, at the end of the last step
    Real flow = 0;                ///< out of a loaded opening, at the end of the last step
    std::int64_t flow_known = 0;  ///< whether there was a last step
    Real trend = 0;               ///< change of flow in the last step, per time
    Vec3 normal{};                ///< outward, of the patch as a whole
    std::vector<std::vector<Real>> basis{};  ///< [functions][faces], orthonormal by area
    std::vector<Sum> sums{};                 ///< scratch
    std::vector<Real> totals{};              ///< scratch
    /// Count of faces on this rank.
    Index faces() const { return patch.end - patch.begin; }
  };
  ///@{
  /// All openings, in the order of the patches.
  std::vector<One>& all() { return openings_; }
  const std::vector<One>& all() const { return openings_; }
  ///@}

 private:
  /// u_b at a face of an opening.
  Vec3 velocity(Index f, const CellField<Vec3>& u, const std::vector<Tensor>& L_f,
                const FaceWeights& weights) const;
  void set_basis(One& opening, const std::vector<Condition>& conditions) const;
  bool orthonormalise(const One& opening, std::vector<Real>& e) const;

  const Mesh& mesh_;
  Real rho_;
  std::vector<One> openings_;
};

}  // namespace fsi::flow
