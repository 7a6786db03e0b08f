#pragma once
// The one header a driver includes.

#include "libfsi/core/error.hpp"     // IWYU pragma: export
#include "libfsi/core/options.hpp"   // IWYU pragma: export
#include "libfsi/core/parallel.hpp"  // IWYU pragma: export
#include "libfsi/core/run.hpp"       // IWYU pragma: export
#include "libfsi/core/types.hpp"     // IWYU pragma: export
#include "libfsi/field/field.hpp"    // IWYU pragma: export
#include "libfsi/mesh/mesh.hpp"      // IWYU pragma: export
#include "libfsi/mesh/read.hpp"      // IWYU pragma: export
