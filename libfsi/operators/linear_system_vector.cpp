#include "libfsi/operators/linear_system_vector.hpp"

#include <petsc/private/petscimpl.h>
#include <petscksp.h>

#include <algorithm>
#include <exception>
#include <string>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/linear_system_options.hpp"
#include "libfsi/operators/stiff_sweep.hpp"

namespace fsi {

/// What the matrix-vector product and the preconditioner work on.
struct VectorOperator {
  const Mesh& mesh;
  VectorMatrix matrix;
  std::vector<Index> cut;    // internal faces with a cell of another rank, ascending
  std::vector<Real> around;  // [n_cells * dim] of a direction the halo; one rank needs none
  StiffSweep sweep;          // of the matrix, where no other preconditioner is asked for

  explicit VectorOperator(const Mesh& m) : mesh(m), matrix(m), sweep(m) {
    for (Index f = 0; f < m.n_internal; ++f)
      if (m.owner[f] >= m.n_owned || m.neighbour[f] >= m.n_owned) cut.push_back(f);
    if (ranks() > 1) around.resize(static_cast<std::size_t>(m.n_cells * m.dim));
  }
};

struct VectorSystem::Handles {
  VectorOperator op;
  std::string name;
  Mat shell = nullptr;
  KSP solver = nullptr;
  Vec x = nullptr, b = nullptr;

  Handles(const Mesh& mesh, const std::string& n) : op(mesh), name(n) {}
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

/// Both cells of the faces [begin, end), all owned: y_P += a_f x_N, y_N += a_f x_P.
template <int dim>
void add_faces(Real* y, const VectorMatrix& matrix, const Real* x, const Mesh& mesh, Index begin,
               Index end) {
  for (Index f = begin; f < end; ++f) {
    const Real a = matrix.off_diagonal[f];
    const Index P = mesh.owner[f] * dim, N = mesh.neighbour[f] * dim;
    for (Index k = 0; k < dim; ++k) y[P + k] += a * x[N + k];
    for (Index k = 0; k < dim; ++k) y[N + k] += a * x[P + k];
  }
}

/// y_c += a (n (n . x_c) - the part of the diagonal).
template <int dim>
void add_couplings(Real* y, const VectorMatrix& matrix, const Real* x) {
  for (const auto& [cell, n, a] : matrix.couplings) {
    const Real* const at = x + cell * dim;
    Real along = 0;
    for (int k = 0; k < dim; ++k) along += n[k] * at[k];
    for (int k = 0; k < dim; ++k) y[cell * dim + k] += a * n[k] * (along - n[k] * at[k]);
  }
}

/// y_c = a_cc x_c + sum_f a_f x_N, dim components a cell, of owned cells; the halo of x arrives
/// meanwhile.
template <int dim>
void multiply(Real* y, VectorOperator& op, const Real* x) {
  const Mesh& mesh = op.mesh;
  const VectorMatrix& matrix = op.matrix;
  const Index n = mesh.n_owned;
  Real* const around = op.around.data();
  mesh.halo.begin(x, around, dim);
  for (Index i = 0; i < n * dim; ++i) y[i] = matrix.diagonal[i] * x[i];
  add_couplings<dim>(y, matrix, x);
  Index begin = 0;
  for (const Index f : op.cut) {
    add_faces<dim>(y, matrix, x, mesh, begin, f);
    begin = f + 1;
  }
  add_faces<dim>(y, matrix, x, mesh, begin, mesh.n_internal);
  mesh.halo.end(x, around, dim);
  for (const Index f : op.cut) {
    const Real a = matrix.off_diagonal[f];
    const auto [mine, other] = std::minmax(mesh.owner[f], mesh.neighbour[f]);
    for (Index k = 0; k < dim; ++k) y[mine * dim + k] += a * around[other * dim + k];
  }
}

/// work(y, x) on the values of both.
template <class Work>
PetscErrorCode on_values(Vec y, Vec x, const Work& work) noexcept {
  PetscFunctionBegin;
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  PetscCall(VecGetArrayRead(x, &from));
  PetscCall(VecGetArrayWrite(y, &to));
  try {
    work(to, from);
  } catch (const std::exception&) {
    PetscFunctionReturn(PETSC_ERR_LIB);
  }
  PetscCall(VecRestoreArrayRead(x, &from));
  PetscCall(VecRestoreArrayWrite(y, &to));
  PetscFunctionReturn(0);
}

PetscErrorCode apply(Mat shell, Vec x, Vec y) noexcept {
  PetscFunctionBegin;
  VectorOperator* op = nullptr;
  PetscCall(MatShellGetContext(shell, &op));
  PetscCall(on_values(y, x, [&](Real* to, const Real* from) {
    (op->mesh.dim == 2 ? multiply<2> : multiply<3>)(to, *op, from);
  }));
  PetscFunctionReturn(0);
}

PetscErrorCode copy_diagonal(Mat shell, Vec diagonal) noexcept {
  PetscFunctionBegin;
  VectorOperator* op = nullptr;
  PetscScalar* to = nullptr;
  PetscCall(MatShellGetContext(shell, &op));
  PetscCall(VecGetArrayWrite(diagonal, &to));
  std::ranges::copy(op->matrix.diagonal, to);
  PetscCall(VecRestoreArrayWrite(diagonal, &to));
  PetscFunctionReturn(0);
}

PetscErrorCode set_up_sweep(PC pc) noexcept {
  PetscFunctionBegin;
  VectorOperator* op = nullptr;
  PetscCall(PCShellGetContext(pc, &op));
  try {
    op->sweep.renew(op->matrix);
  } catch (const std::exception&) {
    PetscFunctionReturn(PETSC_ERR_MEM);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode apply_sweep(PC pc, Vec r, Vec z) noexcept {
  PetscFunctionBegin;
  VectorOperator* op = nullptr;
  PetscCall(PCShellGetContext(pc, &op));
  PetscCall(on_values(z, r, [&](Real* to, const Real* from) { op->sweep.apply(to, from); }));
  PetscFunctionReturn(0);
}

void set_sweep(PC pc, void* context) {
  FSI_PETSC(PCSetType(pc, PCSHELL));
  FSI_PETSC(PCShellSetName(pc, "Gauss-Seidel in stiff cells, Jacobi elsewhere"));
  FSI_PETSC(PCShellSetContext(pc, context));
  FSI_PETSC(PCShellSetSetUp(pc, set_up_sweep));
  FSI_PETSC(PCShellSetApply(pc, apply_sweep));
}

/// Whether the type that the options leave is one that works without an assembled matrix.
void check_type(PC pc, const std::string& name) {
  PCType type = nullptr;
  FSI_PETSC(PCGetType(pc, &type));
  for (const std::string known : {PCSHELL, PCJACOBI, PCNONE})
    if (type == known) return;
  require(false, "option -" + name + "_pc_type: \"" + type +
                     "\" needs an assembled matrix, which this system does not have; there are: "
                     "shell (the default), jacobi, none");
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
  FSI_PETSC(KSPCGUseSingleReduction(h.solver, ranks() > 1 ? PETSC_TRUE : PETSC_FALSE));
  FSI_PETSC(KSPSetNormType(h.solver, KSP_NORM_NATURAL));
  FSI_PETSC(KSPSetInitialGuessNonzero(h.solver, PETSC_TRUE));
  PC pc = nullptr;
  FSI_PETSC(KSPGetPC(h.solver, &pc));
  set_sweep(pc, &h.op);
  FSI_PETSC(KSPSetTolerances(h.solver, relative_tolerance, PETSC_DEFAULT, PETSC_DEFAULT, 500));
  check_solver_options(name + "_");
  FSI_PETSC(KSPSetFromOptions(h.solver));
  check_type(pc, name);
}

VectorSystem::~VectorSystem() = default;
VectorSystem::VectorSystem(VectorSystem&&) noexcept = default;
VectorSystem& VectorSystem::operator=(VectorSystem&&) noexcept = default;

VectorMatrix& VectorSystem::matrix() { return handles_->op.matrix; }

void VectorSystem::renewed() {
  // Tells the preconditioner, which otherwise keeps the first values.
  FSI_PETSC(PetscObjectStateIncrease(reinterpret_cast<PetscObject>(handles_->shell)));
}

SolveResult VectorSystem::solve(std::span<Real> x, std::span<Real> b) {
  Handles& h = *handles_;
  FSI_PETSC(VecPlaceArray(h.x, x.data()));
  FSI_PETSC(VecPlaceArray(h.b, b.data()));
  FSI_PETSC(KSPSolve(h.solver, h.b, h.x));
  PetscInt its = 0;
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  SolveResult result;
  FSI_PETSC(KSPGetConvergedReason(h.solver, &reason));
  FSI_PETSC(KSPGetIterationNumber(h.solver, &its));
  FSI_PETSC(KSPGetResidualNorm(h.solver, &result.residual));
  FSI_PETSC(VecResetArray(h.x));
  FSI_PETSC(VecResetArray(h.b));
  result.iterations = static_cast<int>(its);
  if (reason < 0)
    throw Error(ErrorKind::numerics,
                "system \"" + h.name + "\" did not converge: " + KSPConvergedReasons[reason]);
  h.op.mesh.halo.update(x.data(), h.op.mesh.dim);
  return result;
}

}  // namespace fsi
