#pragma once
// A copy of the state in memory, to which a failed step is taken back.

#include <cstdint>
#include <variant>
#include <vector>

#include "libfsi/io/checkpoint.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// Keeps what a Snapshot lists. Invariant: memory for all of it is held from construction on, so
/// that keep() and restore() allocate nothing.
class Backup {
 public:
  /// what: all that the next step depends on.
  Backup(const io::Snapshot& what, const Mesh& mesh);

  /// Copies the state.
  void keep();
  /// Puts the last copy back, halo included.
  void restore() const;

 private:
  io::Snapshot what_;
  std::vector<std::vector<Real>> fields_;
  std::vector<std::variant<Real, std::int64_t>> scalars_;
};

}  // namespace fsi
