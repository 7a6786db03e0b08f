#pragma once
// The version of libfsi.

#include <string>

namespace fsi {

/// Of the release, as 0.1.0.
std::string version();
/// Of git when the library was built, with "-modified" where the sources were not those of the
/// commit; "unknown" outside a repository.
std::string commit();

}  // namespace fsi
