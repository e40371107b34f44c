// Tests the command with designs that scadray evaluates itself. No openscad runs here unless a test
// plays one.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "frontend/command.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

class EvaluatedDesign : public testing::Test {
 protected:
  struct Said {
    ExitCode code;
    std::string out, err;
  };

  Said run(const std::vector<std::string>& arguments) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const auto renderer = [this](const csgcore::Scene& scene, const csgcore::View& view,
                                 const RenderSettings&, RenderStats&) {
      scene_ = scene;
      view_ = view;
      csgcore::Image image;
      image.width_px = view.width_px;
      image.height_px = view.height_px;
      image.rgb.assign(std::size_t{view.width_px} * view.height_px, {});
      return image;
    };
    Said said{run_command(arguments, renderer), {}, {}};
    said.out = testing::internal::GetCapturedStdout();
    said.err = testing::internal::GetCapturedStderr();
    return said;
  }
  std::string design(const std::string& text) { return folder_.write("a.scad", text); }

  /// Runs the command with a pipe in place of standard input, into which `text` is written.
  Said run_with_input(const std::string& text, const std::vector<std::string>& arguments) {
    std::array<int, 2> ends{};
    EXPECT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
    const int saved = dup(STDIN_FILENO);
    dup2(ends[0], STDIN_FILENO);
    close(ends[0]);
    std::thread writer([&] {
      EXPECT_EQ(write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
      close(ends[1]);
    });
    Said said = run(arguments);
    writer.join();
    dup2(saved, STDIN_FILENO);
    close(saved);
    return said;
  }

  TemporaryFolder folder_;
  csgcore::Scene scene_;
  csgcore::View view_;

 private:
  Environment no_openscad_{"OPENSCAD", "/nonexistent/openscad"};
};

TEST_F(EvaluatedDesign, AHardWarningFailsIn2026) {
  const std::string scad = design("cube(1); echo(x);");
  const auto code = [&](const std::string& language, const std::string& output) {
    return run({"--language=" + language, "--hardwarnings", "-o", folder_ / output, scad}).code;
  };
  EXPECT_EQ(code("2026", "new.csg"), ExitCode::kFailure);
  EXPECT_FALSE(folder_.has("new.csg"));
  EXPECT_EQ(code("2026", "new.echo"), ExitCode::kFailure);
  EXPECT_THAT(folder_.read("new.echo"), StartsWith("WARNING: Ignoring unknown variable"));
  EXPECT_EQ(code("2021.01", "old.csg"), ExitCode::kDone);
  EXPECT_EQ(folder_.read("old.csg"), "\n");
}

TEST_F(EvaluatedDesign, WritesItsTree) {
  const Said said = run({"-o", folder_ / "x.csg", design("echo(1); cube(2, center = 1);")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_EQ(said.err, "ECHO: 1\n");
  EXPECT_EQ(folder_.read("x.csg"), "cube(size = [2, 2, 2], center = false);\n\n");
}

TEST_F(EvaluatedDesign, WritesItsMessages) {
  const Said said = run({"-o", folder_ / "x.echo", design("echo(a); cube(2);")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_EQ(said.err, "");
  EXPECT_EQ(folder_.read("x.echo"),
            "WARNING: Ignoring unknown variable 'a' in file a.scad, line 1\nECHO: undef\n");
}

TEST_F(EvaluatedDesign, GoesToStandardOutput) {
  EXPECT_EQ(run({"-o", "-", "--export-format=csg", design(";")}).out, "\n");
  EXPECT_EQ(run({"-o", "-", "--export-format", "echo", design("echo(1);")}).out, "ECHO: 1\n");
}

/// A terminal in place of the standard output and the standard error, as long as it lives.
class Terminal {
 public:
  Terminal() : master_(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0)
      throw std::runtime_error("no terminal");
    const int slave = open(ptsname(master_), O_RDWR | O_NOCTTY);
    flush_all();
    for (std::size_t i = 0; i < saved_.size(); ++i) {
      saved_[i] = dup(kStreams[i]);
      dup2(slave, kStreams[i]);
    }
    close(slave);
  }
  ~Terminal() {
    flush_all();
    for (std::size_t i = 0; i < saved_.size(); ++i) {
      dup2(saved_[i], kStreams[i]);
      close(saved_[i]);
    }
    close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Returns what it has got, with carriage returns at the ends of lines.
  std::string text() const {
    flush_all();
    std::string text;
    std::array<char, 4096> bytes;
    for (ssize_t count; (count = read(master_, bytes.data(), bytes.size())) > 0;)
      text.append(bytes.data(), static_cast<std::size_t>(count));
    return text;
  }

 private:
  static constexpr std::array<int, 2> kStreams = {STDOUT_FILENO, STDERR_FILENO};
  static void flush_all() { std::fflush(nullptr); }
  int master_;
  std::array<int, 2> saved_{};
};

TEST_F(EvaluatedDesign, DoesNotSteerATerminal) {
  const std::string file =
      design("echo(\"\\x1b[2J\x07\"); import(\"\x1b]0;x.stl\"); text(\"\x1b\");");
  const auto shown = [&](const std::vector<std::string>& arguments) {
    const Terminal terminal;
    run_command(arguments, [](const csgcore::Scene&, const csgcore::View& view,
                              const RenderSettings&, RenderStats&) {
      csgcore::Image image;
      image.width_px = view.width_px;
      image.height_px = view.height_px;
      image.rgb.assign(std::size_t{view.width_px} * view.height_px, {});
      return image;
    });
    return terminal.text();
  };
  const std::string echo = "ECHO: \"\\x1b[2J\\x07\"\r\n";
  EXPECT_EQ(shown({"-o", "-", "--export-format=echo", file}), echo);
  EXPECT_THAT(shown({"-o", "-", "--export-format=csg", file}),
              AllOf(StartsWith(echo), HasSubstr("text(text = \"\\x1b\""), Not(HasSubstr("\x1b"))));
  EXPECT_THAT(shown({"-o", folder_ / "x.png", "--imgsize=2,2", file}),
              AllOf(StartsWith(echo), HasSubstr("\\x1b]0;x.stl"), Not(HasSubstr("\x1b"))));
  EXPECT_THAT(shown({"-o", folder_ / "x.png", folder_ / "\x1b[2J.scad"}),
              AllOf(HasSubstr("\\x1b[2J.scad: error: "), Not(HasSubstr("\x1b"))));
  EXPECT_EQ(run({"-o", "-", "--export-format=echo", file}).out, "ECHO: \"\x1b[2J\x07\"\n");
}

TEST_F(EvaluatedDesign, DoesNotSteerATerminalByOpenScad) {
  const Environment program(
      "OPENSCAD",
      folder_.script("openscad", "printf 'a\\033c\\n' >&2; printf 'b\\033c\\n'; echo >\"$2\""));
  const std::vector<std::string> arguments = {"--evaluator=openscad", "-o", folder_ / "x.csg",
                                              design(";")};
  const Terminal terminal;
  run_command(arguments, {});
  EXPECT_EQ(terminal.text(), "a\\x1bc\r\nb\\x1bc\r\n");
}

TEST_F(EvaluatedDesign, TakesVariablesWhateverItsName) {
  const std::string set = folder_.write("sets.json", R"({"parameterSets": {"s": {"a": "7"}}})");
  const auto size = [&](const std::string& file, std::vector<std::string> arguments) {
    scene_ = {};
    arguments.insert(arguments.end(), {"-o", folder_ / "x.png", file});
    EXPECT_EQ(run(arguments).code, ExitCode::kDone) << file;
    return scene_.primitives.empty() ? 0
                                     : scene_.primitives.back().as<csgcore::SphereShape>().radius;
  };
  const std::string plain = folder_.write("design", "cube(10); sphere(3);");
  EXPECT_EQ(size(plain, {}), 3);
  EXPECT_EQ(size(plain, {"-D", "sphere(20);"}), 20);
  EXPECT_EQ(size(folder_.write("blank", ""), {"-D", "sphere(10);"}), 10);
  EXPECT_EQ(size(folder_.write("set.txt", "a = 1; sphere(a);"), {"-p", set, "-P", "s"}), 7);
}

TEST_F(EvaluatedDesign, WithASyntaxErrorHasNoTree) {
  const Said said = run({"-o", folder_ / "x.csg", design("cube(1)")});
  EXPECT_EQ(said.code, ExitCode::kFailure);
  EXPECT_THAT(said.err, StartsWith("ERROR: Parser error: syntax error in file "));
  EXPECT_THAT(said.err,
              HasSubstr("a.scad, line 2\nCan't parse file '" + folder_ / "a.scad" + "'!\n\n"));
  EXPECT_FALSE(folder_.has("x.csg"));
}

TEST_F(EvaluatedDesign, IsEmptyAfterAFailedAssertion) {
  const Said said = run({"-o", folder_ / "x.csg", design("cube(1); assert(false);")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_THAT(said.err, StartsWith("ERROR: Assertion 'false' failed in file a.scad, line 1\n"));
  EXPECT_EQ(folder_.read("x.csg"), "\n");
}

TEST_F(EvaluatedDesign, HasNoPictureAfterAFailedAssertion) {
  const Said said = run({"-o", folder_ / "x.png", design("cube(1);\nassert(false);")});
  EXPECT_EQ(said.code, ExitCode::kFailure);
  EXPECT_THAT(said.err, HasSubstr("a.scad:2: error: Assertion 'false' failed"));
  EXPECT_FALSE(folder_.has("x.png"));
}

TEST_F(EvaluatedDesign, TakesVariablesAndQuietness) {
  const std::string file = design("a = 1; echo(a); cube(a, foo = 1);");
  EXPECT_THAT(run({"-o", folder_ / "x.csg", "-D", "a=3", file}).err, HasSubstr("ECHO: 3\n"));
  EXPECT_THAT(folder_.read("x.csg"), HasSubstr("[3, 3, 3]"));
  EXPECT_EQ(run({"-q", "-o", folder_ / "x.csg", file}).err, "");
  EXPECT_THAT(run({"--hardwarnings", "-o", folder_ / "x.csg", file}).err, HasSubstr("TRACE:"));
  EXPECT_EQ(folder_.read("x.csg"), "\n");
}

TEST_F(EvaluatedDesign, TellsARuleItsFiles) {
  const std::string used = folder_.write("b.scad", "module b() cube(1);");
  const std::string file = design("use <b.scad>\nb();");
  EXPECT_EQ(run({"-o", folder_ / "x.csg", "-d", folder_ / "x.d", file}).code, ExitCode::kDone);
  EXPECT_EQ(folder_.read("x.d"), folder_ / "x.csg" + ": \\\n\t" + used + " \\\n\t" + file + "\n");
}

TEST_F(EvaluatedDesign, TellsARuleAllOutputs) {
  const std::string file = design("cube(1);");
  const std::string csg = folder_ / "x.csg", png = folder_ / "x.png", echo = folder_ / "x.echo";
  const std::string rule = folder_ / "x.d";
  EXPECT_EQ(run({"-o", png, "-o", csg, "-o", echo, "-d", rule, file}).code, ExitCode::kDone);
  EXPECT_EQ(folder_.read("x.d"), csg + " " + echo + " " + png + ": \\\n\t" + file + "\n");
  EXPECT_THAT(run({"-o", png, "-o", csg, "-d", csg, file}).err, HasSubstr("-d would overwrite -o"));
}

TEST_F(EvaluatedDesign, HasATreeForEachFrame) {
  const std::string file = design("echo($t); cube(1 + $t);");
  const Said said = run({"--animate=2", "-o", folder_ / "x.csg", "-o", folder_ / "x.echo", "-o",
                         folder_ / "x.png", "-d", folder_ / "x.d", file});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"a.scad", "x.d", "x.echo", "x00000.csg",
                                                       "x00000.png", "x00001.csg", "x00001.png"}));
  EXPECT_EQ(folder_.read("x00000.csg"), "cube(size = [1, 1, 1], center = false);\n\n");
  EXPECT_EQ(folder_.read("x00001.csg"), "cube(size = [1.5, 1.5, 1.5], center = false);\n\n");
  EXPECT_EQ(folder_.read("x.echo"),
            "Exporting " + file + "...\nECHO: 0\nExporting " + file + "...\nECHO: 0.5\n");
  EXPECT_THAT(folder_.read("x.d"),
              StartsWith(folder_ / "x00000.csg" + " " + folder_ / "x00001.csg" + " " +
                         folder_ / "x.echo" + " " + folder_ / "x00000.png"));
}

TEST_F(EvaluatedDesign, MayComeFromAPipe) {
  // All outputs are of the text that is read once.
  const std::vector<std::string> outputs = {"-o", folder_ / "x.png",  "-o", folder_ / "x.csg",
                                            "-o", folder_ / "x.echo", "-d", folder_ / "x.d"};
  const auto check = [&](const Said& said, const std::string& name) {
    EXPECT_EQ(said.code, ExitCode::kDone) << name << said.err;
    EXPECT_EQ(scene_.primitives.size(), 1u) << name;
    EXPECT_THAT(folder_.read("x.csg"), HasSubstr("[3, 3, 3]")) << name;
    EXPECT_EQ(folder_.read("x.echo"), "ECHO: 3\n") << name;
  };
  const std::string text = "n = 3; echo(n); cube(n);";
  for (const char* name : {"-", "/dev/stdin"}) {
    std::vector<std::string> arguments = outputs;
    arguments.push_back(name);
    check(run_with_input(text, arguments), name);
  }
  for (const char* name : {"pipe", "pipe.scad", "pipe.csg"}) {
    const std::string path = folder_ / name;
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    std::vector<std::string> arguments = outputs;
    arguments.push_back(path);
    // A .csg holds no more than OpenSCAD exports; it may be read as a .scad for the texts.
    const bool is_csg = path.ends_with(".csg");
    std::thread writer([&] { folder_.write(name, is_csg ? "cube(size = [3, 3, 3]);" : text); });
    const Said said = run(arguments);
    writer.join();
    if (!is_csg) check(said, name);
    EXPECT_EQ(said.code, ExitCode::kDone) << name << said.err;
    EXPECT_EQ(scene_.primitives.size(), 1u) << name;
  }
  // The texts are of the whole, also of what is known to be no .csg after its start.
  const std::string csg_pipe = folder_ / "pipe.csg";
  std::thread writer([&] { folder_.write("pipe.csg", text + std::string(100000, ' ') + text); });
  EXPECT_EQ(run({"-o", folder_ / "x.echo", csg_pipe}).code, ExitCode::kDone);
  writer.join();
  EXPECT_EQ(folder_.read("x.echo"),
            "WARNING: n was assigned on line 1 but was overwritten in file pipe.csg, line 1\n"
            "ECHO: 3\nECHO: 3\n");
  EXPECT_EQ(run_with_input("include <b.scad>\nb();", {"-o", folder_ / "x.png", "-d", "-", "-"}).out,
            folder_ / "x.png" + ":\n");
  EXPECT_THAT(run_with_input("\ncube(1", {"-o", folder_ / "x.png", "-"}).err,
              HasSubstr("standard input:3: error: Parser error: syntax error\n"));
}

TEST_F(EvaluatedDesign, FromAPipeMayNotBeEndless) {
  const auto on_pipe = signal(SIGPIPE, SIG_IGN);  // the reader stops before the end
  constexpr std::size_t kBytes = (std::size_t{64} << 20) + 2;
  const std::string path = folder_ / "pipe";
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&] {
    const int end = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    std::string lines;
    while (lines.size() < std::size_t{1} << 20) lines += "yes\n";
    for (std::size_t written = 0; written < 2 * kBytes;) {
      const ssize_t count = write(end, lines.data(), lines.size());
      if (count <= 0) break;
      written += static_cast<std::size_t>(count);
    }
    close(end);
  });
  EXPECT_EQ(run({"-o", folder_ / "x.png", path}).err,
            path + ": error: is larger than 64 MiB, and no .csg (check the file)\n");
  writer.join();
  signal(SIGPIPE, on_pipe);
  EXPECT_FALSE(folder_.has("x.png"));
}

TEST_F(EvaluatedDesign, FromAPipeIsGivenToOpenScad) {
  const Environment openscad(
      "OPENSCAD",
      folder_.script("openscad", "cat >" + folder_ / "text" + "; echo \"$@\" >" +
                                     folder_ / "arguments" + "; echo 'sphere(r = 1);'"));
  EXPECT_EQ(
      run_with_input("module a() {} a();", {"--evaluator=openscad", "-o", folder_ / "x.png", "-"})
          .err,
      "");
  EXPECT_EQ(folder_.read("text"), "module a() {} a();");
  EXPECT_THAT(folder_.read("arguments"), MatchesRegex("-o - --export-format=csg -d [^ ]+ -- -\n"));
  run_with_input("b();", {"--evaluator=openscad", "-o", folder_ / "x.csg", "-"});
  EXPECT_EQ(folder_.read("text"), "b();");
}

constexpr const char* kOff =
    "OFF 4 4 0\n0 0 0\n3 0 0\n0 4 0\n0 0 5\n3 2 1 0\n3 1 3 0\n3 3 2 0\n3 2 3 1\n";

TEST_F(EvaluatedDesign, MayBeAMeshOrADrawing) {
  const std::string off = folder_.write("a \"b\\\n.OFF", kOff);
  const Said said = run({"-o", folder_ / "x.png", "-o", folder_ / "x.csg", "-d", folder_ / "x.d",
                         "-m", "make", "--evaluator=openscad", off});
  EXPECT_EQ(said.code, ExitCode::kFailure) << "no rule can name it";
  const std::string part = folder_.write("part.off", kOff);
  const std::vector<std::string> outputs = {"-o", folder_ / "x.png", "-o", folder_ / "x.csg"};
  for (const std::string& path : {off, part}) {
    std::vector<std::string> arguments = outputs;
    arguments.insert(arguments.end(), {"-m", "make", "--evaluator=openscad", path});
    EXPECT_EQ(run(arguments).err, "") << path;
    EXPECT_EQ(scene_.primitives.size(), 1u) << path;
    EXPECT_THAT(folder_.read("x.csg"), StartsWith("import(file = \"")) << path;
  }
  run({"-o", folder_ / "x.png", "-d", folder_ / "x.d", part});
  EXPECT_EQ(folder_.read("x.d"), folder_ / "x.png" + ": \\\n\t" + part + "\n");
  const std::string svg = folder_.write(
      "a.svg", "<svg><rect width=\"3\" height=\"4\"/><circle cx=\"9\" r=\"2\"/></svg>");
  EXPECT_EQ(run({"-o", folder_ / "x.png", svg}).err, "");
  EXPECT_FALSE(scene_.primitives.empty());
  EXPECT_EQ(run({"-o", folder_ / "x.csg", "-D", "$fn=7", svg}).err, "");
  EXPECT_THAT(folder_.read("x.csg"), HasSubstr("$fn = 7"));
}

TEST_F(EvaluatedDesign, MayBeNoPicture) {
  using std::string_literals::operator""s;
  const std::string png = folder_.write("a.png", "\x89PNG\r\n\x1a\n\0\0\0\rIHDR"s);
  for (const char* output : {"x.png", "x.csg", "x.echo"}) {
    const Said said = run({"-o", folder_ / output, png});
    EXPECT_EQ(said.code, ExitCode::kFailure);
    EXPECT_THAT(said.err, StartsWith(png + ": error: is no design (give a .scad, a .csg, or what "
                                           "import() reads: .stl, "));
    EXPECT_FALSE(folder_.has(output));
  }
  EXPECT_THAT(run({"-o", folder_ / "x.png", folder_ / "none.stl"}).err,
              HasSubstr("none.stl: error: cannot be read"));
  const std::string pipe = folder_ / "pipe.stl";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(run({"-o", folder_ / "x.png", pipe}).err,
            pipe + ": error: is no regular file (check the file)\n");
}

TEST_F(EvaluatedDesign, IsDrawnWithAllDigits) {
  EXPECT_EQ(run({"-o", folder_ / "x.png", design("translate([1/3, 0, 0]) cube(1);")}).code,
            ExitCode::kDone);
  EXPECT_EQ(scene_.primitives.at(0).local_to_world.translation.x, 1.0 / 3);
}

TEST_F(EvaluatedDesign, SetsTheCameraUnlessTheCommandDoes) {
  const std::string file = design("$vpt = [1, 2, 3]; $vpr = [0, 0, 0]; $vpd = 50; cube(1);");
  run({"-o", folder_ / "x.png", file});
  EXPECT_EQ(view_.eye, csgcore::Vec3(1, 2, 53));
  run({"-o", folder_ / "x.png", "--camera=0,0,0,0,0,0,7", file});
  EXPECT_EQ(view_.eye, csgcore::Vec3(0, 0, 7));
  // As openscad, which says so of a picture that has no --camera.
  constexpr const char* kSaid = "WARNING: Viewall and autocenter disabled in favor of $vp*\n";
  for (const char* output : {"x.png", "x.csg"}) {
    EXPECT_EQ(run({"-o", folder_ / output, file}).err, kSaid);
    EXPECT_EQ(run({"-o", folder_ / output, "--camera=0,0,0,0,0,0,7", file}).err, "");
  }
}

TEST_F(EvaluatedDesign, IsDrawnAfterErrorsThatOpenScadGoesOnAfter) {
  folder_.write("broken.scad", "module m() { cube(1) }");
  const std::string png = folder_ / "x.png";
  const Said said = run({"-o", png, "-p", folder_ / "no.json", "-P", "p",
                         design("use <broken.scad>\necho(1); sphere(1);")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_THAT(said.err, testing::ContainsRegex("^ERROR: Parser error: syntax error in file .*\n"
                                               "ERROR: Cannot open Parameter Set .*\n"
                                               "ECHO: 1\n"));
  EXPECT_EQ(scene_.primitives.at(0).shape(), csgcore::Shape::kSphere);
  const Said failed = run({"-o", png, design("include <broken.scad>\nsphere(1);")});
  EXPECT_EQ(failed.code, ExitCode::kFailure);
}

TEST_F(EvaluatedDesign, IsComparedWithOpenScads) {
  const Environment same("OPENSCAD", folder_.script("same",
                                                    "printf '\\\\'\n"  // as its lexer does
                                                    "echo 'ECHO: 1' >&2\n"
                                                    "printf 'group();\\n\\n' >\"$2\"\n"));
  const Said equal = run({"check", design("echo(1); group();")});
  EXPECT_EQ(equal.code, ExitCode::kDone);
  EXPECT_THAT(equal.out, HasSubstr("a.scad: the same\n"));
  const Said different = run({"check", design("echo(1); hull();")});
  EXPECT_EQ(different.code, ExitCode::kDisagreement);
  EXPECT_THAT(different.out, HasSubstr("the trees differ in line 1:\n  scadray:  hull();\n"
                                       "  openscad: group();\n"));
  EXPECT_EQ(run({"check"}).code, ExitCode::kFailure);
  const Environment longer("OPENSCAD", folder_.script("longer",
                                                      "echo 'ECHO: 1' >&2\n"
                                                      "printf 'group();\\n\\n\\n' >\"$2\"\n"));
  EXPECT_THAT(run({"check", design("echo(1); group();")}).out,
              HasSubstr("the trees differ in line 4:\n  scadray:  (the end)\n"
                        "  openscad: (an empty line)\n"));
}

}  // namespace
}  // namespace frontend
