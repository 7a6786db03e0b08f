#include "libfsi/run/continuation.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <sstream>
#include <system_error>
#include <vector>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/io/crc.hpp"
#include "libfsi/mesh/figures.hpp"

namespace fsi {
namespace {

/// Lines "name value".
std::map<std::string, std::string> lines(const std::string& text) {
  std::map<std::string, std::string> items;
  std::istringstream stream(text);
  for (std::string name, value; stream >> name && std::getline(stream >> std::ws, value);)
    items[name] = value;
  return items;
}

/// Whether an option sets the solid's shape or place at the start.
bool of_undeformed_solid(const std::string& name) {
  constexpr std::array geometry{"shape",  "center", "axis", "angle",     "radius",
                                "height", "axes",   "path", "arc_length"};
  return name.starts_with("solid") &&
         std::ranges::any_of(geometry, [&](const char* end) { return name.ends_with(end); });
}

/// The value of an option. Behind the name of a table stands a check of its content.
std::string with_content(const std::string& value) {
  std::ifstream file(value, std::ios::binary);
  if (!value.ends_with(".csv") || !file) return value;
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto check = io::crc64(std::as_bytes(std::span(text.data(), text.size())));
  return value + print(" [%016llx]", static_cast<unsigned long long>(check));
}
std::string without_content(const std::string& value) {
  return value.ends_with("]") && value.find(".csv [") != std::string::npos
             ? value.substr(0, value.rfind(" ["))
             : value;
}

/// Without the lines that begin with "solid".
std::string of_flow(const std::string& simulated) {
  std::string text;
  for (const auto& [name, value] : lines(simulated))
    if (!name.starts_with("solid")) text.append(name).append(" ").append(value).append("\n");
  return text;
}

void read_flow(io::Checkpoint& checkpoint, const io::Snapshot& snapshot) {
  checkpoint.read(snapshot,
                  "-flow_from takes the folder of a run without solids that had a "
                  "-checkpoint_interval");
}

}  // namespace

std::string simulated(const Options& options) {
  constexpr std::array not_simulated{
      "mesh",    "petscpartitioner", "time_",          "output_",       "sample_",  "check",
      "restart", "max_wall_time",    "end_when_empty", "describe_step", "flow_from"};
  std::string text;
  for (const auto& [name, value] : options.values()) {
    const auto begins = [&, &key = name](const char* start) { return key.starts_with(start); };
    if (std::ranges::none_of(not_simulated, begins))
      text.append(name).append(" ").append(with_content(value)).append("\n");
  }
  return text;
}

std::string differences(const std::string& before, const std::string& now) {
  const std::map<std::string, std::string> old = lines(before), current = lines(now);
  std::set<std::string> names;
  for (const auto* side : {&old, &current})
    for (const auto& item : *side) names.insert(item.first);
  std::string text, undeformed;
  for (const std::string& name : names) {
    const auto was = old.find(name), is = current.find(name);
    if (was != old.end() && is != current.end() && was->second == is->second) continue;
    const std::string then = was == old.end() ? "" : without_content(was->second),
                      here = is == current.end() ? "left out" : without_content(is->second);
    if (is != current.end() && was != old.end() && was->second == here) continue;  // without check
    std::string& list = of_undeformed_solid(name) ? undeformed : text;
    list += (list.empty() ? "-" : ", -") + name + " " + here;
    list += name.ends_with("_stored_pressure") ? " (without effect: that of the checkpoint is kept)"
            : was == old.end()                 ? " (was not given)"
            : then == here                     ? " (with another content)"
                                               : " (was " + then + ")";
  }
  require(undeformed.empty(), "a run that goes on has the solids of its checkpoint, but here is " +
                                  undeformed + "; give what was given there");
  return text.empty() ? "" : "goes on with other values than those of the checkpoint: " + text;
}

std::string identity(const std::string& driver, const Case& setup, const std::deque<Body>& bodies) {
  std::string text = "driver=" + driver + " solid=" + (bodies.empty() ? "no" : "yes");
  for (const Body& body : bodies)
    text += (body.name.empty() ? " " : " " + body.name + ".") +
            "kinematics=" + name_of(body.kinematics) + (body.memory ? "+memory" : "");
  if (const Vec3& v = setup.flow.frame; norm(v) > 0)
    text += print(" frame=%g,%g,%g", v.x, v.y, v.z);
  return text;
}

void start_from_other_run(Solver& solver, const Case& setup) {
  std::error_code code;
  require(!std::filesystem::equivalent(setup.flow_from, setup.output.directory, code),
          "option -flow_from: \"" + setup.flow_from +
              "\" is -output_dir, whose files a new run removes; choose another -output_dir, or go "
              "on there with -restart in place of -flow_from");
  io::Snapshot flow(identity(setup.driver, setup, {}));
  solver.list(flow);
  io::Checkpoint checkpoint(setup.flow_from, solver.mesh());
  read_flow(checkpoint, flow);
  solver.resume();
  const Real t = solver.state().t;
  require(t < setup.time.end,
          print("option -flow_from: that flow is of t = %g, from where this run "
                "goes on; -time_end %g is not behind it",
                t, setup.time.end));
  if (rank() == 0)
    std::printf("the flow is that of \"%s\", t = %g\n", checkpoint.file().c_str(), t);
}

std::string changes_of_flow(const Solver& solver, const Case& setup, const std::string& now) {
  std::string before;
  io::Snapshot words(identity(setup.driver, setup, {}));
  words.add("simulated", &before);
  io::Checkpoint checkpoint(setup.flow_from, solver.mesh());
  read_flow(checkpoint, words);
  return differences(of_flow(before), of_flow(now));
}

void tell_of_changes(const std::string& sentence) {
  if (rank() == 0 && !sentence.empty()) std::fprintf(stderr, "fsi: notice: %s\n", sentence.c_str());
}

void begin_anew(const std::string& directory, const io::Checkpoint& checkpoints) {
  if (rank() != 0) return;
  std::ifstream file(directory + "/summary.json");
  const std::string summary{std::istreambuf_iterator<char>(file), {}};
  const bool ended =
      summary.empty() || summary.find(R"("status": "complete")") != std::string::npos;
  const std::string kept = checkpoints.clear(!ended);
  if (!kept.empty())
    std::fprintf(
        stderr,
        "fsi: notice: the run before in \"%s\" did not come to its end; its checkpoint is "
        "kept as \"%s\"; to go on from it, move it to another folder, without .before, and "
        "give that folder and -restart\n",
        directory.c_str(), kept.c_str());
  std::error_code code;
  std::vector<std::filesystem::path> tables;
  for (const auto& entry : std::filesystem::directory_iterator(directory, code)) {
    const std::string name = entry.path().filename().string();
    if (name != "solid.csv" && !(name.starts_with("solid_") && name.ends_with(".csv"))) continue;
    std::string head;
    std::getline(std::ifstream(entry.path()), head);
    if (head.starts_with("t,x,y,z,ux,uy,uz,volume")) tables.push_back(entry.path());
  }
  for (const std::filesystem::path& table : tables) std::filesystem::remove(table, code);
}

void tell_of_start(const State& state, Real end, const std::string& file) {
  require(state.t <= end * (1 + 1e-12),
          print("option -time_end: %g, but the checkpoint from which the run goes on is of t = %g; "
                "give a later end",
                end, state.t));
  if (rank() != 0) return;
  std::printf("going on from t = %g, step %lld (%s)\n", state.t, static_cast<long long>(state.step),
              file.c_str());
}

void require_same_solids(const Solver& solver, std::size_t before) {
  const std::size_t now = solver.bodies().size();
  require(now >= before,
          "a solid was taken out of the solver while this Output exists: solids are "
          "put in by put_solid, and none is taken out");
  require(now == before,
          "the solver has " + std::to_string(now) + " solids, but " + std::to_string(before) +
              " when this Output was made: put all of them into the solver before making the " +
              "Output; to add one later, end this Output with finish() before put_solid, and " +
              "make another in a new folder");
}

void hand_on(const OutputSetup& output, Real seconds) {
  constexpr Real least = 1e-3;  // 0 is no limit
  set_option("restart", "true");
  set_option("restart_again", "true");
  if (output.wall_seconds_max > 0)
    set_option("max_wall_time", print("%.17g", std::max(output.wall_seconds_max - seconds, least)));
}

std::string text_of_steps(std::int64_t all, std::int64_t first) {
  std::string text = print("%lld steps", static_cast<long long>(all));
  if (first == 0) return text;
  return text + print(", %lld of them in this run,", static_cast<long long>(all - first));
}

}  // namespace fsi
