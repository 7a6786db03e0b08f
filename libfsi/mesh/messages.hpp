#pragma once
// Parts of the error messages on meshes.

#include <string>
#include <vector>

#include "libfsi/core/types.hpp"

namespace fsi {

/// Throws Error{input}. Loops test first and make the sentence only where the test fails.
[[noreturn]] void refuse(const std::string& sentence);

/// "(x, y, z)" with six digits.
std::string text_of(const Vec3& x);

/// "a, b, c".
std::string text_of(const std::vector<std::string>& names);

}  // namespace fsi
