#include "libfsi/run/patches.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/option_names.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/flow/centre_line.hpp"
#include "libfsi/flow/planes_at.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/run/patch_names.hpp"
#include "libfsi/run/table_file.hpp"
#include "libfsi/run/velocity_table.hpp"

namespace fsi {
namespace {

constexpr Real to_be_given = std::numeric_limits<Real>::quiet_NaN();

/// The options of one patch.
class PatchOptions {
 public:
  PatchOptions(Options& options, const std::string& patch)
      : options_(options), name_("patches_" + patch + "_") {}

  Condition read(const std::string& type) {
    type_ = type;
    if (type == "wall") return wall();
    if (type == "symmetry") return Slip{};
    if (type == "flow_rate") return flow_rate();
    if (type == "velocity") return velocity();
    return opening(type);
  }
  /// All of them, each once.
  void list() {
    for (const std::string& type : patch_types) read(type);
  }
  /// The table of a velocity that was read; null: none.
  VelocityTable* table() const { return table_.get(); }

 private:
  /// The option of that key.
  std::string of(const std::string& key) {
    FSI_ASSERT(patch_takes(type_, key));
    return name_ + key;
  }
  Real real(const std::string& key, Real fallback, const std::string& help,
            const std::string& unit) {
    return options_.real(of(key), fallback, {.help = help, .unit = unit, .min = 0});
  }
  /// A number, or a csv file of numbers over time. symbol: another name of its column.
  OfTime of_time(const std::string& key, const std::string& symbol, const std::string& fallback,
                 const std::string& help) {
    const std::string text = options_.text_or_file(
        of(key), fallback, help + "; a number or a csv file of time and value");
    const Real period =
        real("period", 0, "time after which the values of a csv file come again; 0: never", "time");
    char* end = nullptr;
    const Real value = std::strtod(text.c_str(), &end);
    if (end != text.c_str() && *end == '\0' && std::isfinite(value)) {
      require(period == 0, "option -" + of("period") + ": -" + of(key) + " is a number, " + text +
                               "; a period is that of the values of a csv file");
      return value;
    }
    if (options_.help()) return 0;
    require(!text.empty(), "option -" + of(key) + " is missing: " + help);
    require(text.ends_with(".csv"), "option -" + of(key) + ": \"" + text +
                                        "\" is neither a number nor the name of a csv file");
    OfTime values = series(text, period, {key, symbol, "value"}, of(key));
    tell_of_table(values, text, period, {key, symbol, "value"}, of(key));
    return values;
  }
  /// A notice if a table varies, but not during the run, or not to its end, or looks mistaken.
  void tell_of_table(const OfTime& values, const std::string& file, Real period,
                     const ColumnNames& names, const std::string& option) {
    Options aside(options_);
    const Real end = aside.real("time_end", 1, {.help = ""});
    const auto [least, most] = values.range(0, end);
    const auto rows = read_rows(file, {{"t", "time"}, names}, option);
    const auto other = [&](const std::vector<Real>& row) { return row[1] != rows[0][1]; };
    if (end <= 0 || std::ranges::none_of(rows, other)) return;
    std::string text = doubt_about(rows, period, end);
    if (period == 0 && least == most)
      text = print(
          "its values are %g during the whole run to t = %g; its times go from %g to %g: "
          "are both in the same units?",
          most, end, rows.front()[0], rows.back()[0]);
    else if (period == 0 && rows.back()[0] < end)
      text = print(
          "its last time is %g, and the run goes to t = %g; its last value %g holds from "
          "then on; if its values come again, give -%speriod",
          rows.back()[0], end, rows.back()[1], name_.c_str());
    if (rank() == 0 && !text.empty())
      std::fprintf(stderr, "fsi: notice: file \"%s\": %s\n", file.c_str(), text.c_str());
  }

  Condition wall() {
    return Wall{options_.vec3(
        of("wall_velocity"), {},
        {.help = "wall: it slides in its own plane or along its axis", .unit = "velocity"})};
  }
  Condition flow_rate() {
    const OfTime rate =
        of_time("flow_rate", "q", "", "flow_rate, to be given: into the domain, volume per time");
    const std::string profile = options_.choice(
        of("profile"), "parabola", {"parabola", "plug"},
        "flow_rate: as developed flow in a vessel of that section, or the same everywhere");
    return FlowRate{.rate = rate,
                    .profile = profile == "plug" ? InflowProfile::plug : InflowProfile::parabola};
  }
  Condition velocity() {
    const Vec3 u = options_.vec3(of("velocity"), {},
                                 {.help = "velocity: the same everywhere", .unit = "velocity"});
    const std::string file =
        options_.text_or_file(of("velocity_file"), "",
                              "velocity: csv file of x,y,z,ux,uy,uz; a spline between its places");
    require(options_.help() || options_.given(name_ + "velocity") || !file.empty(),
            "option -" + of("velocity") + " is missing: a patch of type velocity needs it or -" +
                of("velocity_file"));
    require(options_.help() || file.empty() || u == Vec3{},
            "options -" + of("velocity") + " and -" + of("velocity_file") +
                " exclude each other; give one of them");
    const OfTime factor =
        of_time("velocity_factor", "factor", "1", "velocity: what it is multiplied by");
    if (file.empty() || options_.help())
      return FixedVelocity{[=](const Vec3&, Real t) { return factor(t) * u; }, factor};
    std::vector<VelocityTable::Row> rows;
    for (const std::vector<Real>& row :
         read_rows(file, {{"x"}, {"y"}, {"z"}, {"ux"}, {"uy"}, {"uz"}}, of("velocity_file")))
      rows.push_back({.x = {row[0], row[1], row[2]}, .u = {row[3], row[4], row[5]}});
    table_ = std::make_shared<VelocityTable>(file, std::move(rows));
    return FixedVelocity{
        [table = table_, factor](const Vec3& x, Real t) { return factor(t) * (*table)(x); },
        factor};
  }
  Condition opening(const std::string& type) {
    Opening opening{
        of_time("pressure", "p", "0", "pressure, resistance, windkessel: given, or beyond it")};
    if (type == "pressure") return opening;
    const std::string unit = "pressure time / volume";
    require(type != "resistance" || options_.help() || options_.given(name_ + "resistance"),
            "option -" + of("resistance") + " is missing: a patch of type resistance needs it");
    opening.load.proximal =
        real("resistance", 0, "resistance, windkessel: pressure per flow rate out", unit);
    if (type == "resistance") return opening;
    opening.load.distal = real("distal_resistance", to_be_given,
                               "windkessel, to be given: resistance beside the capacitance", unit);
    opening.load.capacitance =
        real("capacitance", to_be_given, "windkessel, to be given: volume per pressure",
             "volume / pressure");
    require(options_.help() || opening.load.capacitance > 0,
            "option -" + of("capacitance") + " must be above 0; without one give the patch type " +
                "resistance and the sum of both");
    opening.load.stored =
        options_.real(of("stored_pressure"), 0,
                      {.help = "windkessel: of the capacitance at the start", .unit = "pressure"});
    return opening;
  }

  Options& options_;
  std::string name_;
  std::string type_;
  std::shared_ptr<VelocityTable> table_;
};

std::string read_type(Options& options, const std::string& patch) {
  const std::string name = "patches_" + patch + "_type";
  const bool clear = patch == "wall" || patch == "symmetry";
  require(clear || options.given(name), "patch \"" + patch + "\" of the mesh has no type: give -" +
                                            name + "; choose from: " + joined(patch_types));
  return options.choice(name, clear ? patch : "wall", patch_types, "what stands at this patch");
}

}  // namespace

Conditions read_patches(Options& options, const Mesh& mesh) {
  const auto tell = [](const std::string& notice) {
    if (rank() == 0 && !notice.empty()) std::fprintf(stderr, "fsi: notice: %s\n", notice.c_str());
  };
  check_patch_names(options, mesh);
  Options aside(options);
  std::map<std::string, std::string> types;
  for (const Patch& patch : mesh.patches) types[patch.name] = read_type(aside, patch.name);
  check_patch_keys(options, mesh, types);
  Conditions conditions;
  for (const Patch& patch : mesh.patches) {
    PatchOptions of_patch(options, patch.name);
    conditions[patch.name] = of_patch.read(read_type(options, patch.name));
    if (of_patch.table() != nullptr) tell(of_patch.table()->fit_to(mesh, patch));
  }
  return conditions;
}

namespace {

struct Path {
  std::vector<std::string> patches;
  Real arc_length = 0;
};

Path read_path(Options& options, const std::string& of) {
  const auto patches = options.list(
      of + "path", "two patches whose centre line the solid stands on, in place of its center");
  if (patches.empty() && !options.help() && !options.given(of + "arc_length")) return {};
  const Real s = options.real(
      of + "arc_length", 1, {.help = "way along the path, from its first patch", .unit = "length"});
  return {patches, s};
}

/// Collective. Puts the solids on their paths.
void place_solids(std::vector<SolidSetup>& solids, Options& options, const Mesh& mesh) {
  Options aside(options);
  // The centre line of half a vessel lies in the plane of symmetry, and so do solids on it.
  std::vector<Patch> mirrors;
  for (const Patch& patch : mesh.patches)
    if (aside.text("patches_" + patch.name + "_type", patch.name, "") == "symmetry")
      mirrors.push_back(patch);
  for (const std::string& of : solids_without_shape(options)) read_path(aside, of);
  for (SolidSetup& solid : solids) {
    const std::string& of = solid.options;
    const auto [path, s] = read_path(options, of);
    require(!path.empty() || !options.given(of + "arc_length"),
            "option -" + of + "arc_length goes with -" + of + "path");
    if (path.empty()) continue;
    require(path.size() == 2 && path[0] != path[1],
            "option -" + of + "path needs two different patches: from,to");
    require(!options.given(of + "axis"),
            "options -" + of + "path and -" + of + "axis exclude each other");
    for (const std::string& patch : path) {
      const std::string type = aside.text("patches_" + patch + "_type", patch, "");
      require(type != "wall" && type != "symmetry",
              "option -" + of + "path: patch \"" + patch + "\" is a " + type +
                  "; the centre line goes from one opening to another");
    }
    const flow::CentreLine line(mesh, path[0], path[1]);
    require(s > 0 && s < line.length(),
            "option -" + of +
                print("arc_length: %g is not between 0 and %.4g, the length of the ", s,
                      line.length()) +
                "centre line from " + path[0] + " to " + path[1]);
    auto [at, along] = line.at(s);
    for (const geometry::Mirror& plane : flow::planes_at(mesh.patch(path[0]), mirrors, mesh)) {
      at = plane.foot(at), along -= dot(along, plane.n) * plane.n;
      along = along / norm(along);
    }
    const shapes::Shape aligned = shapes::align(solid.about_origin, along);
    const Real turn = solid.angle * std::numbers::pi / 180;
    solid.centre = at;
    solid.solid.shape = shapes::translate(shapes::rotate(aligned, {0, 0, 1}, turn), at);
    if (rank() != 0) continue;
    const std::string name = solid.solid.name.empty() ? "solid" : "solid " + solid.solid.name;
    std::printf(
        "%s on the centre line from %s to %s, %.4g of %.4g along it: at (%.5g, %.5g, %.5g)\n",
        name.c_str(), path[0].c_str(), path[1].c_str(), s, line.length(), at.x, at.y, at.z);
  }
}

}  // namespace

Mesh read_mesh_and_place(Case& setup, Options& options) {
  const bool late = std::ranges::any_of(setup.solids, &SolidSetup::on_path);
  std::optional<Mesh> mesh(read_mesh(setup.mesh));
  place_solids(setup.solids, options, *mesh);
  if (!late || ranks() == 1 || setup.mesh.loads) return std::move(*mesh);
  mesh.reset();  // two would take twice the memory
  for (SolidSetup& solid : setup.solids) solid.on_path = false;
  share_solids(setup.mesh, setup.solids);
  return read_mesh(setup.mesh);
}

void list_vessel_options(Options& options) {
  options.choice("patches_NAME_type", "wall", patch_types, "what stands at patch NAME of the mesh");
  PatchOptions(options, "NAME").list();
  read_path(options, "solid_");
}

}  // namespace fsi
