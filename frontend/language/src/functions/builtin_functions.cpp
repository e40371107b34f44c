#include "functions/builtin_functions.hpp"

#include <algorithm>
#include <cmath>

#include "functions/text_parameters.hpp"

namespace language::functions {
namespace {

size_t next_below(size_t end, const FunctionCall& call) {
  const size_t next = call.arguments.size();
  return next < std::min(end, call.written) ? next : kNoArgument;
}

size_t next_of_exactly(size_t count, const FunctionCall& call) {
  return next_below(call.written == count ? count : 0, call);
}

}  // namespace

size_t next_while_numbers(const FunctionCall& call) {
  if (!call.arguments.empty() && !call.arguments.back().is_number()) return kNoArgument;
  return next_below(call.written, call);
}

size_t next_of_none(const FunctionCall&) { return kNoArgument; }
size_t next_of_one(const FunctionCall& call) { return next_below(1, call); }
size_t next_of_four(const FunctionCall& call) { return next_below(4, call); }
size_t next_of_exactly_one(const FunctionCall& call) { return next_of_exactly(1, call); }
size_t next_of_exactly_two(const FunctionCall& call) { return next_of_exactly(2, call); }

size_t next_of_lookup(const FunctionCall& call) {
  if (call.arguments.size() != 1) return next_below(call.written, call);
  const Value& key = call.arguments[0];
  return key.is_number() && std::isfinite(key.number()) ? 1 : 0;
}

}  // namespace language::functions

namespace language {
namespace {

constexpr std::string_view kImportParameters[] = {"file"};
constexpr std::string_view kFontParameters[] = {"size", "font"};

constexpr BuiltinFunction kFunctions[] = {
    {"abs", 1, 1, functions::absolute},
    {"acos", 1, 1, functions::arc_cosine},
    {"asin", 1, 1, functions::arc_sine},
    {"atan", 1, 1, functions::arc_tangent},
    {"atan2", 2, 2, functions::arc_tangent_of_two},
    {"ceil", 1, 1, functions::ceiling},
    {"chr", 0, kAnyCount, functions::characters, functions::next_of_characters},
    {"concat", 0, kAnyCount, functions::concatenation},
    {"cos", 1, 1, functions::cosine},
    {"cross", 0, kAnyCount, functions::cross, functions::next_of_exactly_two, {2, 2}},
    {"dxf_cross",
     0,
     kAnyCount,
     functions::drawing_cross,
     functions::next_of_drawing,
     {},
     true,
     false,
     functions::kDrawingParameters},
    {"dxf_dim",
     0,
     kAnyCount,
     functions::drawing_dimension,
     functions::next_of_drawing,
     {},
     true,
     false,
     functions::kDrawingParameters},
    {"exp", 1, 1, functions::exponential},
    {"floor", 1, 1, functions::floor},
    {"fontmetrics",
     0,
     kAnyCount,
     functions::font_metrics,
     nullptr,
     {},
     false,
     true,
     kFontParameters},
    {"has_key", 2, 2, functions::has_key, nullptr, {}, false, true},
    {"import", 0, kAnyCount, functions::imported_json, nullptr, {}, false, true, kImportParameters},
    {"is_bool", 1, 1, functions::is_bool},
    {"is_function", 1, 1, functions::is_function},
    {"is_list", 1, 1, functions::is_list},
    {"is_num", 1, 1, functions::is_number},
    {"is_object", 1, 1, functions::is_object, nullptr, {}, false, true},
    {"is_string", 1, 1, functions::is_string},
    {"len", 1, 1, functions::length},
    {"ln", 1, 1, functions::natural_logarithm},
    {"log", 1, 2, functions::logarithm, functions::next_while_numbers, {1, 2, "2"}},
    {"lookup", 2, 2, functions::lookup, functions::next_of_lookup},
    {"max",
     1,
     kAnyCount,
     functions::maximum,
     functions::next_while_numbers,
     {1, kAnyCount, "at least 1"}},
    {"min",
     1,
     kAnyCount,
     functions::minimum,
     functions::next_while_numbers,
     {1, kAnyCount, "at least 1"}},
    {"norm", 1, 1, functions::norm},
    {"object", 0, kAnyCount, functions::object, functions::next_of_object, {}, true, true},
    {"ord", 0, kAnyCount, functions::code_point, functions::next_of_exactly_one, {1, 1}},
    {"parent_module", 0, 1, functions::parent_module, nullptr, {0, 1, "1"}},
    {"pow", 2, 2, functions::power},
    {"rands", 3, 4, functions::random_numbers, functions::next_of_random_numbers, {3, 4, "3 or 4"}},
    {"round", 1, 1, functions::round},
    {"search", 2, kAnyCount, functions::search, functions::next_of_four, {2, 4, "between 2 and 4"}},
    {"sign", 1, 1, functions::sign},
    {"sin", 1, 1, functions::sine},
    {"sqrt", 1, 1, functions::square_root},
    {"str", 0, kAnyCount, functions::string},
    {"tan", 1, 1, functions::tangent},
    {"textmetrics",
     0,
     kAnyCount,
     functions::text_metrics,
     nullptr,
     {},
     false,
     true,
     kTextParameters},
    {"version", 0, kAnyCount, functions::version, functions::next_of_none},
    {"version_num", 0, kAnyCount, functions::version_number, functions::next_of_one},
};

}  // namespace

std::span<const BuiltinFunction> builtin_functions() { return kFunctions; }

Arity arity_of(const BuiltinFunction& function, const Dialect& dialect) {
  const bool is_other = dialect.tells_wrong_arguments && function.arity_of_2026.most > 0;
  return is_other ? function.arity_of_2026
                  : Arity{function.least_arguments, function.most_arguments};
}

std::string wrong_count(const BuiltinFunction& function, size_t found, const Dialect& dialect) {
  std::string text = std::string(function.name) + "() number of parameters does not match";
  if (!dialect.tells_wrong_arguments) return text;
  const Arity arity = arity_of(function, dialect);
  const std::string expected =
      arity.words.empty() ? std::to_string(arity.least) : std::string(arity.words);
  return text + ": expected " + expected + ", found " + std::to_string(found);
}

}  // namespace language
