#include "functions/builtin_functions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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

constexpr std::array kFunctions = {
    BuiltinFunction{"abs", 1, 1, functions::absolute},
    BuiltinFunction{"acos", 1, 1, functions::arc_cosine},
    BuiltinFunction{"asin", 1, 1, functions::arc_sine},
    BuiltinFunction{"atan", 1, 1, functions::arc_tangent},
    BuiltinFunction{"atan2", 2, 2, functions::arc_tangent_of_two},
    BuiltinFunction{"ceil", 1, 1, functions::ceiling},
    BuiltinFunction{"chr", 0, kAnyCount, functions::characters, functions::next_of_characters},
    BuiltinFunction{"concat", 0, kAnyCount, functions::concatenation},
    BuiltinFunction{"cos", 1, 1, functions::cosine},
    BuiltinFunction{"cross", 0, kAnyCount, functions::cross, functions::next_of_exactly_two},
    BuiltinFunction{"dxf_cross", 0, kAnyCount, functions::drawing_cross,
                    functions::next_of_drawing},
    BuiltinFunction{"dxf_dim", 0, kAnyCount, functions::drawing_dimension,
                    functions::next_of_drawing},
    BuiltinFunction{"exp", 1, 1, functions::exponential},
    BuiltinFunction{"floor", 1, 1, functions::floor},
    BuiltinFunction{"is_bool", 1, 1, functions::is_bool},
    BuiltinFunction{"is_function", 1, 1, functions::is_function},
    BuiltinFunction{"is_list", 1, 1, functions::is_list},
    BuiltinFunction{"is_num", 1, 1, functions::is_number},
    BuiltinFunction{"is_string", 1, 1, functions::is_string},
    BuiltinFunction{"len", 1, 1, functions::length},
    BuiltinFunction{"ln", 1, 1, functions::natural_logarithm},
    BuiltinFunction{"log", 1, 2, functions::logarithm, functions::next_while_numbers},
    BuiltinFunction{"lookup", 2, 2, functions::lookup, functions::next_of_lookup},
    BuiltinFunction{"max", 1, kAnyCount, functions::maximum, functions::next_while_numbers},
    BuiltinFunction{"min", 1, kAnyCount, functions::minimum, functions::next_while_numbers},
    BuiltinFunction{"norm", 1, 1, functions::norm},
    BuiltinFunction{"ord", 0, kAnyCount, functions::code_point, functions::next_of_exactly_one},
    BuiltinFunction{"parent_module", 0, 1, functions::parent_module},
    BuiltinFunction{"pow", 2, 2, functions::power},
    BuiltinFunction{"rands", 3, 4, functions::random_numbers, functions::next_of_random_numbers},
    BuiltinFunction{"round", 1, 1, functions::round},
    BuiltinFunction{"search", 2, kAnyCount, functions::search, functions::next_of_four},
    BuiltinFunction{"sign", 1, 1, functions::sign},
    BuiltinFunction{"sin", 1, 1, functions::sine},
    BuiltinFunction{"sqrt", 1, 1, functions::square_root},
    BuiltinFunction{"str", 0, kAnyCount, functions::string},
    BuiltinFunction{"tan", 1, 1, functions::tangent},
    BuiltinFunction{"version", 0, kAnyCount, functions::version, functions::next_of_none},
    BuiltinFunction{"version_num", 0, kAnyCount, functions::version_number, functions::next_of_one},
};
static_assert(std::is_sorted(kFunctions.begin(), kFunctions.end(),
                             [](const auto& a, const auto& b) { return a.name < b.name; }));

}  // namespace

std::span<const BuiltinFunction> builtin_functions() { return kFunctions; }

const BuiltinFunction* find_builtin_function(std::string_view name) {
  const auto found = std::lower_bound(kFunctions.begin(), kFunctions.end(), name,
                                      [](const BuiltinFunction& function, std::string_view wanted) {
                                        return function.name < wanted;
                                      });
  return found != kFunctions.end() && found->name == name ? &*found : nullptr;
}

}  // namespace language
