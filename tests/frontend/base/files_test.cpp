// Tests reading a design, and writing pictures whole or not at all.
#include "frontend/files.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <thread>

#include "frontend/error.hpp"
#include "frontend/interrupt.hpp"
#include "frontend/parser.hpp"
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

/// A pipe that repeats the text as long as anybody reads it.
class EndlessPipe {
 public:
  explicit EndlessPipe(const std::string& text) {
    if (pipe(ends_) != 0) throw std::runtime_error("no pipe");
    signal(SIGPIPE, SIG_IGN);
    writer_ = std::thread([this, text] {
      while (write(ends_[1], text.data(), text.size()) >= 0) {
      }
    });
  }
  ~EndlessPipe() {
    close(ends_[0]);
    writer_.join();
    close(ends_[1]);
  }
  int descriptor() const { return ends_[0]; }

 private:
  int ends_[2];
  std::thread writer_;
};

TEST(ReadFile, OfACsgEndsWhereItIsSeenToBeNone) {
  const auto read_size = [](int descriptor) {
    return read_descriptor(descriptor, "endless", is_beyond_repair).view().size();
  };
  const int zeros = open("/dev/zero", O_RDONLY);
  EXPECT_EQ(read_size(zeros), 4096u);
  close(zeros);
  EXPECT_EQ(read_size(EndlessPipe("y\n").descriptor()), 4096u);
  // The fault is after 100,000 good bytes.
  EndlessPipe late(std::string(100000, ' ') + "sphere(;");
  EXPECT_EQ(read_size(late.descriptor()), 4096u * 256);
}

TEST(ReadFile, OfALargeFileThatIsNoCsgReadsItsStart) {
  const TemporaryFolder folder;
  const std::string path = folder.write("large.csg", "");
  fs::resize_file(path, std::uintmax_t{1} << 40);  // a sparse file
  EXPECT_EQ(read_file(path, is_beyond_repair).view().size(), 4096u);
}

TEST(ReadFile, OfACsgGivesEveryByteOfAGoodOne) {
  const TemporaryFolder folder;
  std::string text;
  while (text.size() < 300000) text += "sphere(r = 1);\n";
  EXPECT_EQ(read_file(folder.write("large.csg", text), is_beyond_repair).view(), text);
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  std::thread writer([&] {
    for (std::size_t done = 0; done < text.size();) {
      done += static_cast<std::size_t>(write(ends[1], text.data() + done, text.size() - done));
    }
    close(ends[1]);
  });
  const FileText read_text = read_descriptor(ends[0], "pipe", is_beyond_repair);
  writer.join();
  close(ends[0]);
  EXPECT_EQ(read_text.view(), text);
}

TEST(CheckInput, SeesWhatCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of([&] { check_input(folder.write("a", "")); }), "no error");
  EXPECT_THAT(error_of([&] { check_input(folder / "none"); }),
              testing::AllOf(HasSubstr("none: error: "), HasSubstr("No such file")));
  EXPECT_THAT(error_of([&] { check_input(folder.path()); }), HasSubstr("is a folder"));
  EXPECT_THAT(error_of([] { check_input("/dev/zero"); }), HasSubstr("is a device"));
  ASSERT_EQ(mkfifo((folder / "fifo").c_str(), 0600), 0);
  EXPECT_THAT(error_of([&] { check_input(folder / "fifo"); }), "no error");  // and does not wait
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

TEST(WriteOutputs, PastTheLimitOnAFilesSizeAsOnAFullDisk) {
  const TemporaryFolder folder;
  folder.write("old", "before");
  const int status = status_of_process([&] {
    const rlimit limit{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &limit);
    const std::vector<PendingOutput> outputs = {{folder / "new", bytes_of("after")},
                                                {folder / "old", bytes_of(std::string(2000, 'x'))}};
    const std::string error = error_of([&] { write_outputs(outputs); });
    _exit(error == folder / "old" +
                       ": error: cannot be written: File too large (raise the limit on a file's "
                       "size: ulimit -f)"
              ? 1
              : 2);
  });
  EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_THAT(folder.names(), ElementsAre("old"));
  EXPECT_EQ(folder.read("old"), "before");
}

/// Runs `function` as a user who is not root, and who may write to the files of mode 0666 but not
/// to their folder of mode 0555. Returns the result of `function`; 77 if there is no such user.
template <typename Function>
int code_as_another_user(Function function) {
  const int status = status_of_process([&] {
    constexpr uid_t kNobody = 65534;
    if (geteuid() == 0 &&
        (setresgid(kNobody, kNobody, kNobody) != 0 || setresuid(kNobody, kNobody, kNobody) != 0)) {
      _exit(77);
    }
    _exit(function());
  });
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class ReadOnlyFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("open", "before");
    fs::permissions(folder_ / "open", fs::perms(0666));
    fs::permissions(folder_.path(), fs::perms(0555));
    // The folder may be in one that another user cannot reach.
    if (code_as_another_user([&] { return access((folder_ / "open").c_str(), R_OK | W_OK); }) !=
        0) {
      GTEST_SKIP() << "no other user may write here";
    }
  }
  TemporaryFolder folder_;
};

TEST_F(ReadOnlyFolder, ItsWritableFilesAreWrittenInPlace) {
  struct stat before {
  }, after{};
  stat((folder_ / "open").c_str(), &before);
  for (const char* text : {"longer than before", "short", ""}) {
    EXPECT_EQ(code_as_another_user([&] {
                const std::string error = error_of([&] {
                  check_output(folder_ / "open");
                  write_one(folder_ / "open", text);
                });
                return error == "no error" ? 0 : 1;
              }),
              0);
    EXPECT_EQ(folder_.read("open"), text);
  }
  stat((folder_ / "open").c_str(), &after);
  EXPECT_EQ(after.st_ino, before.st_ino);
  EXPECT_EQ(code_as_another_user([&] {
              return error_of([&] { check_output(folder_ / "new"); }).find("Permission denied") ==
                     std::string::npos;
            }),
            0);
  EXPECT_THAT(folder_.names(), ElementsAre("open"));
}

TEST_F(ReadOnlyFolder, AFailureLeavesItsFilesUntouched) {
  EXPECT_EQ(code_as_another_user([&] {
              const std::vector<PendingOutput> outputs = {{folder_ / "open", bytes_of("after")},
                                                          {"/dev/full", bytes_of("after")}};
              return error_of([&] { write_outputs(outputs); }).find("No space") ==
                     std::string::npos;
            }),
            0);
  EXPECT_EQ(folder_.read("open"), "before");
  // The old contents are restored even if writing fails in the middle.
  EXPECT_EQ(code_as_another_user([&] {
              const rlimit limit{1000, 1000};
              setrlimit(RLIMIT_FSIZE, &limit);
              return error_of([&] {
                       write_one(folder_ / "open", std::string(2000, 'x'));
                     }).find("File too large") == std::string::npos;
            }),
            0);
  EXPECT_EQ(folder_.read("open"), "before");
}

/// The folder is like /tmp: everybody may add files, and nobody may replace somebody else's.
TEST_F(ReadOnlyFolder, ASharedOnesFilesAreWrittenInPlace) {
  fs::permissions(folder_.path(), fs::perms(01777));
  EXPECT_EQ(code_as_another_user([&] {
              return error_of([&] { write_one(folder_ / "open", "after"); }) != "no error";
            }),
            0);
  EXPECT_EQ(folder_.read("open"), "after");
  EXPECT_THAT(folder_.names(), ElementsAre("open"));
}

class OutputsDiffer : public testing::Test {
 protected:
  std::string error(const std::vector<NamedPath>& outputs) const {
    const std::vector<NamedPath> inputs = {{"the design", folder_ / "a.csg"}};
    return error_of([&] { check_outputs_differ(outputs, inputs); });
  }
  void SetUp() override {
    fs::create_directory(folder_ / "sub");
    fs::create_symlink("sub", folder_ / "linked");
  }
  TemporaryFolder folder_;
  const std::string design_ = folder_.write("a.csg", "");
};

TEST_F(OutputsDiffer, FromTheDesign) {
  EXPECT_EQ(error({{"-o", design_}}),
            design_ + ": error: -o would overwrite the design (give -o a file of its own)");
  fs::create_symlink("a.csg", folder_ / "link");
  EXPECT_EQ(error({{"--stats", folder_ / "link"}}),
            folder_ / "link" + ": error: --stats would overwrite the design, which is " + design_ +
                " (give --stats a file of its own)");
  fs::create_hard_link(design_, folder_ / "hard");
  for (const char* name : {"hard", "sub/../a.csg", "./a.csg", "linked/../a.csg"}) {
    EXPECT_THAT(error({{"-d", folder_ / name}}), HasSubstr("-d would overwrite the design"))
        << name;
  }
  folder_.write("b.csg", "");
  EXPECT_EQ(error({{"-o", folder_ / "b.csg"}, {"-d", folder_ / "new"}}), "no error");
}

TEST_F(OutputsDiffer, FromEachOther) {
  for (const char* name : {"new", "linked/new", "sub/new"}) {
    const NamedPath output{"-o", folder_ / name};
    EXPECT_EQ(error({{"-o", folder_ / "other"}, output}), "no error") << name;
    EXPECT_THAT(error({output, {"--stats", output.path}}),
                HasSubstr("--stats would overwrite -o ("))
        << name;
    EXPECT_THAT(error({output, output}), HasSubstr("-o would overwrite -o (")) << name;
  }
  EXPECT_THAT(error({{"-o", folder_ / "sub/new"}, {"-d", folder_ / "linked/new"}}),
              HasSubstr("-d would overwrite -o, which is " + (folder_ / "sub/new")));
  fs::create_symlink("sub/new", folder_ / "dangling");
  EXPECT_THAT(error({{"-o", folder_ / "sub/new"}, {"-d", folder_ / "dangling"}}),
              HasSubstr("dangling: error: -d would overwrite -o"));
}

TEST_F(OutputsDiffer, ButForPipesAndDevices) {
  ASSERT_EQ(mkfifo((folder_ / "fifo").c_str(), 0600), 0);
  for (const std::string& path : {std::string("/dev/null"), folder_ / "fifo"}) {
    EXPECT_EQ(error({{"-o", path}, {"--stats", path}, {"-d", path}}), "no error");
  }
  // Returns the error if standard output goes to that file.
  const auto error_where_output_goes_to = [&](const std::string& path, const NamedPath& other) {
    const int saved = dup(STDOUT_FILENO);
    const int file = open(path.c_str(), O_WRONLY | O_CREAT, 0600);
    dup2(file, STDOUT_FILENO);
    const std::string text = error({{"-o", "-"}, other});
    dup2(saved, STDOUT_FILENO);
    close(saved);
    close(file);
    return text;
  };
  EXPECT_EQ(error_where_output_goes_to("/dev/null", {"-d", "/dev/stdout"}), "no error");
  EXPECT_EQ(error_where_output_goes_to(folder_ / "out", {"-d", folder_ / "sub/out"}), "no error");
  EXPECT_THAT(error_where_output_goes_to(folder_ / "out", {"-d", folder_ / "out"}),
              HasSubstr("out: error: -d would overwrite -o, which is -"));
  EXPECT_THAT(error_where_output_goes_to(design_, {"-d", folder_ / "out"}),
              HasSubstr("-: error: -o would overwrite the design"));
}

TEST(Interrupt, RemovesRegisteredFilesAndExitsWithFailure) {
  const TemporaryFolder folder;
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGALRM, SIGVTALRM, SIGPROF, SIGUSR1,
                                  SIGUSR2, SIGIO, SIGPWR, SIGSTKFLT, SIGXCPU, SIGRTMIN, SIGRTMAX}) {
    const std::string unfinished = folder.write("unfinished", "x");
    const std::string finished = folder.write("finished", "x");
    const int status = status_of_process([&] {
      const RemoveOnInterrupt guard(unfinished.c_str());
      { const RemoveOnInterrupt done(finished.c_str()); }
      raise(signal_number);
    });
    ASSERT_TRUE(WIFEXITED(status)) << signal_number;
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_THAT(folder.names(), ElementsAre("finished"));
  }
}

/// Signals that a sanitizer handles itself are left out.
TEST(Interrupt, ACrashRemovesRegisteredFilesToo) {
  const TemporaryFolder folder;
  for (const int signal_number : {SIGQUIT, SIGABRT, SIGSYS}) {
    const std::string unfinished = folder.write("unfinished", "x");
    const int status = status_of_process([&] {
      const rlimit no_core{};
      setrlimit(RLIMIT_CORE, &no_core);
      const RemoveOnInterrupt guard(unfinished.c_str());
      raise(signal_number);
    });
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal_number);
    EXPECT_THAT(folder.names(), IsEmpty());
  }
}

TEST(Interrupt, WaitsForWhatHoldsIt) {
  const TemporaryFolder folder;
  const int status = status_of_process([&] {
    std::atomic<bool> is_held{false};
    std::thread other([&] {  // takes the signal
      while (!is_held) std::this_thread::yield();
      kill(getpid(), SIGTERM);
    });
    std::optional<HoldInterrupts> hold(std::in_place);
    is_held = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    folder.write("written", "");
    hold.reset();
    while (true) pause();
  });
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_THAT(folder.names(), ElementsAre("written"));
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
