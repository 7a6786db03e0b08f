#pragma once
// A box of quads, triangles, hexes or tets as a gmsh file, read back on every rank: a distributed
// Mesh for tests, without the gmsh program.

#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/read.hpp"

namespace fsi::test {

/// Cells per axis (n[2] = 0: 2-D), lengths, simplices or not, periodic patches in pairs, and where
/// the points of the grid are moved to. Patches left, right, bottom, top, back, front; in a box
/// divided into simplices opposite sides match.
struct BoxFile {
  std::array<Index, 3> n{4, 4, 0};
  Vec3 length{1, 1, 1};
  bool simplex = false;
  std::vector<std::string> periodic{};
  std::function<Vec3(const Vec3&)> moved = [](const Vec3& x) { return x; };
  /// Axes of y and z along which the simplices of the upper half are images of those of the lower.
  std::string mirrored{};
  bool shuffled = false;  ///< nodes, elements, and the nodes of triangles and tets in another order
};

namespace box_file {

struct Element {
  int type, physical;
  std::vector<Index> nodes;
};

/// Whether block i of n along an axis is the image of another.
inline bool is_image(const BoxFile& box, int axis, Index i) {
  return box.mirrored.find("xyz"[axis]) != std::string::npos && 2 * i >= box.n[axis];
}

/// Sides (and tets or triangles) of one block with corners numbered as a gmsh hex (quad).
inline void add_cell(const std::vector<Index>& v, bool simplex, int physical,
                     std::vector<Element>& out) {
  if (!simplex) {
    out.push_back({v.size() == 4 ? 3 : 5, physical, v});
  } else if (v.size() == 4) {
    for (const auto& t : {std::array{0, 1, 2}, {0, 2, 3}}) {
      out.push_back({2, physical, {v[t[0]], v[t[1]], v[t[2]]}});
    }
  } else {
    // The six tets of a cube about its diagonal 0-6.
    for (const auto& t : {std::array{0, 1, 2, 6},
                          {0, 2, 3, 6},
                          {0, 3, 7, 6},
                          {0, 7, 4, 6},
                          {0, 4, 5, 6},
                          {0, 5, 1, 6}}) {
      out.push_back({4, physical, {v[t[0]], v[t[1]], v[t[2]], v[t[3]]}});
    }
  }
}

inline std::vector<Element> plane_elements(const BoxFile& box) {
  const auto [nx, ny, nz] = box.n;
  const auto at = [nx = nx](Index i, Index j) { return i + (nx + 1) * j; };
  std::vector<Element> all;
  for (Index j = 0; j < ny; ++j) {
    all.push_back({1, 1, {at(0, j), at(0, j + 1)}});
    all.push_back({1, 2, {at(nx, j), at(nx, j + 1)}});
  }
  for (Index i = 0; i < nx; ++i) {
    all.push_back({1, 3, {at(i, 0), at(i + 1, 0)}});
    all.push_back({1, 4, {at(i, ny), at(i + 1, ny)}});
  }
  for (Index j = 0; j < ny; ++j) {
    for (Index i = 0; i < nx; ++i) {
      std::vector<Index> v{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      if (is_image(box, 1, j)) std::ranges::rotate(v, v.end() - 1);
      add_cell(v, box.simplex, 7, all);
    }
  }
  return all;
}

inline std::vector<Element> space_elements(const BoxFile& box) {
  const auto& n = box.n;
  const auto at = [&](const std::array<Index, 3>& i) {
    return i[0] + (n[0] + 1) * (i[1] + (n[1] + 1) * i[2]);
  };
  std::vector<Element> all;
  for (int axis = 0; axis < 3; ++axis) {
    const int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;  // the other axes, ascending
    for (const int high : {0, 1}) {
      for (Index i = 0; i < n[a]; ++i) {
        for (Index j = 0; j < n[b]; ++j) {
          std::array<Index, 3> k{};
          k[axis] = high * n[axis];
          const bool image_a = is_image(box, a, i), image_b = is_image(box, b, j);
          const auto corner = [&](Index di, Index dj) {
            k[a] = image_a ? i + 1 - di : i + di, k[b] = image_b ? j + 1 - dj : j + dj;
            return at(k);
          };
          // Triangles meet along the diagonal from the low to the high corner, as the tets do.
          add_cell({corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}, box.simplex,
                   1 + 2 * axis + high, all);
        }
      }
    }
  }
  for (Index k = 0; k < n[2]; ++k) {
    for (Index j = 0; j < n[1]; ++j) {
      for (Index i = 0; i < n[0]; ++i) {
        // An image in one plane has x and y exchanged, which keeps its volume positive.
        const bool image_y = is_image(box, 1, j), image_z = is_image(box, 2, k);
        std::vector<Index> v;
        for (const auto& [x, y, z] : {std::array<Index, 3>{0, 0, 0},
                                      {1, 0, 0},
                                      {1, 1, 0},
                                      {0, 1, 0},
                                      {0, 0, 1},
                                      {1, 0, 1},
                                      {1, 1, 1},
                                      {0, 1, 1}}) {
          const auto [dx, dy] = image_y != image_z ? std::pair{y, x} : std::pair{x, y};
          v.push_back(at({i + dx, image_y ? j + 1 - dy : j + dy, image_z ? k + 1 - z : k + z}));
        }
        add_cell(v, box.simplex, 7, all);
      }
    }
  }
  return all;
}

inline void shuffle(std::vector<Element>& all, std::mt19937& random) {
  std::ranges::shuffle(all, random);
  for (Element& e : all) {
    if (e.nodes.size() == 3) std::ranges::rotate(e.nodes, e.nodes.begin() + random() % 3);
    // An even permutation keeps the volume positive.
    if (e.type == 4)
      for (auto i = random() % 12; i > 0; --i)
        std::rotate(e.nodes.begin() + i % 2, e.nodes.begin() + i % 2 + 1,
                    e.nodes.begin() + i % 2 + 3);
  }
}

inline void write(const BoxFile& box, const std::string& path) {
  const bool plane = box.n[2] == 0;
  std::ofstream file(path);
  file.precision(17);
  file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << (plane ? 5 : 7) << "\n";
  const char* names[] = {"left", "right", "bottom", "top", "back", "front", "fluid"};
  for (int i = 0; i < 7; ++i) {
    if (plane && (i == 4 || i == 5)) continue;
    file << (plane ? 2 : 3) - (i < 6 ? 1 : 0) << " " << i + 1 << " \"" << names[i] << "\"\n";
  }
  file << "$EndPhysicalNames\n$Nodes\n" << (box.n[0] + 1) * (box.n[1] + 1) * (box.n[2] + 1) << "\n";
  const Index n_nodes = (box.n[0] + 1) * (box.n[1] + 1) * (box.n[2] + 1);
  std::vector<Index> names_of(static_cast<std::size_t>(n_nodes));
  std::iota(names_of.begin(), names_of.end(), 1);
  std::mt19937 random(7);
  if (box.shuffled) std::ranges::shuffle(names_of, random);
  Index number = 0;
  for (Index k = 0; k <= box.n[2]; ++k) {
    for (Index j = 0; j <= box.n[1]; ++j) {
      for (Index i = 0; i <= box.n[0]; ++i) {
        const Vec3 x = box.moved({box.length.x * i / box.n[0], box.length.y * j / box.n[1],
                                  plane ? 0 : box.length.z * k / box.n[2]});
        file << names_of[number++] << " " << x.x << " " << x.y << " " << x.z << "\n";
      }
    }
  }
  std::vector<Element> all = plane ? plane_elements(box) : space_elements(box);
  if (box.shuffled) shuffle(all, random);
  file << "$EndNodes\n$Elements\n" << all.size() << "\n";
  number = 0;
  for (const Element& e : all) {
    file << ++number << " " << e.type << " 2 " << e.physical << " " << e.physical;
    for (const Index node : e.nodes) file << " " << names_of[node];
    file << "\n";
  }
  file << "$EndElements\n";
}

}  // namespace box_file

/// Collective. The box, divided over all ranks.
inline Mesh read_box(const BoxFile& box) {
  const auto folder = std::filesystem::temp_directory_path();
  const std::string path =
      broadcast((folder / ("fsi_box_" + std::to_string(getpid()) + ".msh")).string());
  if (rank() == 0) box_file::write(box, path);
  Mesh mesh = read_mesh({path, box.periodic, "metis"});
  if (rank() == 0) std::filesystem::remove(path);
  return mesh;
}

}  // namespace fsi::test
