// Fuzzes without libFuzzer: damages the files of the corpus (mutator.hpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "check_input.hpp"
#include "mutator.hpp"

namespace {

constexpr uint64_t kSample = 3000;  // a second or two under asan

std::vector<std::string> corpus() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(SCADRAY_FUZZ_CORPUS)) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());  // the order in a folder is not defined
  std::vector<std::string> texts;
  for (const auto& path : paths) texts.push_back(fuzz::content_of(path));
  return texts;
}

constexpr std::string_view kWords[] = {
    "[",
    "]",
    "{",
    "}",
    "(",
    ")",
    ",",
    ";",
    "\"",
    "\\",
    "/*",
    "*/",
    "//",
    "\n",
    "\t",
    "=",
    "-",
    "+",
    "%",
    "#",
    "!",
    "*",
    "$fn",
    "inf",
    "-nan",
    "undef",
    "true",
    "1e309",
    "1e-999",
    "-0",
    "1e-07",
    "0.1",
    "union() {",
    "difference() {",
    "group();",
    "sphere(r = 1);",
    "cylinder(h = 1, r1 = 1, r2 = 0);",
    "text(text = \"",
    "\", size = ",
    "multmatrix([[",
    "color([1, 0, 0])",
    "center = true",
    std::string_view("\0", 1),
    "\xFF",
    "\xEF\xBB\xBF",
    "4294967296",
    "99999999999999999999",
};

TEST(Corpus, IsThereAndReadsWithoutFault) {
  const std::vector<std::string> texts = corpus();
  ASSERT_GE(texts.size(), 5u);
  for (const std::string& text : texts) EXPECT_EQ(fuzz::fault_of(text), "") << text;
}

TEST(Mutated, FilesGiveATreeOrAnError) {
  const std::vector<std::string> texts = corpus();
  ASSERT_FALSE(texts.empty());
  fuzz::for_each_damaged(kWords, texts, kSample, [](const std::string& text) {
    ASSERT_EQ(fuzz::fault_of(text), "") << text;
  });
}

}  // namespace
