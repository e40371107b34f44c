#include "language/customizer.hpp"

#include <array>
#include <charconv>

#include "base/evaluation_thread.hpp"
#include "messages/messages.hpp"
#include "syntax/arena.hpp"
#include "syntax/parameter_comments.hpp"
#include "syntax/parameter_set.hpp"
#include "syntax/parser.hpp"
#include "syntax/program.hpp"

namespace language {

namespace {

/// Parses a text into an empty program. Returns null if it has a syntax error.
const Scope* parse_alone(Program& program, std::string_view text) {
  const FileId file = program.files.add({}, std::string(text.substr(0, text.find('\0'))));
  program.units.emplace_back().file = file;
  Messages messages(program.files, [](const Message&) {});
  messages.set_main_file(file, {});
  NoFiles no_files;
  Lexer lexer(program.dialect, program.files, program.names, program.arena, messages, no_files,
              {file, {}, false});
  Parser parser(lexer, program, messages, {});
  try {
    return parser.parse_file();
  } catch (const SyntaxError&) {
    return nullptr;
  }
}

/// Returns the range that numbers give; nothing if it is empty.
std::optional<ParameterRange> range_of(const CommentEntry& entry) {
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
std::vector<ParameterChoice> choices_of(const std::vector<CommentEntry>& entries,
                                        bool are_numbers) {
  std::vector<ParameterChoice> choices;
  for (const CommentEntry& entry : entries) {
    if (entry.size() > 2 || (are_numbers && !signed_number(entry.front()))) return {};
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

void annotate_numbers(CustomizerParameter& parameter, const std::vector<CommentEntry>& entries) {
  if (are_range(entries)) {
    parameter.range = range_of(entries.front());
  } else if (std::holds_alternative<double>(parameter.value)) {
    parameter.choices = choices_of(entries, true);
  }
}

/// Appends the shortest text that is read as this number.
void append_number(std::string& out, double number) {
  std::array<char, 32> digits;
  out.append(digits.data(), std::to_chars(digits.begin(), digits.end(), number).ptr);
}

void append_string(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  out += '"';
}

std::optional<double> number_of(const Expression* literal) {
  double sign = 1;
  while (literal && literal->kind == ExpressionKind::kUnary &&
         as<UnaryExpression>(*literal).op == UnaryOperator::kNegate) {
    literal = as<UnaryExpression>(*literal).operand;
    sign = -sign;
  }
  if (!literal || literal->kind != ExpressionKind::kNumber) return std::nullopt;
  return sign * as<NumberExpression>(*literal).value;
}

std::optional<ParameterValue> vector_value(const VectorExpression& vector) {
  if (vector.elements.empty()) return std::nullopt;  // which no parameter set can give
  std::vector<double> numbers;
  std::string text = "[";
  for (const Expression* element : vector.elements) {
    if (text.size() > 1) text += ", ";
    if (const auto number = number_of(element)) {
      append_number(text, *number);
      numbers.push_back(*number);
    } else if (element->kind == ExpressionKind::kString) {
      append_string(text, as<StringExpression>(*element).text);
    } else {
      return std::nullopt;
    }
  }
  const bool are_few = numbers.size() <= kMostNumbers;
  if (numbers.size() == vector.elements.size() && are_few) return numbers;
  return LiteralText{ValueType::kVector, text + "]"};
}

std::optional<ParameterValue> range_value(const RangeExpression& range) {
  const auto begin = number_of(range.begin), step = number_of(range.step),
             end = number_of(range.end);
  if (!begin || !end || (range.step && !step)) return std::nullopt;
  std::string text = "[";
  append_number(text, *begin);
  if (step) append_number(text += " : ", *step);
  append_number(text += " : ", *end);
  return LiteralText{ValueType::kRange, text + "]"};
}

ValueType type_of(const ParameterValue& value) {
  if (const auto* literal = std::get_if<LiteralText>(&value)) return literal->type;
  constexpr ValueType kTypes[] = {ValueType::kBool, ValueType::kNumber, ValueType::kString,
                                  ValueType::kVector};
  return kTypes[value.index()];
}

/// Gives a parameter what its comment says of its type of value; what it does not is left.
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
  const std::vector<CommentEntry> entries = comment_entries(comment);
  if (is_numeric) annotate_numbers(parameter, entries);
  if (is_text) parameter.choices = choices_of(entries, false);
}

/// Returns the value of a literal that a parameter set can give; nothing if it is none.
std::optional<ParameterValue> literal_value(const Expression& literal) {
  switch (literal.kind) {
    case ExpressionKind::kBool:
      return as<BoolExpression>(literal).value;
    case ExpressionKind::kString:
      return std::string(as<StringExpression>(literal).text);
    case ExpressionKind::kVector:
      return vector_value(as<VectorExpression>(literal));
    case ExpressionKind::kRange:
      return range_value(as<RangeExpression>(literal));
    default:
      break;
  }
  const auto number = number_of(&literal);
  return number ? std::optional<ParameterValue>(*number) : std::nullopt;
}

}  // namespace

std::string set_text(const ParameterValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* literal = std::get_if<LiteralText>(&value)) return literal->text;
  if (const auto* boolean = std::get_if<bool>(&value)) return *boolean ? "true" : "false";
  std::string text;
  if (const auto* number = std::get_if<double>(&value)) {
    append_number(text, *number);
    return text;
  }
  for (const double number : std::get<std::vector<double>>(value)) {
    append_number(text += text.empty() ? "[" : ", ", number);
  }
  return text + "]";
}

std::optional<ParameterValue> value_of_text(std::string_view text, const ParameterValue& fallback) {
  Arena arena;
  const Expression* literal = parameter_literal(arena, {}, text, type_of(fallback));
  return literal ? literal_value(*literal) : std::nullopt;
}

std::optional<std::vector<CustomizerParameter>> customizer_parameters(std::string_view text,
                                                                      LanguageVersion version) {
  Program program(dialect_of(version));
  const Scope* scope = nullptr;
  with_deep_stack(program.dialect.most_symbols, [&] { scope = parse_alone(program, text); });
  if (!scope) return std::nullopt;
  const ParameterComments comments(text);
  std::vector<CustomizerParameter> parameters;
  for (const Assignment& assignment : scope->assignments) {
    const uint32_t offset = assignment.place.offset;
    if (!comments.may_be_parameter(offset)) continue;
    auto value = literal_value(*assignment.value);
    if (!value) continue;
    CustomizerParameter& parameter = parameters.emplace_back();
    parameter.name = program.names.text(assignment.name);
    parameter.description = comments.description(offset);
    parameter.group = comments.group(offset);
    parameter.value = std::move(*value);
    parameter.offset = offset;
    parameter.comment = comments.annotation(offset);
    annotate(parameter, parameter.comment);
  }
  return parameters;
}

}  // namespace language
