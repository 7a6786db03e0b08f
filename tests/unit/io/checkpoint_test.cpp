#include "libfsi/io/checkpoint.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <limits>

#include "libfsi/core/error.hpp"
#include "libfsi/io/crc.hpp"
#include "libfsi/io/file.hpp"
#include "tests/unit/io/support.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

using io::Checkpoint;
using test::Folder;
using test::Sample;

const test::BoxFile& periodic_box() {
  static const test::BoxFile box{.n = {5, 4, 3}, .periodic = {"left", "right"}};
  return box;
}

/// Kind of the Error that `action` throws on every rank, and its sentence; 0 where none.
template <class Action>
std::pair<int, std::string> outcome(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return {static_cast<int>(error.kind()), error.what()};
  }
  return {0, ""};
}

bool exists(const std::string& path) {
  return all_of_ranks(rank() != 0 || std::filesystem::exists(path));
}

/// Collective. Rank 0 changes a file.
template <class Change>
void damage(const std::string& path, Change change) {
  if (rank() == 0) {
    std::string bytes = test::content(path);
    change(bytes);
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  } else {
    test::content(path);
  }
  all_of_ranks(true);
}

TEST(Crc, KnownValueAndParts) {
  const std::string text = "123456789";
  const auto bytes = std::as_bytes(std::span(text));
  EXPECT_EQ(io::crc64(bytes), 0x995dc9bbdf1939faULL);
  EXPECT_EQ(io::crc64(bytes.subspan(4), io::crc64(bytes.first(4))), 0x995dc9bbdf1939faULL);
}

TEST(Checkpoint, GivesBackEveryBit) {
  const Mesh mesh = test::read_box(periodic_box());
  const Folder folder;
  {
    Sample state(mesh);
    state.fill();
    Checkpoint checkpoint(folder.path(), mesh);
    EXPECT_TRUE(checkpoint.write(state.snapshot()));
    EXPECT_EQ(checkpoint.file(), folder / "checkpoint_0001.h5");
  }
  Sample state(mesh);
  Checkpoint(folder.path(), mesh).read(state.snapshot());
  EXPECT_EQ(state.wrong(), 0);
  EXPECT_FALSE(exists(io::temporary_of(folder / "checkpoint_0001.h5")));
}

// HDF5 keeps no attribute of 64 KiB in one piece.
TEST(Checkpoint, KeepsALongText) {
  const Mesh mesh = test::read_box(periodic_box());
  const Folder folder;
  const auto snapshot_of = [](std::string& text) {
    io::Snapshot all("long");
    all.add("text", &text);
    return all;
  };
  for (const std::size_t size : {0, 59'999, 60'000, 60'001, 250'000}) {
    std::string text(size, 'a'), again = "b";
    if (size > 0) text.back() = 'z';
    EXPECT_TRUE(Checkpoint(folder.path(), mesh).write(snapshot_of(text)));
    Checkpoint(folder.path(), mesh).read(snapshot_of(again));
    EXPECT_EQ(again, text) << size;
  }
}

TEST(Checkpoint, TwoAreKeptAndTheNewestIsRead) {
  const Mesh mesh = test::read_box({.n = {3, 2, 0}});
  const Folder folder;
  Sample state(mesh);
  state.fill();
  Checkpoint first(folder.path(), mesh);
  for (int i = 0; i < 3; ++i) {
    state.t = i;
    EXPECT_TRUE(first.write(state.snapshot()));
  }
  Checkpoint later(folder.path(), mesh);
  state.t = 3;
  EXPECT_TRUE(later.write(state.snapshot()));
  EXPECT_FALSE(exists(folder / "checkpoint_0002.h5"));
  EXPECT_TRUE(exists(folder / "checkpoint_0003.h5"));
  state.t = -1;
  later.read(state.snapshot());
  EXPECT_EQ(state.t, 3);
  EXPECT_EQ(later.file(), folder / "checkpoint_0004.h5");
}

TEST(Checkpoint, ADamagedOneIsPassedOver) {
  const Mesh mesh = test::read_box({.n = {3, 2, 0}});
  const Folder folder;
  Sample state(mesh);
  state.fill();
  Checkpoint checkpoint(folder.path(), mesh);
  EXPECT_TRUE(checkpoint.write(state.snapshot()));
  const std::size_t size = test::content(folder / "checkpoint_0001.h5").size();
  // A bit in the head, in HDF5's own data, in the values, at the end; cut; longer; empty.
  using Change = std::function<void(std::string&)>;
  std::vector<Change> changes;
  for (const std::size_t at :
       {std::size_t{3}, std::size_t{300}, std::size_t{520}, size / 2, size - 1})
    changes.push_back([at](std::string& bytes) { bytes[at] = static_cast<char>(bytes[at] ^ 16); });
  changes.push_back([](std::string& bytes) { bytes.resize(bytes.size() / 2); });
  changes.push_back([](std::string& bytes) { bytes += '\0'; });
  changes.push_back([](std::string& bytes) { bytes.clear(); });
  for (const Change& change : changes) {
    const Real old = state.t;
    state.t += 1;
    EXPECT_TRUE(checkpoint.write(state.snapshot()));
    const std::string newest = checkpoint.file();
    damage(newest, change);
    checkpoint.read(state.snapshot());
    EXPECT_EQ(state.t, old);
    EXPECT_NE(checkpoint.file(), newest);
    EXPECT_TRUE(exists(newest + ".damaged"));
  }
  damage(folder / "checkpoint_0001.h5", changes.front());
  const auto [kind, text] = outcome([&] { checkpoint.read(state.snapshot()); });
  EXPECT_EQ(kind, 4);
  EXPECT_NE(text.find("checkpoint_0001.h5"), std::string::npos);
}

TEST(Checkpoint, RefusesWhatIsNotOfThisRun) {
  const Mesh mesh = test::read_box({.n = {3, 2, 0}}), other = test::read_box({.n = {2, 3, 0}});
  const Folder folder;
  Sample state(mesh), elsewhere(other);
  state.fill();
  const auto none = outcome([&] { Checkpoint(folder.path(), mesh).read(state.snapshot()); });
  EXPECT_EQ(none.first, 2);
  EXPECT_NE(none.second.find("there is no checkpoint in"), std::string::npos);
  EXPECT_TRUE(Checkpoint(folder.path(), mesh).write(state.snapshot()));
  const auto read = [&](const Mesh& m, const io::Snapshot& s) {
    return outcome([&] { Checkpoint(folder.path(), m).read(s); });
  };
  const auto mesh_text = read(other, elsewhere.snapshot());
  EXPECT_EQ(mesh_text.first, 2);
  EXPECT_NE(mesh_text.second.find("another mesh"), std::string::npos);
  const auto run_text = read(mesh, state.snapshot("driver=other"));
  EXPECT_EQ(run_text.first, 2);
  EXPECT_NE(run_text.second.find("\"driver=test\""), std::string::npos);
  CellField<Real> more(mesh);
  io::Snapshot longer = state.snapshot();
  longer.add("more", more);
  EXPECT_NE(read(mesh, longer).second.find("holds no field \"more\""), std::string::npos);
  Real extra = 0;
  io::Snapshot with_scalar = state.snapshot();
  with_scalar.add("extra", &extra);
  EXPECT_NE(read(mesh, with_scalar).second.find("holds no \"extra\""), std::string::npos);
}

TEST(Checkpoint, AFailedWriteIsNoEnd) {
  const Mesh mesh = test::read_box({.n = {3, 2, 0}});
  const Folder folder;
  Sample state(mesh);
  state.fill();
  Checkpoint checkpoint(folder / "gone", mesh);
  EXPECT_FALSE(checkpoint.write(state.snapshot()));
  if (rank() == 0) std::filesystem::create_directory(folder / "gone");
  EXPECT_TRUE(checkpoint.write(state.snapshot()));
  EXPECT_EQ(checkpoint.file(), folder / "gone/checkpoint_0001.h5");
}

TEST(Checkpoint, WhatIsNotFiniteIsNotWritten) {
  const Mesh mesh = test::read_box({.n = {3, 2, 0}});
  const Folder folder;
  Sample state(mesh);
  state.fill();
  Checkpoint checkpoint(folder.path(), mesh);
  for (Index c = 0; c < mesh.n_owned; ++c)
    if (mesh.global_id[c] == 4) state.u[c].y = std::numeric_limits<Real>::quiet_NaN();
  const auto [kind, text] = outcome([&] { checkpoint.write(state.snapshot()); });
  EXPECT_EQ(kind, 3);
  EXPECT_EQ(text, "field \"u\" is not finite in cell 4 at (0.5, 0.75, 0)");
  EXPECT_FALSE(exists(folder / "checkpoint_0001.h5"));
}

TEST(Checkpoint, WhatAnInterruptedWriteLeftIsRemoved) {
  const Mesh mesh = test::read_box({.n = {3, 2, 0}});
  const Folder folder;
  const std::string leftover = io::temporary_of(folder / "checkpoint_0001.h5");
  if (rank() == 0) std::ofstream(leftover) << "half";
  all_of_ranks(true);
  Sample state(mesh);
  const Checkpoint checkpoint(folder.path(), mesh);
  EXPECT_FALSE(exists(leftover));
}

}  // namespace
}  // namespace fsi
