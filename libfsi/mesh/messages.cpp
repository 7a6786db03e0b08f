#include "libfsi/mesh/messages.hpp"

#include <sstream>

#include "libfsi/core/error.hpp"

namespace fsi {
void refuse(const std::string& sentence) { throw Error(ErrorKind::input, sentence); }

std::string text_of(const Vec3& x) {
  std::ostringstream out;
  out << '(' << x.x << ", " << x.y << ", " << x.z << ')';
  return out.str();
}

std::string text_of(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace fsi
