#include "libfsi/io/table.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "libfsi/core/error.hpp"
#include "tests/unit/io/support.hpp"

namespace fsi {
namespace {

using io::Table;
using test::content;
using test::Folder;

TEST(Table, HeaderOnceAndEveryDigit) {
  const Folder folder;
  Table table(folder / "a.csv", {"t", "x"});
  table.row(std::vector<Real>{0, 0.1});
  table.row(std::vector<Real>{1, -1e-300});
  EXPECT_EQ(content(folder / "a.csv"), "t,x\n0,0.10000000000000001\n1,-1e-300\n");
}

TEST(Table, ANewRunStartsANewFile) {
  const Folder folder;
  Table(folder / "a.csv", {"t"}).row(std::vector<Real>{1});
  const Table again(folder / "a.csv", {"t"});
  EXPECT_EQ(content(folder / "a.csv"), "t\n");
}

TEST(Table, ARestartDropsWhatLiesBeyondItsTime) {
  const Folder folder;
  {
    Table table(folder / "a.csv", {"t", "x"});
    for (const Real t : {0.0, 0.1, 0.2, 0.30000000000000004, 0.4})
      table.row(std::vector<Real>{t, 10 * t});
  }
  Table table(folder / "a.csv", {"t", "x"}, 0.3);
  table.row(std::vector<Real>{0.35, 7});
  EXPECT_EQ(content(folder / "a.csv"),
            "t,x\n0,0\n0.10000000000000001,1\n0.20000000000000001,2\n"
            "0.30000000000000004,3.0000000000000004\n0.34999999999999998,7\n");
}

TEST(Table, ARowCutByAKillIsDropped) {
  const Folder folder;
  if (rank() == 0) std::ofstream(folder / "a.csv") << "t,x\n0,1\n0.1,0.12345";
  all_of_ranks(true);
  const Table table(folder / "a.csv", {"t", "x"}, 5);
  EXPECT_EQ(content(folder / "a.csv"), "t,x\n0,1\n");
}

TEST(Table, ARestartWithoutAFileMakesOne) {
  const Folder folder;
  const Table table(folder / "a.csv", {"t", "x"}, 5);
  EXPECT_EQ(content(folder / "a.csv"), "t,x\n");
}

TEST(Table, OtherColumnsAreNotMixed) {
  const Folder folder;
  { const Table table(folder / "a.csv", {"t", "x"}); }
  EXPECT_THROW(Table(folder / "a.csv", {"t", "y"}, 1), Error);
  EXPECT_EQ(content(folder / "a.csv"), "t,x\n");
}

TEST(Table, WhatIsNotFiniteIsNotWritten) {
  const Folder folder;
  Table table(folder / "a.csv", {"t", "x"});
  for (const Real bad :
       {std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity()}) {
    try {
      table.row(std::vector<Real>{0, bad});
      ADD_FAILURE() << "written";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::numerics);
      EXPECT_NE(std::string(error.what()).find("column \"x\""), std::string::npos);
    }
  }
  EXPECT_EQ(content(folder / "a.csv"), "t,x\n");
}

TEST(Table, ARowHasAValueForEachColumn) {
  const Folder folder;
  Table table(folder / "a.csv", {"t", "x"});
  for (const std::size_t count : {1, 3}) {
    try {
      table.row(std::vector<Real>(count, 0));
      ADD_FAILURE() << "written";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::internal);
      EXPECT_EQ(error.what(), "a row of \"" + (folder / "a.csv") + "\" has " +
                                  std::to_string(count) + " values for the 2 columns t, x");
    }
  }
  EXPECT_EQ(content(folder / "a.csv"), "t,x\n");
}

TEST(Table, ANameThatNobodyCanReadIsRefused) {
  const Folder folder;
  const auto sentence = [&](const std::vector<std::string>& columns) {
    try {
      const Table table(folder / "a.csv", columns);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(sentence({"t", "mean speed", "u'v'"}), "");
  for (const char* name : {"", " ", "a,b", "\"a", "a\nb", "a\r", "x ", "\tx"}) {
    const std::string said = sentence({"t", name});
    EXPECT_NE(said.find("cannot be the name of a column of \"" + (folder / "a.csv")),
              std::string::npos)
        << name << ": " << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }
  EXPECT_NE(sentence({"t", "x", "t"}).find("two columns \"t\""), std::string::npos);
}

TEST(Table, AMissingFolderIsAnError) {
  const Folder folder;
  try {
    const Table table(folder / "none/a.csv", {"t"});
    ADD_FAILURE() << "opened";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos);
  }
}

}  // namespace
}  // namespace fsi
