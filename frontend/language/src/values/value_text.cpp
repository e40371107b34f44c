#include "values/value_text.hpp"

#include <vector>

#include "base/evaluation_thread.hpp"
#include "base/number_text.hpp"
#include "values/function_object.hpp"
#include "values/object_memory.hpp"
#include "values/range.hpp"

namespace language {
namespace {

void append_range(std::string& out, const RangeObject& range) {
  out += '[';
  append_echo_number(out, range.begin);
  out += " : ";
  append_echo_number(out, range.step);
  out += " : ";
  append_echo_number(out, range.end);
  out += ']';
}

void append_quoted(std::string& out, std::string_view text) {
  out += '"';
  out += text;
  out += '"';
}

// Appends a value that is no vector.
void append_leaf(std::string& out, const Value& value) {
  switch (value.type()) {
    case ValueType::kBool:
      out += value.boolean() ? "true" : "false";
      break;
    case ValueType::kNumber:
      append_echo_number(out, value.number());
      break;
    case ValueType::kString:
      append_quoted(out, value.text());
      break;
    case ValueType::kRange:
      append_range(out, value.range());
      break;
    case ValueType::kFunction:
      value.function().append_text(out);
      break;
    default:
      out += "undef";
      break;
  }
}

constexpr size_t kWorkOfElement = 16;  // a number's text takes some 100 ns

// Checks a text that is for messages or strings, and how many brackets are open.
void check_shown(size_t bytes, size_t depth) {
  if (bytes > kMostTextBytes) throw TooLarge("A text takes too much memory: more than 32 MiB");
  if (depth > kMostNesting)
    throw TooLarge("Stack exhausted while trying to convert a vector to EchoString");
}

// Appends a vector. What is being written lies on a stack of its own, since vectors nest deeply.
// `check` is called for each element.
template <typename Check>
void append_vector(std::string& out, std::span<const Value> elements, Check check) {
  std::vector<std::span<const Value>> rests{elements};  // of each open bracket, what is not written
  out += '[';
  while (true) {
    check(out.size(), rests.size());
    count_work(kWorkOfElement);
    std::span<const Value>& rest = rests.back();
    if (rest.empty()) {
      out += ']';
      rests.pop_back();
      if (rests.empty()) return;
      if (!rests.back().empty()) out += ", ";
      continue;
    }
    const Value& element = rest.front();
    rest = rest.subspan(1);
    if (element.is_vector()) {
      out += '[';
      rests.push_back(element.elements());
      continue;
    }
    append_leaf(out, element);
    if (!rest.empty()) out += ", ";
  }
}

}  // namespace

void append_value_text(std::string& out, const Value& value) {
  const auto check = [](size_t bytes, size_t) { check_text_size(bytes); };
  if (value.is_vector())
    append_vector(out, value.elements(), check);
  else
    append_leaf(out, value);
}

void append_echo_text(std::string& out, const Value& value) {
  if (value.is_vector())
    append_vector(out, value.elements(), check_shown);
  else
    append_leaf(out, value);
  check_shown(out.size(), 0);
}

void append_str_text(std::string& out, const Value& value) {
  if (!value.is_string()) return append_echo_text(out, value);
  out += value.text();
  check_shown(out.size(), 0);
}

std::string echo_text(const Value& value) {
  std::string text;
  append_echo_text(text, value);
  return text;
}

}  // namespace language
