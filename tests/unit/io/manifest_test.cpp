#include "libfsi/io/manifest.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "libfsi/core/error.hpp"
#include "tests/unit/io/support.hpp"

namespace fsi {
namespace {

using test::Folder;

TEST(Manifest, SummaryIsJson) {
  io::Summary summary;
  summary.case_name = "a \"case\"\n\t\\";
  summary.status = "complete";
  summary.version = "1.2.3", summary.commit = "abc";
  summary.cells = 100, summary.steps = 10, summary.wall_seconds = 2;
  summary.solid_volume_drift = std::numeric_limits<Real>::quiet_NaN();
  summary.phases = {{"pressure", 1.5}, {"vof", 0.25}};
  summary.limits = {{"elastic", 7}};
  EXPECT_EQ(io::json(summary),
            "{\n  \"case\": \"a \\\"case\\\"  \\\\\",\n  \"status\": \"complete\",\n"
            "  \"version\": \"1.2.3\",\n  \"commit\": \"abc\",\n"
            "  \"message\": \"\",\n  \"cells\": 100,\n  \"ranks\": 1,\n  \"steps\": 10,\n"
            "  \"t\": 0,\n  \"rejected_steps\": 0,\n  \"wall_seconds\": 2,\n"
            "  \"us_per_cell_step\": 2000,\n  \"phases\": {\"pressure\": 1.5, \"vof\": 0.25},\n"
            "  \"limits\": {\"elastic\": 7},\n  \"rejections\": {},\n"
            "  \"solid_volume_drift\": null,\n  \"divergence_max\": 0\n}\n");
}

TEST(Manifest, ARestartTimesItsOwnSteps) {
  io::Summary summary;
  summary.cells = 100, summary.steps = 30, summary.first_step = 20, summary.wall_seconds = 2;
  EXPECT_NE(io::json(summary).find("\"us_per_cell_step\": 2000,"), std::string::npos);
}

TEST(Manifest, TextReplacesTheOldOne) {
  const Folder folder;
  io::make_directory(folder / "a/b");
  io::write_text(folder / "a/b/run.yaml", "one");
  io::write_text(folder / "a/b/run.yaml", "two");
  EXPECT_EQ(test::content(folder / "a/b/run.yaml"), "two");
}

TEST(Manifest, WhatCannotBeWrittenIsNamed) {
  const Folder folder;
  io::write_text(folder / "file", "");
  for (const auto& action : {+[](const std::string& path) { io::make_directory(path); },
                             +[](const std::string& path) { io::write_text(path, ""); }}) {
    try {
      action(folder / "file/below");
      ADD_FAILURE() << "written";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::io);
      EXPECT_NE(std::string(error.what()).find("Not a directory"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace fsi
