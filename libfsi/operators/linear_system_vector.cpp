#include "libfsi/operators/linear_system_vector.hpp"

#include <petsc/private/petscimpl.h>
#include <petscksp.h>

#include <algorithm>
#include <string>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"

namespace fsi {

namespace {

/// What the matrix-vector product works on.
struct Operator {
  const Mesh& mesh;
  VectorMatrix matrix;
  std::vector<Real> around;  // [n_cells * dim] a direction with its halo; one rank needs none
};

}  // namespace

struct VectorSystem::Handles {
  Operator op;
  std::string name;
  Mat shell = nullptr;
  KSP solver = nullptr;
  Vec x = nullptr, b = nullptr;

  Handles(const Mesh& mesh, const std::string& n) : op{mesh, VectorMatrix(mesh), {}}, name(n) {
    if (ranks() > 1) op.around.resize(static_cast<std::size_t>(mesh.n_cells * mesh.dim));
  }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    // Nothing useful can be done with a code here, and a destructor must not throw.
    static_cast<void>(KSPDestroy(&solver));  // layers: destructor
    static_cast<void>(MatDestroy(&shell));   // layers: destructor
    static_cast<void>(VecDestroy(&x));       // layers: destructor
    static_cast<void>(VecDestroy(&b));       // layers: destructor
  }
};

namespace {

/// y_c = a_cc x_c + sum_f a_f x_N, dim components a cell; x: owned and halo, y: owned.
template <int dim>
void multiply(Real* y, const VectorMatrix& matrix, const Real* x, const Mesh& mesh) {
  const Index n = mesh.n_owned;
  for (Index i = 0; i < n * dim; ++i) y[i] = matrix.diagonal[i] * x[i];
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Real a = matrix.off_diagonal[f];
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    if (P < n)
      for (Index k = 0; k < dim; ++k) y[P * dim + k] += a * x[N * dim + k];
    if (N < n)
      for (Index k = 0; k < dim; ++k) y[N * dim + k] += a * x[P * dim + k];
  }
}

PetscErrorCode apply(Mat shell, Vec x, Vec y) noexcept {
  PetscFunctionBegin;
  Operator* op = nullptr;
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  PetscCall(MatShellGetContext(shell, &op));
  PetscCall(VecGetArrayRead(x, &from));
  PetscCall(VecGetArrayWrite(y, &to));
  const Mesh& mesh = op->mesh;
  const Real* values = from;
  try {
    if (!op->around.empty()) {
      std::copy_n(from, mesh.n_owned * mesh.dim, op->around.begin());
      mesh.halo.update(op->around.data(), mesh.dim);
      values = op->around.data();
    }
  } catch (const Error&) {
    PetscFunctionReturn(PETSC_ERR_LIB);
  }
  (mesh.dim == 2 ? multiply<2> : multiply<3>)(to, op->matrix, values, mesh);
  PetscCall(VecRestoreArrayRead(x, &from));
  PetscCall(VecRestoreArrayWrite(y, &to));
  PetscFunctionReturn(0);
}

PetscErrorCode copy_diagonal(Mat shell, Vec diagonal) noexcept {
  PetscFunctionBegin;
  Operator* op = nullptr;
  PetscScalar* to = nullptr;
  PetscCall(MatShellGetContext(shell, &op));
  PetscCall(VecGetArrayWrite(diagonal, &to));
  std::ranges::copy(op->matrix.diagonal, to);
  PetscCall(VecRestoreArrayWrite(diagonal, &to));
  PetscFunctionReturn(0);
}

void make_shell(Mat* shell, PetscInt n, void* context) {
  FSI_PETSC(MatCreateShell(comm(), n, n, PETSC_DETERMINE, PETSC_DETERMINE, context, shell));
  FSI_PETSC(MatShellSetOperation(*shell, MATOP_MULT, reinterpret_cast<void (*)()>(apply)));
  FSI_PETSC(MatShellSetOperation(*shell, MATOP_GET_DIAGONAL,
                                 reinterpret_cast<void (*)()>(copy_diagonal)));
  FSI_PETSC(MatSetOption(*shell, MAT_SYMMETRIC, PETSC_TRUE));
  FSI_PETSC(MatSetOption(*shell, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  FSI_PETSC(MatSetOption(*shell, MAT_SPD, PETSC_TRUE));
}

}  // namespace

VectorSystem::VectorSystem(const Mesh& mesh, const std::string& name, Real relative_tolerance)
    : handles_(std::make_unique<Handles>(mesh, name)) {
  Handles& h = *handles_;
  const PetscInt n = mesh.n_owned * mesh.dim;
  make_shell(&h.shell, n, &h.op);
  FSI_PETSC(VecCreateMPIWithArray(comm(), 1, n, PETSC_DETERMINE, nullptr, &h.x));
  FSI_PETSC(VecCreateMPIWithArray(comm(), 1, n, PETSC_DETERMINE, nullptr, &h.b));
  FSI_PETSC(KSPCreate(comm(), &h.solver));
  FSI_PETSC(KSPSetOptionsPrefix(h.solver, (name + "_").c_str()));
  FSI_PETSC(KSPSetOperators(h.solver, h.shell, h.shell));
  FSI_PETSC(KSPSetType(h.solver, KSPCG));
  FSI_PETSC(KSPSetNormType(h.solver, KSP_NORM_NATURAL));
  FSI_PETSC(KSPSetInitialGuessNonzero(h.solver, PETSC_TRUE));
  PC pc = nullptr;
  FSI_PETSC(KSPGetPC(h.solver, &pc));
  FSI_PETSC(PCSetType(pc, PCJACOBI));
  FSI_PETSC(KSPSetTolerances(h.solver, relative_tolerance, PETSC_DEFAULT, PETSC_DEFAULT, 500));
  FSI_PETSC(KSPSetFromOptions(h.solver));
  PCType type = nullptr;
  FSI_PETSC(PCGetType(pc, &type));
  require(std::string(type) == PCJACOBI || std::string(type) == PCNONE,
          "option -" + name + "_pc_type: \"" + type +
              "\" needs an assembled matrix, which this system does not have; there are: jacobi, "
              "none");
}

VectorSystem::~VectorSystem() = default;
VectorSystem::VectorSystem(VectorSystem&&) noexcept = default;
VectorSystem& VectorSystem::operator=(VectorSystem&&) noexcept = default;

VectorMatrix& VectorSystem::matrix() { return handles_->op.matrix; }

void VectorSystem::renewed() {
  // Tells the preconditioner, which otherwise keeps the first diagonal.
  FSI_PETSC(PetscObjectStateIncrease(reinterpret_cast<PetscObject>(handles_->shell)));
}

Solve VectorSystem::solve(std::span<Real> x, std::span<Real> b) {
  Handles& h = *handles_;
  FSI_PETSC(VecPlaceArray(h.x, x.data()));
  FSI_PETSC(VecPlaceArray(h.b, b.data()));
  FSI_PETSC(KSPSolve(h.solver, h.b, h.x));
  PetscInt its = 0;
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  Solve result;
  FSI_PETSC(KSPGetConvergedReason(h.solver, &reason));
  FSI_PETSC(KSPGetIterationNumber(h.solver, &its));
  FSI_PETSC(KSPGetResidualNorm(h.solver, &result.residual));
  FSI_PETSC(VecResetArray(h.x));
  FSI_PETSC(VecResetArray(h.b));
  result.iterations = static_cast<int>(its);
  if (reason < 0)
    throw Error(Kind::numerics,
                "system \"" + h.name + "\" did not converge: " + KSPConvergedReasons[reason]);
  h.op.mesh.halo.update(x.data(), h.op.mesh.dim);
  return result;
}

}  // namespace fsi
