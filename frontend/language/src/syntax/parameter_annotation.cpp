#include "syntax/parameter_annotation.hpp"

#include <algorithm>

#include "syntax/parameter_text.hpp"

namespace language {

namespace {

/// `[value]`, `[value:label]`, or `[min:step:max]`.
using Entry = std::vector<std::string_view>;

bool is_number(std::string_view text) { return signed_number(text).has_value(); }

/// Returns words with one blank between them, without quotes and parentheses; nothing if there is
/// none, or if they are several numbers.
std::optional<std::string> plain_words(std::string_view text) {
  if (text.empty() || text.find_first_of("[]") != text.npos) return std::nullopt;
  std::string words;
  bool is_quoted = false, has_other = false;
  for (const std::string_view word : split(text, ' ')) {
    if (word.empty()) continue;
    has_other = has_other || !is_number(word);
    if (!words.empty()) words += ' ';
    for (const char c : word) {
      if (c == '"') {
        is_quoted = !is_quoted;
      } else if (is_quoted || (c != '(' && c != ')')) {
        words += c;
      }
    }
  }
  if (words.find(' ') != words.npos && !has_other) return std::nullopt;
  return words;
}

/// Returns the entries of a list in brackets; none if it is not well formed.
std::vector<Entry> entries_of(std::string_view comment) {
  if (comment.size() < 2 || comment.front() != '[' || comment.back() != ']') return {};
  std::vector<Entry> entries;
  for (const std::string_view entry : split(comment.substr(1, comment.size() - 2), ',')) {
    entries.push_back(split(entry, ':'));
    for (const std::string_view part : entries.back()) {
      if (!plain_words(part)) return {};
    }
  }
  return entries;
}

/// Returns the range that numbers give; nothing if it is empty.
std::optional<ParameterRange> range_of(const Entry& entry) {
  if (entry.size() > 3) return std::nullopt;
  ParameterRange range;
  range.max = *signed_number(entry.back());
  if (entry.size() > 1) range.min = *signed_number(entry.front());
  if (entry.size() > 2) range.step = *signed_number(entry[1]);
  if (range.step && *range.step <= 0) range.step.reset();
  return range.min < range.max ? std::optional(range) : std::nullopt;
}

/// Returns the choices that a list of entries gives; none if one of them is no number, but has to
/// be.
std::vector<ParameterChoice> choices_of(const std::vector<Entry>& entries, bool are_numbers) {
  std::vector<ParameterChoice> choices;
  for (const Entry& entry : entries) {
    if (entry.size() > 2 || (are_numbers && !is_number(entry.front()))) return {};
    ParameterChoice choice;
    if (are_numbers) {
      choice.value = *signed_number(entry.front());
    } else {
      choice.value = *plain_words(entry.front());
    }
    choice.label = *plain_words(entry.back());
    choices.push_back(std::move(choice));
  }
  return choices;
}

void annotate_numbers(CustomizerParameter& parameter, const std::vector<Entry>& entries) {
  const bool is_range =
      entries.size() == 1 && std::all_of(entries.front().begin(), entries.front().end(), is_number);
  if (is_range) {
    parameter.range = range_of(entries.front());
  } else if (std::holds_alternative<double>(parameter.value)) {
    parameter.choices = choices_of(entries, true);
  }
}

}  // namespace

void annotate(CustomizerParameter& parameter, std::string_view comment) {
  constexpr double kMostCharacters = 1e6;
  const bool is_text = std::holds_alternative<std::string>(parameter.value);
  const bool is_numeric = std::holds_alternative<double>(parameter.value) ||
                          std::holds_alternative<std::vector<double>>(parameter.value);
  if (const auto number = signed_number(comment)) {
    if (*number <= 0) return;
    if (is_numeric) parameter.step = *number;
    if (is_text && *number >= 1 && *number <= kMostCharacters) {
      parameter.longest = static_cast<uint32_t>(*number);
    }
    return;
  }
  const std::vector<Entry> entries = entries_of(comment);
  if (is_numeric) annotate_numbers(parameter, entries);
  if (is_text) parameter.choices = choices_of(entries, false);
}

}  // namespace language
