#include "libfsi/mesh/mesh.hpp"

#include "libfsi/core/error.hpp"

namespace fsi {

const Patch& Mesh::patch(const std::string& name) const {
  std::string names;
  for (const Patch& p : patches) {
    if (p.name == name) return p;
    names += (names.empty() ? "" : ", ") + p.name;
  }
  throw Error(ErrorKind::input,
              "patch \"" + name + "\" unknown; mesh has: " +
                  (names.empty() ? "no patch (every boundary is periodic)" : names));
}

}  // namespace fsi
