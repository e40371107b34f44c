// Tests which events tell of changes, and how long a save takes to settle.
#include "follow/file_watch.hpp"

#include <gmock/gmock.h>
#include <poll.h>

#include "temporary_folder.hpp"

namespace frontend {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using Clock = FileWatch::Clock;

constexpr std::chrono::hours kNever{1};

/// Takes events until one matters.
void wait_for_change(FileWatch& watch) {
  while (!watch.update()) {
    pollfd wait{watch.descriptor(), POLLIN, 0};
    ASSERT_GT(poll(&wait, 1, 60'000), 0) << "no event";
  }
}

/// Checks how long the last change takes to settle, counted from before it.
void expect_settles_after(const FileWatch& watch, Clock::time_point before,
                          std::chrono::milliseconds settle) {
  ASSERT_TRUE(watch.settled_at());
  EXPECT_GE(*watch.settled_at(), before + settle);
  EXPECT_LE(*watch.settled_at(), Clock::now() + settle);
}

TEST(FileWatch, TheNetworkIsPolled) {
  for (const long local : {0xEF53L, 0x01021994L, 0x9123683EL, 0x58465342L, 0x794C7630L}) {
    EXPECT_TRUE(FileWatch::tells_of_every_change(local));  // ext4, tmpfs, btrfs, xfs, overlay
  }
  for (const long network : {0x6969L, 0xFF534D42L, 0xFE534D42L, 0x65735546L, 0x01021997L, 0L}) {
    EXPECT_FALSE(FileWatch::tells_of_every_change(network));  // NFS, SMB, SMB 2, FUSE, 9P, unknown
  }
}

TEST(FileWatch, AFileSystemThatDoesNotTellIsPolled) {
  FileWatch watch(false, kNever);
  watch.set_files({"/proc/self/status"});
  EXPECT_TRUE(watch.next_look());
}

TEST(FileWatch, WhatIsThereNeedsNoLook) {
  const TemporaryFolder folder;
  FileWatch watch(false, kNever);
  watch.set_files({folder.write("a", "x")});
  EXPECT_GE(watch.descriptor(), 0);
  EXPECT_FALSE(watch.next_look());
  EXPECT_FALSE(watch.settled_at());
  watch.set_files({folder / "a", folder / "b"});  // missing: it may be about to be mounted
  EXPECT_TRUE(watch.next_look());
}

TEST(FileWatch, WhatIsClosedSettlesAtOnce) {
  const TemporaryFolder folder;
  FileWatch watch(false, kNever);
  watch.set_files({folder.write("a", "x")});
  auto before = Clock::now();
  folder.write("a", "y");
  wait_for_change(watch);
  expect_settles_after(watch, before, FileWatch::kSettleClosed);
  watch.forget_changes();
  before = Clock::now();
  fs::rename(folder.write("b", "z"), folder / "a");
  wait_for_change(watch);
  expect_settles_after(watch, before, FileWatch::kSettleClosed);
}

TEST(FileWatch, WhatIsOpenEmptyOrMissingSettlesLater) {
  const TemporaryFolder folder;
  FileWatch watch(false, kNever);
  watch.set_files({folder.write("a", "x")});
  auto before = Clock::now();
  std::ofstream file(folder / "a", std::ios::app);
  file << 'y' << std::flush;
  wait_for_change(watch);
  expect_settles_after(watch, before, FileWatch::kSettleOpen);
  file.close();
  before = Clock::now();
  wait_for_change(watch);
  expect_settles_after(watch, before, FileWatch::kSettleClosed);
  before = Clock::now();
  folder.write("a", "");
  wait_for_change(watch);
  expect_settles_after(watch, before, FileWatch::kSettleMissing);
  before = Clock::now();
  fs::remove(folder / "a");
  wait_for_change(watch);
  expect_settles_after(watch, before, FileWatch::kSettleMissing);
  before = Clock::now();
  folder.write("a", "z");
  wait_for_change(watch);
  expect_settles_after(watch, before, FileWatch::kSettleClosed);
  watch.forget_changes();
  EXPECT_FALSE(watch.settled_at());
}

TEST(FileWatch, TheLastFileToSettleCounts) {
  const TemporaryFolder folder;
  FileWatch watch(false, kNever);
  watch.set_files({folder.write("a", "x"), folder.write("b", "x")});
  const auto before = Clock::now();
  fs::remove(folder / "a");
  folder.write("b", "y");
  wait_for_change(watch);
  expect_settles_after(watch, before, FileWatch::kSettleMissing);
}

TEST(FileWatch, WhatWasReadBeforeItWasWatchedMayHaveChanged) {
  const TemporaryFolder folder;
  const std::string old = folder.write("old", "x");
  const int64_t changed_ns = language::FileSignature(old).changed_ns();
  FileWatch watch(false, kNever);
  watch.set_files({old}, changed_ns + 1'000'000'000);
  EXPECT_FALSE(watch.update());
  FileWatch later(false, kNever);
  later.set_files({old}, changed_ns);
  EXPECT_TRUE(later.update());
  EXPECT_TRUE(later.settled_at());
}

TEST(FileWatch, NothingStaysWatchedInVain) {
  const TemporaryFolder folder;
  FileWatch watch(false, kNever);
  const auto watches = [&watch] {
    std::ifstream info("/proc/self/fdinfo/" + std::to_string(watch.descriptor()));
    int count = 0;
    for (std::string line; std::getline(info, line);) count += line.starts_with("inotify");
    return count;
  };
  watch.set_files({folder.write("a", "x")});
  EXPECT_GT(watches(), 1);
  watch.set_files({});
  EXPECT_EQ(watches(), 0);
}

TEST(FileWatch, PermissionsCount) {
  const TemporaryFolder folder;
  FileWatch watch(false, kNever);
  watch.set_files({folder.write("a", "x")});
  fs::permissions(folder / "a", fs::perms::none);
  wait_for_change(watch);
}

TEST(FileWatch, AnEventThatChangesNothingIsNone) {
  const TemporaryFolder folder;
  FileWatch watch(false, kNever);
  watch.set_files({folder.write("a", "x"), folder / "missing/b"});
  fs::create_directory(folder / "missing");
  EXPECT_FALSE(watch.update());
  fs::create_hard_link(folder / "a", folder / "c");
  EXPECT_FALSE(watch.update());
  folder.write("missing/b", "x");  // its folder is watched by now
  wait_for_change(watch);
}

std::vector<std::string> lookups(const std::string& path) {
  std::vector<std::string> result;
  visit_lookups(path, [&](const PathLookup& lookup) {
    result.push_back(lookup.folder + " " + lookup.name + (lookup.is_last ? " last" : ""));
  });
  return result;
}

TEST(VisitLookups, FollowsLinksAndStopsAtWhatIsMissing) {
  const TemporaryFolder folder;
  const std::string top = fs::canonical(folder.path());
  const std::size_t above = lookups(top).size();
  const auto of = [&](const std::string& name) {
    std::vector<std::string> all = lookups(top + "/" + name);
    return std::vector<std::string>(all.begin() + static_cast<std::ptrdiff_t>(above), all.end());
  };
  folder.write("a", "");
  fs::create_directory(top + "/d");
  fs::create_symlink("../a", top + "/d/link");
  fs::create_symlink(top + "/d/link", top + "/far");
  fs::create_symlink("loop", top + "/loop");
  EXPECT_THAT(of("a"), ElementsAre(top + " a last"));
  EXPECT_THAT(of("none/a"), ElementsAre(top + " none"));
  EXPECT_THAT(of("./d/../d//link"),
              ElementsAre(top + " d", top + " d", top + "/d link last", top + " a last"));
  EXPECT_EQ(of("far").back(), top + " a last");
  EXPECT_EQ(of("far").front(), top + " far last");
  EXPECT_LT(of("loop").size(), 100u);
}

}  // namespace
}  // namespace frontend
