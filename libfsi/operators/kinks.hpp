#pragma once
// What kinks of a velocity between cells add to its values at faces.

#include <cstddef>
#include <vector>

#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// Internal faces between whose cells the velocity has a kink, and u_f - (u_P + u_N) / 2 there. No
/// face is in it twice: where the surfaces of two bodies pass, L changes by the jumps of both, and
/// the mean of what they find counts.
class Kinks {
 public:
  /// None yet; the mesh gives the number of faces.
  explicit Kinks(const Mesh& mesh) : place_(static_cast<std::size_t>(mesh.n_internal), -1) {}

  /// Forgets all faces and keeps the memory.
  void clear() {
    for (const Index f : faces_) place_[f] = -1;
    faces_.clear(), excess_.clear(), times_.clear();
  }
  /// Makes room for n more faces.
  void reserve(std::size_t n) {
    n += faces_.size();
    faces_.reserve(n), excess_.reserve(n), times_.reserve(n);
  }
  /// Adds what a body finds at a face.
  void add(Index f, const Vec3& excess) {
    if (place_[f] < 0) {
      place_[f] = static_cast<Index>(faces_.size());
      faces_.push_back(f), excess_.push_back(excess), times_.push_back(1);
    } else {
      Vec3& mean = excess_[place_[f]];
      mean += (1.0 / ++times_[place_[f]]) * (excess - mean);
    }
  }
  /// The faces.
  const std::vector<Index>& faces() const { return faces_; }
  /// u_f - (u_P + u_N) / 2 of each of them, in the same order.
  const std::vector<Vec3>& excess() const { return excess_; }

 private:
  std::vector<Index> place_;  // [n_internal] in faces_; -1: not there
  std::vector<Index> faces_;
  std::vector<Vec3> excess_;
  std::vector<int> times_;  // bodies that added the face
};

}  // namespace fsi
