// Damages texts in ways that depend only on a seed, so that every machine runs the same inputs.
// SCADRAY_FUZZ_ITERATIONS sets the number of inputs, SCADRAY_FUZZ_SEED the first seed (that of a
// failure, for example).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <string_view>

namespace fuzz {

inline std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class Mutator {
 public:
  /// Damages one of the texts by the words and by pieces of the texts.
  Mutator(uint64_t seed, std::span<const std::string_view> words,
          std::span<const std::string> texts)
      : random_(seed), words_(words), texts_(texts) {}

  std::string damaged() {
    constexpr size_t kMostChanges = 6;
    std::string text = any_text();
    for (size_t changes = 1 + below(kMostChanges); changes > 0; --changes) change(text);
    return text;
  }

 private:
  /// Returns a number in [0, limit). std::uniform_int_distribution differs from one library to
  /// another.
  size_t below(size_t limit) { return limit == 0 ? 0 : random_() % limit; }
  const std::string& any_text() { return texts_[below(texts_.size())]; }

  void change(std::string& text) {
    constexpr size_t kLongest = 200;  // of a stretch that is moved
    const size_t at = below(text.size() + 1);
    const size_t length = below(std::min(text.size() - at, kLongest) + 1);
    const std::string_view word = words_[below(words_.size())];
    switch (below(9)) {
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
        if (below(4) == 0) text.resize(at);
        break;
      case 5: {
        const std::string& other = any_text();
        text.insert(at, other.substr(below(other.size() + 1), length));
        break;
      }
      case 6:
        replace_number(at, word, text);
        break;
      default:
        text.insert(at, word);
    }
  }

  /// Puts the word in the place of the next number.
  static void replace_number(size_t at, std::string_view word, std::string& text) {
    const size_t begin = text.find_first_of("0123456789", at);
    if (begin == std::string::npos) return;
    const size_t end = std::min(text.find_first_not_of("0123456789.", begin), text.size());
    text.replace(begin, end - begin, word);
  }

  std::mt19937_64 random_;
  std::span<const std::string_view> words_;
  std::span<const std::string> texts_;
};

/// Calls the test with damaged texts, `sample` of them, until it fails fatally.
template <typename Test>
void for_each_damaged(std::span<const std::string_view> words, std::span<const std::string> texts,
                      uint64_t sample, const Test& test) {
  const auto setting = [](const char* name, uint64_t otherwise) {
    const char* const text = std::getenv(name);
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
  };
  const uint64_t first = setting("SCADRAY_FUZZ_SEED", 1);
  const uint64_t count = setting("SCADRAY_FUZZ_ITERATIONS", sample);
  for (uint64_t seed = first; seed < first + count && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE("SCADRAY_FUZZ_SEED=" + std::to_string(seed));
    test(Mutator(seed, words, texts).damaged());
  }
}

}  // namespace fuzz
