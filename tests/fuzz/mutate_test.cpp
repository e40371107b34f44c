// Fuzzes without libFuzzer: damages the files of the corpus in ways that depend only on a seed, so
// that every machine runs the same inputs. SCADRAY_FUZZ_ITERATIONS sets the length,
// SCADRAY_FUZZ_SEED the first seed (that of a failure, for example).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "check_input.hpp"

namespace {

constexpr uint64_t kSample = 3000;  // a second or two under asan

uint64_t from_environment(const char* name, uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

std::vector<std::string> corpus() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(SCADRAY_FUZZ_CORPUS)) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());  // the order in a folder is not defined
  std::vector<std::string> texts;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
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

class Mutator {
 public:
  Mutator(uint64_t seed, const std::vector<std::string>& texts) : random_(seed), texts_(texts) {}

  std::string next() {
    std::string text = any_text();
    const size_t changes = 1 + below(6);
    for (size_t i = 0; i < changes; ++i) change(text);
    return text;
  }

 private:
  /// Returns a number in [0, limit). std::uniform_int_distribution differs from one library to
  /// another.
  size_t below(size_t limit) { return limit == 0 ? 0 : random_() % limit; }
  const std::string& any_text() { return texts_[below(texts_.size())]; }

  void change(std::string& text) {
    constexpr size_t kLongest = 200;  // of a stretch moved
    const size_t at = below(text.size() + 1);
    const size_t length = below(std::min(text.size() - at, kLongest) + 1);
    switch (below(8)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(random_());
        break;
      case 1:
        if (at < text.size()) text[at] ^= static_cast<char>(1u << below(8));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(below(text.size() + 1), text.substr(at, length));
        break;
      case 4:
        text.resize(at);
        break;
      case 5: {
        const std::string& other = any_text();
        text.insert(at, other.substr(below(other.size() + 1), length));
        break;
      }
      default:
        text.insert(at, kWords[below(std::size(kWords))]);
    }
  }

  std::mt19937_64 random_;
  const std::vector<std::string>& texts_;
};

TEST(Corpus, IsThereAndReadsWithoutFault) {
  const std::vector<std::string> texts = corpus();
  ASSERT_GE(texts.size(), 5u);
  for (const std::string& text : texts) EXPECT_EQ(fuzz::fault_of(text), "") << text;
}

TEST(Mutated, FilesGiveATreeOrAnError) {
  const std::vector<std::string> texts = corpus();
  ASSERT_FALSE(texts.empty());
  const uint64_t first = from_environment("SCADRAY_FUZZ_SEED", 1);
  const uint64_t count = from_environment("SCADRAY_FUZZ_ITERATIONS", kSample);
  for (uint64_t seed = first; seed < first + count; ++seed) {
    const std::string text = Mutator(seed, texts).next();
    ASSERT_EQ(fuzz::fault_of(text), "") << "SCADRAY_FUZZ_SEED=" << seed << '\n' << text;
  }
}

}  // namespace
