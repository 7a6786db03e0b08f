#pragma once
// A directory of its own for a test, and fields whose values tell where they belong.

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "libfsi/core/parallel.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/io/checkpoint.hpp"

namespace fsi::test {

/// Collective. A fresh directory, removed at the end.
class Folder {
 public:
  Folder() {
    const auto root = std::filesystem::temp_directory_path();
    path_ = broadcast((root / ("fsi_io_" + std::to_string(getpid()))).string());
    if (rank() == 0) std::filesystem::remove_all(path_), std::filesystem::create_directory(path_);
    all_of_ranks(true);
  }
  ~Folder() {
    all_of_ranks(true);
    std::error_code code;
    if (rank() == 0) std::filesystem::remove_all(path_, code);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Collective. The text of a file, as rank 0 sees it.
inline std::string content(const std::string& path) {
  std::ostringstream text;
  if (rank() == 0) text << std::ifstream(path, std::ios::binary).rdbuf();
  return broadcast(text.str());
}

/// A state with a field of every kind. Values follow from global numbers alone.
struct Sample {
  explicit Sample(const Mesh& m) : mesh(m), u(m), B(m), phi(m), p_b(m) {}

  const Mesh& mesh;
  CellField<Vec3> u;
  CellField<SymTensor> B;
  FaceField<Real> phi;
  BoundaryField<Real> p_b;
  Real t = 0;
  std::int64_t step = 0;
  std::string note;

  Real face_value(Index f) const {
    const auto P = static_cast<Real>(mesh.global_id[mesh.owner[f]]);
    const Real N = f < mesh.n_internal ? static_cast<Real>(mesh.global_id[mesh.neighbour[f]]) : -1;
    return std::sin(P + 0.37 * N) + mesh.Sf[f].x + 1e-3 * mesh.Cf[f].y;
  }
  /// Calls visit(value, what it must be) for all values, halo included.
  template <class Visit>
  void each(Visit visit) {
    for (Index c = 0; c < mesh.n_cells; ++c) {
      const Real id = std::sqrt(static_cast<Real>(mesh.global_id[c]) + 0.1);
      for (int k = 0; k < 3; ++k) visit(u[c][k], id / (k + 3));
      visit(B[c].xx, id), visit(B[c].xy, -id), visit(B[c].xz, 0.0), visit(B[c].yy, 1 / (1 + id));
      visit(B[c].yz, 5e-324 * (1 + id)), visit(B[c].zz, 1e300 * id);
    }
    for (Index f = 0; f < mesh.n_faces; ++f) visit(phi[f], face_value(f));
    for (Index f = mesh.n_internal; f < mesh.n_faces; ++f)
      visit(p_b[f - mesh.n_internal], face_value(f) / 3);
  }
  void fill() {
    each([](Real& value, Real right) { value = right; });
    t = 0.1 + 0.2, step = (std::int64_t{1} << 60) + 1, note = "left,\nright";
  }
  /// Count of values that are not, bit for bit, what fill() gives.
  Index wrong() {
    Index count = 0;
    each([&](Real& value, Real right) { count += value == right ? 0 : 1; });
    return count + (t == 0.1 + 0.2 && step == (std::int64_t{1} << 60) + 1 ? 0 : 1) +
           (note == "left,\nright" ? 0 : 1);
  }
  io::Snapshot snapshot(const std::string& identity = "driver=test") {
    io::Snapshot list(identity);
    list.add("u", u), list.add("B", B), list.add("phi", phi), list.add("p_b", p_b);
    list.add("t", &t), list.add("step", &step), list.add("note", &note);
    return list;
  }
};

}  // namespace fsi::test
