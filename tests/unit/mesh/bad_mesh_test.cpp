// Every fault of a mesh file ends in one sentence, the same on all ranks.

#include <gtest/gtest.h>

#include "libfsi/core/error.hpp"
#include "tests/unit/mesh/block.hpp"

namespace fsi::test {
namespace {

/// 3 x 3 quads: nodes 1 + i + 4 j, sides 1-12 (left, right, bottom, top), cells 13-21.
std::string quads(int nx = 3, int ny = 3) {
  Block block;
  block.type = CellType::quad, block.n = {nx, ny, 1};
  return BlockText(block).text();
}
std::string triangles() {
  Block block;
  block.type = CellType::triangle;
  return BlockText(block).text();
}
std::string hexes() { return BlockText(Block{}).text(); }

/// `text` with the line that starts with `begin` replaced; the line must be there.
std::string with(std::string text, const std::string& begin, const std::string& line) {
  const std::size_t at = text.find("\n" + begin);
  EXPECT_NE(at, std::string::npos) << begin;
  const std::size_t end = text.find('\n', at + 1);
  return text.replace(at + 1, end - at - 1, line);
}
std::string with_element(const std::string& text, const std::string& number,
                         const std::string& rest) {
  const std::size_t elements = text.find("$Elements");
  return text.substr(0, elements) + with(text.substr(elements), number + " ", number + " " + rest);
}
std::string with_node(const std::string& text, const std::string& number, const std::string& rest) {
  const std::size_t nodes = text.find("$Nodes");
  return text.substr(0, nodes) + with(text.substr(nodes), number + " ", number + " " + rest);
}
/// 21 elements and 16 nodes of quads() become more.
std::string with_more(std::string text, const std::vector<std::string>& nodes,
                      const std::vector<std::string>& elements) {
  std::string lines;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    lines += std::to_string(22 + i) + " " + elements[i] + "\n";
  }
  text.insert(text.find("$EndElements"), lines);
  text = with(text, "21\n", std::to_string(21 + elements.size()));
  lines.clear();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    lines += std::to_string(17 + i) + " " + nodes[i] + "\n";
  }
  text.insert(text.find("$EndNodes"), lines);
  return with(text, "16\n", std::to_string(16 + nodes.size()));
}
std::string without_sides(const std::string& text) {
  std::string result = text;
  for (int i = 1; i <= 12; ++i) {
    result = with_element(result, std::to_string(i), "15 2 0 0 1");  // a point instead
  }
  return result;
}

/// Two tets above one triangle, one within the other.
std::string folded_tets() {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
         "5 .2 .2 .3\n$EndNodes\n$Elements\n2\n1 4 2 9 9 1 2 3 4\n2 4 2 9 9 2 3 1 "
         "5\n$EndElements\n";
}

/// Two quads in format 4.1, whose one curve of sides is of two physical groups; `names` of them.
std::string two_groups(const std::string& names = "2\n1 1 \"left\"\n1 2 \"right\"\n") {
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n" + names +
         "$EndPhysicalNames\n$Entities\n0 1 1 0\n7 0 0 0 2 1 0 2 1 -2 0\n9 0 0 0 2 1 0 0 0\n"
         "$EndEntities\n$Nodes\n1 6 1 6\n2 9 0 6\n1\n2\n3\n4\n5\n6\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n"
         "1 1 0\n2 1 0\n$EndNodes\n$Elements\n2 8 1 8\n1 7 1 6\n1 1 2\n2 2 3\n3 3 6\n4 6 5\n5 5 4\n"
         "6 4 1\n2 9 3 2\n7 1 2 5 4\n8 2 3 6 5\n$EndElements\n";
}

struct Fault {
  std::string name, text, sentence;
  std::vector<std::string> periodic{};
};

std::vector<Fault> faults_of_the_file() {
  const std::string good = quads();
  return {
      {"empty", "", "is empty"},
      {"blank", " \r\n\n", "is empty"},
      {"garbage", "solid cube\nfacet", "line 1: expected $MeshFormat, found \"solid\""},
      {"version 3", with(good, "2.2", "3 0 8"), "line 2: gmsh format 3 is not known"},
      {"version 5", with(good, "2.2", "5 0 8"), "write the mesh as 2.2, 4.0 or 4.1"},
      {"file type", with(good, "2.2", "2.2 7 8"), "expected file type 0 (ascii) or 1 (binary)"},
      {"number size", with(good, "2.2", "2.2 0 4"), "numbers of 4 bytes"},
      {"word for number", with_node(good, "6", "0.3 0.3 up"), "expected a number, found \"up\""},
      {"fraction for count", with(good, "16\n", "16.5"), "expected a whole number, found \"16.5\""},
      {"count too high", with(good, "16\n", "16000"), "16000 nodes announced"},
      {"count beyond all files", with(good, "16\n", "1000000000000000"),
       "1000000000000000 nodes announced, but the file ends before them"},
      {"count too low", with(good, "16\n", "15"), "expected $EndNodes, found \"16\""},
      {"unknown node", with_element(good, "13", "3 2 9 9 1 2 6 99"),
       "element 13 names node 99, which the file does not define"},
      {"node twice", with_node(good, "6", "0.3 0.3 0\n6 0.3 0.3 0"), "node 6 is defined twice"},
      {"number twice", with(good, "6 0.3", "5 0.3 0.3 0"), "node 5 is defined twice"},
      {"nodes twice", good + "$Nodes\n1\n1 0 0 0\n$EndNodes\n", "a second section $Nodes"},
      {"second order", with_element(good, "13", "16 2 9 9 1 2 6 5 1 1 1 1"), "element type 16"},
      {"loose text", good + "\nend\n", "expected a section ($...), found \"end\""},
  };
}

std::vector<Fault> faults_of_cells() {
  const std::string good = quads();
  return {
      {"no cells", with(good.substr(0, good.find("13 3 2")) + "$EndElements\n", "21\n", "12"),
       "holds no cells"},
      {"not a number", with_node(good, "6", "nan 0.3 0"), "node 6 lies at (nan, 0.3, 0)"},
      {"infinite", with_node(good, "6", "0.3 inf 0"), "node 6 lies at (0.3, inf, 0)"},
      {"out of plane", with_node(good, "6", "0.3 0.3 0.1"), "do not lie in one plane z = const"},
      {"repeated node", with_element(good, "13", "3 2 9 9 1 2 6 6"),
       "element 13 names node 6 twice"},
      {"collapsed edge", with_node(good, "2", "0 0 0"),
       "element 13 has a collapsed edge: its nodes 1 and 2 lie at the same place (0, 0, 0)"},
      {"collapsed edge of a hex", with_node(hexes(), "2", "0 0 1e-12"),
       "collapsed edge: its nodes 1 and 2 lie"},
      {"folded edge", with_more(good, {"0 0.2 0", "0.3 0.2 0"}, {"3 2 9 9 1 2 18 17"}),
       "elements 13 and 22 share the face at (0.166667, 0, 0) and lie on the same side of it"},
      {"folded face", folded_tets(), "elements 1 and 2 share the face at (0.333333, 0.333333, 0)"},
      {"one cell", quads(1, 1), "has only one cell, element 5"},
      {"flat", with_element(triangles(), "13", "2 2 9 9 1 2 3"),
       "element 13 at (0.333333, 0, 0) has no volume"},
      {"nearly flat", with_node(triangles(), "6", "0.333333 1e-8 0"), "is flat: 1.5e-08 of its"},
      {"inverted", with_element(good, "13", "3 2 9 9 1 5 6 2"),
       "element 13 at (0.166667, 0.166667, 0) is turned inside out, as 1 of the 9 cells"},
      {"tangled", with_node(good, "6", "0.1 0.1 0"),
       "is tangled: it folds over at its corner (0.1, 0.1, 0)"},
      {"tangled hex", with_node(hexes(), "22", "0.12 0.12 0.12"), "is tangled"},
      {"duplicate", with_more(good, {}, {"3 2 9 9 6 5 1 2"}), "element 22 has the same nodes"},
      {"non-manifold",
       with_more(good, {"0.3 -0.3 0", "0.6 -0.3 0", "0.3 -0.4 0", "0.6 -0.4 0"},
                 {"3 2 9 9 17 18 3 2", "3 2 9 9 19 20 3 2"}),
       "the face at (0.5, 0, 0) of element 14 belongs to more than two cells"},
      {"island", with_more(good, {"2 0 0", "3 0 0", "3 1 0", "2 1 0"}, {"3 2 9 9 17 18 19 20"}),
       "falls into 2 parts that share no face; the smallest has 1 cells, one with a corner at (2, "
       "0, 0)"},
  };
}

std::vector<Fault> faults_of_names() {
  const std::string good = quads();
  return {
      {"no side", with_element(good, "1", "15 2 0 0 1"),
       "1 boundary faces carry no physical name, the first at (0, 0.166667, 0); names are: left, "
       "right, bottom, top"},
      {"no name", with_element(good, "4", "1 2 0 5 4 8"),
       "1 boundary faces carry no physical name"},
      {"no sides", without_sides(good),
       "12 boundary faces carry no physical name, the first at (0.166667, 0, 0), (0, 0.166667, 0), "
       "(0.5, 0, 0), (0.833333, 0, 0), (1, 0.166667, 0); names are: none"},
      {"two names", with_more(good, {}, {"1 2 2 2 1 5"}), "carries two names"},
      {"two groups of a curve", two_groups(), "boundary element 1 carries two names: left, right"},
      {"loose side", with_more(good, {}, {"1 2 1 1 1 6"}),
       "boundary element 22 of \"left\" at (0, 0, 0) is not a face of any cell"},
      {"misspelt",
       good,
       "periodic patch \"rigth\" unknown; mesh has: left, right, bottom, top; did "
       "you mean \"right\"?",
       {"left", "rigth"}},
      {"nothing near",
       good,
       "periodic patch \"zzz\" unknown; mesh has: left, right, bottom, top",
       {"zzz", "left"}},
      {"odd", good, "come in pairs; given are 3: left, right, top", {"left", "right", "top"}},
      {"itself", good, "\"left\" with itself", {"left", "left"}},
      {"counts", quads(4, 3), "4 nodes against 5; the two meshes must match", {"left", "top"}},
      {"no translation", good, "no node of \"top\" at", {"left", "top"}},
      {"moved", with_node(good, "8", "1 0.4 0"), "no node of \"right\" at", {"left", "right"}},
      {"two layers", quads(2, 3), "fewer than 3 cells across a period", {"left", "right"}},
      {"one layer", quads(3, 1), "fewer than 3 cells across a period", {"bottom", "top"}},
      {"rotation", good + "$Periodic\n1\n1 4 1\n4\n13 1\n14 5\n15 9\n16 13\n$EndPeriodic\n",
       "only translations are known"},
  };
}

std::string sentence_of(const std::string& text, const std::vector<std::string>& periodic) {
  const TextFile file(text);
  try {
    read_mesh({file.path(), periodic});
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    const std::string mine = error.what();
    EXPECT_EQ(mine, broadcast(mine)) << "all ranks say the same";
    return mine;
  }
  return "no error";
}

void expect_sentences(const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) {
    const std::string sentence = sentence_of(fault.text, fault.periodic);
    EXPECT_NE(sentence.find(fault.sentence), std::string::npos) << fault.name << ": " << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos);
  }
}

TEST(BadMesh, File) { expect_sentences(faults_of_the_file()); }
TEST(BadMesh, Cells) { expect_sentences(faults_of_cells()); }
TEST(BadMesh, Names) { expect_sentences(faults_of_names()); }

TEST(BadMesh, CutAnywhere) {
  const std::string good = hexes();
  for (std::size_t length = 1; length + 12 < good.size(); length += good.size() / 97) {
    std::string sentence = "no error";
    try {
      check_mesh(parse_gmsh("cut.msh", good.substr(0, length)), {});
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      sentence = error.what();
    }
    EXPECT_EQ(sentence.rfind("cut.msh", 0), 0u) << "at " << length << ": " << sentence;
  }
}

TEST(BadMesh, MissingFile) { EXPECT_THROW(read_mesh({"no/such/file.msh", {}}), Error); }

TEST(BadMesh, Partitioner) {
  const TextFile file(quads());
  try {
    read_mesh({file.path(), {}, "parmetis"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "partitioner \"parmetis\" unknown; there are: metis, ptscotch, simple");
  }
}

TEST(BadMesh, Patch) {
  const TextFile file(quads());
  const Mesh mesh = divided(file.path(), {"left", "right"});
  try {
    mesh.patch("topp");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "patch \"topp\" unknown; mesh has: bottom, top");
  }
}

TEST(GoodMesh, LinesMayEndInCrlf) {
  std::string text = hexes();
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) {
    text.replace(at, 1, "\r\n");
  }
  EXPECT_EQ(check_mesh(parse_gmsh("a", text), {}).hash,
            check_mesh(parse_gmsh("b", hexes()), {}).hash);
}

TEST(GoodMesh, ClockwiseSurfaceIsTurned) {
  for (const CellType type : {CellType::triangle, CellType::quad, CellType::tet, CellType::hex,
                              CellType::prism, CellType::pyramid}) {
    Block block;
    block.type = type;
    block.moved = [](const Vec3& x) { return Vec3{-x.x, x.y, x.z}; };
    const TextFile file(BlockText(block).text());
    const Mesh mesh = divided(file.path(), {});
    EXPECT_NEAR(mesh.total_volume, 1, 1e-14);
    for (const Real V : mesh.V) EXPECT_GT(V, 0);
  }
}

TEST(GoodMesh, PlaneElsewhere) {
  Block block;
  block.type = CellType::quad;
  block.moved = [](const Vec3& x) { return Vec3{x.x, x.y, 2}; };
  const TextFile file(BlockText(block).text());
  for (const Vec3& x : divided(file.path(), {}).points) EXPECT_EQ(x.z, 0);
}

TEST(GoodMesh, GroupsWithoutNamesAreCalledByNumber) {
  std::string text = quads();
  const std::size_t begin = text.find("$PhysicalNames"), end = text.find("$Nodes");
  text.erase(begin, end - begin);
  const TextFile file(text);
  const Mesh mesh = divided(file.path(), {});
  EXPECT_EQ(mesh.patches.size(), 4u);
  EXPECT_EQ(mesh.patches.front().name, "1");
}

// A named line between two cells is no wall, and is told.
TEST(GoodMesh, NamedFacesInsideAreTold) {
  const RawMesh raw = parse_gmsh("a", with_more(quads(), {}, {"1 2 1 1 6 7"}));
  testing::internal::CaptureStderr();
  EXPECT_EQ(check_mesh(raw, {}).patches.size(), 4u);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("between two cells: 1;"),
            std::string::npos);
}

TEST(GoodMesh, HashTellsMeshesApart) {
  const auto hash = [](const std::string& text, const std::vector<std::string>& periodic) {
    return check_mesh(parse_gmsh("a", text), periodic).hash;
  };
  const auto first = hash(quads(), {});
  EXPECT_EQ(first, hash(quads(), {}));
  EXPECT_NE(first, hash(with_node(quads(), "6", "0.3 0.3 0"), {}));
  EXPECT_NE(first, hash(with_element(quads(), "1", "1 2 2 2 1 5"), {}));
  EXPECT_NE(first, hash(quads(), {"left", "right"}));
}

// abs() of the least whole number overflows.
TEST(GoodMesh, AGroupOfTheLeastNumberIsLeftOutToo) {
  const std::string text = two_groups("1\n1 1 \"left\"\n");
  EXPECT_EQ(sentence_of(with(text, "7 0 0 0", "7 0 0 0 2 1 0 2 1 -2147483648 0"), {}), "no error");
}

// A second group without a name, as of all curves, is no name.
TEST(GoodMesh, AGroupWithoutANameIsLeftOutBesideOneWithAName) {
  EXPECT_EQ(sentence_of(two_groups("1\n1 1 \"left\"\n"), {}), "no error");
}

}  // namespace
}  // namespace fsi::test
