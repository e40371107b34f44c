#include "random/random_expression.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <string_view>

namespace language {
namespace {

using Kind = RandomExpression::Kind;

// What an expression is meant to be; one in ten is of another type than its place asks for.
enum class Wanted { kNumber, kVector, kMatrix, kString, kRange, kAny };

struct Function {
  std::string_view name;
  Wanted result;
  std::vector<Wanted> arguments;
};

const std::vector<Function>& known_functions() {
  using enum Wanted;
  static const std::vector<Function> functions = {
      {"abs", kNumber, {kNumber}},
      {"sign", kNumber, {kNumber}},
      {"floor", kNumber, {kNumber}},
      {"ceil", kNumber, {kNumber}},
      {"round", kNumber, {kNumber}},
      {"sqrt", kNumber, {kNumber}},
      {"exp", kNumber, {kNumber}},
      {"ln", kNumber, {kNumber}},
      {"log", kNumber, {kNumber}},
      {"log", kNumber, {kNumber, kNumber}},
      {"pow", kNumber, {kNumber, kNumber}},
      {"sin", kNumber, {kNumber}},
      {"cos", kNumber, {kNumber}},
      {"tan", kNumber, {kNumber}},
      {"asin", kNumber, {kNumber}},
      {"acos", kNumber, {kNumber}},
      {"atan", kNumber, {kNumber}},
      {"atan2", kNumber, {kNumber, kNumber}},
      {"min", kNumber, {kNumber, kNumber, kNumber}},
      {"max", kNumber, {kNumber, kNumber}},
      {"min", kNumber, {kVector}},
      {"max", kNumber, {kMatrix}},
      {"norm", kNumber, {kVector}},
      {"cross", kVector, {kVector, kVector}},
      {"len", kNumber, {kVector}},
      {"len", kNumber, {kString}},
      {"str", kString, {kAny, kAny, kAny}},
      {"str", kString, {kNumber}},
      {"chr", kString, {kNumber, kVector}},
      {"chr", kString, {kRange}},
      {"ord", kNumber, {kString}},
      {"concat", kVector, {kAny, kVector}},
      {"lookup", kNumber, {kNumber, kMatrix}},
      {"search", kVector, {kAny, kVector}},
      {"search", kVector, {kString, kString, kNumber}},
      {"search", kVector, {kString, kMatrix, kNumber, kNumber}},
      {"search", kVector, {kVector, kMatrix, kNumber, kNumber}},
      {"rands", kVector, {kNumber, kNumber, kNumber, kNumber}},
      {"version_num", kNumber, {}},
      {"is_list", kAny, {kAny}},
      {"is_num", kAny, {kAny}},
      {"is_bool", kAny, {kAny}},
      {"is_string", kAny, {kAny}},
      {"is_function", kAny, {kAny}},
  };
  return functions;
}

constexpr std::string_view kNumbers[] = {
    "0",    "1",     "2",    "3",     "4",       "5",        "10",        "0.5",      "1.5",
    "2.5",  "30",    "45",   "60",    "90",      "180",      "360",       "65",       "8364",
    "1e5",  "1e6",   "1e10", "1e-5",  "1e-6",    "1e100",    "1e300",     "1e-300",   "5e-324",
    "0.1",  "0.2",   "0.7",  "0.125", "123456",  "999999.5", "123456.5",  "1234567",  "270",
    "-1",   "-2",    "-0.5", "-90",   "-1e10",   "0/0",      "1/0",       "-1/0",     "-0",
    "1.25", "65536", "1e9",  "55296", "1114112", "1.0e308",  "0.1234565", "0.000015", "4294967297",
};
// No string begins with what is no UTF-8: in the memory that search() of openscad has freed, that
// is often found.
constexpr std::string_view kStrings[] = {
    "",   "a", "b",    "ab",  "abc", "cab", "0",   "1",         "é",   "éa",        "€uro",
    "𝄞x", "A", "true", "[1]", "x y", "zz",  "\\n", "\\\"q\\\\", "aab", "a\xe2\x82", "undef",
};
constexpr std::string_view kOperators[] = {"+",  "-", "*",  "/",  "%",  "^",  "<",
                                           "<=", ">", ">=", "==", "!=", "&&", "||"};
constexpr std::string_view kMembers[] = {"x", "y", "z", "w", "begin", "step", "end"};

class Generator {
 public:
  explicit Generator(std::mt19937& random) : random_(random) {}

  RandomExpression make(Wanted wanted, int depth) {
    if (one_in(10)) wanted = Wanted::kAny;
    switch (wanted) {
      case Wanted::kNumber:
        return number(depth);
      case Wanted::kVector:
        return vector(depth);
      case Wanted::kMatrix:
        return matrix(depth);
      case Wanted::kString:
        return string(depth);
      case Wanted::kRange:
        return range(depth);
      case Wanted::kAny:
        return any(depth);
    }
    return {};
  }

  RandomExpression any(int depth) {
    switch (below(depth > 0 ? 11 : 6)) {
      case 0:
        return {Kind::kLiteral, one_in(2) ? "true" : "false", {}};
      case 1:
        return {Kind::kLiteral, "undef", {}};
      case 2:
        return string(depth);
      case 3:
        return vector(depth);
      case 4:
        return one_in(2) ? range(depth) : matrix(depth);
      case 5:
        return number(depth);
      case 6:
        return ternary(depth);
      case 7:
        return unary("!", Wanted::kAny, depth);
      case 8:
        return index(depth);
      case 9:
        return call(depth);
      default:
        return binary(depth);
    }
  }

 private:
  uint32_t below(size_t end) { return static_cast<uint32_t>(random_() % end); }
  bool one_in(uint32_t count) { return below(count) == 0; }
  template <typename Container>
  auto pick(const Container& container) {
    return container[below(std::size(container))];
  }

  RandomExpression number(int depth) {
    if (depth <= 0 || one_in(3)) return number_literal();
    switch (below(6)) {
      case 0:
        return unary("-", Wanted::kNumber, depth);
      case 1:
        return call_of(Wanted::kNumber, depth);
      case 2:
        return {Kind::kMember, std::string(pick(kMembers)), parts({Wanted::kVector}, depth)};
      case 3:
        return index(depth);
      default:
        return arithmetic(Wanted::kNumber, Wanted::kNumber, depth);
    }
  }

  RandomExpression vector(int depth) {
    if (depth <= 0 || one_in(3)) return list_of(Wanted::kNumber, below(5), depth);
    switch (below(6)) {
      case 0:
        return unary("-", Wanted::kVector, depth);
      case 1:
        return call_of(Wanted::kVector, depth);
      case 2:
        return list_of(Wanted::kAny, below(5), depth);
      case 3:
        return arithmetic(Wanted::kMatrix, Wanted::kVector, depth);
      case 4:
        return arithmetic(Wanted::kVector, Wanted::kMatrix, depth);
      default:
        return arithmetic(Wanted::kVector, Wanted::kVector, depth);
    }
  }

  // Rows of one length, mostly, as products need them.
  RandomExpression matrix(int depth) {
    const uint32_t rows = 1 + below(3), columns = one_in(2) ? 2 : 1 + below(3);
    RandomExpression matrix{Kind::kVector, "", {}};
    const Wanted first = one_in(4) ? Wanted::kString : Wanted::kNumber;
    for (uint32_t i = 0; i < rows; ++i) {
      RandomExpression row = list_of(Wanted::kNumber, one_in(12) ? below(4) : columns, depth);
      if (first == Wanted::kString && !row.parts.empty()) row.parts[0] = string(0);
      matrix.parts.push_back(one_in(20) ? any(depth - 1) : row);
    }
    if (depth > 0 && one_in(3))
      return arithmetic(Wanted::kMatrix, one_in(2) ? Wanted::kMatrix : Wanted::kNumber, depth);
    return matrix;
  }

  RandomExpression string(int depth) {
    if (depth > 0 && one_in(3)) return call_of(Wanted::kString, depth);
    return {Kind::kLiteral, '"' + std::string(pick(kStrings)) + '"', {}};
  }

  RandomExpression range(int depth) {
    RandomExpression range{Kind::kRange, "", {}};
    const uint32_t count = 2 + below(2);
    for (uint32_t i = 0; i < count; ++i)
      range.parts.push_back(one_in(3) ? make(Wanted::kNumber, depth - 1) : number_literal());
    return range;
  }

  RandomExpression number_literal() {
    if (one_in(3)) return {Kind::kLiteral, std::to_string(below(8)), {}};
    if (!one_in(3)) return {Kind::kLiteral, std::string(pick(kNumbers)), {}};
    return {Kind::kLiteral, decimal(), {}};
  }

  // A decimal of up to 17 digits. Seven of them often make a tie of six.
  std::string decimal() {
    std::string text;
    const uint32_t digits = one_in(2) ? 7 : 1 + below(17);
    for (uint32_t i = 0; i < digits; ++i) text += static_cast<char>('0' + below(10));
    if (one_in(2)) text.back() = '5';
    if (!one_in(4)) text.insert(below(text.size()) + 1, ".");
    if (one_in(4)) text += "e" + std::to_string(static_cast<int>(below(40)) - 20);
    return text;
  }

  RandomExpression list_of(Wanted wanted, uint32_t size, int depth) {
    RandomExpression list{Kind::kVector, "", {}};
    for (uint32_t i = 0; i < size; ++i) list.parts.push_back(make(wanted, depth - 1));
    return list;
  }

  RandomExpression unary(std::string sign, Wanted operand, int depth) {
    return {Kind::kUnary, std::move(sign), parts({operand}, depth)};
  }

  RandomExpression arithmetic(Wanted left, Wanted right, int depth) {
    return {Kind::kBinary, std::string(pick(std::span(kOperators).first(6))),
            parts({left, right}, depth)};
  }

  RandomExpression binary(int depth) {
    const Wanted wanted = pick(std::array{Wanted::kNumber, Wanted::kVector, Wanted::kMatrix,
                                          Wanted::kString, Wanted::kRange, Wanted::kAny});
    return {Kind::kBinary, std::string(pick(kOperators)), parts({wanted, wanted}, depth)};
  }

  RandomExpression ternary(int depth) {
    return {Kind::kTernary, "", parts({Wanted::kAny, Wanted::kAny, Wanted::kAny}, depth)};
  }

  RandomExpression index(int depth) {
    const Wanted container =
        pick(std::array{Wanted::kVector, Wanted::kMatrix, Wanted::kString, Wanted::kRange});
    return {Kind::kIndex, "", parts({container, Wanted::kNumber}, depth)};
  }

  RandomExpression call(int depth) { return call_to(pick(known_functions()), depth); }

  RandomExpression call_of(Wanted result, int depth) {
    while (true) {
      const Function function = pick(known_functions());
      if (function.result == result) return call_to(function, depth);
    }
  }

  RandomExpression call_to(const Function& function, int depth) {
    RandomExpression call{Kind::kCall, std::string(function.name),
                          parts(function.arguments, depth)};
    if (function.name == "rands") call.parts[2] = {Kind::kLiteral, std::to_string(below(4)), {}};
    // version_num([1, "a"]) shows what openscad finds in memory.
    if (function.name == "rands" || function.name == "version_num") return call;
    if (one_in(15)) call.parts.push_back(make(Wanted::kAny, depth - 1));
    if (one_in(15) && !call.parts.empty()) call.parts.pop_back();
    return call;
  }

  std::vector<RandomExpression> parts(const std::vector<Wanted>& wanted, int depth) {
    std::vector<RandomExpression> made;
    for (const Wanted part : wanted) made.push_back(make(part, depth - 1));
    return made;
  }

  std::mt19937& random_;
};

std::string joined(const std::vector<RandomExpression>& parts, std::string_view separator) {
  std::string text;
  for (const RandomExpression& part : parts) {
    if (!text.empty()) text += separator;
    text += expression_text(part);
  }
  return text;
}

std::string operand_text(const RandomExpression& operand) {
  return '(' + expression_text(operand) + ')';
}

}  // namespace

RandomExpression random_expression(std::mt19937& random, int depth) {
  return Generator(random).any(depth);
}

std::string expression_text(const RandomExpression& expression) {
  const auto& parts = expression.parts;
  switch (expression.kind) {
    case Kind::kLiteral:
      return expression.token;
    case Kind::kUnary:
      return expression.token + operand_text(parts[0]);
    case Kind::kBinary:
      return operand_text(parts[0]) + ' ' + expression.token + ' ' + operand_text(parts[1]);
    case Kind::kTernary:
      return operand_text(parts[0]) + " ? " + operand_text(parts[1]) + " : " +
             operand_text(parts[2]);
    case Kind::kIndex:
      return operand_text(parts[0]) + '[' + expression_text(parts[1]) + ']';
    case Kind::kMember:
      return operand_text(parts[0]) + '.' + expression.token;
    case Kind::kCall:
      return expression.token + '(' + joined(parts, ", ") + ')';
    case Kind::kVector:
      return '[' + joined(parts, ", ") + ']';
    case Kind::kRange:
      return '[' + joined(parts, " : ") + ']';
  }
  return {};
}

}  // namespace language
