// Tests what the window remembers from run to run, and that nothing depends on its file.
#include "memory.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "frontend/render_settings.hpp"
#include "temporary_folder.hpp"

namespace window {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pointee;

class MemoryTest : public testing::Test {
 protected:
  const std::string path() const { return folder_ / "scadray/window"; }
  frontend::TemporaryFolder folder_;
  const Memory::Clock::time_point now_ = Memory::Clock::now();
};

TEST_F(MemoryTest, WritesWhatHasChangedOnceItHasSettled) {
  Memory memory(path());
  memory.note({{"axes", "off"}, {"edges", "off"}}, now_);
  EXPECT_FALSE(memory.due());
  memory.note({{"axes", "on"}, {"edges", "off"}}, now_);
  ASSERT_TRUE(memory.due());
  EXPECT_GT(*memory.due(), now_);
  EXPECT_LE(*memory.due(), now_ + std::chrono::seconds(2));
  memory.write();
  EXPECT_FALSE(memory.due());
  EXPECT_EQ(folder_.read("scadray/window"), "axes=on\n");
  EXPECT_THAT(Memory(path()).find("axes"), Pointee(std::string("on")));
  EXPECT_EQ(Memory(path()).find("edges"), nullptr);
}

TEST_F(MemoryTest, SeveralWindowsKeepEachOthersChanges) {
  Memory one(path()), two(path());
  for (Memory* memory : {&one, &two}) memory->note({{"axes", "off"}, {"edges", "off"}}, now_);
  one.note({{"axes", "on"}}, now_);
  one.note_design("/a.scad", now_);
  two.note({{"edges", "on"}}, now_);
  two.note_design("/b.scad", now_);
  one.write();
  two.write();
  const Memory next(path());
  EXPECT_THAT(next.find("axes"), Pointee(std::string("on")));
  EXPECT_THAT(next.find("edges"), Pointee(std::string("on")));
  EXPECT_THAT(next.recent(), ElementsAre("/b.scad", "/a.scad"));
}

TEST_F(MemoryTest, OneWindowHasThePosition) {
  {
    Memory one(path());
    one.note_design("/a", now_);
    one.write();  // makes the folder
    const Memory two(path());
    EXPECT_TRUE(one.is_only_window());
    EXPECT_FALSE(two.is_only_window());
  }
  EXPECT_TRUE(Memory(path()).is_only_window());
}

TEST_F(MemoryTest, KeepsTheLatestDesignsOnce) {
  Memory memory(path());
  for (int i = 0; i < 12; ++i) memory.note_design("/" + std::to_string(i), now_);
  memory.note_design("/5", now_);
  memory.note_design("/a\nb", now_);
  memory.write();
  EXPECT_THAT(Memory(path()).recent(),
              ElementsAre("/5", "/11", "/10", "/9", "/8", "/7", "/6", "/4", "/3", "/2"));
}

TEST_F(MemoryTest, ForgetsAllButTheDesignsWhereItIsTold) {
  {
    Memory memory(path());
    for (const char* state : {"off", "on"}) memory.note({{"axes", state}}, now_);
    memory.note_design("/a", now_);
    memory.write();
  }
  Memory memory(path(), true);
  EXPECT_EQ(memory.find("axes"), nullptr);
  EXPECT_THAT(memory.recent(), ElementsAre("/a"));
  memory.write();
  EXPECT_EQ(folder_.read("scadray/window"), "recent=/a\n");
}

TEST_F(MemoryTest, ADamagedFileCostsNothing) {
  std::filesystem::create_directories(folder_ / "scadray");
  const std::string tail = "axes=on\nrecent=relative\nrecent=/a\n";
  for (const std::string& text : {std::string("\0\xff=1\n\n=\nno line\nAB=2\n", 21) + tail, tail}) {
    folder_.write("scadray/window", text);
    Memory memory(path());
    EXPECT_THAT(memory.find("axes"), Pointee(std::string("on")));
    EXPECT_THAT(memory.recent(), ElementsAre("/a"));
    memory.note_design("/b", now_);
    memory.write();
    EXPECT_EQ(folder_.read("scadray/window"), "axes=on\nrecent=/b\nrecent=/a\n");
  }
  folder_.write("scadray/window", std::string(1 << 20, '\n') + tail);
  EXPECT_THAT(Memory(path()).recent(), IsEmpty());
}

TEST_F(MemoryTest, WhatIsNoFileIsLeftAlone) {
  std::filesystem::create_directories(folder_ / "scadray");
  ASSERT_EQ(mkfifo(path().c_str(), 0600), 0);
  for (const std::string& place :
       {path(), folder_.write("file", "") + "/scadray/window", std::string()}) {
    Memory memory(place);
    memory.note_design("/b", now_);
    memory.write();
    EXPECT_THAT(Memory(place).recent(), IsEmpty()) << place;
  }
  EXPECT_TRUE(std::filesystem::is_fifo(path()));
}

TEST_F(MemoryTest, ItsPlaceIsTheXdgState) {
  const frontend::Environment home("HOME", "/h");
  {
    const frontend::Environment state("XDG_STATE_HOME", "/s");
    EXPECT_EQ(memory_path(), "/s/scadray/window");
  }
  const frontend::Environment relative("XDG_STATE_HOME", "s");
  EXPECT_EQ(memory_path(), "/h/.local/state/scadray/window");
  const frontend::Environment none("HOME", "");
  EXPECT_EQ(memory_path(), "");
}

class HabitsTest : public MemoryTest {
 protected:
  State restored(const frontend::Options& options = {}) const {
    State state(options);
    restore_habits(Memory(path()), options.given, state);
    return state;
  }
};

TEST_F(HabitsTest, AreRestored) {
  State state{frontend::Options{}};
  Memory memory(path());
  memory.note(habits_of(state), now_);
  for (const Command command :
       {Command::kAxes, Command::kEdges, Command::kOrthographic, Command::kPhongShading,
        Command::kStatus, Command::kParameters, Command::kGrid, Command::kOrientation}) {
    state.apply(command);
  }
  state.look.samples = 16;
  state.look.scheme = *frontend::find_color_scheme("Tomorrow Night");
  memory.note(habits_of(state), now_);
  memory.write();
  EXPECT_EQ(habits_of(restored()), habits_of(state));
  EXPECT_EQ(restored().notice, "");
  // What is seen of one design is not a habit.
  state.apply(Command::kDepth);
  state.apply(Command::kSectionX);
  EXPECT_EQ(habits_of(restored()), habits_of(state));
}

TEST_F(HabitsTest, TheCommandLineWins) {
  std::filesystem::create_directories(folder_ / "scadray");
  folder_.write("scadray/window",
                "axes=on\northographic=on\nphong=on\nphong_shadows=on\ndepth_order=on\nsamples="
                "16\ncolours=Metallic\nplace=off\n");
  frontend::Options options;
  options.given = {true, true, true, true, true, true};
  const State state = restored(options);
  State plain{frontend::Options{}};
  plain.shows_place = false;
  plain.overlays.grid = false;
  EXPECT_EQ(habits_of(state), habits_of(plain));
}

TEST_F(HabitsTest, ValuesThatAreNoneAreNotTaken) {
  std::filesystem::create_directories(folder_ / "scadray");
  folder_.write("scadray/window",
                "axes=perhaps\nsamples=65\ncolours=None\nsize=0 10\nposition=1\nmaximized=1\n");
  EXPECT_EQ(habits_of(restored()), habits_of(State{frontend::Options{}}));
  const Placement placement = remembered_placement(Memory(path()), std::nullopt);
  EXPECT_EQ(placement.size, (Size{1024, 768}));
  EXPECT_EQ(placement.position, std::nullopt);
  EXPECT_FALSE(placement.is_maximized);
}

TEST_F(HabitsTest, ThePlacementIsRestored) {
  Memory memory(path());
  const Placement moved{{640, 480}, {{-30, 20}}, false};
  memory.note(values_of({{10, 10}, {{0, 0}}, false}, true), now_);
  memory.note(values_of(moved, true), now_);
  memory.write();
  const Placement second = remembered_placement(Memory(path()), std::nullopt);
  EXPECT_EQ(second.size, moved.size);
  EXPECT_EQ(second.position, std::nullopt) << "another window is open";
  memory.note(values_of({{1280, 1024}, {{0, 0}}, true}, true), now_);
  memory.write();
  const Placement maximized = remembered_placement(Memory(path()), std::nullopt);
  EXPECT_TRUE(maximized.is_maximized);
  EXPECT_EQ(maximized.size, moved.size);
  const Placement given = remembered_placement(memory, Size{300, 200});
  EXPECT_EQ(given.size, (Size{300, 200}));
  EXPECT_FALSE(given.is_maximized);
}

}  // namespace
}  // namespace window
