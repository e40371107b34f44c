// Tests following a design: every way in which editors save, files that come and go, and what is
// reported.
#include "frontend/design_follower.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "follow/followed.hpp"
#include "follow/saves.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

struct SaveCase {
  Save save;
  bool polls;
};

class EveryWayOfSaving : public testing::TestWithParam<SaveCase> {
 protected:
  FollowOptions options() const { return GetParam().polls ? by_polling() : by_inotify(); }
  TemporaryFolder folder_;
};

TEST_P(EveryWayOfSaving, ShowsTheLastContent) {
  Followed design(folder_.write("a.csg", spheres(1)), options());
  design.next_of(1);
  for (int i = 2; i < 12; ++i) {
    const auto before = std::chrono::steady_clock::now();
    GetParam().save.write(folder_, "a.csg", spheres(i));
    const DesignVersion version = design.next_of(static_cast<uint32_t>(i));
    EXPECT_GE(version.noticed, before);
    EXPECT_LE(version.noticed, std::chrono::steady_clock::now());
  }
  design.wait_until_idle();
}

TEST_P(EveryWayOfSaving, MissingValidBrokenValid) {
  Followed design(folder_ / "a.csg", options());
  EXPECT_THAT(design.next_error().error,
              AllOf(StartsWith(folder_ / "a.csg: error: "), HasSubstr("No such file")));
  folder_.write("a.csg", spheres(2));
  const DesignVersion valid = design.next_of(2);
  GetParam().save.write(folder_, "a.csg", "sphere(r = 1);\nspher(r = 1);\n");
  const DesignVersion broken = design.next([](const DesignVersion& version) {
    return version.error.find("spher") != std::string::npos;
  });
  EXPECT_THAT(broken.error, StartsWith(folder_ / "a.csg:2:1: error: unknown node"));
  EXPECT_EQ(broken.design, nullptr);
  GetParam().save.write(folder_, "a.csg", spheres(3));
  EXPECT_EQ(design.next_of(3).error, "");
  fs::remove(folder_ / "a.csg");
  EXPECT_THAT(design.next_error().error, HasSubstr("No such file"));
  folder_.write("a.csg", spheres(3));
  design.next_of(3);
}

std::vector<SaveCase> save_cases() {
  std::vector<SaveCase> cases;
  for (const Save& save : kSaves) {
    for (const bool polls : {false, true}) cases.push_back({save, polls});
  }
  return cases;
}
INSTANTIATE_TEST_SUITE_P(Follow, EveryWayOfSaving, testing::ValuesIn(save_cases()),
                         [](const auto& test) {
                           return std::string(test.param.save.name) +
                                  (test.param.polls ? "Polled" : "");
                         });

/// Runs with inotify and with polling.
class Follow : public testing::TestWithParam<bool> {
 protected:
  FollowOptions options() const { return GetParam() ? by_polling() : by_inotify(); }
  TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(By, Follow, testing::Bool(), [](const auto& test) {
  return std::string(test.param ? "Polling" : "Inotify");
});

TEST_P(Follow, ImportedFilesAreFollowed) {
  const std::string path = folder_.write("a.csg", "import(\"part.off\"); sphere();");
  Followed design(path, options());
  const DesignVersion missing = design.next();
  EXPECT_THAT(missing.messages, ElementsAre(HasSubstr("Can't open import file")));
  EXPECT_THAT(missing.files, ElementsAre(path, folder_ / "part.off"));
  EXPECT_EQ(missing.design->scene.primitives.size(), 1u);
  const auto off = [](const std::string& z) {
    return "OFF 4 4 0\n0 0 0\n3 0 0\n0 4 0\n0 0 " + z + "\n3 2 1 0\n3 1 3 0\n3 3 2 0\n3 2 3 1\n";
  };
  for (const char* z : {"5", "7"}) {
    folder_.write("part.off", off(z));
    const DesignVersion found = design.next([&](const DesignVersion& version) {
      return version.design && version.design->view_box.max.z == std::stod(z);
    });
    EXPECT_EQ(found.design->scene.primitives.size(), 2u);
  }
  fs::remove(folder_ / "part.off");
  design.next([](const DesignVersion& version) { return !version.messages.empty(); });
}

TEST_P(Follow, AMeshIsFollowed) {
  const auto off = [](const std::string& z) {
    return "OFF 4 4 0\n0 0 0\n3 0 0\n0 4 0\n0 0 " + z + "\n3 2 1 0\n3 1 3 0\n3 3 2 0\n3 2 3 1\n";
  };
  const std::string path = folder_ / "part.off";
  Followed design(path, options());
  EXPECT_THAT(design.next_error().error, HasSubstr("part.off: error: cannot be read"));
  for (const char* z : {"5", "7"}) {
    folder_.write("part.off", off(z));
    const DesignVersion found = design.next([&](const DesignVersion& version) {
      return version.design && version.design->view_box.max.z == std::stod(z);
    });
    EXPECT_EQ(found.design->scene.primitives.size(), 1u);
    EXPECT_THAT(found.files, ElementsAre(path));
    EXPECT_FALSE(found.parameters);
  }
}

TEST_P(Follow, HalfAFileDoesNotStay) {
  Followed design(folder_.write("a.csg", spheres(1)), options());
  design.next_of(1);
  std::ofstream file(folder_ / "a.csg", std::ios::binary);
  file << "sphere(r = 1); sphere(r = " << std::flush;
  EXPECT_THAT(design.next_error().error, StartsWith(folder_ / "a.csg:1:"));
  file << "2); sphere(r = 3);" << std::flush;  // the file is still open
  design.next_of(3);
  file << "sphere(r = 3);" << std::flush;
  file.close();
  design.next_of(4);
}

TEST_P(Follow, OneThatIsEmptyInTheEndIsShownEmpty) {
  Followed design(folder_.write("a.csg", spheres(1)), options());
  design.next_of(1);
  folder_.write("a.csg", "");
  EXPECT_EQ(design.next().error, "");
}

TEST_P(Follow, FoldersThatVanishAndComeBack) {
  fs::create_directories(folder_ / "x/y");
  const std::string path = folder_.write("x/y/a.csg", spheres(1));
  Followed design(path, options());
  design.next_of(1);
  fs::rename(folder_ / "x", folder_ / "z");
  EXPECT_THAT(design.next_error().error, HasSubstr("No such file"));
  fs::create_directories(folder_ / "x/y");
  folder_.write("x/y/a.csg", spheres(2));
  design.next_of(2);
  folder_.write("x/y/a.csg", spheres(3));
  design.next_of(3);
  fs::remove_all(folder_ / "x");
  design.next_error();
  folder_.write("z/y/a.csg", spheres(4));  // the path now leads there
  fs::rename(folder_ / "z", folder_ / "x");
  design.next_of(4);
}

TEST_P(Follow, LinksToFilesAndFolders) {
  for (const char* name : {"one", "two"}) fs::create_directory(folder_ / name);
  folder_.write("one/real.csg", spheres(1));
  folder_.write("two/real.csg", spheres(2));
  fs::create_directory_symlink("one", folder_ / "now");
  fs::create_symlink("now/../now/real.csg", folder_ / "a.csg");
  Followed design(folder_ / "a.csg", options());
  design.next_of(1);
  folder_.write("one/real.csg", spheres(3));
  design.next_of(3);
  fs::rename(folder_.write("one/new", spheres(4)), folder_ / "one/real.csg");
  design.next_of(4);
  fs::create_directory_symlink("two", folder_ / "next");
  fs::rename(folder_ / "next", folder_ / "now");  // a folder on the path
  design.next_of(2);
  fs::create_symlink("one/real.csg", folder_ / "b.csg");
  fs::rename(folder_ / "b.csg", folder_ / "a.csg");  // the file itself
  design.next_of(4);
  fs::remove(folder_ / "one/real.csg");  // leaves a dangling link
  EXPECT_THAT(design.next_error().error, HasSubstr("No such file"));
  folder_.write("one/real.csg", spheres(5));
  design.next_of(5);
}

TEST_P(Follow, AFileUnderAnotherName) {  // two hard links
  const std::string path = folder_.write("a.csg", spheres(1));
  fs::create_directory(folder_ / "other");
  fs::create_hard_link(path, folder_ / "other/b.csg");
  Followed design(path, options());
  design.next_of(1);
  folder_.write("other/b.csg", spheres(2));
  design.next_of(2);
}

TEST_P(Follow, AFolderInItsPlace) {
  fs::create_directory(folder_ / "a.csg");
  Followed design(folder_ / "a.csg", options());
  EXPECT_THAT(design.next_error().error, HasSubstr("is a folder"));
  fs::remove(folder_ / "a.csg");
  folder_.write("a.csg", spheres(2));
  design.next_of(2);
}

TEST_P(Follow, ASaveThatChangesNothing) {
  Followed design(folder_.write("a.csg", spheres(2)), options());
  const DesignVersion first = design.next_of(2);
  EXPECT_EQ(first.number, 1u);
  EXPECT_EQ(first.source.tree.nodes->size(), 2u);
  EXPECT_EQ((*first.source.tree.files)[0].text, spheres(2));
  fs::rename(folder_.write("new", spheres(2)), folder_ / "a.csg");
  const DesignVersion second = design.next();
  EXPECT_EQ(second.number, 2u);
  EXPECT_EQ(second.design->scene.primitives.size(), 2u);
  EXPECT_EQ(second.source.tree.nodes->size(), 2u);
  folder_.write("a.csg", "sphere(");
  design.next_error();
  folder_.write("a.csg", spheres(2));
  design.next_of(2);
}

TEST_P(Follow, HullsThatAreTheSameAreNotMadeAnew) {
  const std::string hull =
      "hull() { cube(1); polyhedron(points = [[0,0,0],[3,0,0],[0,3,0],[0,0,3]], "
      "faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,2]]); }";
  Followed design(folder_.write("a.csg", hull + "sphere(1);"), options());
  const DesignVersion first = design.next_of(3);
  folder_.write("a.csg", "sphere(1);" + hull + "sphere(2);");
  const DesignVersion second = design.next_of(4);
  EXPECT_NE(first.design->scene.primitives[0].polyhedron(), nullptr);
  EXPECT_EQ(first.design->scene.primitives[0].polyhedron(),
            second.design->scene.primitives[1].polyhedron());
}

TEST_P(Follow, OtherFilesOfTheFolderDoNotMatter) {
  Followed design(folder_.write("a.csg", spheres(1)), options());
  design.next_of(1);
  design.wait_until_idle();
  folder_.write("b.csg", spheres(2));
  fs::rename(folder_ / "b.csg", folder_ / "c.csg");
  fs::remove(folder_ / "c.csg");
  folder_.write("a.csg", spheres(3));
  EXPECT_EQ(design.next_of(3).number, 2u);
}

TEST(DesignFollower, IsIdleOnceItHasRead) {
  const TemporaryFolder folder;
  Followed design(folder.write("a.csg", spheres(1)));
  EXPECT_EQ(design.next_of(1).number, 1u);
  design.wait_until_idle();
  EXPECT_FALSE(design->take());  // only once
}

TEST(DesignFollower, ReadsAgainOnDemand) {
  const TemporaryFolder folder;
  Followed design(folder.write("a.csg", spheres(1)));
  const DesignVersion first = design.next_of(1);
  design->reload();
  const DesignVersion second = design.next();
  EXPECT_EQ(second.number, 2u);
  EXPECT_GT(second.noticed, first.noticed);
}

TEST(DesignFollower, StopsAtTheUsersWish) {
  const TemporaryFolder folder;
  const std::string endless = "function f(n) = n < 2 ? n : f(n - 1) + f(n - 2); cube(f(99));";
  FollowOptions options = by_inotify();
  options.evaluator = Evaluator::kOwn;
  Followed design(folder.write("a.scad", endless), options);
  while (!design->activity() || design->activity()->stage != "evaluating") {
    std::this_thread::yield();
  }
  design->stop();
  EXPECT_EQ(design->state(), DesignFollower::State::kStopped) << "at once";
  EXPECT_FALSE(design->activity());
  EXPECT_FALSE(design->take());
  folder.write("a.scad", "cube(1);");
  design.next_of(1);
}

/// The error of a file that is used names that file, where OpenSCAD leaves its folder out.
TEST(DesignFollower, AnErrorTellsTheFileThatItIsIn) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "lib");
  folder.write("lib/bad.scad", "module bad() {\n  foo();\n  assert(false);\n}\n");
  FollowOptions options = by_inotify();
  options.evaluator = Evaluator::kOwn;
  Followed design(folder.write("a.scad", "use <lib/bad.scad>\n\n bad();\n"), options);
  const DesignVersion version = design.next_error();
  EXPECT_THAT(version.error, StartsWith(folder / "lib/bad.scad:3: error: Assertion"));
  EXPECT_THAT(version.messages,
              ElementsAre(StartsWith("WARNING: "), StartsWith("TRACE: "), StartsWith("TRACE: ")));
  EXPECT_EQ(version.before_error, 1u);
  ASSERT_EQ(version.places.size(), 3u);
  EXPECT_EQ(text_of(version.places[0]), "bad.scad:2:3");
  EXPECT_EQ(version.places[1].path, fs::canonical(folder / "lib/bad.scad").string());
  EXPECT_EQ(text_of(version.places[2]), "a.scad:3:2");
}

/// Without what a broken file has, a design is not the one that was shown before.
TEST(DesignFollower, ABrokenUsedFileBreaksAGoodDesign) {
  const TemporaryFolder folder;
  folder.write("part.scad", "module part() { cube(1;");
  FollowOptions options = by_inotify();
  options.evaluator = Evaluator::kOwn;
  Followed design(folder.write("a.scad", "use <part.scad>\npart(); sphere(1);"), options);
  EXPECT_THAT(design.next_of(1).messages, Contains(StartsWith("ERROR: Parser error")));
  folder.write("part.scad", "module part() { cube(1); }");
  design.next_of(2);
  folder.write("part.scad", "module part() { cube(1;");
  EXPECT_THAT(design.next_error().error, StartsWith(folder / "part.scad:1: error: Parser error"));
  folder.write("part.scad", "module part() { cube(1); }");
  design.next_of(2);
}

/// Whatever it does when it is stopped, nothing comes of it.
TEST(DesignFollower, NothingComesOfWhatWasStopped) {
  const TemporaryFolder folder;
  const std::string slow =
      "minkowski() { for (i = [0 : 60]) rotate(7 * i) cube([i + 9, 1, 1]); "
      "for (i = [0 : 60]) rotate([i, i, 0]) cube([1, 2, i + 1]); }";
  FollowOptions options = by_inotify();
  options.evaluator = Evaluator::kOwn;
  for (const int delay_ms : {0, 1, 3, 10, 40, 160}) {
    SCOPED_TRACE(delay_ms);
    Followed design(folder.write("a.scad", slow), options);
    while (!design->activity()) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
    design->stop();
    EXPECT_FALSE(design->activity());
    EXPECT_FALSE(design->take());
    folder.write("a.scad", "cube(1);");
    design.next_of(1);
    EXPECT_TRUE(design.passed().empty()) << "nothing comes of the slow one";
  }
}

TEST(DesignFollower, ListsWhatIsLeftOut) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.csg", "sphere(r = 1); cube(1e308);");
  Followed design(path);
  const DesignVersion version = design.next_of(2);
  EXPECT_THAT(version.messages, ElementsAre(HasSubstr("cube is left out")));
  design->reload();
  EXPECT_THAT(design.next_of(2).messages, ElementsAre(HasSubstr("cube is left out")));
}

TEST(DesignFollower, FollowsARelativePath) {
  const TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  folder.write("a.csg", spheres(1));
  {
    Followed design("a.csg");
    EXPECT_THAT(design.next_of(1).files, ElementsAre("a.csg"));
    folder.write("a.csg", spheres(2));
    design.next_of(2);
  }
  fs::current_path(before);
}

/// Puts a pipe in place of standard input.
class FromStandardInput : public testing::Test {
 protected:
  void SetUp() override {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    saved_ = dup(STDIN_FILENO);
    dup2(ends[0], STDIN_FILENO);
    close(ends[0]);
    write_end_ = ends[1];
  }
  void TearDown() override {
    dup2(saved_, STDIN_FILENO);
    close(saved_);
    if (write_end_ >= 0) close(write_end_);
  }
  int saved_ = -1;
  int write_end_ = -1;
};

TEST_F(FromStandardInput, IsReadOnce) {
  Followed design("-");
  ASSERT_GT(write(write_end_, "sphere(r = 1);", 14), 0);
  close(std::exchange(write_end_, -1));
  design.next_of(1);
  design->reload();
  design.wait_until_idle();
  EXPECT_FALSE(design->take());
}

TEST_F(FromStandardInput, AScadIsEvaluatedAgainWithOtherInputs) {
  FollowOptions options = by_inotify();
  options.evaluator = Evaluator::kOwn;
  Followed design("-", options);
  constexpr std::string_view kText =
      "n = 1; // [1:9]\n$vpt = [1, 2, 3];\nfor (i = [1:n]) sphere(i);";
  ASSERT_GT(write(write_end_, kText.data(), kText.size()), 0);
  close(std::exchange(write_end_, -1));
  const DesignVersion first = design.next_of(1);
  ASSERT_TRUE(first.parameters);
  EXPECT_EQ(first.parameters->list.at(0).name, "n");
  EXPECT_THAT(first.messages, testing::IsEmpty()) << "the window's camera is no news";
  design->set_inputs({language::ParameterSet{{"n", "4"}}, std::nullopt});
  design.next_of(4);
}

TEST_F(FromStandardInput, DoesNotHoldUpTheEnd) {
  Followed design("-");
  design.end();  // nobody has written anything
}

TEST(DesignFollower, ANamedPipeWithoutAWriterDoesNotHoldUpTheEnd) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "a.csg").c_str(), 0600), 0);
  Followed design(folder / "a.csg");
  design.end();
}

TEST(DesignFollower, ReadsANamedPipeOnce) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "a.csg").c_str(), 0600), 0);
  Followed design(folder / "a.csg");
  folder.write("a.csg", spheres(1));  // waits for a reader
  EXPECT_EQ(design.next().design->primitive_nodes, 1u);
}

}  // namespace
}  // namespace frontend
