// Texts that stand in place of those of files.
#include "language/text_overlay.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "kept/shown.hpp"
#include "language/evaluation.hpp"

namespace language {
namespace {

class Overlaid : public testing::Test {
 protected:
  static std::string path(const std::string& name) { return std::filesystem::absolute(name); }
  void put(const std::string& name, const std::string& text) {
    overlay_.set(path(name), std::make_shared<const std::string>(text));
  }
  std::string said(const std::string& text, EvaluationCache* cache = nullptr) {
    EvaluationOptions options;
    options.overlay = &overlay_;
    options.cache = cache;
    std::string lines;
    evaluate(
        path("main.scad"), options, [&](const SaidLine& line) { (lines += line.text) += '\n'; },
        text);
    return lines;
  }

  DesignFolder folder_;
  TextOverlay overlay_;
};

TEST_F(Overlaid, ATextIsReadInPlaceOfItsFile) {
  folder_.write("a.scad", "a = 1;\n");
  EXPECT_EQ(said("include <a.scad>\necho(a);"), "ECHO: 1\n");
  put("a.scad", "a = 2; function f() = 3;\n");
  EXPECT_EQ(said("include <a.scad>\necho(a);"), "ECHO: 2\n");
  EXPECT_EQ(said("use <a.scad>\necho(f());"), "ECHO: 3\n");
  overlay_.erase(path("a.scad"));
  EXPECT_EQ(said("include <a.scad>\necho(a);"), "ECHO: 1\n");
}

TEST_F(Overlaid, TheFileNeedNotExist) {
  put("sub/../new.scad", "include <deep.scad>\n");
  put("deep.scad", "a = 4;\n");
  EXPECT_EQ(said("include <new.scad>\necho(a);"), "ECHO: 4\n");
}

TEST_F(Overlaid, ALinkLeadsToTheText) {
  folder_.write("a.scad", "a = 1;\n");
  put("a.scad", "a = 5;\n");
  std::filesystem::create_symlink("a.scad", "link.scad");
  EXPECT_EQ(said("include <link.scad>\necho(a);"), "ECHO: 5\n");
}

TEST_F(Overlaid, WhatIsKeptFollowsTheText) {
  EvaluationCache cache;
  folder_.write("a.scad", "a = 1;\n");
  for (const char* text : {"a = 2;\n", "a = 3;\n", "a = 2;\n"}) {
    put("a.scad", text);
    EXPECT_EQ(said("include <a.scad>\necho(a);", &cache),
              "ECHO: " + std::string(1, text[4]) + "\n");
  }
  overlay_ = {};
  EXPECT_EQ(said("include <a.scad>\necho(a);", &cache), "ECHO: 1\n");
}

}  // namespace
}  // namespace language
