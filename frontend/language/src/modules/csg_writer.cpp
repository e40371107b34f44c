#include "language/csg_writer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>
#include <vector>

#include "base/number_text.hpp"
#include "values/value_text.hpp"

namespace language {
namespace {

/// Appends a number or a boolean.
void append_general(std::string& out, const Value& value) {
  if (value.is_number()) {
    append_general_number(out, value.number());
  } else {
    append_value_text(out, value);
  }
}

void append_numbers(std::string& out, std::span<const double> numbers, std::string_view separator) {
  std::string_view before;
  for (const double number : numbers) {
    out += std::exchange(before, separator);
    append_general_number(out, number);
  }
}

void append_list(std::string& out, std::span<const double> numbers, std::string_view separator) {
  out += '[';
  append_numbers(out, numbers, separator);
  out += ']';
}

/// Appends a vector of vectors of numbers; anything else as a value.
void append_lists(std::string& out, const Value& lists) {
  if (!lists.is_vector()) return append_general(out, lists);
  out += '[';
  std::string_view before_list;
  for (const Value& list : lists.elements()) {
    out += std::exchange(before_list, ", ");
    out += '[';
    std::string_view before;
    for (const Value& number : list.elements()) {
      out += std::exchange(before, ", ");
      append_general_number(out, number.number());
    }
    out += ']';
  }
  out += ']';
}

// Most of a tree's text is matrices: each is put together first and appended once.
void append_matrix(std::string& out, std::span<const double> numbers,
                   char* (*put_number)(char* out, double number)) {
  constexpr size_t kColumns = 4, kNumbers = 16, kMostBetween = 4;
  std::array<char, kNumbers*(kMostNumberText + kMostBetween)> text;
  char* end = text.data();
  const auto put = [&](std::string_view part) { end = std::copy(part.begin(), part.end(), end); };
  for (size_t i = 0; i < kNumbers; ++i) {
    put(i == 0 ? "[[" : i % kColumns == 0 ? "], [" : ", ");
    end = put_number(end, numbers[i]);
  }
  put("]]");
  out.append(text.data(), end);
}

void append_integer(std::string& out, double number) {
  std::array<char, 24> digits;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<int64_t>(number)).ptr;
  out.append(digits.data(), end);
}

void append_value(std::string& out, const NodeTree& tree, const NodeArgument& argument) {
  const std::span<const double> numbers = tree.numbers_of(argument);
  switch (argument.style) {
    case ArgumentStyle::kGeneral:
      if (numbers.empty()) return append_general(out, argument.value);
      return append_list(out, numbers, ", ");
    case ArgumentStyle::kGeneralTight:
      return append_list(out, numbers, ",");
    case ArgumentStyle::kEcho:
      return append_value_text(out, argument.value);
    case ArgumentStyle::kMatrix:
      return append_matrix(out, numbers, put_echo_number);
    case ArgumentStyle::kGeneralMatrix:
      return append_matrix(out, numbers, put_general_number);
    case ArgumentStyle::kGeneralLists:
      return append_lists(out, argument.value);
    case ArgumentStyle::kGeneralSpaced:
      out += "[ ";
      append_numbers(out, numbers, ", ");
      out += ']';
      return;
    case ArgumentStyle::kInteger:
      return append_integer(out, argument.value.number());
    case ArgumentStyle::kRawString:
      out += '"';
      out += argument.value.text();
      out += '"';
      return;
    case ArgumentStyle::kEscapedString:
      append_string_literal(out, argument.value.text());
      return;
  }
}

/// Appends modifiers, indentation, name and arguments. A root (!) has lost its other modifiers.
void append_head(std::string& out, const NodeTree& tree, uint32_t index, size_t depth) {
  const Node& node = tree.nodes[index];
  const bool is_root = depth == 0 && (node.modifiers & kRootModifier) != 0;
  if (!is_root && (node.modifiers & kBackgroundModifier) != 0) out += '%';
  if (!is_root && (node.modifiers & kHighlightModifier) != 0) out += '#';
  out.append(depth, '\t');
  out += name_of(node.kind);
  out += '(';
  std::string_view before;
  for (const NodeArgument& argument : tree.arguments_of(node)) {
    out += std::exchange(before, ", ");
    if (!argument.name.is_positional()) out.append(argument.name.text()).append(" = ");
    append_value(out, tree, argument);
  }
  out += ')';
}

/// Appends the nodes from `begin` to `end`, which are siblings and all below them.
void append_nodes(std::string& out, const NodeTree& tree, uint32_t begin, uint32_t end) {
  std::vector<uint32_t> ends;  // of the nodes that are open
  const auto close_until = [&](uint32_t node) {
    while (!ends.empty() && ends.back() <= node) {
      ends.pop_back();
      out.append(ends.size(), '\t') += "}\n";
    }
  };
  for (uint32_t i = begin; i < end; ++i) {
    close_until(i);
    append_head(out, tree, i, ends.size());
    const bool has_children = tree.nodes[i].end > i + 1 || tree.nodes[i].has_lists;
    out += has_children ? " {\n" : ";\n";
    if (has_children) ends.push_back(tree.nodes[i].end);
  }
  close_until(end);
}

}  // namespace

std::string csg_text(const NodeTree& tree) {
  std::string out;
  // Room that is not used is not touched; growing copies.
  constexpr size_t kBytesPerNode = 80;
  out.reserve(kBytesPerNode * tree.size());
  if (const std::optional<uint32_t> shown = root_modifiers(tree).shown) {
    append_nodes(out, tree, *shown, tree.nodes[*shown].end);
  } else {
    append_nodes(out, tree, 0, tree.size());
  }
  out += '\n';
  return out;
}

}  // namespace language
