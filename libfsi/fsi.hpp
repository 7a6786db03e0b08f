#pragma once
// The one header a driver includes.

#include "libfsi/core/clock.hpp"
#include "libfsi/core/error.hpp"
#include "libfsi/core/options.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/core/run.hpp"
#include "libfsi/core/signals.hpp"
#include "libfsi/field/boundary.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/io/manifest.hpp"
#include "libfsi/io/table.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/mesh/read.hpp"
#include "libfsi/solver/carried.hpp"
#include "libfsi/solver/case.hpp"
#include "libfsi/solver/output.hpp"
#include "libfsi/solver/solver.hpp"
