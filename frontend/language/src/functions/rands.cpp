#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/evaluation_thread.hpp"
#include "functions/builtin_functions.hpp"
#include "language/make.hpp"

namespace language::functions {
namespace {

constexpr double kMostBound = std::numeric_limits<double>::max() / 2;

// Warns that an argument cannot be used, and says by what it is replaced.
void warn_of_reset(const FunctionCall& call, std::string_view problem, const std::string& reset) {
  call.warn("rands() " + std::string(problem));
  call.environment.messages.say(MessageGroup::kWarning, "resetting " + reset);
}

void warn_of_infinite(const FunctionCall& call, size_t index) {
  if (index == 0)
    warn_of_reset(call, "range min cannot be infinite", "to " + std::to_string(-kMostBound));
  else if (index == 1)
    warn_of_reset(call, "range max cannot be infinite", "to " + std::to_string(kMostBound));
  else if (index == 2)
    warn_of_reset(call, "cannot create an infinite number of results", "number of results to 1");
}

double finite_or(const Value& argument, double otherwise) {
  return std::isfinite(argument.number()) ? argument.number() : otherwise;
}

size_t count_of(const Value& argument) {
  const double count = std::trunc(std::abs(finite_or(argument, 1)));
  constexpr double kEnd = 18446744073709551616.0;  // 2^64
  return count < kEnd ? static_cast<size_t>(count) : std::numeric_limits<size_t>::max();
}

// Returns the seed that a number stands for: its remainder modulo the prime 2^31 - 1, where a
// binary fraction is an integer times a power of the inverse of 2, with the number's sign.
uint32_t seed_of(double number) {
  constexpr int kBits = 31;
  constexpr uint64_t kPrime = (uint64_t{1} << kBits) - 1;
  constexpr uint32_t kInfinite = 314159;
  if (std::isnan(number)) return 0;
  if (std::isinf(number)) return number > 0 ? kInfinite : 0u - kInfinite;
  constexpr int kMantissaBits = 53;
  int exponent = 0;
  const double mantissa = std::frexp(std::abs(number), &exponent);
  const auto integer = static_cast<uint64_t>(std::ldexp(mantissa, kMantissaBits));
  // 2^31 is 1 modulo the prime, so that the power's exponent counts modulo 31.
  const int power = ((exponent - kMantissaBits) % kBits + kBits) % kBits;
  const auto remainder = static_cast<uint32_t>((integer % kPrime << power) % kPrime);
  return number < 0 ? 0u - remainder : remainder;
}

// Returns a number in [0, 1) from two draws, the second of which counts more.
double draw(std::mt19937& random) {
  constexpr double kDraws = 4294967296.0;
  const double low = random();
  const double high = random();
  const double unit = (low + high * kDraws) / (kDraws * kDraws);
  return unit < 1 ? unit : std::nextafter(1.0, 0.0);
}

}  // namespace

size_t next_of_random_numbers(const FunctionCall& call) {
  const auto arguments = call.arguments;
  if (!arguments.empty() && arguments.back().is_number() &&
      !std::isfinite(arguments.back().number()))
    warn_of_infinite(call, arguments.size() - 1);
  return next_while_numbers(call);
}

Value random_numbers(const FunctionCall& call) {
  const auto arguments = call.arguments;
  if (!call.environment.dialect.has_lazy_functions) {
    if (!std::ranges::all_of(arguments, &Value::is_number)) return no_number(call);
    for (size_t i = 0; i < arguments.size(); ++i)
      if (!std::isfinite(arguments[i].number())) warn_of_infinite(call, i);
  }
  if (arguments.size() < call.written || !arguments.back().is_number()) return Value::undef();
  double least = finite_or(arguments[0], -kMostBound), most = finite_or(arguments[1], kMostBound);
  if (most < least) std::swap(least, most);
  std::mt19937& random = call.environment.random;
  if (arguments.size() > 3) random.seed(seed_of(arguments[3].number()));
  const size_t count = count_of(arguments[2]);
  Value result = make_vector(count);
  for (size_t i = 0; i < count; ++i) {
    count_work();
    append_element(result, least == most ? least : draw(random) * (most - least) + least);
  }
  return result;
}

}  // namespace language::functions
