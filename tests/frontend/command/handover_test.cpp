// Tests what the command leaves to the installed openscad, which a script of each test plays, and
// the command lines of editors and of the playground.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "frontend/command.hpp"
#include "frontend/interrupt.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Writes "made" to the output, its arguments to `words`, and a message. Its --help knows the
/// options of OpenSCAD 2021.01, as far as they are used here.
constexpr const char* kPlayed = R"(
if [ "$1" = --help ]; then echo '  -h [ --help ]  --render arg --hardwarnings  -q [ --quiet ]'; exit; fi
echo "$@" >>"$(dirname "$0")/words"
for last; do :; done
while [ $# -gt 0 ]; do case $1 in
  -o) out=$2;; -d) printf 'x: \\\n\t%s\n' "$last" >"$2";; esac; shift; done
echo 'ECHO: by openscad' >&2
[ "$out" = - ] && out=/dev/stdout
printf made >"$out"
)";

class Handover : public testing::Test {
 protected:
  struct Said {
    int code;
    std::string out, err;
  };

  static csgcore::Image draw(const csgcore::Scene&, const csgcore::View& view,
                             const RenderSettings&, RenderStats&) {
    csgcore::Image image;
    image.width_px = view.width_px;
    image.height_px = view.height_px;
    image.rgb.assign(std::size_t{view.width_px} * view.height_px, {});
    return image;
  }

  Said run(const std::vector<std::string>& arguments) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = static_cast<int>(run_command(arguments, draw));
    std::string out = testing::internal::GetCapturedStdout();
    return {code, std::move(out), testing::internal::GetCapturedStderr()};
  }
  std::string design(const std::string& text) { return folder_.write("a.scad", text); }
  /// The words that openscad was called with, without the names of files in memory.
  std::string words() const {
    std::string text = folder_.read("words");
    for (std::size_t at = 0; (at = text.find("/proc/", at)) != std::string::npos; ++at) {
      text.replace(at, text.find_first_of(" \n", at) - at, "FILE");
    }
    return text;
  }

  TemporaryFolder folder_;
  const std::string scad_ = design("cube(1);");

 private:
  Environment program_{"SCADRAY_OPENSCAD", folder_.script("openscad", kPlayed)};
};

TEST_F(Handover, OutputsOfBothKindsInOneCall) {
  const Said said = run({"-o", folder_ / "x.nef3", "-o", folder_ / "x.csg", "-o", folder_ / "x.png",
                         "-o", folder_ / "x.off", "-o", folder_ / "x.wrl", scad_});
  EXPECT_EQ(said.code, 0);
  EXPECT_EQ(said.err, "ECHO: by openscad\nECHO: by openscad\n");
  EXPECT_EQ(words(), "-o FILE --export-format=nef3 -- " + scad_ +
                         "\n-o FILE --export-format=wrl -- " + scad_ + "\n");
  for (const char* name : {"x.nef3", "x.wrl"}) EXPECT_EQ(folder_.read(name), "made") << name;
  EXPECT_EQ(folder_.read("x.csg"), "cube(size = [1, 1, 1], center = false);\n\n");
  EXPECT_TRUE(folder_.has("x.png") && folder_.has("x.off"));
}

TEST_F(Handover, EveryFormatThatOpenScadHas) {
  for (const std::string format : {"wrl", "nef3", "nefdbg", "ast", "term", "pov"}) {
    EXPECT_EQ(run({"-o", folder_ / "x." + format, scad_}).code, 0);
    EXPECT_EQ(run({"-o", "-", "--export-format=" + format, scad_}).out, "made") << format;
  }
}

TEST_F(Handover, OptionsThatOpenScadKnows) {
  const Said said = run({"-q", "--render", "--threads=1", "-D", "--a=1", "--hardwarnings", "-o",
                         folder_ / "x.pov", scad_});
  EXPECT_EQ(said.err, "ECHO: by openscad\n");
  EXPECT_EQ(words(), "--quiet --render -D --a=1 --hardwarnings -o FILE --export-format=pov -- " +
                         scad_ + "\n");
  const Said newer = run({"--backend=manifold", "-O", "export-3mf/unit=inch", "--summary=area",
                          "-o", folder_ / "x.pov", scad_});
  EXPECT_EQ(newer.code, 0);
  for (const char* option : {"--backend", "--O", "--summary"}) {
    EXPECT_THAT(newer.err, HasSubstr(folder_ / "openscad does not know " + option));
    EXPECT_THAT(words(), Not(HasSubstr(option)));
  }
}

TEST_F(Handover, WhereOpenScadDoesNotTellItsOptionsItIsGivenAll) {
  folder_.script("openscad", std::string("[ \"$1\" = --help ] && exit 1\n") + kPlayed);
  EXPECT_EQ(run({"--enable=all", "-o", folder_ / "x.ast", scad_}).code, 0);
  EXPECT_EQ(words(), "--enable=all -o FILE --export-format=ast -- " + scad_ + "\n");
  // An evaluation by openscad is given them, too.
  run({"--evaluator=openscad", "--enable=roof", "-o", folder_ / "x.csg", scad_});
  EXPECT_THAT(words(), HasSubstr("--enable=roof -o FILE --export-format=csg"));
  run({"--evaluator=openscad", "--enable=fill", "-o", folder_ / "x.png", scad_});
  EXPECT_THAT(words(), HasSubstr("-d FILE --enable=fill -- "));
}

TEST_F(Handover, ItsExitCodeIsOpenScadsAndNothingIsHalfWritten) {
  folder_.script("openscad", std::string(kPlayed) + "\necho 'ERROR: no' >&2\nexit 3");
  folder_.write("x.nef3", "before");
  const Said said =
      run({"-o", folder_ / "x.nef3", "-o", folder_ / "x.wrl", "-o", folder_ / "x.stl", scad_});
  EXPECT_EQ(said.code, 3);
  EXPECT_THAT(said.err, HasSubstr("ERROR: no\n"));
  EXPECT_EQ(folder_.read("x.nef3"), "before");
  EXPECT_FALSE(folder_.has("x.wrl") || folder_.has("x.stl"));
  folder_.script("openscad", "exit 0");
  EXPECT_THAT(run({"-o", folder_ / "x.nef3", scad_}).err, HasSubstr("openscad wrote no .nef3"));
  EXPECT_EQ(folder_.read("x.nef3"), "before");
}

TEST_F(Handover, WithoutOpenScadItSaysWhatToInstall) {
  const Environment none("SCADRAY_OPENSCAD", "/nonexistent/openscad");
  const Said said =
      run({"--hardwarnings", "-o", folder_ / "x.stl", "-o", folder_ / "x.nef3", scad_});
  EXPECT_EQ(said.code, 1);
  EXPECT_EQ(said.err,
            "error: a .nef3 file is written by OpenSCAD, and /nonexistent/openscad was not found "
            "(install it, with: apt-get install openscad; or name it in $SCADRAY_OPENSCAD)\n");
  EXPECT_FALSE(folder_.has("x.stl") || folder_.has("x.nef3"));
}

TEST_F(Handover, WhichProgramIsOpenScad) {
  const auto taken = [&](const char* scadrays, const char* older) {
    const Environment first("SCADRAY_OPENSCAD", scadrays), second("OPENSCAD", older);
    run({"-o", folder_ / "x.ast", scad_});
    return folder_.read("x.ast");
  };
  const std::string says_name =
      "for word; do out=$word; [ \"$was\" = -o ] && break; was=$word; "
      "done\nprintf \"$(basename \"$0\")\" >\"$out\"";
  for (const char* name : {"one", "two", "openscad", "openscad-nightly"}) {
    folder_.script(name, says_name);
  }
  const Environment path("PATH", folder_.path() + ":" + getenv("PATH"));
  EXPECT_EQ(taken("one", "two"), "one");
  EXPECT_EQ(taken("", "two"), "two");
  EXPECT_EQ(taken("", ""), "openscad-nightly");
  std::filesystem::remove(folder_ / "openscad-nightly");
  EXPECT_EQ(taken("", ""), "openscad");
}

TEST_F(Handover, FramesAndTheRuleForMake) {
  EXPECT_EQ(run({"-o", folder_ / "x.ast", "--animate=2", "-d", folder_ / "x.d", scad_}).code, 0);
  EXPECT_EQ(words(), "-o FILE --export-format=ast -D $t=0 -d FILE -- " + scad_ +
                         "\n-o FILE --export-format=ast -D $t=0.5 -d FILE -- " + scad_ + "\n");
  EXPECT_TRUE(folder_.has("x00000.ast") && folder_.has("x00001.ast"));
  EXPECT_EQ(folder_.read("x.d"),
            folder_ / "x00000.ast" + " " + folder_ / "x00001.ast" + ": \\\n\t" + scad_ + "\n");
  // The rule is that of all outputs, whoever writes them.
  run({"-o", folder_ / "x.ast", "-o", folder_ / "x.csg", "-d", folder_ / "x.d", scad_});
  EXPECT_EQ(folder_.read("x.d"),
            folder_ / "x.ast" + " " + folder_ / "x.csg" + ": \\\n\t" + scad_ + "\n");
}

TEST_F(Handover, AMeshIsGivenAsTheDesignThatImportsIt) {
  folder_.script("openscad",
                 std::string("[ \"$1\" = --help ] || cat >\"$(dirname \"$0\")/text\"\n") + kPlayed);
  const std::string off = folder_.write("a.off",
                                        "OFF 4 4 0\n0 0 0\n3 0 0\n0 4 0\n0 0 5\n3 2 1 0\n"
                                        "3 1 3 0\n3 3 2 0\n3 2 3 1\n");
  EXPECT_EQ(run({"-o", folder_ / "x.wrl", off}).code, 0);
  EXPECT_THAT(folder_.read("text"), HasSubstr("import(\"" + off + "\")"));
}

TEST_F(Handover, NoOutputIsTheDesign) {
  EXPECT_THAT(run({"-o", scad_, "--export-format=ast", scad_}).err, HasSubstr("the design"));
  EXPECT_EQ(folder_.read("a.scad"), "cube(1);");
}

TEST_F(Handover, AnInterruptionEndsOpenScad) {
  folder_.script("openscad",
                 "echo $$ >\"$(dirname \"$0\")/pid.new\"; mv \"$(dirname \"$0\")/pid.new\" "
                 "\"$(dirname \"$0\")/pid\"; exec sleep 100");
  const pid_t pid = fork();
  if (pid == 0) {
    handle_interrupts();
    run_command({"-o", folder_ / "x.nef3", scad_}, draw);
    _exit(99);
  }
  while (!folder_.has("pid")) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  const pid_t openscad = std::stoi(folder_.read("pid"));
  EXPECT_EQ(kill(openscad, 0), 0);
  kill(pid, SIGTERM);
  int status = 0;
  waitpid(pid, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1);
  for (int wait = 0; wait < 1000 && kill(openscad, 0) == 0; ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_NE(kill(openscad, 0), 0);
  EXPECT_FALSE(folder_.has("x.nef3"));
}

/// The extensions of VS Code (Antyos.openscad, Leathong.openscad-language-support) put their launch
/// arguments or `-o OUT`, OUT with any suffix that OpenSCAD exports, before the design; the
/// playground (ochafik/openscad-web) gives all options by itself.
TEST_F(Handover, EditorsAndThePlaygroundSucceed) {
  const std::string solid = scad_, plane = folder_.write("p.scad", "a = 1; circle(a);");
  const auto succeeds = [&](const std::string& output, std::vector<std::string> words,
                            const std::string& file) {
    words.insert(words.end(), {"-o", folder_ / output, file});
    EXPECT_EQ(run(words).code, 0) << testing::PrintToString(words);
    EXPECT_TRUE(folder_.has(output)) << output;
    std::filesystem::remove(folder_ / output);
  };
  for (const char* suffix : {"stl", "off", "amf", "3mf", "csg", "png", "echo", "ast", "term",
                             "nef3", "nefdbg", "wrl", "pov", "obj", "param"}) {
    succeeds(std::string("x.") + suffix, {}, solid);
  }
  for (const char* suffix : {"dxf", "svg", "pdf"}) succeeds(std::string("x.") + suffix, {}, plane);
  succeeds("x.stl", {"--backend=Manifold", "--export-format=binstl"}, solid);
  succeeds("x.png", {"--colorscheme=BeforeDawn", "--projection=o", "--render=force"}, solid);
  succeeds("x.stl",
           {"--hardwarnings", "--trust-python", "--python-module=a", "--enable=textmetrics",
            "--trace-depth=5", "--trace-usermodule-parameters=false", "--debug=all"},
           solid);
  succeeds(
      "out.off",
      {"--backend=manifold", "--export-format=off", "-Da=2", "--enable=manifold",
       "--enable=fast-csg", "--enable=lazy-union", "--enable=roof", "--enable=predictible-output"},
      solid);
  succeeds("out.svg", {"--backend=manifold", "--export-format=svg", "--enable=lazy-union"}, plane);
  succeeds("out.json", {"--export-format=param"}, plane);
  succeeds("x.3mf",
           {"--backend=manifold", "-O", "export-3mf/unit=millimeter", "-O", "export-3mf/x=y",
            "--summary=all", "--summary-file=" + folder_ / "s.json"},
           solid);
}

}  // namespace
}  // namespace frontend
