// `--messages=json`: each message is an object on a line of standard error.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "frontend/command.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class JsonMessages : public testing::Test {
 protected:
  std::vector<json> run(const std::vector<std::string>& arguments) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const Renderer renderer = [](const csgcore::Scene&, const csgcore::View& view,
                                 const RenderSettings&, RenderStats& stats) {
      stats.renderer = "played";
      csgcore::Image image;
      image.width_px = view.width_px;
      image.height_px = view.height_px;
      image.rgb.resize(std::size_t{view.width_px} * view.height_px);
      return image;
    };
    code_ = run_command(arguments, renderer);
    out_ = testing::internal::GetCapturedStdout();
    std::istringstream lines(testing::internal::GetCapturedStderr());
    std::vector<json> messages;
    for (std::string line; std::getline(lines, line);) messages.push_back(json::parse(line));
    return messages;
  }
  std::vector<json> draw(const std::string& scad, std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--messages=json", "-o", folder_ / "a.png", "--imgsize=8,8",
                             folder_.write("a.scad", scad)});
    return run(more);
  }
  json message(const char* group, const std::string& text, int line, int column) const {
    return {{"group", group},
            {"text", text},
            {"file", folder_ / "a.scad"},
            {"line", line},
            {"column", column}};
  }

  TemporaryFolder folder_;
  ExitCode code_{};
  std::string out_;
};

TEST_F(JsonMessages, HaveGroupTextAndPlace) {
  EXPECT_THAT(
      draw(
          "module m() { child(); }\nx = \"ä\" + yy;\necho(\"1\\nin file a, line 3\"); m() cube();"),
      ElementsAre(
          message("WARNING", "Ignoring unknown variable 'yy'", 2, 11),
          message("WARNING", "undefined operation (string + undefined)", 2, 5),
          json{{"group", "ECHO"}, {"text", "\"1\nin file a, line 3\""}},
          message("DEPRECATED",
                  "child() will be removed in future releases. Use children() instead.", 1, 14)));
  EXPECT_EQ(code_, ExitCode::kDone);
}

TEST_F(JsonMessages, AnErrorHasItsTrace) {
  const std::vector<json> said = draw("module m(x) { assert(x > 1); }\nm(1);");
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(code_, ExitCode::kFailure);
  json error = said[0];
  const json trace = error["trace"];
  error.erase("trace");
  EXPECT_EQ(error, message("ERROR", "Assertion '(x > 1)' failed", 1, 15));
  ASSERT_EQ(trace.size(), 2u);
  EXPECT_EQ(
      trace[1],
      (json{{"text", "called by 'm'"}, {"file", folder_ / "a.scad"}, {"line", 2}, {"column", 1}}));
}

TEST_F(JsonMessages, OfTextsAreTheSame) {
  const auto said =
      run({"--messages=json", "-o", folder_ / "a.csg", folder_.write("a.scad", "cube(;")});
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(said[0], message("ERROR", "Parser error: syntax error", 1, 7));
  EXPECT_EQ(said[1]["group"], "NOTE");
  EXPECT_EQ(code_, ExitCode::kFailure);
}

TEST_F(JsonMessages, OfScadraysOwnErrorsAreTheSame) {
  auto said = draw("cube();", {"--view=none", "--samples=0"});
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0]["group"], "ERROR");
  EXPECT_THAT(said[0]["text"].get<std::string>(), HasSubstr("samples"));
  said = draw("cube();", {"--view=none"});
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0]["group"], "WARNING");
  EXPECT_THAT(said[0]["text"].get<std::string>(), HasSubstr("--view=none is not known"));
  said = run({"--messages", "json", "-o", folder_ / "a.png", folder_ / "none.scad"});
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0]["group"], "ERROR");
  EXPECT_EQ(said[0]["file"], folder_ / "none.scad");
  said = run({"--messages=json", "--none"});
  ASSERT_EQ(said.size(), 1u);
}

TEST_F(JsonMessages, OfACsgHaveItsPlaces) {
  const std::string path = folder_.write("a.csg", "sphere(r = 1);\ncube(;\n");
  const auto said = run({"--messages=json", "-o", folder_ / "a.png", path});
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0]["file"], path);
  EXPECT_EQ(said[0]["line"], 2);
  EXPECT_EQ(said[0]["column"], 6);
}

TEST_F(JsonMessages, BytesThatAreNoUtf8AreReplaced) {
  EXPECT_THAT(draw("echo(\"\xff\");cube();"),
              ElementsAre(json{{"group", "ECHO"}, {"text", "\"\xEF\xBF\xBD\""}}));
}

TEST_F(JsonMessages, EchoesMayGoToStandardOutput) {
  EXPECT_THAT(draw("echo(1);cube();", {"--echo"}), IsEmpty());
  EXPECT_EQ(out_, "ECHO: 1\n");
  EXPECT_THAT(draw("echo(1);cube();", {"-q"}), IsEmpty());
}

}  // namespace
}  // namespace frontend
