#include "libfsi/io/file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <optional>

#include "libfsi/core/error.hpp"
#include "tests/unit/io/support.hpp"

namespace fsi {
namespace {

using io::Durable;
using io::replace_file;
using test::Folder;

io::Bytes bytes(const std::string& text) { return std::as_bytes(std::span(text)); }

TEST(File, TheNewContentReplacesTheOld) {
  const Folder folder;
  const std::string path = folder / "file", one = "one", two = "two", three = "three";
  if (rank() == 0) {
    EXPECT_EQ(replace_file(path, {bytes(one)}, Durable::no), "");
    EXPECT_EQ(replace_file(path, {bytes(two), bytes(three)}, Durable::yes), "");
  }
  EXPECT_EQ(test::content(path), "twothree");
}

TEST(File, AFullDiskLeavesTheOldContent) {
  const Folder folder;
  if (rank() == 0) {
    const std::string path = folder / "file", old = "old", big(1 << 20, 'x');
    EXPECT_EQ(replace_file(path, {bytes(old)}, Durable::yes), "");
    // A limit on the size of files stands for a full disk.
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{1 << 16, before.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    EXPECT_EQ(replace_file(path, {bytes(big)}, Durable::yes), "File too large");
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_FALSE(std::filesystem::exists(io::temporary_of(path)));
  }
  EXPECT_EQ(test::content(folder / "file"), rank() >= 0 ? "old" : "");
}

TEST(File, AMissingFolderIsNamedByTheSystem) {
  const Folder folder;
  const std::string text = "text";
  EXPECT_EQ(replace_file(folder / "none/file", {bytes(text)}, Durable::no),
            "No such file or directory");
}

TEST(Lock, OneRunHoldsADirectory) {
  const Folder folder;
  std::optional<io::Lock> first(std::in_place, folder.path());
  try {
    const io::Lock second(folder.path());
    ADD_FAILURE() << "two locks";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_NE(std::string(error.what()).find("in use by another run"), std::string::npos);
  }
  first.reset();
  EXPECT_NO_THROW(io::Lock{folder.path()});
}

}  // namespace
}  // namespace fsi
