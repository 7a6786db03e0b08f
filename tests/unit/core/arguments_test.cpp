#include "libfsi/core/arguments.hpp"

#include <gtest/gtest.h>

namespace fsi {
namespace {

Arguments read(std::vector<std::string> words) {
  words.insert(words.begin(), "program");
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  return read_arguments(static_cast<int>(list.size()), list.data());
}

TEST(Arguments, AnOptionsFileComesFirst) {
  const Arguments a = read({"case.yaml", "-help", "-a", "1"});
  EXPECT_EQ(a.file, "case.yaml");
  EXPECT_TRUE(a.help);
  EXPECT_EQ(a.words, (std::vector<std::string>{"program", "-options_file_yaml", "case.yaml",
                                               "-case_folder", ".", "-a", "1"}));
  EXPECT_EQ(read({"cases/own.yml"}).words.back(), "cases");
  EXPECT_EQ(read({"-a", "case.yaml"}).file, "case.yaml");
  EXPECT_EQ(read({"-options_file_yaml", "case.yaml"}).file, "");
  EXPECT_EQ(read({"-help", "-a", "1", "case.yaml"}).words, a.words);
  EXPECT_FALSE(a.version);
  EXPECT_TRUE(read({"-version"}).version);
}

TEST(Arguments, EveryWordBelongsToAnOption) {
  EXPECT_EQ(fault_of(read({"-a", "1", "-flag", "-b", "-2", "--c", "x,y"})), "");
  EXPECT_NE(fault_of(read({"-a", "1,", "2"})).find("\"2\" belongs to no option"),
            std::string::npos);
  EXPECT_NE(fault_of(read({"case.yml", "more.yml"})).find("\"more.yml\""), std::string::npos);
  EXPECT_NE(fault_of(read({"-a", "1", "-a", "2"})).find("-a is given twice"), std::string::npos);
}

TEST(Arguments, CapitalsAndDashesMakeNoOtherOption) {
  for (const char* again : {"-time_END", "--time_end", "--Time_End"}) {
    const std::string said = fault_of(read({"-time_end", "1", again, "2"}));
    EXPECT_NE(said.find("option " + std::string(again) + " is given twice"), std::string::npos)
        << said;
    EXPECT_NE(said.find("first as -time_end"), std::string::npos) << said;
  }
  EXPECT_NE(fault_of(read({"case.yaml", "-Options_File_Yaml", "b.yaml"})).find("given twice"),
            std::string::npos);
}

TEST(Arguments, OptionsFilesAreFound) {
  const auto files = options_files(
      read({"case.yaml", "-a", "1", "-Options_file", "more", "-b", "-options_file_no", "x"}));
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].name, "case.yaml");
  EXPECT_TRUE(files[0].yaml);
  EXPECT_EQ(files[1].name, "more");
  EXPECT_FALSE(files[1].yaml);
  EXPECT_TRUE(options_files(read({"-options_file", "a.yml"})).front().yaml);
  EXPECT_TRUE(options_files(read({"-options_file_yaml", "a"})).front().yaml);
  for (const auto& words :
       {std::vector<std::string>{"-options_file"}, {"-options_file", "-a", "1"}})
    EXPECT_NE(fault_of(read(words)).find("-options_file needs the name of a file"),
              std::string::npos);
}

TEST(Arguments, KeysGivenTwiceAreFoundWhereverTheyNest) {
  EXPECT_EQ(repeated_key("a: 1\nb:\n  a: 2\n  c: 3\nc: 4\n"), "");
  EXPECT_EQ(repeated_key("a: 1\nb: 2\na: 3\n"), "a");
  EXPECT_EQ(repeated_key("solids:\n  a: {shape: disk}\n  A: {shape: disk}\n"), "solids_A_shape");
  EXPECT_EQ(repeated_key("solid:\n  shape: torus\n  density: 1\nfluid:\n  density: 1\n"), "");
  EXPECT_EQ(repeated_key("solid:  # soft\n  shape: torus\n\nsolid_shape: disk\n"), "solid_shape");
  EXPECT_EQ(repeated_key("a:\n  b:\n    c: 1\n  d: 2\na:\n  b:\n    c: 1\n"), "a_b_c");
  EXPECT_EQ(repeated_key("mesh: {a: 1, b: 2}\n# mesh: 1\nfile: C:x\n"), "");
  EXPECT_EQ(repeated_key("\"a\": 1\n'a': 2\n"), "a");
}

TEST(Arguments, WhatIsNoYamlIsToldWithItsLine) {
  EXPECT_EQ(yaml_fault("a: {b: 1}\nc: [1, 2]\n"), "");
  EXPECT_EQ(yaml_fault(""), "");
  EXPECT_EQ(yaml_fault("{}"), "");
  EXPECT_EQ(yaml_fault("a: 1\nsolids: {}\n"), "line 2: a block without keys");
  EXPECT_TRUE(yaml_fault("solids:\n  - {shape: torus}\n").starts_with("line 2: a list of blocks"));
  for (const auto& [text, line, words] :
       {std::tuple{"a: {b: 1\nc: 2\n", "line 2: ", "flow mapping that begins in line 1"},
        {"a:\n  b: 1\n   c: 2\n", "line 3: ", "mapping values are not allowed"},
        {"a:\n  b: 1\n c: 2\n", "line 3: ", "block mapping that begins in line 1"},
        {"a:\n\tb: 1\n", "line 2: ", "holds a tab"},
        {"a: [1, 2\n", "line 2: ", "flow sequence that begins in line 1"}}) {
    EXPECT_TRUE(yaml_fault(text).starts_with(line)) << yaml_fault(text);
    EXPECT_NE(yaml_fault(text).find(words), std::string::npos) << yaml_fault(text);
  }
}

TEST(Arguments, KeysGivenTwiceAreFoundInBraces) {
  EXPECT_EQ(repeated_key("{a: 1, a: 2}"), "a");
  EXPECT_EQ(repeated_key("solid: {shape: torus, density: 1, shape: disk}\n"), "solid_shape");
  EXPECT_EQ(repeated_key("solid: {shape: torus}\nsolid_shape: disk\n"), "solid_shape");
  EXPECT_EQ(repeated_key("solid: {a: 1}\nsolid: {b: 1}\nsolid:\n  a: 2\n"), "solid_a");
  EXPECT_EQ(repeated_key("a: {b: {c: 1, d: 2},\n  # b: 1\n    b: {c: 3}}\n"), "a_b_c");
  EXPECT_EQ(repeated_key("a:\n  {b: 1, 'c': 2,\n   \"c\": 3}\n"), "a_c");
  EXPECT_EQ(repeated_key("a: {b, c, b}\n"), "a_b");
  EXPECT_EQ(repeated_key("{\"a\":1,\"a\":2}\n"), "a");
  EXPECT_EQ(repeated_key("a: [x, y, x]\nb: {c: [1, 1], d: '}, c: 1'}\n"), "");
  EXPECT_EQ(repeated_key("p: {in: {type: a}, out: {type: a}, wall: {type: wall}}\n"), "");
  EXPECT_EQ(repeated_key("a: {x: 'it''s', y: \"a\\\"b, x: 1\"}\nb: {x: 1}\n"), "");
  EXPECT_EQ(repeated_key("a: {b: 1  # b: 2\n}\nc: {"), "");
}

}  // namespace
}  // namespace fsi
