#include "libfsi/solid/law/laws.hpp"

#include "libfsi/core/error.hpp"

namespace fsi::solid {
namespace {

/// Errors: Error{input} where an option of `law` is given that the law named does not take.
template <class Shipped>
void refuse_options_of(Shipped law, const Options& options, const std::string& option,
                       const std::string& named) {
  const auto taken = options.values();
  Options aside(options);
  law.read(aside, option);
  for (const auto& [name, value] : aside.values())
    require(taken.contains(name) || !options.given(name),
            "option -" + name + " is for " + law.name + ", but -" + option + " is " + named);
}

}  // namespace

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
        if (!options.help()) (refuse_options_of(one, options, option, name), ...);
        return law;
      },
      laws);
}

}  // namespace fsi::solid
