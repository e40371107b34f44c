#include "client.hpp"

namespace serve {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class Diagnostics : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ / name; }
  Json first(const std::string& name) {
    client_.settle();
    return client_.diagnostics[uri_of_path(path(name))].at(0);
  }

  TemporaryFolder folder_;
  Client client_;
};

TEST_F(Diagnostics, ADesignWithoutFaultsHasNone) {
  client_.open(path("a.scad"), "echo(1);\ncube(2);\n");
  EXPECT_THAT(client_.said(path("a.scad")), IsEmpty());
  EXPECT_TRUE(client_.diagnostics.contains(uri_of_path(path("a.scad"))));
}

TEST_F(Diagnostics, ASyntaxErrorStandsAtItsToken) {
  client_.open(path("a.scad"), "x = 1;\ncube([1, 2);\n");
  EXPECT_THAT(client_.said(path("a.scad")), ElementsAre("1:10-1:11 Parser error: syntax error"));
  EXPECT_EQ(first("a.scad")["severity"], 1);
  EXPECT_EQ(first("a.scad")["source"], "scadray");
}

TEST_F(Diagnostics, AnErrorAtTheEndStandsAtTheLastToken) {
  client_.open(path("a.scad"), "cube(1)");
  EXPECT_THAT(client_.said(path("a.scad")), ElementsAre("0:6-0:7 Parser error: syntax error"));
}

TEST_F(Diagnostics, WarningsStandAtTheirNames) {
  client_.open(path("a.scad"), "x = \"😀\" + yy;\r\nnone();\r\n");
  EXPECT_THAT(client_.said(path("a.scad")),
              ElementsAre("0:11-0:13 Ignoring unknown variable 'yy'",
                          "0:4-0:8 undefined operation (string + undefined)",
                          "1:0-1:4 Ignoring unknown module 'none'"));
  EXPECT_EQ(first("a.scad")["severity"], 2);
}

TEST_F(Diagnostics, ATraceIsRelatedInformation) {
  client_.open(path("a.scad"), "module m(x) { assert(x > 1); }\nm(1);\n");
  EXPECT_THAT(client_.said(path("a.scad")), ElementsAre("0:14-0:20 Assertion '(x > 1)' failed"));
  const Json related = first("a.scad")["relatedInformation"];
  ASSERT_EQ(related.size(), 2u);
  EXPECT_EQ(Client::place(related[1]["location"]["range"]), "1:0-1:1");
  EXPECT_EQ(related[1]["location"]["uri"], uri_of_path(path("a.scad")));
  EXPECT_EQ(related[1]["message"], "called by 'm'");
}

TEST_F(Diagnostics, WhatIsDeprecatedIsTagged) {
  client_.open(path("a.scad"), "module m() { child(); }\nm() cube();\n");
  EXPECT_THAT(client_.said(path("a.scad")),
              ElementsAre("0:13-0:18 child() will be removed in future releases. Use children() "
                          "instead."));
  EXPECT_EQ(first("a.scad")["tags"], Json{2});
}

TEST_F(Diagnostics, FollowEachChange) {
  client_.open(path("a.scad"), "cube(x);\n");
  EXPECT_THAT(client_.said(path("a.scad")), ElementsAre("0:5-0:6 Ignoring unknown variable 'x'"));
  const Json here = {{"start", {{"line", 0}, {"character", 0}}},
                     {"end", {{"line", 0}, {"character", 0}}}};
  client_.change(path("a.scad"), 2, {{{"range", here}, {"text", "x = 1;\n"}}});
  EXPECT_THAT(client_.said(path("a.scad")), IsEmpty());
}

TEST_F(Diagnostics, WorkThatIsOutOfDateIsStopped) {
  client_.open(path("a.scad"),
               "function f(n) = n == 0 ? 0 : f(n - 1);\n"
               "x = [for (i = [0 : 1e9]) f(1000)];\n");
  client_.change(path("a.scad"), 2, {{{"text", "cube(q);"}}});
  EXPECT_THAT(client_.said(path("a.scad")), ElementsAre("0:5-0:6 Ignoring unknown variable 'q'"));
}

TEST_F(Diagnostics, ManyEqualOnesAreOne) {
  client_.open(path("a.scad"),
               "for (i = [0 : 9]) cube(x);\nfor (i = [0 : 999]) { a = i; cube(y); }");
  EXPECT_THAT(client_.said(path("a.scad")), ElementsAre("0:23-0:24 Ignoring unknown variable 'x'",
                                                        "1:34-1:35 Ignoring unknown variable 'y'"));
}

TEST_F(Diagnostics, AFileThatIsMissingIsToldWhereItIsNamed) {
  client_.open(path("a.scad"), "cube();\ninclude <none.scad>\nuse <no.scad>\n");
  EXPECT_THAT(client_.said(path("a.scad")),
              ElementsAre("1:0-1:19 Can't open include file 'none.scad'.",
                          "2:0-2:13 Can't open library 'no.scad'."));
}

TEST_F(Diagnostics, StandInTheFileThatHasTheFault) {
  folder_.write("lib.scad", "function f() = nothing;\n");
  client_.open(path("a.scad"), "use <lib.scad>\nx = f();\n");
  EXPECT_THAT(client_.said(path("a.scad")), IsEmpty());
  EXPECT_THAT(client_.said(path("lib.scad")),
              ElementsAre("0:15-0:22 Ignoring unknown variable 'nothing'"));
  client_.close(path("a.scad"));
  EXPECT_THAT(client_.said(path("lib.scad")), IsEmpty());
}

TEST_F(Diagnostics, AFileIsReadAsItIsTyped) {
  folder_.write("lib.scad", "function f() = nothing;\n");
  client_.open(path("a.scad"), "use <lib.scad>\nx = f();\ny = g();");
  client_.open(path("lib.scad"), "function f() = 1;\n");
  EXPECT_THAT(client_.said(path("lib.scad")), IsEmpty());
  EXPECT_THAT(client_.said(path("a.scad")), ElementsAre("2:4-2:5 Ignoring unknown function 'g'"));
  client_.change(path("lib.scad"), 2, {{{"text", "function f() = 1; function g() = 2;"}}});
  EXPECT_THAT(client_.said(path("a.scad")), IsEmpty());
  client_.close(path("lib.scad"));
  EXPECT_THAT(client_.said(path("lib.scad")),
              ElementsAre("0:15-0:22 Ignoring unknown variable 'nothing'"));
}

TEST_F(Diagnostics, AnOpenFileNeedNotExist) {
  client_.open(path("a.scad"), "include <new.scad>\ncube(width);\n");
  EXPECT_THAT(client_.said(path("a.scad")).size(), 2u);
  client_.open(path("new.scad"), "width = 3;\n");
  EXPECT_THAT(client_.said(path("a.scad")), IsEmpty());
}

TEST_F(Diagnostics, AnIncludedDocumentIsEvaluatedWhereItIsIncluded) {
  client_.open(path("part.scad"), "cube(width);\n");
  EXPECT_THAT(client_.said(path("part.scad")),
              ElementsAre("0:5-0:10 Ignoring unknown variable 'width'"));
  client_.open(path("a.scad"), "width = 3;\ninclude <part.scad>\n");
  EXPECT_THAT(client_.said(path("part.scad")), IsEmpty());
  client_.close(path("a.scad"));
  EXPECT_EQ(client_.said(path("part.scad")).size(), 1u);
}

TEST_F(Diagnostics, ASavedFileIsReadAgain) {
  folder_.write("lib.scad", "width = ;\n");
  client_.open(path("a.scad"), "include <lib.scad>\ncube(width);\n");
  EXPECT_THAT(client_.said(path("lib.scad")).size(), 1u);
  folder_.write("lib.scad", "width = 1;\n");
  client_.notify("workspace/didChangeWatchedFiles",
                 {{"changes", {{{"uri", uri_of_path(path("lib.scad"))}, {"type", 2}}}}});
  EXPECT_THAT(client_.said(path("lib.scad")), IsEmpty());
  EXPECT_THAT(client_.said(path("a.scad")), IsEmpty());
}

TEST_F(Diagnostics, LongAndManyOnesAreCut) {
  client_.open(path("a.scad"),
               "s = [for (i = [0 : 99999]) i];\nfor (i = [0 : 9999]) cube([i, str(i) + 1]);\n"
               "assert(false, s);\n");
  client_.settle();
  const Json list = client_.diagnostics[uri_of_path(path("a.scad"))];
  EXPECT_LE(list.size(), 1000u);
  for (const Json& one : list) EXPECT_LE(one["message"].get<std::string>().size(), 4000u);
}

TEST_F(Diagnostics, ASaveHasTheDocumentEvaluatedAgain) {
  client_.open(path("a.scad"), "include <lib.scad>\ncube(width);\n");
  EXPECT_THAT(client_.said(path("a.scad")).size(), 2u);
  folder_.write("lib.scad", "width = 1;\n");
  client_.notify("textDocument/didSave",
                 {{"textDocument", {{"uri", uri_of_path(path("a.scad"))}}}});
  EXPECT_THAT(client_.said(path("a.scad")), IsEmpty());
}

TEST_F(Diagnostics, ADocumentNeedsNoFile) {
  const std::string uri = "untitled:Untitled-1";
  client_.notify("textDocument/didOpen",
                 {{"textDocument", {{"uri", uri}, {"version", 1}, {"text", "cube(x);"}}}});
  client_.settle();
  ASSERT_EQ(client_.diagnostics[uri].size(), 1u);
  EXPECT_EQ(client_.diagnostics[uri][0]["message"], "Ignoring unknown variable 'x'");
}

TEST_F(Diagnostics, AnEndlessRecursionIsToldOf) {
  client_.open(path("a.scad"), "function f(x) = 1 + f(x);\ny = f(1);\n");
  EXPECT_EQ(client_.said(path("a.scad")).size(), 1u);
}

TEST_F(Diagnostics, OfTheLanguageThatIsAskedFor) {
  Client client(language::LanguageVersion::k2026);
  client.open(path("a.scad"), "x = object(a = 1).b;\ncube(y);\n");
  EXPECT_THAT(client.said(path("a.scad")), ElementsAre("1:5-1:6 Ignoring unknown variable \"y\""));
}

}  // namespace
}  // namespace serve
