// Tests `scadray serve` as a program, through its pipes.
#include <gmock/gmock.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

#include "protocol.hpp"
#include "rpc.hpp"
#include "temporary_folder.hpp"

namespace serve {
namespace {

using frontend::TemporaryFolder;
using testing::HasSubstr;
using testing::StartsWith;

/// A running server.
class Program {
 public:
  Program() {
    int in[2], out[2];
    if (pipe(in) != 0 || pipe(out) != 0) throw std::runtime_error("no pipe");
    pid_ = fork();
    if (pid_ == 0) {
      dup2(in[0], STDIN_FILENO);
      dup2(out[1], STDOUT_FILENO);
      for (const int descriptor : {in[0], in[1], out[0], out[1]}) ::close(descriptor);
      execl(SCADRAY_PROGRAM, SCADRAY_PROGRAM, "serve", "--stdio", nullptr);
      _exit(127);
    }
    ::close(in[0]);
    ::close(out[1]);
    to_ = in[1];
    from_ = out[0];
  }
  ~Program() {
    close();
    if (pid_ > 0) kill(pid_, SIGKILL);
    ::close(from_);
  }

  void write(const std::string& bytes) {
    std::size_t at = 0;
    while (at < bytes.size()) {
      const ssize_t count = ::write(to_, bytes.data() + at, bytes.size() - at);
      if (count <= 0) break;
      at += static_cast<std::size_t>(count);
    }
  }
  void send(Json message) {
    message["jsonrpc"] = "2.0";
    write(framed(message));
  }
  /// Waits for a message that says something of that kind: an answer's id, or a method.
  Json wait_for(const Json& wanted) {
    while (const auto text = reader_.next()) {
      const Json message = Json::parse(*text);
      if (message.value("id", Json()) == wanted || message.value("method", Json()) == wanted)
        return message;
    }
    return {};
  }
  void close() {
    if (to_ >= 0) ::close(to_);
    to_ = -1;
  }
  /// Waits for the end, and returns the exit code.
  int wait() {
    int status = 0;
    waitpid(std::exchange(pid_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  int to_ = -1, from_ = -1;
  pid_t pid_ = -1;
  FrameReader reader_{[this](char* bytes, std::size_t room) {
    const ssize_t count = read(from_, bytes, room);
    return count > 0 ? static_cast<std::size_t>(count) : std::size_t{0};
  }};
};

Json open_message(const std::string& path, const std::string& text) {
  return {
      {"method", "textDocument/didOpen"},
      {"params", {{"textDocument", {{"uri", uri_of_path(path)}, {"version", 1}, {"text", text}}}}}};
}

TEST(ServeProgram, SpeaksWithAnEditor) {
  const TemporaryFolder folder;
  Program program;
  program.send(
      {{"id", 1}, {"method", "initialize"}, {"params", {{"capabilities", Json::object()}}}});
  const Json started = program.wait_for(1)["result"];
  EXPECT_EQ(started["serverInfo"]["name"], "scadray");
  EXPECT_EQ(started["capabilities"]["positionEncoding"], "utf-16");
  program.send({{"method", "initialized"}, {"params", Json::object()}});
  program.send(open_message(folder / "a.scad", "cube(x);\n"));
  const Json published = program.wait_for("textDocument/publishDiagnostics")["params"];
  EXPECT_EQ(published["uri"], uri_of_path(folder / "a.scad"));
  EXPECT_EQ(published["version"], 1);
  ASSERT_EQ(published["diagnostics"].size(), 1u);
  EXPECT_EQ(published["diagnostics"][0]["message"], "Ignoring unknown variable 'x'");
  program.send({{"id", 2},
                {"method", "textDocument/hover"},
                {"params",
                 {{"textDocument", {{"uri", uri_of_path(folder / "a.scad")}}},
                  {"position", {{"line", 0}, {"character", 1}}}}}});
  EXPECT_THAT(program.wait_for(2)["result"]["contents"]["value"].get<std::string>(),
              HasSubstr("cube(size = 1"));
  program.send({{"id", 3}, {"method", "shutdown"}});
  EXPECT_EQ(program.wait_for(3)["result"], nullptr);
  program.send({{"method", "exit"}});
  EXPECT_EQ(program.wait(), 0);
}

TEST(ServeProgram, AnswersWhatIsNoMessage) {
  Program program;
  program.write("Content-Length: 3\r\n\r\n{,}");
  EXPECT_EQ(program.wait_for(nullptr)["error"]["code"], -32700);
  program.write("Content-Length: x\r\n\r\n");
  EXPECT_EQ(program.wait_for(nullptr)["error"]["code"], -32700);
  program.send({{"id", 1}, {"method", "initialize"}});
  EXPECT_TRUE(program.wait_for(1).contains("result"));
}

TEST(ServeProgram, EndsWithItsInput) {
  Program program;
  program.send({{"id", 1}, {"method", "initialize"}});
  program.wait_for(1);
  program.close();
  EXPECT_EQ(program.wait(), 1);
}

TEST(ServeProgram, EndsWhileItEvaluates) {
  const TemporaryFolder folder;
  Program program;
  program.send({{"id", 1}, {"method", "initialize"}});
  program.send(open_message(folder / "a.scad", "x = [for (i = [0 : 1e9]) sin(i)];"));
  program.send({{"id", 2}, {"method", "shutdown"}});
  program.wait_for(2);
  program.send({{"method", "exit"}});
  EXPECT_EQ(program.wait(), 0);
}

TEST(ServeProgram, ExitWithoutShutdownIsAFailure) {
  Program program;
  program.send({{"id", 1}, {"method", "initialize"}});
  program.send({{"method", "exit"}});
  EXPECT_EQ(program.wait(), 1);
}

TEST(ServeProgram, PrintsTheAddressForBrowsers) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  folder.write("index.html", "");
  const std::string command = std::string("timeout --signal=INT 2 '") + SCADRAY_PROGRAM +
                              "' serve --panel='" + folder.path() + "' --http '" +
                              (folder / "a.scad") + "' >'" + (folder / "out") + "'";
  static_cast<void>(std::system(command.c_str()));
  EXPECT_THAT(folder.read("out"),
              testing::MatchesRegex("http://127.0.0.1:[0-9]+/\\?token=[0-9a-f]+\n"));
}

TEST(ServeProgram, HasACommandLine) {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& words) {
    const std::string command = std::string("'") + SCADRAY_PROGRAM + "' serve " + words + " >'" +
                                (folder / "out") + "' 2>&1 </dev/null";
    const int status = std::system(command.c_str());
    return WEXITSTATUS(status);
  };
  EXPECT_EQ(run("--help"), 0);
  EXPECT_THAT(folder.read("out"),
              StartsWith("Usage: scadray serve [options]\n       scadray serve --http[=PORT]"));
  EXPECT_EQ(run("--version"), 0);
  EXPECT_THAT(folder.read("out"), StartsWith("scadray-serve version "));
  EXPECT_EQ(run("a.scad"), 1);
  EXPECT_THAT(folder.read("out"), HasSubstr("error: scadray serve takes no file: a.scad"));
  EXPECT_EQ(run("--language=7"), 1);
  folder.write("a.scad", "cube(1);");
  const std::string design = " '" + (folder / "a.scad") + "'";
  const TemporaryFolder panel;
  panel.write("index.html", "");
  for (const auto& [words, error] : std::vector<std::pair<std::string, std::string>>{
           {"--http", "--http shows one design"},
           {"--http=8080" + design + design, "--http shows one design"},
           {"--http --panel=" + panel.path() + " none.stl", "none.stl"},
           {"--http=99999" + design, "--http"},
           {"--bind=127.0.0.1", "--bind has no effect without --http"},
           {"--http --panel=/none" + design, "holds no panel for browsers"}}) {
    EXPECT_EQ(run(words), 1) << words;
    EXPECT_THAT(folder.read("out"), HasSubstr(error)) << words;
  }
}

}  // namespace
}  // namespace serve
