#pragma once
// What the words of a Watch share.

#include <cstdio>
#include <string>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/body.hpp"

namespace fsi {

/// A line on standard error, of rank 0. kind: "warning" or "notice".
inline void say(const char* kind, const std::string& text) {
  if (rank() == 0) std::fprintf(stderr, "fsi: %s: %s\n", kind, text.c_str());
}

/// Whether more of the solid than specks ahead of it is out of the mesh.
inline bool leaves(const Body& body) {
  constexpr Real specks = 1e-4;
  return body.volume_out > specks * body.filled.volume;
}

/// "solid", with the name of one of several.
inline std::string name_of(const Body& body) {
  return body.name.empty() ? "solid" : "solid " + body.name;
}

/// The file of the solid's table.
inline std::string table_of(const Body& body) {
  return body.name.empty() ? "solid.csv" : "solid_" + body.name + ".csv";
}

}  // namespace fsi
