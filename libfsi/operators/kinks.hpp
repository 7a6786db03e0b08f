#pragma once
// What kinks of a velocity between cells add to its values at faces.

#include <cstddef>
#include <vector>

#include "libfsi/core/types.hpp"

namespace fsi {

/// Internal faces between whose cells the velocity has a kink, and u_f - (u_P + u_N) / 2 there.
/// Both ranks of a face list it.
struct Kinks {
  std::vector<Index> faces;  ///< the faces, once for each body whose surface passes there
  std::vector<Vec3> excess;  ///< of each of them, in the same order

  /// Forgets all faces and keeps the memory.
  void clear() { faces.clear(), excess.clear(); }
  /// Makes room for n more faces.
  void reserve(std::size_t n) {
    faces.reserve(faces.size() + n), excess.reserve(excess.size() + n);
  }
};

}  // namespace fsi
