#include "values/value_text.hpp"

#include <vector>

#include "base/evaluation_thread.hpp"
#include "base/number_text.hpp"
#include "values/function_object.hpp"
#include "values/members_object.hpp"
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

// Appends a value that has no parts.
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

// A vector or an object that is being written.
struct OpenBracket {
  std::span<const Value> rest;  // what is not written yet
  bool is_object;
};

bool has_parts(const Value& value) { return value.is_vector() || value.is_object(); }

OpenBracket opened(std::string& out, const Value& value) {
  if (value.is_vector()) {
    out += '[';
    return {value.elements(), false};
  }
  out += "{ ";
  return {value.members().keys_and_values(), true};
}

// Goes on behind a part.
void separate(std::string& out, const OpenBracket& bracket) {
  if (bracket.is_object) {
    out += "; ";
  } else if (!bracket.rest.empty()) {
    out += ", ";
  }
}

// Appends a vector or an object. What is being written lies on a stack of its own, since vectors
// nest deeply. `check` is called for each part.
template <typename Check>
void append_parts(std::string& out, const Value& value, Check check) {
  std::vector<OpenBracket> brackets{opened(out, value)};
  while (true) {
    check(out.size(), brackets.size());
    count_work(kWorkOfElement);
    OpenBracket& bracket = brackets.back();
    std::span<const Value>& rest = bracket.rest;
    if (rest.empty()) {
      out += bracket.is_object ? '}' : ']';
      brackets.pop_back();
      if (brackets.empty()) return;
      separate(out, brackets.back());
      continue;
    }
    if (bracket.is_object) {
      out += rest.front().text();
      out += " = ";
      rest = rest.subspan(1);
    }
    const Value& part = rest.front();
    rest = rest.subspan(1);
    if (has_parts(part)) {
      brackets.push_back(opened(out, part));
      continue;
    }
    if (bracket.is_object && part.is_string()) {
      append_string_literal(out, part.text());
    } else {
      append_leaf(out, part);
    }
    separate(out, bracket);
  }
}

}  // namespace

void append_string_literal(std::string& out, std::string_view text) {
  constexpr std::string_view kEscaped = "\n\t\r\\\"", kLetters = "ntr\\\"";
  out += '"';
  for (const char c : text) {
    const size_t found = kEscaped.find(c);
    if (found != kEscaped.npos) out += '\\';
    out += found == kEscaped.npos ? c : kLetters[found];
  }
  out += '"';
}

void append_value_text(std::string& out, const Value& value) {
  const auto check = [](size_t bytes, size_t) { check_text_size(bytes); };
  if (has_parts(value))
    append_parts(out, value, check);
  else
    append_leaf(out, value);
}

void append_echo_text(std::string& out, const Value& value) {
  if (has_parts(value))
    append_parts(out, value, check_shown);
  else
    append_leaf(out, value);
  check_shown(out.size(), 0);
}

void append_quoted_text(std::string& out, const Value& value) {
  if (!value.is_string()) return append_echo_text(out, value);
  append_string_literal(out, value.text());
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
