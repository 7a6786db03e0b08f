#pragma once
// Options of patches, patches_NAME_KEY: which patch and which key they mean.

#include <map>
#include <string>
#include <vector>

#include "libfsi/core/options.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// What may stand at a patch.
extern const std::vector<std::string> patch_types;

/// Errors: Error{input} where an option patches_... is of no patch of the mesh, or a patch has a
/// name that no option can have.
void check_patch_names(const Options& options, const Mesh& mesh);

/// Whether a patch of that type takes that key.
bool patch_takes(const std::string& type, const std::string& key);

/// types: that of each patch. Errors: Error{input} if a patch has an option that its type does not
/// take. Also if an option can be that of two patches, a_b_KEY of `a` or of `a_b`, where a patch
/// but the one with the longest name takes it. The default 0 is allowed: the file that repeats a
/// run gives it.
void check_patch_keys(const Options& options, const Mesh& mesh,
                      const std::map<std::string, std::string>& types);

}  // namespace fsi
