// Evaluates damaged designs (mutator.hpp): none may crash, run for ever, or throw. As libraries
// they have to make the same tree.
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include "language/csg_writer.hpp"
#include "language/evaluation.hpp"
#include "language/stopped.hpp"
#include "mutator.hpp"
#include "temporary_folder.hpp"

namespace {

constexpr uint64_t kSampleDesigns = 400;

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
  const std::string text = fuzz::content_of(SCADRAY_FUZZ_SCAD);
  ASSERT_FALSE(text.empty());
  fuzz::for_each_damaged(kPieces, {&text, 1}, kSampleDesigns, test);
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
