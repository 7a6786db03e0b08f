// Numbers from csv files: what is read, and what is refused with which words.

#include "libfsi/run/table_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "libfsi/core/error.hpp"

namespace fsi {
namespace {

/// A file of that text, gone at the end of its scope.
struct File {
  explicit File(const std::string& text)
      : path(std::filesystem::temp_directory_path() /
             ("fsi_rows_" + std::to_string(getpid()) + ".csv")) {
    std::ofstream(path) << text;
  }
  ~File() { std::filesystem::remove(path); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  std::filesystem::path path;
};

TEST(Series, JoinsItsRowsByLinesAndComesAgain) {
  const File file("time,flow_rate\n0,1\n0.5,3\n0.75,2\n");
  const OfTime once = series(file.path), again = series(file.path, 1);
  for (const auto& [t, value] :
       {std::pair{-1.0, 1.0}, {0.25, 2.0}, {0.5, 3.0}, {0.7, 2.2}, {9.0, 2.0}})
    EXPECT_NEAR(once(t), value, 1e-14) << t;
  for (const auto& [t, value] :
       {std::pair{0.25, 2.0}, {3.25, 2.0}, {0.875, 1.5}, {7.875, 1.5}, {2.0, 1.0}, {-0.125, 1.5}})
    EXPECT_NEAR(again(t), value, 1e-13) << t;
}

// The extremes of a pulse between two times that both lie beside it.
TEST(Series, KnowsItsRangeBetweenTwoTimes) {
  const File file("t,flow_rate\n0,1\n1,1\n1.1,5\n1.2,1\n1.6,-2\n2,1\n");
  const OfTime once = series(file.path), again = series(file.path, 2);
  EXPECT_EQ(once.range(0.2, 3), (OfTime::Range{-2, 5}));
  EXPECT_EQ(once.range(0.2, 0.9), (OfTime::Range{1, 1}));
  EXPECT_EQ(once.range(2, 9), (OfTime::Range{1, 1}));
  EXPECT_EQ(again.range(6.5, 7.15), (OfTime::Range{1, 5}));
  EXPECT_EQ(again.range(0, 100), (OfTime::Range{-2, 5}));
  EXPECT_EQ(step_of(once, 0, 9), 9 * std::pow(0.75, 8)) << "it does not leap over the pulse";
}

TEST(Series, WhatIsNoTableIsRefused) {
  EXPECT_THROW(series("there is no such file.csv"), Error);
  EXPECT_THROW(series(File("0,1\n0.5\n").path), Error);
  try {
    series(File("0,1\n3,2\n2,2\n").path);
    ADD_FAILURE() << "times that fall";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("from row to row, but 2 follows 3"),
              std::string::npos);
  }
  EXPECT_THROW(series(File("time,value\n").path), Error);
  EXPECT_THROW(series(File("0,1\n2,2\n").path, 1), Error);
}

TEST(Table, AHeaderIsReadWhateverItsDress) {
  for (const char* text : {"0,1\n2,3\n", "t,flow_rate\n0,1\n2,3\n",
                           "# a pulse\n\nTime [s], Flow rate (mm3/s)\r\n0,1\r\n2,3\r\n",
                           "\xef\xbb\xbf\"time\";\"Q\"\n0;1\n2;3\n", "t q\n0 1\n\n# later\n2\t3\n",
                           "T,VALUE\n0,1\n2,3"}) {
    const File file(text);
    const auto rows = read_rows(file.path, {{"t", "time"}, {"flow_rate", "q", "value"}});
    ASSERT_EQ(rows.size(), 2U) << text;
    EXPECT_EQ(rows[1], (std::vector<Real>{2, 3})) << text;
  }
}

/// The sentence that refuses a table of t and flow_rate with that text.
std::string refusal(const std::string& text) {
  const File file(text);
  try {
    series(file.path, 0, {"flow_rate", "value"});
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    return error.what();
  }
  return "";
}

TEST(Table, WhatIsNotMeantIsNamed) {
  for (const auto& [text, words] :
       {std::pair{"flow_rate,t\n1,0\n", "column 1 is called \"flow_rate\"; expected: t or time"},
        {"t,pressure\n0,1\n", "column 2 is called \"pressure\""},
        {"t,flow\n0,1\n", "flow_rate or value (a unit in brackets behind a name"},
        {"t\n0,1\n", "names 1 columns"},
        {"t,value\nflow_rate,t\n0,1\n", "\"flow_rate,t\" is not 2 numbers"},
        {"t,value\n0,1,\n1,2,3\n", "\"1,2,3\" is not 2 numbers"},
        {"0,1\nnan,2\n", "\"nan,2\" is not 2 numbers"}})
    EXPECT_NE(refusal(text).find(words), std::string::npos) << refusal(text);
}

TEST(Series, DoubtsATableInAnotherUnitOfTime) {
  const std::vector<std::vector<Real>> rows{{0, 1}, {300, 4}, {800, 1}};
  for (const Real period : {0, 800})
    EXPECT_NE(doubt_about(rows, period, 0.8).find("from 0 to 800, and the run to t = 0.8"),
              std::string::npos);
  EXPECT_EQ(doubt_about(rows, 800, 2400), "");
  EXPECT_EQ(doubt_about({{0, 1}, {800, 1}}, 0, 0.8), "") << "nothing varies";
}

TEST(Series, DoubtsALastRowThatDoesNotRepeatTheFirst) {
  const std::vector<std::vector<Real>> rows{{0, 1}, {0.5, 3}, {1, 2}};
  EXPECT_NE(doubt_about(rows, 1, 4).find("jump from 2 to 1 after each period of 1"),
            std::string::npos);
  EXPECT_EQ(doubt_about(rows, 1, 0.9), "") << "the run ends before";
  EXPECT_NE(doubt_about({{0.5, 1}, {1, 3}, {1.5, 2}}, 1, 0.9), "")
      << "the table begins after t = 0";
  EXPECT_EQ(doubt_about(rows, 1.2, 4), "") << "a line leads back";
  EXPECT_EQ(doubt_about(rows, 0, 4), "") << "no period";
}

}  // namespace
}  // namespace fsi
