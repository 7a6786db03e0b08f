#pragma once
// A block of any cell type as the text of a gmsh 2.2 file, and the Mesh read from a text.

#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/build.hpp"
#include "libfsi/mesh/check.hpp"
#include "libfsi/mesh/gmsh.hpp"
#include "libfsi/mesh/metrics.hpp"
#include "libfsi/mesh/quality.hpp"
#include "libfsi/mesh/read.hpp"

namespace fsi::test {

/// A unit cube (square for triangles and quads) of n[0] x n[1] x n[2] blocks, each one hex or quad,
/// or 2 triangles, 2 prisms, 6 tets, 6 pyramids; sides are named left, right, bottom, top, back,
/// front; opposite sides match.
struct Block {
  CellType type = CellType::hex;
  std::array<int, 3> n{3, 3, 3};
  int links = 0;  ///< the first `links` axes are joined by $Periodic
  std::function<Vec3(const Vec3&)> moved = [](const Vec3& x) { return x; };

  int dim() const { return shape_of(type).dim; }
  int layers() const { return dim() == 2 ? 1 : n[2]; }
  int point(int i, int j, int k) const { return 1 + i + (n[0] + 1) * (j + (n[1] + 1) * k); }
  int n_points() const { return (n[0] + 1) * (n[1] + 1) * (dim() == 2 ? 1 : n[2] + 1); }
};

/// Moves every point by a smooth function of period 1: cells become skewed, their sides warped,
/// opposite sides of the block stay the same.
inline Vec3 warp(const Vec3& x) {
  const Real w = 2 * std::numbers::pi;
  return {x.x + 0.04 * std::sin(w * x.y) * std::cos(w * x.z) + 0.02 * std::sin(w * x.x),
          x.y + 0.03 * std::cos(w * x.x) * std::cos(w * x.z),
          x.z + 0.05 * std::sin(w * x.x) * std::sin(w * x.y)};
}
/// The same within the plane z = 0.
inline Vec3 warp_plane(const Vec3& x) {
  const Real w = 2 * std::numbers::pi;
  return {x.x + 0.04 * std::sin(w * x.y) + 0.02 * std::sin(w * x.x), x.y + 0.03 * std::cos(w * x.x),
          0};
}

class BlockText {
 public:
  explicit BlockText(const Block& block) : b_(block) {}

  std::string text() {
    sides();
    cells();
    std::ostringstream out;
    out.precision(17);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << 2 * b_.dim() << "\n";
    const char* names[] = {"left", "right", "bottom", "top", "back", "front"};
    for (int i = 0; i < 2 * b_.dim(); ++i) {
      out << b_.dim() - 1 << " " << i + 1 << " \"" << names[i] << "\"\n";
    }
    out << "$EndPhysicalNames\n$Nodes\n"
        << b_.n_points() + static_cast<int>(centres_.size()) << "\n";
    int number = 0;
    const int top = b_.dim() == 2 ? 0 : b_.n[2];
    for (int k = 0; k <= top; ++k) {
      for (int j = 0; j <= b_.n[1]; ++j) {
        for (int i = 0; i <= b_.n[0]; ++i) write(out, ++number, at(i, j, k));
      }
    }
    for (const Vec3& x : centres_) write(out, ++number, x);
    out << "$EndNodes\n$Elements\n" << elements_ << "\n" << lines_.str() << "$EndElements\n";
    if (b_.links > 0) periodic(out);
    return out.str();
  }

 private:
  Vec3 at(Real i, Real j, Real k) const {
    return b_.moved({i / b_.n[0], j / b_.n[1], b_.dim() == 2 ? 0 : k / b_.n[2]});
  }
  static void write(std::ostream& out, int number, const Vec3& x) {
    out << number << " " << x.x << " " << x.y << " " << x.z << "\n";
  }
  void element(int type, int physical, const std::vector<int>& nodes) {
    lines_ << ++elements_ << " " << type << " 2 " << physical << " " << physical;
    for (const int node : nodes) lines_ << " " << node;
    lines_ << "\n";
  }
  /// A side of a block with the corners (0,0) (1,0) (1,1) (0,1); triangles meet along (0,0) (1,1).
  void quad(int physical, const std::array<int, 4>& q, bool split) {
    if (!split) return element(3, physical, {q[0], q[1], q[2], q[3]});
    element(2, physical, {q[0], q[1], q[2]});
    element(2, physical, {q[0], q[2], q[3]});
  }
  void sides() {
    const auto n = b_.n;
    for (int axis = 0; axis < b_.dim(); ++axis) {
      const int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
      for (const int high : {0, 1}) {
        const int physical = 1 + 2 * axis + high;
        for (int i = 0; i < n[a]; ++i) {
          for (int j = 0; j < (b_.dim() == 2 ? 1 : n[b]); ++j) {
            std::array<int, 3> k{};
            k[axis] = high * n[axis];
            const auto corner = [&](int di, int dj) {
              k[a] = i + di, k[b] = b_.dim() == 2 ? 0 : j + dj;
              return b_.point(k[0], k[1], k[2]);
            };
            if (b_.dim() == 2) {
              element(1, physical, {corner(0, 0), corner(1, 0)});
              continue;
            }
            const bool split =
                b_.type == CellType::tet || (b_.type == CellType::prism && axis == 2);
            quad(physical, {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}, split);
          }
        }
      }
    }
  }
  void cells() {
    for (int k = 0; k < b_.layers(); ++k) {
      for (int j = 0; j < b_.n[1]; ++j) {
        for (int i = 0; i < b_.n[0]; ++i) cell(i, j, k);
      }
    }
  }
  void cell(int i, int j, int k) {
    const auto p = [&](int di, int dj, int dk) { return b_.point(i + di, j + dj, k + dk); };
    const std::vector<int> q{p(0, 0, 0), p(1, 0, 0), p(1, 1, 0), p(0, 1, 0)};
    if (b_.type == CellType::quad) return element(3, 9, q);
    if (b_.type == CellType::triangle) return quad(9, {q[0], q[1], q[2], q[3]}, true);
    const std::vector<int> v{q[0],       q[1],       q[2],       q[3],
                             p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1)};
    if (b_.type == CellType::hex) return element(5, 9, v);
    if (b_.type == CellType::prism) {
      element(6, 9, {v[0], v[1], v[2], v[4], v[5], v[6]});
      return element(6, 9, {v[0], v[2], v[3], v[4], v[6], v[7]});
    }
    if (b_.type == CellType::tet) {  // six about the diagonal 0-6
      const int turn[] = {1, 2, 3, 7, 4, 5, 1};
      for (int t = 0; t < 6; ++t) element(4, 9, {v[0], v[turn[t]], v[turn[t + 1]], v[6]});
      return;
    }
    centres_.push_back(at(i + 0.5, j + 0.5, k + 0.5));
    const int apex = b_.n_points() + static_cast<int>(centres_.size());
    for (int f = 0; f < 6; ++f) {
      const auto face = shape_of(CellType::hex).face_corners(f);
      element(7, 9, {v[face[3]], v[face[2]], v[face[1]], v[face[0]], apex});
    }
  }
  void periodic(std::ostream& out) {
    out << "$Periodic\n" << b_.links << "\n";
    for (int axis = 0; axis < b_.links; ++axis) {
      const int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
      const int last = b_.dim() == 2 ? 0 : b_.n[b];
      out << b_.dim() - 1 << " " << 2 * axis + 2 << " " << 2 * axis + 1 << "\n"
          << (b_.n[a] + 1) * (last + 1) << "\n";
      std::array<int, 3> k{};
      for (k[a] = 0; k[a] <= b_.n[a]; ++k[a]) {
        for (k[b] = 0; k[b] <= last; ++k[b]) {
          auto high = k;
          high[axis] = b_.n[axis];
          out << b_.point(high[0], high[1], high[2]) << " " << b_.point(k[0], k[1], k[2]) << "\n";
        }
      }
    }
    out << "$EndPeriodic\n";
  }

  const Block& b_;
  std::vector<Vec3> centres_;
  std::ostringstream lines_;
  int elements_ = 0;
};

inline constexpr CellType all_types[] = {CellType::triangle, CellType::quad,  CellType::tet,
                                         CellType::hex,      CellType::prism, CellType::pyramid};

/// A bent block of 4 x 3 x 5 boxes cut into cells of one type.
inline Block block_of(CellType type, int links = 0) {
  Block block;
  block.type = type, block.links = links;
  block.n = {4, 3, 5};
  block.moved = block.dim() == 2 ? warp_plane : warp;
  return block;
}

/// Collective. A file with this text, seen by all ranks; gone with the object.
class TextFile {
 public:
  explicit TextFile(const std::string& text) {
    const auto name = "fsi_mesh_" + std::to_string(getpid()) + ".msh";
    path_ = broadcast((std::filesystem::temp_directory_path() / name).string());
    if (rank() == 0) std::ofstream(path_, std::ios::binary) << text;
    MPI_Barrier(comm());
  }
  ~TextFile() {
    MPI_Barrier(comm());
    if (rank() == 0) std::filesystem::remove(path_);
  }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Collective. The mesh of a file, divided.
inline Mesh divided(const std::string& file, const std::vector<std::string>& periodic,
                    const std::string& partitioner = "metis") {
  return read_mesh({file, periodic, partitioner});
}

/// Collective. The whole mesh of a file on every rank, as one rank has it.
inline Mesh whole(const std::string& file, const std::vector<std::string>& periodic) {
  return build_mesh(check_mesh(read_gmsh(file), periodic));
}

}  // namespace fsi::test
