#include "libfsi/solid/law/laws.hpp"

namespace fsi::solid {

Law read_law(Options& options, const std::string& option) {
  Laws laws;
  return std::apply(
      [&](auto&... one) {
        const std::vector<std::string> names{one.name...};
        const std::string name =
            options.choice(option, names.front(), names, "elastic law, of shear modulus G at rest");
        Law law;
        const auto take = [&](auto& shipped) {
          if (options.help() || name == shipped.name) shipped.read(options, option);
          if (name == shipped.name) law = Law(shipped);
        };
        (take(one), ...);
        return law;
      },
      laws);
}

}  // namespace fsi::solid
