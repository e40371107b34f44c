// Damages or alters texts in ways that depend only on a seed, so that every machine runs the same
// inputs. SCADRAY_FUZZ_ITERATIONS sets the number of inputs, SCADRAY_FUZZ_SEED the first seed (that
// of a failure, for example).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

  /// Puts words, which are numbers, in the place of others, one operation in that of another, and
  /// changes the order of statements, so that most designs stay designs.
  std::string altered() {
    constexpr size_t kMostChanges = 4;
    std::string text = any_text();
    for (size_t changes = 1 + below(kMostChanges); changes > 0; --changes) {
      const size_t at = below(text.size() + 1);
      switch (below(5)) {
        case 0:
          swap_statements(text);
          break;
        case 1:
          replace_operation(at, text);
          break;
        default:
          replace_number(at, words_[below(words_.size())], text);
      }
    }
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

  /// Puts the word in the place of the next number that is no part of a name.
  static void replace_number(size_t at, std::string_view word, std::string& text) {
    constexpr std::string_view kDigits = "0123456789";
    const auto is_in_name = [&](size_t place) {
      const unsigned char before = place == 0 ? ' ' : static_cast<unsigned char>(text[place - 1]);
      return std::isalpha(before) != 0 || before == '_';
    };
    size_t begin = text.find_first_of(kDigits, at);
    while (begin != std::string::npos && is_in_name(begin)) {
      begin = text.find_first_of(kDigits, text.find_first_not_of(kDigits, begin));
    }
    if (begin == std::string::npos) return;
    const size_t end = std::min(text.find_first_not_of("0123456789.", begin), text.size());
    text.replace(begin, end - begin, word);
  }

  /// Puts another operation in the place of the next one.
  void replace_operation(size_t at, std::string& text) {
    constexpr std::string_view kOperations[] = {"union", "difference", "intersection",
                                                "hull",  "minkowski",  "group"};
    size_t first = std::string::npos;
    size_t length = 0;
    for (const std::string_view operation : kOperations) {
      const size_t place = text.find(std::string(operation) + "(", at);
      if (place >= first) continue;
      first = place;
      length = operation.size();
    }
    if (first == std::string::npos) return;
    text.replace(first, length, kOperations[below(std::size(kOperations))]);
  }

  /// Lets two lines that end in a semicolon change places.
  void swap_statements(std::string& text) {
    std::vector<std::pair<size_t, size_t>> statements;  // begin and length
    for (size_t begin = 0; begin < text.size();) {
      const size_t end = std::min(text.find('\n', begin), text.size());
      if (end > begin && text[end - 1] == ';') statements.emplace_back(begin, end - begin);
      begin = end + 1;
    }
    if (statements.empty()) return;
    auto first = statements[below(statements.size())];
    auto second = statements[below(statements.size())];
    if (first == second) return;
    if (second < first) std::swap(first, second);
    const std::string moved = text.substr(first.first, first.second);
    const std::string other = text.substr(second.first, second.second);
    text.replace(second.first, second.second, moved);
    text.replace(first.first, first.second, other);
  }

  std::mt19937_64 random_;
  std::span<const std::string_view> words_;
  std::span<const std::string> texts_;
};

/// Calls the test with seeds, `sample` of them, until it fails fatally.
template <typename Test>
void for_each_seed(uint64_t sample, const Test& test) {
  const auto setting = [](const char* name, uint64_t otherwise) {
    const char* const text = std::getenv(name);
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
  };
  const uint64_t first = setting("SCADRAY_FUZZ_SEED", 1);
  const uint64_t count = setting("SCADRAY_FUZZ_ITERATIONS", sample);
  for (uint64_t seed = first; seed < first + count && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE("SCADRAY_FUZZ_SEED=" + std::to_string(seed));
    test(seed);
  }
}

/// Calls the test with damaged texts, `sample` of them, until it fails fatally.
template <typename Test>
void for_each_damaged(std::span<const std::string_view> words, std::span<const std::string> texts,
                      uint64_t sample, const Test& test) {
  for_each_seed(sample, [&](uint64_t seed) { test(Mutator(seed, words, texts).damaged()); });
}

}  // namespace fuzz
