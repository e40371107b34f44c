// Evaluates damaged designs, which depend only on a seed: none may crash, run for ever, or throw.
// As libraries they have to make the same tree. SCADRAY_FUZZ_ITERATIONS sets their number,
// SCADRAY_FUZZ_SEED the first seed.
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <mutex>
#include <optional>
#include <random>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include "language/csg_writer.hpp"
#include "language/evaluation.hpp"
#include "language/stopped.hpp"
#include "temporary_folder.hpp"

namespace {

constexpr uint64_t kSampleDesigns = 400;

uint64_t setting(const char* name, uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

std::string text_of_corpus() {
  std::ifstream file(SCADRAY_FUZZ_SCAD, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

constexpr std::string_view kPieces[] = {
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ";",
    ",",
    "=",
    "\"",
    "\\",
    "/*",
    "*/",
    "//",
    "\n",
    "for (",
    "let (",
    "if (",
    "else",
    "each ",
    "echo(",
    "assert(",
    "1e400",
    "$fn",
    "[0:1e9]",
    "function(",
    "module m",
    "g(1e6)",
    "children(-1)",
    "\x03",
    "\xff",
    "include <",
    "use <",
    "!",
    "a[",
};

/// Deletes, repeats, moves or inserts some pieces.
std::string damaged(std::string text, std::mt19937_64& random) {
  const auto below = [&](size_t limit) { return limit == 0 ? 0 : random() % limit; };
  for (uint64_t count = 1 + below(4); count > 0; --count) {
    const size_t at = below(text.size());
    const size_t length = below(40);
    switch (below(4)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      case 2:
        text.insert(at, kPieces[below(std::size(kPieces))]);
        break;
      default:
        if (!text.empty()) text[at] = static_cast<char>(below(256));
        break;
    }
  }
  return text;
}

/// Asks for a stop after some time, unless it is destroyed before.
class Deadline {
 public:
  explicit Deadline(std::chrono::milliseconds time)
      : thread_([this, time](const std::stop_token& ended) {
          std::unique_lock lock(mutex_);
          if (!wake_.wait_for(lock, ended, time, [] { return false; })) source_.request_stop();
        }) {}
  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;
};

/// Returns the tree of a design; nothing if it takes too long.
std::optional<std::string> tree_of(const std::string& design) {
  const Deadline deadline(std::chrono::milliseconds(500));
  language::EvaluationOptions options;
  options.stop = deadline.token();
  try {
    return csg_text(*language::evaluate(
                         "-", options, [](std::string_view) {}, design)
                         .tree);
  } catch (const language::Stopped&) {
    return std::nullopt;
  }
}

/// Calls a function with damaged designs, which are the same for the same seed.
template <typename Test>
void for_damaged_designs(const Test& test) {
  const std::string text = text_of_corpus();
  ASSERT_FALSE(text.empty());
  const uint64_t first = setting("SCADRAY_FUZZ_SEED", 1);
  const uint64_t designs = setting("SCADRAY_FUZZ_ITERATIONS", kSampleDesigns);
  for (uint64_t seed = first; seed < first + designs; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    test(damaged(text, random));
  }
}

TEST(LanguageMutations, NoDamagedDesignCrashes) {
  for_damaged_designs([](const std::string& design) {
    const auto tree = tree_of(design);
    EXPECT_TRUE(!tree || !tree->empty());
  });
}

// Definitions of included files are read when they are called.
TEST(LanguageMutations, DamagedLibrariesAreWhatTheirTextIs) {
  const frontend::TemporaryFolder folder;
  for_damaged_designs([&](const std::string& design) {
    const auto tree = tree_of("include <" + folder.write("library.scad", design) + ">\n");
    const auto written = tree_of(design);
    EXPECT_TRUE(!tree || !written || *tree == *written) << design;
  });
}

}  // namespace
