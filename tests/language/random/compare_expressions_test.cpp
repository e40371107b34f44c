// Random expressions, evaluated by the library and by openscad, which have to say the same.
// SCADRAY_TEST_EXPRESSIONS sets how many, SCADRAY_FUZZ_SEED the first file's seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "language/evaluation.hpp"
#include "random/random_expression.hpp"

namespace language {
namespace {

constexpr uint64_t kSample = 500;
constexpr uint64_t kExpressionsPerFile = 500;  // so that openscad's start counts little
constexpr int kDepth = 5;

uint64_t from_environment(const char* name, uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string design(uint32_t seed, uint64_t expressions) {
  std::mt19937 random(seed);
  std::string text;
  for (uint64_t i = 0; i < expressions; ++i)
    text += "echo(" + expression_text(random_expression(random, kDepth)) + ");\n";
  return text;
}

std::string own_messages(const std::filesystem::path& path) {
  std::string lines;
  evaluate(path.string(), {}, [&](std::string_view line) { (lines += line) += '\n'; });
  return lines;
}

// Returns nothing where openscad cannot be run.
std::string messages_of_openscad(const std::filesystem::path& path) {
  const std::filesystem::path echo = path.parent_path() / "expressions.echo";
  const std::string command =
      "timeout 60 openscad -o '" + echo.string() + "' '" + path.string() + "' > /dev/null 2>&1";
  return std::system(command.c_str()) == 0 ? text_of(echo) : std::string();
}

// Returns the first line in which two texts differ, from both.
std::string first_difference(const std::string& own, const std::string& other) {
  const auto [a, b] = std::mismatch(own.begin(), own.end(), other.begin(), other.end());
  const auto line_at = [](const std::string& text, size_t offset) {
    const size_t begin = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;
    return text.substr(begin, text.find('\n', begin) - begin);
  };
  const auto offset = static_cast<size_t>(a - own.begin());
  return "own:      " + line_at(own, offset) + "\nopenscad: " + line_at(other, offset);
}

TEST(RandomExpressions, AreEvaluatedAsByOpenScad) {
  if (std::system("command -v openscad > /dev/null 2>&1") != 0) GTEST_SKIP() << "no openscad";
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "scadray_expressions";
  std::filesystem::create_directories(folder);
  const std::filesystem::path path = folder / "expressions.scad";
  const uint64_t count = from_environment("SCADRAY_TEST_EXPRESSIONS", kSample);
  auto seed = static_cast<uint32_t>(from_environment("SCADRAY_FUZZ_SEED", 1));
  for (uint64_t done = 0; done < count; done += kExpressionsPerFile, ++seed) {
    std::ofstream(path, std::ios::binary)
        << design(seed, std::min(kExpressionsPerFile, count - done));
    const std::string own = own_messages(path), other = messages_of_openscad(path);
    ASSERT_FALSE(other.empty()) << "openscad failed, seed " << seed;
    EXPECT_TRUE(own == other) << "seed " << seed << '\n' << first_difference(own, other);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace language
