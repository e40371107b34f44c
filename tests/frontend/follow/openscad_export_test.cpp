// Tests running openscad, with programs in its place and with the installed one.
#include "frontend/openscad_export.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "frontend/design_file.hpp"
#include "frontend/error.hpp"
#include "frontend/interrupt.hpp"
#include "frontend/stop.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using testing::UnorderedElementsAre;

struct Result {
  std::string csg;
  std::vector<std::string> messages, files;
  std::string error;
  int waits = 0;
};

Result run_export(const std::string& path, const std::vector<std::string>& arguments = {}) {
  Result result;
  try {
    OpenScadExport exported = export_with_openscad(
        path, arguments, [&](const std::string& line) { result.messages.push_back(line); },
        [&] { ++result.waits; });
    result.csg = exported.csg.view();
    result.files = std::move(exported.files);
  } catch (const Error& error) {
    result.error = error.what();
  }
  return result;
}

class FakeOpenScad : public testing::Test {
 protected:
  Result run(const std::string& body, const std::vector<std::string>& arguments = {}) {
    const Environment openscad("OPENSCAD", folder_.script("openscad", body));
    return run_export("dir/a.scad", arguments);
  }
  TemporaryFolder folder_;
};

TEST_F(FakeOpenScad, GetsItsArgumentsWithoutAShell) {
  const Result result =
      run("for a in \"$@\"; do echo \"<$a>\"; done", {"-D", "s=\"$(x) ;`y` 'z'\""});
  EXPECT_EQ(result.error, "");
  EXPECT_THAT(result.csg,
              AllOf(StartsWith("<-o>\n<->\n<--export-format=csg>\n<-d>\n</proc/self/fd/"),
                    EndsWith(">\n<-D>\n<s=\"$(x) ;`y` 'z'\">\n<-->\n<dir/a.scad>\n")));
}

TEST_F(FakeOpenScad, WhatItEchoesBeforeTheCsgIsBlank) {
  EXPECT_EQ(run("printf '%s' '\\\\'; sleep 0.1; printf '%s' '\\@text(text = \"\\\");'").csg,
            "    text(text = \"\\\");");
}

TEST_F(FakeOpenScad, ThatDoesNotSayWhatItReadsIsAnError) {
  const Environment openscad("OPENSCAD", folder_.script("openscad", "echo 'sphere(r = 1);'"));
  const std::string path = folder_.write("a.scad", "");
  DesignFileOptions options;
  options.evaluator = Evaluator::kOpenScad;
  options.wants_files = true;
  options.message = [](const std::string&) {};
  options.progress = [](const char*) {};
  try {
    read_design(path, options);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                StartsWith(path + ": error: openscad does not say which files it reads ("));
  }
}

TEST(DesignFile, ThatTakesTooMuchMemoryIsNamed) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.csg", "sphere(r = 1);");
  DesignFileOptions options;
  options.evaluator = Evaluator::kOpenScad;
  options.progress = [](const char*) { throw std::bad_alloc(); };
  try {
    read_design(path, options);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), path + ": error: out of memory (try a smaller design)");
  }
}

TEST_F(FakeOpenScad, ItsMessagesAreShownLineByLine) {
  const Result result = run("echo 'WARNING: one' >&2; printf 'ECHO: two' >&2; echo ';'");
  EXPECT_THAT(result.messages, ElementsAre("WARNING: one", "ECHO: two"));
  EXPECT_EQ(result.csg, ";\n");
}

TEST_F(FakeOpenScad, AnErrorCountsAlthoughItExits0) {
  const Result result =
      run("echo 'sphere(r = 1);'; echo 'ERROR: Assertion failed in file a.scad, line 12' >&2;"
          "echo 'TRACE: called' >&2; exit 0");
  EXPECT_EQ(result.error, "dir/a.scad:12: error: Assertion failed");
  EXPECT_THAT(result.messages, ElementsAre("TRACE: called"));
  EXPECT_EQ(run("echo x; echo 'ERROR: in general' >&2").error, "dir/a.scad: error: in general");
  EXPECT_EQ(run("echo x; echo 'ERROR: bad in file lib/b.scad, line 3' >&2").error,
            "lib/b.scad:3: error: bad");
}

TEST_F(FakeOpenScad, AMissingFontIsNoError) {
  const Result result =
      run("echo 'sphere(r = 1);'; echo \"ERROR: Can't read font with path 'a.ttf'\" >&2");
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.csg, "sphere(r = 1);\n");
  EXPECT_THAT(result.messages, ElementsAre("ERROR: Can't read font with path 'a.ttf'"));
}

TEST_F(FakeOpenScad, Failures) {
  EXPECT_THAT(run("echo x; exit 3").error, HasSubstr("exit code 3"));
  EXPECT_THAT(run("echo x; kill -9 $$").error, HasSubstr("exit code 137"));
  EXPECT_THAT(run("exit 0").error, HasSubstr("wrote no .csg"));
}

TEST_F(FakeOpenScad, MissingOrNotAProgram) {
  const Environment nowhere("OPENSCAD", folder_ / "none");
  EXPECT_THAT(run_export("a.scad").error,
              AllOf(HasSubstr("was not found"), HasSubstr("apt-get install openscad")));
  const Environment no_name("OPENSCAD", "");
  const Environment no_path("PATH", folder_.path());
  EXPECT_THAT(run_export("a.scad").error, HasSubstr("openscad was not found"));
  const Environment no_program("OPENSCAD", folder_.write("text", "x"));
  EXPECT_THAT(run_export("a.scad").error, HasSubstr("cannot be run"));
}

TEST_F(FakeOpenScad, IsFoundOnPath) {
  folder_.script("openscad", "echo found");
  const Environment no_name("OPENSCAD", "");
  const Environment path("PATH", folder_.path() + ":/usr/bin:/bin");
  EXPECT_EQ(run_export("a.scad").csg, "found\n");
}

TEST_F(FakeOpenScad, MuchOnBothPipesDoesNotBlock) {
  const Result result =
      run("i=0; while [ $i -lt 3000 ]; do echo 'WARNING: 0123456789012345678901234567890123456789'"
          " >&2; echo 'sphere(r = 1); sphere(r = 1); sphere(r = 1);'; i=$((i+1)); done");
  EXPECT_EQ(result.messages.size(), 3000u);
  EXPECT_EQ(result.csg.size(), 3000u * 45);
}

TEST_F(FakeOpenScad, WaitingIsReported) { EXPECT_GE(run("sleep 0.35; echo x").waits, 2); }

TEST_F(FakeOpenScad, ReadsNothingFromOurStandardInput) {
  const int saved = dup(STDIN_FILENO);
  const int input = open(folder_.write("input", "ours\n").c_str(), O_RDONLY);
  dup2(input, STDIN_FILENO);
  const Result result = run("cat; echo end");
  dup2(saved, STDIN_FILENO);
  close(saved);
  close(input);
  EXPECT_EQ(result.csg, "end\n");
}

/// Returns whether the process ends soon. A killed one is a zombie until its adopter has reaped it.
bool ends_soon(pid_t pid) {
  const auto is_running = [pid] {
    std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
    std::string number, name, state;
    return stat >> number >> name >> state && state != "Z" && state != "X";  // dead, being reaped
  };
  for (int i = 0; i < 1000; ++i) {
    if (!is_running()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// Part of a script: starts a program that runs on, and writes its number to a file.
std::string starting_another(const std::string& pid_file, const std::string& program) {
  return program + " & echo $! >" + pid_file + ".new; mv " + pid_file + ".new " + pid_file + "; ";
}

TEST_F(FakeOpenScad, ADeathKillsItAndWhatItStarted) {
  const std::string pid_file = folder_ / "pid";
  const Environment openscad(
      "OPENSCAD",
      folder_.script("openscad", starting_another(pid_file, "sleep 1000") + "echo $$ >" + pid_file +
                                     "2; mv " + pid_file + "2 " + pid_file + "_own; wait"));
  for (const int signal_number : {SIGTERM, SIGUSR1, SIGXCPU, SIGQUIT, SIGABRT, SIGKILL}) {
    const pid_t pid = fork();
    if (pid == 0) {
      const rlimit no_core{};
      setrlimit(RLIMIT_CORE, &no_core);
      handle_interrupts();
      // Another thread than the main one shows what depends on the thread.
      std::thread([] { run_export("a.scad"); }).join();
      _exit(99);
    }
    while (!folder_.has("pid_own")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const pid_t own = std::stoi(folder_.read("pid_own"));
    const pid_t started = std::stoi(folder_.read("pid"));
    std::filesystem::remove(folder_ / "pid_own");
    kill(pid, signal_number);
    int status = 0;
    waitpid(pid, &status, 0);
    EXPECT_NE(WEXITSTATUS(status), 99);
    EXPECT_TRUE(ends_soon(own)) << signal_number;
    EXPECT_TRUE(ends_soon(started)) << signal_number;
  }
}

TEST_F(FakeOpenScad, EndsWithoutWhatItStartedAndLeavesNothing) {
  const std::string text(60000, ' ');
  const std::string body = starting_another(folder_ / "pid", "sleep 1000");
  const Result result = run(body + "cat " + folder_.write("text", text) +
                            "; echo 'WARNING: late' >&2; echo 'sphere(r = 1);'");
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.csg, text + "sphere(r = 1);\n");
  EXPECT_THAT(result.messages, ElementsAre("WARNING: late"));
  EXPECT_TRUE(ends_soon(std::stoi(folder_.read("pid"))));
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no child is left
}

TEST_F(FakeOpenScad, EndsThoughWhatItStartedWritesOn) {
  const Result result = run(starting_another(folder_ / "pid", "yes //") + "exit 0");
  EXPECT_TRUE(ends_soon(std::stoi(folder_.read("pid"))));
  EXPECT_THAT(run(starting_another(folder_ / "pid", "yes // >&2") + "exit 3").error,
              HasSubstr("exit code 3"));
}

TEST_F(FakeOpenScad, WhatItWritesEndsWhereItIsSeenToBeNoCsg) {
  EXPECT_EQ(run("yes").csg.substr(0, 4), "y\ny\n");
  EXPECT_EQ(run("cat /dev/zero").csg.size(), 4096u);
  EXPECT_EQ(run("echo 'ERROR: bad in file a.scad, line 2' >&2; sleep 0.1; yes").error,
            "dir/a.scad:2: error: bad");
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no child is left
}

TEST_F(FakeOpenScad, ALineWithoutAnEndIsShownInPieces) {
  const Result result = run("head -c 300000 /dev/zero | tr '\\000' x >&2; echo 'sphere(r = 1);'");
  EXPECT_EQ(result.error, "");
  EXPECT_GE(result.messages.size(), 3u);
  std::string all;
  for (const std::string& line : result.messages) all += line;
  EXPECT_EQ(all, std::string(300000, 'x'));
}

TEST_F(FakeOpenScad, HasTheSignalsThatItsCallerHad) {
  const pid_t pid = fork();
  if (pid == 0) {
    handle_interrupts();
    const std::string error = run("kill -XFSZ $$; echo 'sphere(r = 1);'").error;
    _exit(error.find("exit code " + std::to_string(128 + SIGXFSZ)) != std::string::npos ? 0 : 1);
  }
  int status = 0;
  waitpid(pid, &status, 0);
  EXPECT_EQ(status, 0);
}

/// `begun` is what the program writes last before it sleeps.
void expect_stops(const TemporaryFolder& folder, const std::string& begun) {
  std::stop_source stop;
  std::thread stopper([&] {
    while (!folder.has(begun)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    stop.request_stop();
  });
  EXPECT_THROW(export_with_openscad(
                   "a.scad", {}, [](const std::string&) {}, [] {}, stop.get_token()),
               Stopped);
  stopper.join();
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no child is left
}

TEST_F(FakeOpenScad, StopsWhenAsked) {
  const std::string begun = folder_ / "begun";
  const Environment openscad("OPENSCAD",
                             folder_.script("openscad", ": >" + begun + "; sleep 1000"));
  expect_stops(folder_, "begun");
}

TEST_F(FakeOpenScad, StopsWhenItHasClosedItsPipesAndRunsOn) {
  const std::string begun = folder_ / "begun";
  const Environment openscad(
      "OPENSCAD", folder_.script("openscad", "exec >/dev/null 2>&1; : >" + begun + "; sleep 1000"));
  expect_stops(folder_, "begun");
}

TEST_F(FakeOpenScad, IsNotStartedOnceStopped) {
  std::stop_source stop;
  stop.request_stop();
  const Environment openscad("OPENSCAD", folder_.script("openscad", ": >" + (folder_ / "begun")));
  EXPECT_THROW(export_with_openscad(
                   "a.scad", {}, [](const std::string&) {}, [] {}, stop.get_token()),
               Stopped);
  EXPECT_FALSE(folder_.has("begun"));
}

/// Uses the installed openscad, which tests/run installs.
class InstalledOpenScad : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v openscad >/dev/null") != 0) GTEST_SKIP() << "no openscad";
  }
  TemporaryFolder folder_;
};

TEST_F(InstalledOpenScad, Exports) {
  const Result result =
      run_export(folder_.write("-a.scad", "s=1; echo(s); sphere(s, $fn=9);"), {"-D", "s=3"});
  EXPECT_EQ(result.error, "");
  EXPECT_THAT(result.csg, HasSubstr("sphere($fn = 9, $fa = 12, $fs = 2, r = 3);"));
  EXPECT_THAT(result.messages, ElementsAre("ECHO: 3"));
}

TEST_F(InstalledOpenScad, SaysWhatItReads) {
  const std::string used = folder_.write("the used.scad", "module used() sphere(2);");
  const std::string included = folder_.write("#1$;%=:.scad", "use <the used.scad>\n");
  const std::string mesh = folder_ / "missing.stl";
  const std::string path =
      folder_.write("a design.scad", "include <#1$;%=:.scad>\nused(); import(\"missing.stl\");");
  const Result result = run_export(path);
  EXPECT_EQ(result.error, "");
  EXPECT_THAT(result.files, UnorderedElementsAre(used, included, mesh, path));
}

TEST_F(InstalledOpenScad, PassesParameterSets) {
  const std::string sets =
      folder_.write("p.json", R"({"parameterSets":{"big":{"s":"7"}},"fileFormatVersion":"1"})");
  const Result result =
      run_export(folder_.write("a.scad", "s=1;\nsphere(s);\n"), {"-p", sets, "-P", "big"});
  EXPECT_THAT(result.csg, HasSubstr("r = 7"));
}

TEST_F(InstalledOpenScad, ReportsErrorsWithTheirPlace) {
  const std::string path = folder_.write("a.scad", "\nsphere(1\n");
  EXPECT_THAT(run_export(path).error, StartsWith(path + ":"));
  EXPECT_THAT(run_export(path).error, HasSubstr("syntax error"));
  const std::string failing = folder_.write("b.scad", "sphere(1);\nassert(false);\n");
  EXPECT_THAT(run_export(failing).error, StartsWith(failing + ":2: error: Assertion"));
}

TEST_F(InstalledOpenScad, ShowsWarningsAndGoesOn) {
  const Result result = run_export(folder_.write("a.scad", "sphere(1); nothing();"));
  EXPECT_THAT(result.messages, ElementsAre(HasSubstr("Ignoring unknown module 'nothing'")));
  EXPECT_THAT(result.csg, HasSubstr("sphere"));
}

}  // namespace
}  // namespace frontend
