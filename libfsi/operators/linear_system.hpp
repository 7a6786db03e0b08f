#pragma once
// A constant symmetric sparse system on the cells and its solver.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"
#include "libfsi/field/field.hpp"

namespace fsi {

/// A symmetric matrix on the cell graph: one diagonal value a cell, one coefficient a face.
struct FaceMatrix {
  /// A zero matrix.
  explicit FaceMatrix(const Mesh& mesh)
      : diagonal(static_cast<std::size_t>(mesh.n_owned)),
        off_diagonal(static_cast<std::size_t>(mesh.n_internal)) {}
  std::vector<Real> diagonal;      ///< [n_owned]
  std::vector<Real> off_diagonal;  ///< [n_internal] a_PN = a_NP
};

/// How a system is solved unless options with its prefix say otherwise.
enum class Method {
  multigrid,  ///< conjugate gradients on BoomerAMG's levels; for a constant Laplacian-like matrix
  direct,     ///< Cholesky factors, kept; for a constant matrix of a small 2-D mesh
};

/// The figures of a solve.
struct SolveResult {
  int iterations = 0;  ///< count
  Real residual = 0;   ///< norm at the end, as the solver measures it
};

/// Mat + KSP. The name is the option prefix: "p" reads -p_ksp_type and so on.
class LinearSystem {
 public:
  /// Collective. singular: the constant is the null space; the right-hand side must sum to zero.
  LinearSystem(const Mesh& mesh, const std::string& name, Method method, bool singular,
               Real relative_tolerance);
  ~LinearSystem();
  ///@{
  /// Moves the system.
  LinearSystem(LinearSystem&&) noexcept;
  LinearSystem& operator=(LinearSystem&&) noexcept;
  ///@}

  /// Collective. Sets the values, once: the data for another assembly are freed.
  void assemble(const FaceMatrix& matrix);
  /// Collective, after `assemble`. Sets new values. The preconditioner stays that of `assemble`:
  /// this needs no set-up, but more iterations as the values differ more.
  void renew(const FaceMatrix& matrix);
  /// Collective. Solves A x = b from the guess in x; on return owned cells and halo are set.
  /// Where the constant is the null space, the mean of b is removed first. Iterates until |r| <=
  /// max(relative |b|, absolute), relative being the tolerance of the options times `loosened`.
  /// Errors: Error{numerics} with the system's name and PETSc's reason when it does not converge.
  SolveResult solve(CellField<Real>& x, std::span<Real> b, Real absolute = 0, Real loosened = 1);
  /// Collective, after `assemble`. x = the preconditioner applied to b, one cycle or a solve with
  /// the factors; owned and halo. If the constant is the null space, b must sum to zero.
  void precondition(CellField<Real>& x, std::span<Real> b);

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace fsi
