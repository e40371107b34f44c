// Reading a design; writing pictures whole or not at all.
#include "frontend/files.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <thread>

#include "frontend/error.hpp"
#include "frontend/interrupt.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

void write_one(const std::string& path, const std::string& text) {
  const std::vector<PendingOutput> outputs = {{path, bytes_of(text)}};
  write_outputs(outputs);
}

template <typename Function>
std::string error_of(Function function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ReadFile, GivesEveryByte) {
  const TemporaryFolder folder;
  std::string text("a\0b\r\n", 5);
  EXPECT_EQ(read_file(folder.write("a", text)).view(), text);
  EXPECT_EQ(read_file(folder.write("empty", "")).view(), "");
  text.assign(300000, 'x');
  text.back() = 'y';
  EXPECT_EQ(read_file(folder.write("large", text)).view(), text);
}

TEST(ReadFile, ReadsAPipeOfUnknownLength) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const std::string text(200000, 'z');
  std::thread writer([&] {
    for (std::size_t done = 0; done < text.size();) {
      done += static_cast<std::size_t>(write(ends[1], text.data() + done, text.size() - done));
    }
    close(ends[1]);
  });
  const FileText read_text = read_descriptor(ends[0], "pipe");
  writer.join();
  close(ends[0]);
  EXPECT_EQ(read_text.view(), text);
}

TEST(ReadFile, ErrorsNameTheFileAndTheReason) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of([&] { read_file(folder / "none.csg"); }),
              testing::AllOf(HasSubstr(folder / "none.csg: error: "), HasSubstr("No such file")));
  EXPECT_THAT(error_of([&] { read_file(folder.path()); }), HasSubstr("is a folder"));
  EXPECT_THAT(error_of([&] { read_file(folder.write("a", "") + "/b"); }),
              HasSubstr("Not a directory"));
  if (geteuid() != 0) {  // root may read everything
    const std::string secret = folder.write("secret", "");
    fs::permissions(secret, fs::perms::none);
    EXPECT_THAT(error_of([&] { read_file(secret); }), HasSubstr("Permission denied"));
  }
}

TEST(WriteOutputs, WritesAndReplaces) {
  const TemporaryFolder folder;
  write_one(folder / "x", "one");
  EXPECT_EQ(folder.read("x"), "one");
  write_one(folder / "x", "two");
  EXPECT_EQ(folder.read("x"), "two");
  EXPECT_THAT(folder.names(), ElementsAre("x"));
}

TEST(WriteOutputs, NewFilesHaveTheUsualPermissionsAndOldOnesKeepTheirs) {
  const TemporaryFolder folder;
  const mode_t old_mask = umask(027);
  write_one(folder / "new", "text");
  umask(old_mask);
  EXPECT_EQ(static_cast<unsigned>(fs::status(folder / "new").permissions()), 0640u);
  folder.write("old", "");
  chmod((folder / "old").c_str(), 0604);
  write_one(folder / "old", "text");
  EXPECT_EQ(static_cast<unsigned>(fs::status(folder / "old").permissions()), 0604u);
}

TEST(WriteOutputs, AFailureLeavesNothingNewAndOldFilesUntouched) {
  const TemporaryFolder folder;
  folder.write("old", "before");
  const std::vector<PendingOutput> outputs = {{folder / "old", bytes_of("after")},
                                              {folder / "new", bytes_of("after")},
                                              {folder / "none/x", bytes_of("after")}};
  EXPECT_THAT(error_of([&] { write_outputs(outputs); }), HasSubstr("none/x: error: "));
  EXPECT_THAT(folder.names(), ElementsAre("old"));
  EXPECT_EQ(folder.read("old"), "before");
}

TEST(WriteOutputs, AFullDeviceIsAnErrorAndTakesTheOthersWithIt) {
  const TemporaryFolder folder;
  const std::vector<PendingOutput> outputs = {{folder / "new", bytes_of("after")},
                                              {"/dev/full", bytes_of("after")}};
  EXPECT_THAT(error_of([&] { write_outputs(outputs); }), HasSubstr("No space left"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(WriteOutputs, FollowsSymbolicLinksAndKeepsThem) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "sub");
  folder.write("sub/real", "before");
  fs::create_symlink("sub/real", folder / "link");
  fs::create_symlink("link", folder / "link2");
  write_one(folder / "link2", "after");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_TRUE(fs::is_symlink(folder / "link2"));
  EXPECT_EQ(folder.read("sub/real"), "after");
  fs::create_symlink("sub/new", folder / "dangling");
  write_one(folder / "dangling", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "dangling"));
  EXPECT_EQ(folder.read("sub/new"), "new");
  fs::create_symlink("circle", folder / "circle");
  EXPECT_THAT(error_of([&] { write_one(folder / "circle", "x"); }), HasSubstr("symbolic links"));
}

TEST(WriteOutputs, WritesToPipesAndDevicesThemselves) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "fifo").c_str(), 0600), 0);
  std::string read_text;
  std::thread reader([&] { read_text = std::string(read_file(folder / "fifo").view()); });
  write_one(folder / "fifo", "through");
  reader.join();
  EXPECT_EQ(read_text, "through");
  EXPECT_TRUE(fs::is_fifo(folder / "fifo"));
  write_one("/dev/null", "gone");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(WriteOutputs, StandardOutputByEachOfItsNames) {
  for (const char* name : {"-", "/dev/stdout", "/dev/fd/1"}) {
    testing::internal::CaptureStdout();
    write_one(name, "text");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "text") << name;
  }
}

TEST(CheckOutput, SeesBeforehandWhatCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of([&] { check_output(folder / "new"); }), "no error");
  EXPECT_THAT(error_of([&] { check_output(folder.write("old", "")); }), "no error");
  EXPECT_THAT(error_of([] { check_output("-"); }), "no error");
  EXPECT_THAT(error_of([] { check_output("/dev/null"); }), "no error");
  EXPECT_THAT(error_of([] { check_output("new-in-the-working-folder"); }), "no error");
  EXPECT_THAT(error_of([&] { check_output(folder.path()); }), HasSubstr("Is a directory"));
  EXPECT_THAT(error_of([&] { check_output(folder / "none/x"); }), HasSubstr("No such file"));
  EXPECT_THAT(error_of([&] { check_output(folder / "old/x"); }), HasSubstr("Not a directory"));
  if (geteuid() != 0) {
    fs::permissions(folder / "old", fs::perms::owner_read);
    EXPECT_THAT(error_of([&] { check_output(folder / "old"); }), HasSubstr("Permission denied"));
    fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_THAT(error_of([&] { check_output(folder / "new"); }), HasSubstr("Permission denied"));
  }
}

/// Runs `function` in a process of its own and returns that process's wait status.
template <typename Function>
int status_of_process(Function function) {
  const pid_t pid = fork();
  if (pid == 0) {
    handle_interrupts();
    function();
    _exit(99);
  }
  int status = 0;
  waitpid(pid, &status, 0);
  return status;
}

TEST(Interrupt, RemovesRegisteredFilesAndExitsWithFailure) {
  const TemporaryFolder folder;
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
    const std::string unfinished = folder.write("unfinished", "x");
    const std::string finished = folder.write("finished", "x");
    const int status = status_of_process([&] {
      const RemoveOnInterrupt guard(unfinished.c_str());
      { const RemoveOnInterrupt done(finished.c_str()); }
      raise(signal_number);
    });
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_THAT(folder.names(), ElementsAre("finished"));
  }
}

TEST(Interrupt, AnIgnoredSignalStaysIgnored) {
  const pid_t pid = fork();
  if (pid == 0) {
    signal(SIGHUP, SIG_IGN);
    handle_interrupts();
    raise(SIGHUP);
    _exit(7);
  }
  int status = 0;
  waitpid(pid, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

TEST(Interrupt, ABrokenPipeIsAnErrorOfWriting) {
  const int status = status_of_process([] {
    int ends[2];
    if (pipe(ends) != 0) _exit(2);
    close(ends[0]);
    dup2(ends[1], STDOUT_FILENO);
    _exit(error_of([] { write_one("-", "x"); }).find("Broken pipe") != std::string::npos ? 0 : 3);
  });
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace frontend
