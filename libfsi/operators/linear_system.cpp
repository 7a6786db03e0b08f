#include "libfsi/operators/linear_system.hpp"

#include <petscksp.h>

#include <algorithm>
#include <array>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/linear_system_multigrid.hpp"
#include "libfsi/operators/linear_system_options.hpp"

namespace fsi {

struct LinearSystem::Handles {
  const Mesh& mesh;
  std::string name;
  bool pinned = false;  ///< direct and singular: one diagonal entry is doubled
  bool cycle = false;   ///< PETSc's own on BoomerAMG's levels
  Mat matrix = nullptr;
  Mat renewed = nullptr;  ///< where its values are not those the preconditioner was made of
  KSP solver = nullptr;
  Vec x = nullptr, b = nullptr;
  MatNullSpace constant = nullptr;  ///< of a system that is singular and not pinned
  std::vector<PetscScalar> values;
  std::vector<Index> face;  // of every off-diagonal entry

  explicit Handles(const Mesh& m) : mesh(m) {}
  /// Attaches the null space. PETSc then takes the constant out after each product and sweep, with
  /// one reduction each. The cycle of this library has its coarsest level pinned and takes it out
  /// only at the end.
  void attach(Mat to) const {
    if (constant != nullptr && !cycle) FSI_PETSC(MatSetNullSpace(to, constant));
  }
  /// Collective. Puts the values in.
  void set(Mat to, const FaceMatrix& from) {
    const std::size_t n = from.diagonal.size();
    values.resize(n + face.size());
    std::copy(from.diagonal.begin(), from.diagonal.end(), values.begin());
    // A pinned singular system with a right-hand side of zero sum has the solution that vanishes
    // in the pinned cell: summing all rows leaves a_00 x_0 = 0.
    if (pinned && n > 0 && mesh.global_id[0] == 0) values[0] *= 2;
    for (std::size_t e = 0; e < face.size(); ++e) values[n + e] = from.off_diagonal[face[e]];
    FSI_PETSC(MatSetValuesCOO(to, values.data(), INSERT_VALUES));
  }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    // Nothing useful can be done with a code here, and a destructor must not throw.
    static_cast<void>(KSPDestroy(&solver));             // layers: destructor
    static_cast<void>(MatDestroy(&matrix));             // layers: destructor
    static_cast<void>(MatDestroy(&renewed));            // layers: destructor
    static_cast<void>(VecDestroy(&x));                  // layers: destructor
    static_cast<void>(VecDestroy(&b));                  // layers: destructor
    static_cast<void>(MatNullSpaceDestroy(&constant));  // layers: destructor
  }
};

namespace {

constexpr PetscReal no_absolute = 1e-300;  // a value that no user sets

bool is_given(const std::string& name) {
  PetscBool there = PETSC_FALSE;
  FSI_PETSC(PetscOptionsHasName(nullptr, nullptr, name.c_str(), &there));
  return there == PETSC_TRUE;
}

/// Puts an option into the database unless the user did.
void prefer(const std::string& prefix, const std::string& option, const char* value) {
  const std::string name = "-" + prefix + option;
  if (!is_given(name)) FSI_PETSC(PetscOptionsSetValue(nullptr, name.c_str(), value));
}

/// Global row of every local cell, halo included.
std::vector<PetscInt> global_rows(const Mesh& mesh) {
  GlobalIndex before = 0, mine = mesh.n_owned;
  MPI_Exscan(&mine, &before, 1, MPI_INT64_T, MPI_SUM, comm());
  if (rank() == 0) before = 0;
  std::vector<Real> number(static_cast<std::size_t>(mesh.n_cells));
  for (Index c = 0; c < mesh.n_owned; ++c) number[c] = static_cast<Real>(before + c);
  mesh.halo.update(number.data(), 1);
  return {number.begin(), number.end()};
}

void set_properties(Mat matrix) {
  FSI_PETSC(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  FSI_PETSC(MatSetOption(matrix, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  FSI_PETSC(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
}

/// A matrix on the cell graph, without values; face: of every off-diagonal entry.
Mat new_matrix(const Mesh& mesh, std::vector<Index>& face) {
  const std::vector<PetscInt> row = global_rows(mesh);
  std::vector<PetscInt> i(row.begin(), row.begin() + mesh.n_owned), j = i;
  face.clear();
  for (Index f = 0; f < mesh.n_internal; ++f)
    for (const auto& [c, other] :
         {std::pair{mesh.owner[f], mesh.neighbour[f]}, std::pair{mesh.neighbour[f], mesh.owner[f]}})
      if (c < mesh.n_owned) {
        i.push_back(row[c]), j.push_back(row[other]);
        face.push_back(f);
      }
  Mat matrix = nullptr;
  FSI_PETSC(MatCreate(comm(), &matrix));
  FSI_PETSC(MatSetSizes(matrix, mesh.n_owned, mesh.n_owned, PETSC_DETERMINE, PETSC_DETERMINE));
  FSI_PETSC(MatSetType(matrix, MATAIJ));
  FSI_PETSC(MatSetPreallocationCOO(matrix, static_cast<PetscCount>(i.size()), i.data(), j.data()));
  return matrix;
}

/// PETSc refuses a guess where the preconditioner alone, such as -p_pc_type lu, is the solver.
void start_from_zero_where_direct(KSP solver) {
  PetscBool direct = PETSC_FALSE;
  FSI_PETSC(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(solver), KSPPREONLY, &direct));
  if (direct == PETSC_TRUE) FSI_PETSC(KSPSetInitialGuessNonzero(solver, PETSC_FALSE));
}

void set_defaults(const std::string& prefix, Method method, KSP solver) {
  FSI_PETSC(KSPSetType(solver, KSPCG));
  FSI_PETSC(KSPCGUseSingleReduction(solver, ranks() > 1 ? PETSC_TRUE : PETSC_FALSE));
  FSI_PETSC(KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED));
  FSI_PETSC(KSPSetInitialGuessNonzero(solver, PETSC_TRUE));
  PC pc = nullptr;
  FSI_PETSC(KSPGetPC(solver, &pc));
  switch (method) {
    case Method::multigrid:
      FSI_PETSC(PCSetType(pc, PCHYPRE));
      FSI_PETSC(PCHYPRESetType(pc, "boomeramg"));
      prefer(prefix, "pc_hypre_boomeramg_coarsen_type", "HMIS");
      prefer(prefix, "pc_hypre_boomeramg_interp_type", "ext+i");
      prefer(prefix, "pc_hypre_boomeramg_P_max", "4");
      prefer(prefix, "pc_hypre_boomeramg_strong_threshold", "0.25");
      // Of BoomerAMG's own cycle, where the user asks for that; else its levels are all that stays.
      prefer(prefix, "pc_hypre_boomeramg_relax_type_all", "Chebyshev");
      if (!is_given("-" + prefix + "pc_type"))
        prefer(prefix, "pc_hypre_boomeramg_max_coarse_size", "500");
      break;
    case Method::direct:
      factor_whole(pc);
      break;
  }
}

}  // namespace

LinearSystem::LinearSystem(const Mesh& mesh, const std::string& name, Method method, bool singular,
                           Real relative_tolerance)
    : handles_(std::make_unique<Handles>(mesh)) {
  Handles& h = *handles_;
  h.name = name;
  h.pinned = singular && method == Method::direct;
  if (singular && !h.pinned)
    FSI_PETSC(MatNullSpaceCreate(comm(), PETSC_TRUE, 0, nullptr, &h.constant));

  h.matrix = new_matrix(mesh, h.face);
  set_properties(h.matrix);
  FSI_PETSC(VecCreateMPIWithArray(comm(), 1, mesh.n_owned, PETSC_DETERMINE, nullptr, &h.x));
  FSI_PETSC(VecCreateMPIWithArray(comm(), 1, mesh.n_owned, PETSC_DETERMINE, nullptr, &h.b));
  FSI_PETSC(KSPCreate(comm(), &h.solver));
  FSI_PETSC(KSPSetOptionsPrefix(h.solver, (name + "_").c_str()));
  FSI_PETSC(KSPSetOperators(h.solver, h.matrix, h.matrix));
  set_defaults(name + "_", method, h.solver);
  FSI_PETSC(KSPSetTolerances(h.solver, relative_tolerance, no_absolute, PETSC_DEFAULT, 500));
  check_solver_options(name + "_");
  FSI_PETSC(KSPSetFromOptions(h.solver));
  start_from_zero_where_direct(h.solver);
  h.cycle = method == Method::multigrid && !is_given("-" + name + "_pc_type");
}

LinearSystem::~LinearSystem() = default;
LinearSystem::LinearSystem(LinearSystem&&) noexcept = default;
LinearSystem& LinearSystem::operator=(LinearSystem&&) noexcept = default;

void LinearSystem::assemble(const FaceMatrix& matrix) {
  Handles& h = *handles_;
  h.set(h.matrix, matrix);
  Mat lean = nullptr;  // a copy is without PETSc's table from entries to their places
  FSI_PETSC(MatDuplicate(h.matrix, MAT_COPY_VALUES, &lean));
  FSI_PETSC(MatDestroy(&h.matrix));
  h.matrix = lean;
  set_properties(h.matrix);
  FSI_PETSC(KSPSetOperators(h.solver, h.matrix, h.matrix));
  h.values = {}, h.face = {};
  h.cycle = h.cycle && cycle_on_levels(h.solver, h.constant != nullptr);
  h.attach(h.matrix);
}

void LinearSystem::renew(const FaceMatrix& matrix) {
  Handles& h = *handles_;
  if (h.renewed == nullptr) {
    h.renewed = new_matrix(h.mesh, h.face);
    set_properties(h.renewed);
    h.attach(h.renewed);
  }
  h.set(h.renewed, matrix);
  FSI_PETSC(KSPSetReusePreconditioner(h.solver, PETSC_TRUE));
  FSI_PETSC(KSPSetOperators(h.solver, h.renewed, h.matrix));
}

SolveResult LinearSystem::solve(CellField<Real>& x, std::span<Real> b, Real absolute,
                                Real loosened) {
  Handles& h = *handles_;
  FSI_PETSC(VecPlaceArray(h.x, x.data()));
  FSI_PETSC(VecPlaceArray(h.b, b.data()));
  if (h.constant != nullptr) FSI_PETSC(MatNullSpaceRemove(h.constant, h.b));
  PetscReal rtol = 0, given = 0, divergence = 0;
  PetscInt its = 0, most = 0;
  FSI_PETSC(KSPGetTolerances(h.solver, &rtol, &given, &divergence, &most));
  if (given != no_absolute) absolute = given;  // as the user set it
  FSI_PETSC(KSPSetTolerances(h.solver, std::min(loosened * rtol, 0.5),
                             std::max(absolute, no_absolute), divergence, most));
  FSI_PETSC(KSPSolve(h.solver, h.b, h.x));
  FSI_PETSC(KSPSetTolerances(h.solver, rtol, given, divergence, most));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  SolveResult result;
  FSI_PETSC(KSPGetConvergedReason(h.solver, &reason));
  FSI_PETSC(KSPGetIterationNumber(h.solver, &its));
  FSI_PETSC(KSPGetResidualNorm(h.solver, &result.residual));
  if (h.constant != nullptr) FSI_PETSC(MatNullSpaceRemove(h.constant, h.x));
  FSI_PETSC(VecResetArray(h.x));
  FSI_PETSC(VecResetArray(h.b));
  result.iterations = static_cast<int>(its);
  if (reason < 0)
    throw Error(ErrorKind::numerics,
                "system \"" + h.name + "\" did not converge: " + KSPConvergedReasons[reason]);
  h.mesh.halo.update(x);
  return result;
}

void LinearSystem::precondition(CellField<Real>& x, std::span<Real> b) {
  Handles& h = *handles_;
  PC pc = nullptr;
  FSI_PETSC(KSPSetUp(h.solver));
  FSI_PETSC(KSPGetPC(h.solver, &pc));
  FSI_PETSC(VecPlaceArray(h.x, x.data()));
  FSI_PETSC(VecPlaceArray(h.b, b.data()));
  FSI_PETSC(PCApply(pc, h.b, h.x));
  if (h.constant != nullptr) FSI_PETSC(MatNullSpaceRemove(h.constant, h.x));
  FSI_PETSC(VecResetArray(h.x));
  FSI_PETSC(VecResetArray(h.b));
  h.mesh.halo.update(x);
}

}  // namespace fsi
