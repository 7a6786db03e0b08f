#pragma once
// The laws that come with the library.

#include <tuple>

#include "libfsi/solid/law/gent.hpp"
#include "libfsi/solid/law/law.hpp"
#include "libfsi/solid/law/mooney_rivlin.hpp"
#include "libfsi/solid/law/neo_hookean.hpp"

namespace fsi::solid {

/// A law is one header and one name here; the first is the default of -solid_law.
using Laws = std::tuple<NeoHookean, MooneyRivlin, Gent>;

/// Reads -solid_law and the options of the law that it names. Errors: Error{input}.
Law read_law(Options& options, const std::string& option = "solid_law");

}  // namespace fsi::solid
