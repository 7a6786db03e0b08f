#pragma once
// The unknowns, and what a step reports.

#include <cstdint>
#include <map>
#include <string>

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// The unknowns at time t.
struct State {
  /// At rest, at t = 0.
  explicit State(const Mesh& mesh) : u(mesh), p(mesh), phi(mesh) {}
  CellField<Vec3> u;      ///< velocity
  CellField<Real> p;      ///< pressure, half a step behind u
  FaceField<Real> phi;    ///< volume flux, divergence-free to the solver's tolerance
  Real t = 0;             ///< time
  std::int64_t step = 0;  ///< steps taken since t = 0
};

/// What the last step took, and what went wrong in this run.
struct StepReport {
  int velocity_iterations = 0, pressure_iterations = 0;  ///< of the linear solvers
  Real pressure_residual = 0;  ///< norm over the cells of the net flux that the solve left
  std::int64_t rejected = 0;   ///< steps taken back; an Output counts from 0
  std::map<std::string, std::int64_t> rejections{};  ///< by reason, since the start or restart
  /// The step is smaller than asked for, after a rejected one or one in which a solid left.
  bool held_back = false;
  std::string failure;  ///< why the run cannot go on; empty while it can
};

}  // namespace fsi
