#include "libfsi/run/patches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/flow/centre_line.hpp"

namespace fsi {
namespace {

const std::vector<std::string> types{"wall",       "symmetry",  "pressure", "resistance",
                                     "windkessel", "flow_rate", "velocity"};

/// The options of one patch.
class PatchOptions {
 public:
  PatchOptions(Options& options, const std::string& patch)
      : options_(options), name_("patches_" + patch + "_") {}

  Condition read(const std::string& type) {
    if (type == "wall") return wall();
    if (type == "symmetry") return Slip{};
    if (type == "flow_rate") return flow_rate();
    if (type == "velocity") return velocity();
    return opening(type);
  }
  /// All of them, each once.
  void list() {
    for (const std::string& type : types) read(type);
  }

 private:
  Real real(const std::string& key, Real fallback, const std::string& help,
            const std::string& unit) {
    return options_.real(name_ + key, fallback, {.help = help, .unit = unit, .min = 0});
  }
  /// A number, or a csv file of numbers over time.
  OfTime of_time(const std::string& key, const std::string& fallback, const std::string& help) {
    const std::string text = options_.text_or_file(
        name_ + key, fallback, help + "; a number or a csv file of time and value");
    const Real period =
        real("period", 0, "time after which the values of a csv file come again; 0: never", "time");
    char* end = nullptr;
    const Real value = std::strtod(text.c_str(), &end);
    if (end != text.c_str() && *end == '\0' && std::isfinite(value)) return value;
    if (options_.help()) return 0;
    require(text.ends_with(".csv"), "option -" + name_ + key + ": \"" + text +
                                        "\" is neither a number nor the name of a csv file");
    return series(text, period);
  }

  Condition wall() {
    return Wall{options_.vec3(
        name_ + "wall_velocity", {},
        {.help = "wall: it slides in its own plane or along its axis", .unit = "velocity"})};
  }
  Condition flow_rate() {
    const OfTime rate = of_time("flow_rate", "0", "flow_rate: into the domain, volume per time");
    const std::string profile = options_.choice(
        name_ + "profile", "parabola", {"parabola", "plug"},
        "flow_rate: as developed flow in a vessel of that section, or the same everywhere");
    return FlowRate{.rate = rate,
                    .profile = profile == "plug" ? InflowProfile::plug : InflowProfile::parabola};
  }
  Condition velocity() {
    const Vec3 u = options_.vec3(name_ + "velocity", {},
                                 {.help = "velocity: the same everywhere", .unit = "velocity"});
    const std::string file = options_.text_or_file(
        name_ + "velocity_file", "", "velocity: csv file of x,y,z,ux,uy,uz, taken at the nearest");
    const OfTime factor = of_time("velocity_factor", "1", "velocity: what it is multiplied by");
    if (file.empty() || options_.help())
      return FixedVelocity{[=](const Vec3&, Real t) { return factor(t) * u; }};
    return FixedVelocity{[rows = read_rows(file, 6), factor](const Vec3& x, Real t) {
      const auto at = [](const std::vector<Real>& row) { return Vec3{row[0], row[1], row[2]}; };
      const auto nearest = std::ranges::min_element(
          rows, {}, [&](const std::vector<Real>& row) { return norm2(x - at(row)); });
      return factor(t) * Vec3{(*nearest)[3], (*nearest)[4], (*nearest)[5]};
    }};
  }
  Condition opening(const std::string& type) {
    Opening opening{
        of_time("pressure", "0", "pressure, resistance, windkessel: given, or beyond it")};
    if (type == "pressure") return opening;
    const std::string unit = "pressure time / volume";
    opening.load.proximal =
        real("resistance", 0, "resistance, windkessel: pressure per flow rate out", unit);
    if (type == "resistance") return opening;
    opening.load.distal = real("distal_resistance", 1, "windkessel: beside the capacitance", unit);
    opening.load.capacitance =
        real("capacitance", 1, "windkessel: volume per pressure", "volume / pressure");
    opening.load.stored =
        options_.real(name_ + "stored_pressure", 0,
                      {.help = "windkessel: of the capacitance at the start", .unit = "pressure"});
    return opening;
  }

  Options& options_;
  std::string name_;
};

std::string joined(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
  return list;
}

}  // namespace

Conditions read_patches(Options& options, const Mesh& mesh) {
  Conditions conditions;
  for (const Patch& patch : mesh.patches) {
    const std::string name = "patches_" + patch.name + "_type";
    const bool clear = patch.name == "wall" || patch.name == "symmetry";
    require(clear || options.given(name), "patch \"" + patch.name + "\" of the mesh has no type: " +
                                              "give -" + name + "; choose from: " + joined(types));
    const std::string type =
        options.choice(name, clear ? patch.name : "wall", types, "what stands at this patch");
    conditions[patch.name] = PatchOptions(options, patch.name).read(type);
  }
  return conditions;
}

std::vector<std::vector<Real>> read_rows(const std::string& file, std::size_t columns) {
  std::string text = "?";
  if (rank() == 0)
    if (std::ifstream stream(file); stream)
      text = std::string(std::istreambuf_iterator<char>(stream), {});
  text = broadcast(text);
  require(text != "?", "cannot read the file \"" + file + "\"");
  std::ranges::replace(text, ',', ' ');
  std::istringstream stream(text);
  std::vector<std::vector<Real>> rows;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || std::string("0123456789+-.").find(line[first]) > 12) continue;
    std::istringstream items(line);
    std::vector<Real>& row = rows.emplace_back();
    for (Real value; items >> value;) row.push_back(value);
    require(row.size() == columns && items.eof(), "file \"" + file + "\": the line \"" + line +
                                                      "\" is not " + std::to_string(columns) +
                                                      " numbers");
  }
  require(!rows.empty(), "file \"" + file + "\" holds no numbers");
  return rows;
}

OfTime series(const std::string& file, Real period) {
  const std::vector<std::vector<Real>> rows = read_rows(file, 2);
  for (std::size_t i = 1; i < rows.size(); ++i)
    require(rows[i][0] > rows[i - 1][0],
            "file \"" + file + "\": its times must grow from row to row");
  require(period == 0 || period >= rows.back()[0] - rows.front()[0],
          "file \"" + file + "\" is longer than its period");
  return [rows, period](Real t) {
    const Real start = rows.front()[0];
    if (period > 0) t = start + (t - start) - period * std::floor((t - start) / period);
    const auto next =
        std::ranges::upper_bound(rows, t, {}, [](const std::vector<Real>& row) { return row[0]; });
    if (next == rows.begin()) return rows.front()[1];
    const std::vector<Real>& a = *(next - 1);
    // Behind the last row a period leads back to the first.
    const bool behind = next == rows.end();
    if (behind && (period == 0 || a[0] >= start + period)) return a[1];
    const Real t_b = behind ? start + period : (*next)[0], b = behind ? rows[0][1] : (*next)[1];
    return a[1] + (b - a[1]) * (t - a[0]) / (t_b - a[0]);
  };
}

namespace {

struct Path {
  std::vector<std::string> patches;
  Real arc_length;
};

Path read_path(Options& options, const std::string& of) {
  const auto patches = options.list(
      of + "path", "two patches whose centre line the solid stands on, in place of its center");
  const Real s = options.real(
      of + "arc_length", 1, {.help = "way along the path, from its first patch", .unit = "length"});
  return {patches, s};
}

}  // namespace

void place_solids(std::vector<SolidSetup>& solids, Options& options, const Mesh& mesh) {
  for (SolidSetup& solid : solids) {
    const std::string& of = solid.options;
    const auto [path, s] = read_path(options, of);
    if (path.empty()) continue;
    require(path.size() == 2, "option -" + of + "path needs two patches: from,to");
    require(!options.given(of + "axis"),
            "options -" + of + "path and -" + of + "axis exclude each other");
    const flow::CentreLine line(mesh, path[0], path[1]);
    require(s > 0 && s < line.length(), "option -" + of + "arc_length: the centre line from " +
                                            path[0] + " to " + path[1] + " is " +
                                            std::to_string(line.length()) + " long");
    const auto [at, along] = line.at(s);
    const shapes::Shape aligned = shapes::align(solid.about_origin, along);
    const Real turn = solid.angle * std::numbers::pi / 180;
    solid.solid.shape = shapes::translate(shapes::rotate(aligned, {0, 0, 1}, turn), at);
    if (rank() != 0) continue;
    const std::string name = solid.solid.name.empty() ? "solid" : "solid " + solid.solid.name;
    std::printf(
        "%s on the centre line from %s to %s, %.4g of %.4g along it: at (%.5g, %.5g, %.5g)\n",
        name.c_str(), path[0].c_str(), path[1].c_str(), s, line.length(), at.x, at.y, at.z);
  }
}

void list_vessel_options(Options& options) {
  options.choice("patches_NAME_type", "wall", types, "what stands at patch NAME of the mesh");
  PatchOptions(options, "NAME").list();
  read_path(options, "solid_");
}

}  // namespace fsi
