// Tests as many saves as in an hour: nothing grows, nothing is left over, and the last one is
// shown.
#include <gtest/gtest.h>

#include "designs.hpp"
#include "follow/saves.hpp"
#include "live_window.hpp"
#include "support/full_run.hpp"

namespace window_test {
namespace {

constexpr int kSaves = 1000;
/// From this save on, everything that is kept for good, and the allocator's own room, has been
/// allocated.
constexpr int kSettled = 200;

/// The memory by which heaps of several threads may vary at any time. A picture of the window has
/// 0.4 MB: keeping one in every save, or in every tenth, would take far more.
constexpr std::size_t kLeeway_bytes = std::size_t{8} << 20;

#if defined(SCADRAY_SANITIZED)
constexpr bool kMemoryIsMeasured = false;  // freed memory is kept, to find its use; leaks are found
#else
constexpr bool kMemoryIsMeasured = true;
#endif

struct Usage {
  std::size_t bytes, descriptors;
};

Usage usage_of(const Process& process) {
  return {resident_bytes(process.pid()), open_descriptors(process.pid())};
}

using ManySaves = LiveWindow;

TEST_F(ManySaves, LeaveNothingBehind) {
  // The test waits for every so many pictures; other saves overtake each other.
  const int rest = test_support::full_run() ? 1 : 8;
  std::cout << kSaves << " saves; every " << rest << ". is waited for\n";
  const std::string design = folder_.write("a.csg", row_of(1));
  open(design, {"--camera=10,0,0,55,0,25,100"});
  next();
  Usage settled{};
  for (int i = 1; i <= kSaves; ++i) {
    const int count = 1 + i % 50;
    frontend::kSaves[static_cast<std::size_t>(i) % std::size(frontend::kSaves)].write(
        folder_, "a.csg", row_of(count));
    if (i % rest == 0) next_of(static_cast<std::size_t>(count));
    if (i == kSettled) settled = usage_of(program());
  }
  folder_.write("a.csg", row_of(60));
  expect_drawn(design, next_of(60));
  const Usage last = usage_of(program());
  EXPECT_LE(last.descriptors, settled.descriptors);
  if (kMemoryIsMeasured) {
    EXPECT_LE(last.bytes, settled.bytes + kLeeway_bytes);
  }
  std::cout << "resident: " << (settled.bytes >> 10) << " KiB after " << kSettled << " saves, "
            << (last.bytes >> 10) << " KiB in the end\n";
  EXPECT_EQ(children(program().pid()), 0u);
  key("ctrl+q");
  EXPECT_EQ(program().wait(), 0);
  EXPECT_EQ(errors(), "");
}

/// The same with a .scad, and a program in openscad's place.
TEST_F(ManySaves, LeaveNoExportBehind) {
  const frontend::Environment openscad("OPENSCAD", folder_.script("openscad",
                                                                  "for path; do :; done\n"
                                                                  "cat \"$path\"\n"));
  const int saves = test_support::full_run() ? kSaves : kSaves / 5;
  std::cout << saves << " saves\n";
  const std::string design = folder_.write("a.scad", row_of(1));
  open(design, {"--camera=10,0,0,55,0,25,100", "--evaluator=openscad"});
  next();
  for (int i = 1; i <= saves; ++i) {
    const int count = 1 + i % 50;
    folder_.write("a.scad", row_of(count));
    if (i % 20 == 0) next_of(static_cast<std::size_t>(count));
  }
  folder_.write("a.scad", row_of(60));
  next_of(60);
  EXPECT_TRUE(wait_until([this] { return children(program().pid()) == 0; }));
  key("ctrl+q");
  EXPECT_EQ(program().wait(), 0);
  EXPECT_EQ(errors(), "");
}

}  // namespace
}  // namespace window_test
