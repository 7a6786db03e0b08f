#pragma once
// A symmetric sparse system for all components of a vector at once, and its Krylov solver.

#include <memory>
#include <span>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/linear_system.hpp"

namespace fsi {

/// A symmetric matrix on the cell graph: one coefficient a face for all components, one diagonal
/// value a cell and component. Components are coupled in single cells alone.
struct VectorMatrix {
  /// a (n n - its diagonal) in an owned cell, n a unit vector; a n_i n_i is part of `diagonal`.
  struct Coupling {
    Index cell;  ///< an owned one
    Vec3 n;      ///< unit vector
    Real a;      ///< coefficient
  };

  /// A zero matrix.
  explicit VectorMatrix(const Mesh& mesh)
      : diagonal(static_cast<std::size_t>(mesh.n_owned * mesh.dim)),
        off_diagonal(static_cast<std::size_t>(mesh.n_internal)) {}
  std::vector<Real> diagonal;       ///< [n_owned * dim]
  std::vector<Real> off_diagonal;   ///< [n_internal] a_PN = a_NP
  std::vector<Coupling> couplings;  ///< any number of them in a cell
};

/// Conjugate gradients for a matrix that changes every step and is close to its diagonal in most
/// cells, preconditioned by StiffSweep. The matrix is applied face by face, never assembled.
class VectorSystem {
 public:
  /// Collective. The name is the option prefix: "u" reads -u_ksp_type and so on. Errors:
  /// Error{input} if -NAME_pc_type needs an assembled matrix.
  VectorSystem(const Mesh& mesh, const std::string& name, Real relative_tolerance);
  ~VectorSystem();
  ///@{
  /// Moves the system.
  VectorSystem(VectorSystem&&) noexcept;
  VectorSystem& operator=(VectorSystem&&) noexcept;
  ///@}

  /// To be filled; renewed() tells the solver.
  VectorMatrix& matrix();
  /// Collective. The matrix has new values.
  void renewed();

  /// Collective. Solves A x = b from the guess in x, dim values a cell. x: owned and halo, the
  /// latter set on return; b: owned. Iterates until the natural norm of the residual falls by the
  /// relative tolerance. Errors: Error{numerics} with the system's name and PETSc's reason when it
  /// does not converge.
  SolveResult solve(std::span<Real> x, std::span<Real> b);

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace fsi
