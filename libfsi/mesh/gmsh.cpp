#include "libfsi/mesh/gmsh.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <sstream>

#include "libfsi/core/memory.hpp"
#include "libfsi/mesh/token_reader.hpp"

namespace fsi {
namespace {

/// Elements of one dimension, as read.
struct Elements {
  std::vector<CellType> types;
  Csr corners;
  std::vector<std::int32_t> entities, physicals;  // physical 0: none
  std::vector<std::int64_t> tags;
};

/// From the numbers of nodes in the file to 0, 1, 2 ...: a table where the numbers are dense, a
/// search where they are not.
class Numbering {
 public:
  void build(const std::vector<std::int64_t>& tags) {
    const auto n = static_cast<std::int64_t>(tags.size());
    const auto [low, high] = std::ranges::minmax_element(tags);
    if (n > 0 && *low >= 0 && *high < 4 * n + 1024) {
      table_.assign(static_cast<std::size_t>(*high) + 1, -1);
      for (std::int64_t i = n - 1; i >= 0; --i) table_[at(tags[at(i)])] = static_cast<Index>(i);
      return;
    }
    for (std::int64_t i = 0; i < n; ++i) sorted_.emplace_back(tags[at(i)], static_cast<Index>(i));
    std::ranges::sort(sorted_);
  }
  /// -1 where there is no such node; the first of two that share a number.
  Index operator[](std::int64_t tag) const {
    if (!table_.empty()) {
      return tag >= 0 && at(tag) < table_.size() ? table_[at(tag)] : -1;
    }
    const auto found = std::ranges::lower_bound(sorted_, std::pair<std::int64_t, Index>{tag, 0});
    return found != sorted_.end() && found->first == tag ? found->second : -1;
  }

 private:
  static std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }
  std::vector<Index> table_;
  std::vector<std::pair<std::int64_t, Index>> sorted_;
};

/// A gmsh element type: its dimension, count of nodes and, for the ones a cell can have, its shape.
struct GmshType {
  int number, dim, nodes;
  CellType type;
};
constexpr GmshType known_types[] = {
    {15, 0, 1, CellType::triangle}, {1, 1, 2, CellType::triangle}, {2, 2, 3, CellType::triangle},
    {3, 2, 4, CellType::quad},      {4, 3, 4, CellType::tet},      {5, 3, 8, CellType::hex},
    {6, 3, 6, CellType::prism},     {7, 3, 5, CellType::pyramid},
};

class Reader {
 public:
  Reader(const std::string& file, std::string text) : in_(file, std::move(text)) {
    raw_.file = file;
  }
  RawMesh read();

 private:
  void format();
  void physical_names();
  void entities();
  void nodes_2();
  void nodes_4();
  void elements_2();
  void elements_4();
  void periodic();
  void section(const std::string& name);
  void assemble();
  const GmshType& element_type(int number);
  void element(const GmshType& type, std::int64_t tag, std::int32_t entity, std::int32_t physical,
               bool wide);
  Index node(std::int64_t tag, const std::string& who);
  std::vector<std::int32_t> groups_of(const Elements& sides, std::size_t i) const;
  /// A count or tag: 8 bytes in binary 4.1, an int in tags of 4.0.
  std::int64_t tag(bool wide) {
    return wide ? static_cast<std::int64_t>(in_.take<std::size_t>()) : in_.take<int>();
  }
  bool is(double version) const { return version_ == version; }

  Source in_;
  double version_ = 0;
  RawMesh raw_;
  Numbering numbering_;
  Elements elements_[4];
  std::map<std::pair<int, std::int32_t>, std::string> names_;                    // (dim, physical)
  std::map<std::pair<int, std::int32_t>, std::vector<std::int32_t>> physicals_;  // (dim, entity)
};

void Reader::format() {
  if (in_.next_is("$NOD"))
    in_.fail("gmsh format 1 is not known; write the mesh as 2.2, 4.0 or 4.1");
  in_.expect("$MeshFormat");
  in_.set_section("$MeshFormat");
  version_ = in_.number<double>();
  if (!is(2.2) && !is(4.0) && !is(4.1)) {
    std::ostringstream sentence;
    sentence << "gmsh format " << version_ << " is not known; write the mesh as 2.2, 4.0 or 4.1";
    in_.fail(sentence.str());
  }
  const int kind = in_.number<int>();
  const int size = in_.number<int>();
  if (kind != 0 && kind != 1) in_.fail("expected file type 0 (ascii) or 1 (binary)");
  if (size != 8) in_.fail("numbers of " + std::to_string(size) + " bytes; 8 are expected");
  if (kind == 1) {
    in_.end_line();
    in_.set_binary(true);
    if (in_.bytes<int>() != 1) in_.fail("written on a machine of the other byte order");
  }
  in_.expect("$EndMeshFormat");
}

void Reader::physical_names() {
  const auto n = in_.count(in_.number<std::size_t>(), 4, "physical names");
  for (std::size_t i = 0; i < n; ++i) {
    const int dim = in_.number<int>();
    const auto number = in_.number<std::int32_t>();
    names_[{dim, number}] = in_.quoted();
  }
}

void Reader::entities() {
  std::size_t counts[4];
  for (std::size_t& count : counts) count = in_.count(in_.take<std::size_t>(), 8, "entities");
  for (int dim = 0; dim < 4; ++dim) {
    for (std::size_t i = 0; i < counts[dim]; ++i) {
      const auto entity = in_.take<std::int32_t>();
      const int box = dim == 0 && is(4.1) ? 3 : 6;
      for (int k = 0; k < box; ++k) in_.take<double>();
      std::vector<std::int32_t> groups(in_.count(in_.take<std::size_t>(), 2, "physical groups"));
      for (auto& group : groups) group = in_.take<std::int32_t>();
      physicals_[{dim, entity}] = std::move(groups);
      if (dim == 0) continue;
      const auto bounds = in_.count(in_.take<std::size_t>(), 2, "bounding entities");
      for (std::size_t k = 0; k < bounds; ++k) in_.take<std::int32_t>();
    }
  }
}

void Reader::nodes_2() {
  const auto n = in_.count(in_.number<std::size_t>(), 8, "nodes");
  if (in_.binary()) in_.end_line();
  raw_.points.resize(n), raw_.point_tags.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    raw_.point_tags[i] = in_.take<int>();
    Vec3& x = raw_.points[i];
    x.x = in_.take<double>(), x.y = in_.take<double>(), x.z = in_.take<double>();
  }
}

void Reader::nodes_4() {
  const auto blocks = in_.count(in_.take<std::size_t>(), 8, "blocks of nodes");
  const auto total = in_.count(in_.take<std::size_t>(), 8, "nodes");
  if (is(4.1)) in_.take<std::size_t>(), in_.take<std::size_t>();
  raw_.points.reserve(total), raw_.point_tags.reserve(total);
  for (std::size_t b = 0; b < blocks; ++b) {
    int dim = in_.take<int>();
    const int entity = in_.take<int>();
    if (is(4.0)) dim = entity;
    const int parameters = in_.take<int>() != 0 ? dim : 0;
    const auto n = in_.count(in_.take<std::size_t>(), 8, "nodes");
    if (is(4.1)) {
      for (std::size_t i = 0; i < n; ++i) raw_.point_tags.push_back(tag(true));
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (is(4.0)) raw_.point_tags.push_back(tag(false));
      Vec3 x;
      x.x = in_.take<double>(), x.y = in_.take<double>(), x.z = in_.take<double>();
      raw_.points.push_back(x);
      for (int k = 0; k < parameters; ++k) in_.take<double>();
    }
  }
}

Index Reader::node(std::int64_t number, const std::string& who) {
  const Index i = numbering_[number];
  if (i < 0)
    in_.fail(who + " names node " + std::to_string(number) + ", which the file does not define");
  return i;
}

const GmshType& Reader::element_type(int number) {
  for (const GmshType& type : known_types) {
    if (type.number == number) return type;
  }
  in_.fail(
      "element type " + std::to_string(number) +
      "; only first-order triangles, quads, tets, hexes, prisms and pyramids are known (in gmsh: "
      "-order 1, Mesh.ElementOrder = 1)");
}

void Reader::element(const GmshType& type, std::int64_t number, std::int32_t entity,
                     std::int32_t physical, bool wide) {
  Elements& list = elements_[type.dim];
  for (int i = 0; i < type.nodes; ++i) {
    const std::int64_t given = tag(wide);
    const Index found = numbering_[given];
    if (found < 0) node(given, "element " + std::to_string(number));
    list.corners.index.push_back(found);
  }
  // Corners and faces of cells are numbered by Index (mesh/cell_list.hpp).
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<Index>::max());
  if (list.corners.index.size() > most || list.types.size() >= most / max_faces)
    in_.fail("more elements than one mesh can have, " + std::to_string(most / max_faces));
  list.corners.offset.push_back(static_cast<Index>(list.corners.index.size()));
  list.types.push_back(type.type);
  list.entities.push_back(entity), list.physicals.push_back(physical);
  list.tags.push_back(number);
}

void Reader::elements_2() {
  const auto n = in_.count(in_.number<std::size_t>(), 8, "elements");
  if (in_.binary()) in_.end_line();
  for (std::size_t i = 0; i < n;) {
    int type_number = 0, block = 1, groups = 0, number = 0;
    if (in_.binary()) {
      type_number = in_.take<int>(), block = in_.take<int>(), groups = in_.take<int>();
    } else {
      number = in_.take<int>(), type_number = in_.take<int>(), groups = in_.take<int>();
    }
    const GmshType& type = element_type(type_number);
    if (block < 1) in_.fail("a block of " + std::to_string(block) + " elements");
    for (int k = 0; k < block; ++k, ++i) {
      if (in_.binary()) number = in_.take<int>();
      std::int32_t group[2] = {0, 0};
      for (int g = 0; g < groups; ++g) {
        const int value = in_.take<int>();
        if (g < 2) group[g] = value;
      }
      element(type, number, group[1], group[0], false);
    }
  }
}

void Reader::elements_4() {
  const auto blocks = in_.count(in_.take<std::size_t>(), 8, "blocks of elements");
  in_.count(in_.take<std::size_t>(), 4, "elements");
  if (is(4.1)) in_.take<std::size_t>(), in_.take<std::size_t>();
  for (std::size_t b = 0; b < blocks; ++b) {
    int dim = in_.take<int>(), entity = in_.take<int>();
    if (is(4.0)) std::swap(dim, entity);
    const GmshType& type = element_type(in_.take<int>());
    const auto n = in_.count(in_.take<std::size_t>(), 4, "elements");
    for (std::size_t i = 0; i < n; ++i) element(type, tag(is(4.1)), entity, 0, is(4.1));
  }
}

void Reader::periodic() {
  // In 2.2 this section is text also in a binary file.
  const bool binary = in_.binary();
  if (is(2.2)) in_.set_binary(false);
  const auto n = in_.count(in_.take<std::size_t>(), 6, "periodic entities");
  for (std::size_t i = 0; i < n; ++i) {
    RawMesh::Link link;
    link.dim = in_.take<int>();
    in_.take<int>(), in_.take<int>();
    if (is(4.1)) {
      const auto affine = in_.count(in_.take<std::size_t>(), 2, "numbers");
      for (std::size_t k = 0; k < affine; ++k) in_.take<double>();
    } else if (!in_.binary() && in_.next_is("Affine")) {
      in_.end_line();
    }
    const auto pairs = in_.count(in_.take<std::size_t>(), 4, "pairs of nodes");
    const bool wide = is(4.1);
    for (std::size_t k = 0; k < pairs; ++k) {
      const Index slave = node(tag(wide), "$Periodic");
      link.nodes.emplace_back(slave, node(tag(wide), "$Periodic"));
    }
    raw_.links.push_back(std::move(link));
  }
  in_.set_binary(binary);
}

void Reader::section(const std::string& name) {
  if (name == "$PhysicalNames") return physical_names();
  if (name == "$Entities") return entities();
  if (name == "$Nodes") {
    if (!raw_.points.empty()) in_.fail("a second section $Nodes; write one");
    is(2.2) ? nodes_2() : nodes_4();
    numbering_.build(raw_.point_tags);
    for (std::size_t i = 0; i < raw_.point_tags.size(); ++i)
      if (numbering_[raw_.point_tags[i]] != static_cast<Index>(i))
        in_.fail("node " + std::to_string(raw_.point_tags[i]) + " is defined twice");
    return;
  }
  if (name == "$Elements") return is(2.2) ? elements_2() : elements_4();
  if (name == "$Periodic") return periodic();
}

RawMesh Reader::read() {
  format();
  for (std::string name(in_.word()); !name.empty(); name = in_.word()) {
    if (name.front() != '$')
      in_.fail("expected a section ($...), found \"" + name.substr(0, 40) + "\"");
    in_.set_section(name);
    if (name == "$PartitionedEntities")
      in_.fail("the mesh is partitioned by gmsh: mesh it without -part, a run divides it itself");
    const std::string end = "$End" + name.substr(1);
    const bool known = name == "$PhysicalNames" || name == "$Entities" || name == "$Nodes" ||
                       name == "$Elements" || name == "$Periodic";
    if (!known) {
      in_.skip_past(end);
      continue;
    }
    in_.end_line();
    section(name);
    in_.expect(end);
  }
  assemble();
  return std::move(raw_);
}

/// The physical groups of a boundary element: its own in format 2.2, those of its entity in 4, but
/// only the named ones if there are any. A minus sign tells the orientation in the group. 0: none.
std::vector<std::int32_t> Reader::groups_of(const Elements& sides, std::size_t i) const {
  const auto found = physicals_.find({raw_.dim - 1, sides.entities[i]});
  if (found == physicals_.end() || found->second.empty()) return {sides.physicals[i]};
  std::vector<std::int32_t> groups = found->second;
  for (std::int32_t& group : groups) group = std::abs(std::max(group, -INT32_MAX));
  const auto named = [&](std::int32_t group) { return names_.contains({raw_.dim - 1, group}); };
  if (std::ranges::any_of(groups, named)) std::erase_if(groups, std::not_fn(named));
  return groups;
}

void Reader::assemble() {
  raw_.dim = elements_[3].types.empty() ? 2 : 3;
  Elements& cells = elements_[raw_.dim];
  raw_.types = std::move(cells.types), raw_.corners = std::move(cells.corners);
  raw_.entities = std::move(cells.entities), raw_.tags = std::move(cells.tags);

  const Elements& sides = elements_[raw_.dim - 1];
  std::map<std::int32_t, Index> name_of;  // by number of the group, so that formats agree
  for (std::size_t i = 0; i < sides.types.size(); ++i)
    for (const std::int32_t physical : groups_of(sides, i)) name_of[physical] = -1;
  for (auto& [physical, index] : name_of) {
    if (physical == 0) continue;
    const auto named = names_.find({raw_.dim - 1, physical});
    const std::string name = named == names_.end() ? std::to_string(physical) : named->second;
    const auto place = std::ranges::find(raw_.names, name);
    index = static_cast<Index>(place - raw_.names.begin());
    if (place == raw_.names.end()) raw_.names.push_back(name);
  }
  for (std::size_t i = 0; i < sides.types.size(); ++i) {
    RawMesh::Side side;
    std::ranges::copy(sides.corners[static_cast<Index>(i)], side.corner.begin());
    side.tag = sides.tags[i];
    for (const std::int32_t physical : groups_of(sides, i))
      side.name = name_of[physical], raw_.sides.push_back(side);
  }
}

}  // namespace

RawMesh parse_gmsh(const std::string& file, std::string text) {
  return Reader(file, std::move(text)).read();
}

RawMesh read_gmsh(const std::string& file) {
  for (const char* geometry : {".geo", ".geo_unrolled", ".step", ".stp", ".brep", ".stl"})
    if (file.ends_with(geometry))
      throw Error(ErrorKind::input,
                  "mesh file \"" + file +
                      "\" is a geometry, not a mesh: gmsh -3 -bin makes a mesh of it "
                      "(-2 in two dimensions)");
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in || std::filesystem::is_directory(file))
    throw Error(ErrorKind::input, "mesh file \"" + file + "\" cannot be opened, or it is a folder");
  const auto end = in.tellg();
  const auto size = end > 0 ? static_cast<std::size_t>(end) : 0;
  const std::uint64_t memory = memory_limit();
  // The text and the cells made of it: at least twice the file (six to eight times were measured).
  require(size < memory / 2, "mesh file \"" + file + "\" has " + text_of_bytes(size) +
                                 ", too much for the " + text_of_bytes(memory) +
                                 " of memory that this process can have");
  std::string text(size, '\0');
  in.seekg(0);
  if (!in.read(text.data(), static_cast<std::streamsize>(text.size()))) {
    throw Error(ErrorKind::io, "mesh file \"" + file + "\" cannot be read");
  }
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw Error(ErrorKind::input, "mesh file \"" + file + "\" is empty");
  }
  return parse_gmsh(file, std::move(text));
}

}  // namespace fsi
