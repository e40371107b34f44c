// Tests following a .scad: the files that it reads, and the openscad that exports it, in whose
// place programs of the test run.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "follow/followed.hpp"
#include "frontend/interrupt.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

void wait_until(const std::function<bool()>& is_done) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!is_done()) {
    ASSERT_LT(std::chrono::steady_clock::now(), end) << "nothing for too long";
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

/// Zombies that nobody has reaped yet do not count.
bool is_running(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string number, name, state;
  return stat >> number >> name >> state && state != "Z";
}

bool has_children() { return waitpid(-1, nullptr, WNOHANG) != -1 || errno != ECHILD; }

std::size_t open_descriptors() {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator("/proc/self/fd")) ++count;
  return count;
}

/// A program that takes a .csg for a .scad. If the text contains "slow", it starts another program,
/// writes that one's number to the file "slow", and waits for ever. The file "starts" grows by a
/// byte with each start; "twice" is written if one was running already.
class FakeOpenScad : public testing::Test {
 protected:
  std::string body() const {
    const std::string in = folder_.path() + "/";
    return "for path; do :; done\n"
           "if [ -s " +
           in + "running ] && kill -0 $(cat " + in +
           "running) 2>/dev/null; then\n"
           "  echo twice >" +
           in +
           "twice\n"
           "fi\n"
           "echo $$ >" +
           in +
           "running\n"
           "printf x >>" +
           in +
           "starts\n"
           "if grep -q slow \"$path\"; then\n"
           "  sleep 1000 & echo $! >" +
           in + "slow.new; mv " + in + "slow.new " + in +
           "slow; wait\n"
           "fi\n"
           "cat \"$path\"; echo '//'\n"
           ": >" +
           in + "running\n";
  }
  void wait_until_slow() {
    wait_until([this] { return folder_.has("slow"); });
    slow_ = std::stoi(folder_.read("slow"));
    fs::remove(folder_ / "slow");
    EXPECT_TRUE(is_running(slow_));
  }
  void expect_slow_ends() {
    wait_until([this] { return !is_running(slow_); });
  }

  TemporaryFolder folder_;
  const Environment openscad_{"OPENSCAD", folder_.script("openscad", body())};
  const std::string path_ = folder_.write("a.scad", "// slow");
  pid_t slow_ = 0;
};

TEST_F(FakeOpenScad, ANewerSaveEndsASlowExport) {
  Followed design(path_);
  for (int i = 1; i < 5; ++i) {
    wait_until_slow();
    EXPECT_EQ(design->state(), DesignFollower::State::kReading);
    folder_.write("a.scad", spheres(i));
    design.next_of(static_cast<uint32_t>(i));
    expect_slow_ends();
    design.wait_until_idle();
    EXPECT_FALSE(has_children());
    folder_.write("a.scad", "// slow");
  }
  EXPECT_FALSE(folder_.has("twice"));
  EXPECT_THAT(design.passed(), IsEmpty());  // a run that was stopped gives no version
}

TEST_F(FakeOpenScad, TheEndDuringAnExportLeavesNoProcess) {
  Followed design(path_);
  wait_until_slow();
  design.end();
  EXPECT_FALSE(has_children());
  expect_slow_ends();
}

TEST_F(FakeOpenScad, AnInterruptionLeavesNoProcess) {
  const pid_t pid = fork();
  if (pid == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that fails leaves nobody who keeps CTest waiting
    handle_interrupts();
    const DesignFollower design(path_, by_inotify(), [] {});
    while (true) pause();
  }
  wait_until_slow();
  kill(pid, SIGINT);
  int status = 0;
  waitpid(pid, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 1);
  expect_slow_ends();
}

TEST_F(FakeOpenScad, AThousandSavesInFastSuccession) {
  folder_.write("a.scad", spheres(1));
  Followed design(path_);
  design.next_of(1);
  design.wait_until_idle();
  const std::size_t descriptors = open_descriptors();
  for (int i = 0; i < 1000; ++i) {
    const std::string text = i % 7 == 3 ? "// slow" : spheres(2 + i % 50);
    const std::string starts = folder_.read("starts");
    if (i % 2 == 0) {
      folder_.write("a.scad", text);
    } else {
      fs::rename(folder_.write("new", text), path_);
    }
    if (i % 20 == 19) {  // so that one starts now and then
      wait_until([&] { return folder_.read("starts") != starts; });
    }
  }
  folder_.write("a.scad", spheres(99));
  design.next_of(99);
  design.wait_until_idle();
  EXPECT_GE(folder_.read("starts").size(), 50u);
  EXPECT_FALSE(folder_.has("twice"));
  EXPECT_FALSE(has_children());
  EXPECT_EQ(open_descriptors(), descriptors);
}

TEST_F(FakeOpenScad, AMissingOpenScadIsAnErrorThatGoesAway) {
  folder_.write("a.scad", spheres(1));
  const fs::path program = folder_ / "openscad";
  fs::rename(program, folder_ / "away");
  Followed design(path_);
  EXPECT_THAT(design.next_error().error, HasSubstr("was not found"));
  fs::rename(folder_ / "away", program);
  design->reload();
  design.next_of(1);
}

/// An editor's plugin may pass a file of such a name; only its text tells what it is.
TEST_F(FakeOpenScad, IsRunForAScadOfAnyName) {
  const Environment openscad("OPENSCAD", folder_.script("openscad2",
                                                        "for path; do :; done\n"
                                                        "if grep -q broken \"$path\"; then\n"
                                                        "  echo 'ERROR: broken' >&2; exit 1\n"
                                                        "fi\n"
                                                        "grep -h sphere " +
                                                            (folder_ / "b.scad")));
  folder_.write("b.scad", spheres(1));
  const std::string path = folder_.write("scad-x7Qf", "include <b.scad>");
  Followed design(path);
  const DesignVersion first = design.next_of(1);
  EXPECT_GT(first.export_ms, 0);
  EXPECT_THAT(first.files, ElementsAre(path));  // our openscad names no files
  folder_.write("b.scad", spheres(2));
  folder_.write("scad-x7Qf", "include <b.scad> //");
  design.next_of(2);
  folder_.write("scad-x7Qf", "include <b.scad> // broken");
  EXPECT_EQ(design.next_error().error, path + ": error: broken");
  folder_.write("scad-x7Qf", "include <b.scad>");
  design.next_of(2);
  folder_.write("scad-x7Qf", spheres(5));  // now a .csg
  EXPECT_EQ(design.next_of(5).export_ms, 0);
  // A file of this name is a .csg, whatever its text.
  Followed named(folder_.write("a.csg", "include <b.scad>"));
  EXPECT_THAT(named.next_error().error, StartsWith(folder_ / "a.csg:1:1: error: unknown node"));
}

TEST_F(FakeOpenScad, ThatSaysTheSameAgainAndAgainIsNotKept) {
  const Environment openscad(
      "OPENSCAD",
      folder_.script("openscad2", "yes 'WARNING: again' | head -c 5000000 >&2; echo ';'"));
  Followed design(path_);
  const std::vector<std::string> messages = design.next_of(0).messages;
  std::size_t bytes = 0;
  for (const std::string& line : messages) bytes += line.size();
  EXPECT_GT(bytes, std::size_t{1} << 19);
  EXPECT_LE(bytes, (std::size_t{1} << 20) + 100);
  EXPECT_EQ(messages.back(), "(the evaluation says more)");
}

TEST_F(FakeOpenScad, IsNotRunForACsg) {
  Followed design(folder_.write("a.csg", spheres(2)));
  EXPECT_THAT(design.next_of(2).files, ElementsAre(folder_ / "a.csg"));
  EXPECT_FALSE(folder_.has("starts"));
}

class FollowedScad : public testing::Test {
 protected:
  static FollowOptions by(Evaluator evaluator) {
    FollowOptions options = by_inotify();
    options.evaluator = evaluator;
    return options;
  }
  static FollowOptions options() { return by(Evaluator::kOwn); }
  TemporaryFolder folder_;
};

class FollowedByEither : public FollowedScad, public testing::WithParamInterface<Evaluator> {
 protected:
  /// tests/run installs openscad.
  void SetUp() override {
    if (GetParam() == Evaluator::kOwn) return;
    if (std::system("command -v openscad >/dev/null") != 0) GTEST_SKIP() << "no openscad";
  }
  static FollowOptions options() { return by(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(, FollowedByEither, testing::Values(Evaluator::kOwn, Evaluator::kOpenScad),
                         [](const auto& instance) {
                           return instance.param == Evaluator::kOwn ? "own" : "openscad";
                         });

TEST_P(FollowedByEither, AndWhatItIncludesAndWhatThatIncludes) {
  fs::create_directory(folder_ / "lib");
  folder_.write("lib/c.scad", "module c() sphere(1);");
  folder_.write("lib/b.scad", "use <c.scad>\nmodule b() c();");
  const std::string path = folder_.write("a.scad", "include <lib/b.scad>\nb();");
  Followed design(path, options());
  const DesignVersion first = design.next_of(1);
  EXPECT_GT(first.export_ms, 0);
  for (const std::string& file : {path, folder_ / "lib/b.scad", folder_ / "lib/c.scad"}) {
    EXPECT_THAT(first.files, Contains(file));
  }
  folder_.write("lib/b.scad", "use <c.scad>\nmodule b() { c(); c(); }");
  design.next_of(2);
  folder_.write("lib/c.scad", "module c() { sphere(1); sphere(2); }");
  design.next_of(4);
}

TEST_F(FollowedScad, AnIncludedFolderThatGoesAway) {
  fs::create_directory(folder_ / "lib");
  folder_.write("lib/b.scad", "module b() sphere(1);");
  Followed design(folder_.write("a.scad", "include <lib/b.scad>\nb();"), options());
  design.next_of(1);
  fs::rename(folder_ / "lib", folder_ / "new");  // a warning
  design.next_of(0);
  fs::rename(folder_ / "new", folder_ / "lib");
  design.next_of(1);
}

TEST_F(FollowedScad, AnIncludeThatIsMissingAtFirst) {
  folder_.write("b.scad", "include <lib/c.scad>");
  Followed design(folder_.write("a.scad", "include <b.scad>\nsphere(1);"), options());
  const DesignVersion first = design.next_of(1);
  EXPECT_THAT(first.messages, Contains(HasSubstr("Can't open include file 'lib/c.scad'")));
  EXPECT_THAT(first.files, Contains(folder_ / "lib/c.scad"));
  fs::create_directory(folder_ / "lib");
  folder_.write("lib/c.scad", "sphere(2);");
  EXPECT_THAT(design.next_of(2).messages, IsEmpty());
}

TEST_F(FollowedScad, AnIncludeThatIsBrokenAtFirst) {
  const std::string b = folder_.write("b.scad", "sphere(1);\nsphere(\n");
  Followed design(folder_.write("a.scad", "include <b.scad>\nsphere(1);"), options());
  EXPECT_THAT(design.next_error().error, HasSubstr("syntax error"));
  folder_.write("b.scad", "sphere(2);");
  design.next_of(2);
  folder_.write("b.scad", "sphere(2");
  design.next_error();
  folder_.write("b.scad", "sphere(2); sphere(3);");
  design.next_of(3);
}

TEST_P(FollowedByEither, AnImportStaysWatchedAfterAnError) {
  const std::string mesh = folder_.write("m.stl", "solid x\nendsolid x\n");
  const std::string path = folder_.write("a.scad", "import(\"m.stl\"); sphere(1);");
  Followed design(path, options());
  EXPECT_THAT(design.next_of(2).files, Contains(mesh));
  folder_.write("a.scad", "import(\"m.stl\"); sphere(1); sphere(");
  EXPECT_THAT(design.next_error().files, Contains(mesh));
  folder_.write("m.stl", "solid y\nendsolid y\n");
  design.next_error();
}

const fs::path kSymbols = "/usr/share/openscad/testdata/ttf/marvosym-3.10/marvosym.ttf";

TEST_P(FollowedByEither, ADesignsFontIsUsed) {
  if (!fs::exists(kSymbols)) GTEST_SKIP() << "no " << kSymbols;
  fs::copy_file(kSymbols, folder_ / "font.ttf");
  const std::string path =
      folder_.write("a.scad", "use <font.ttf>\ntext(\"a\", font = \"MarVoSym\");");
  Followed design(path, options());
  EXPECT_THAT(design.next_of(1).messages, IsEmpty());
}

TEST_F(FollowedScad, AFontIsFollowed) {
  if (!fs::exists(kSymbols)) GTEST_SKIP() << "no " << kSymbols;
  const std::string path =
      folder_.write("a.scad", "use <font.ttf>\ntext(\"a\", font = \"MarVoSym\");");
  Followed design(path, options());
  const DesignVersion missing = design.next_of(1);
  EXPECT_THAT(missing.messages, Contains(HasSubstr("Can't read font")));
  EXPECT_THAT(missing.messages, Contains(HasSubstr("'MarVoSym' is not installed")));
  fs::copy_file(kSymbols, folder_ / "new.ttf");
  fs::rename(folder_ / "new.ttf", folder_ / "font.ttf");
  const DesignVersion found = design.next_of(1);
  EXPECT_THAT(found.messages, IsEmpty());
  EXPECT_THAT(found.files, Contains(folder_ / "font.ttf"));
}

TEST_P(FollowedByEither, AnEditThatChangesOnlyMessages) {
  const std::string path = folder_.write("a.scad", "sphere(1);");
  Followed design(path, options());
  design.next_of(1);
  folder_.write("a.scad", "sphere(1); echo(\"two\");");
  const DesignVersion second = design.next_of(1);
  EXPECT_THAT(second.messages, ElementsAre("ECHO: \"two\""));
}

TEST_P(FollowedByEither, GetsItsArguments) {
  FollowOptions with_arguments = options();
  with_arguments.openscad_arguments = {"-D", "n=3"};
  Followed design(folder_.write("a.scad", "n=1; for (i = [1:n]) translate([i,0,0]) sphere(1);"),
                  with_arguments);
  design.next_of(3);
}

TEST_P(FollowedByEither, MissingValidBrokenValid) {
  const std::string path = folder_ / "a.scad";
  Followed design(path, options());
  EXPECT_THAT(design.next_error().error, StartsWith(path + ": error: "));
  folder_.write("a.scad", "sphere(1);");
  design.next_of(1);
  folder_.write("a.scad", "sphere(1);\nassert(false);");
  EXPECT_THAT(design.next_error().error, StartsWith(path + ":2: error: Assertion"));
  folder_.write("a.scad", "sphere(1); sphere(2);");
  design.next_of(2);
}

}  // namespace
}  // namespace frontend
