#pragma once
// Why a step is taken back.

#include <string>

#include "libfsi/solver/solver.hpp"

namespace fsi {

/// What may end a step: the equation whose limit is passed, or what was thrown.
enum class Term {
  none,
  convection,
  pressure,
  transport,
  fraction,
  elasticity,
  strain,
  eigenvalue,
  solve
};

/// A step that is refused.
struct Rejection {
  std::string reason{};        ///< a sentence, the same at all places; empty: it is not refused
  Term term = Term::none;      ///< whose limit it is
  const Body* body = nullptr;  ///< whose limit it is; null: that of the flow
};

/// Collective. What holds the steps as short as dt, where there were too many such in a row.
Rejection holder(const Solver& solver, Real dt);

}  // namespace fsi
