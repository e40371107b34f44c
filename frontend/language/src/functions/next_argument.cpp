#include <algorithm>
#include <cmath>

#include "functions/functions.hpp"

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
