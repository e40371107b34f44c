#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "functions/functions.hpp"
#include "values/make.hpp"

namespace language::functions {
namespace {

// Says that a bound is infinite, and returns the bound that is used in its place.
double reset_bound(const FunctionCall& call, std::string_view which, double bound) {
  call.warn("rands() range " + std::string(which) + " cannot be infinite");
  call.environment.messages.say(MessageGroup::kWarning, "resetting to " + std::to_string(bound));
  return bound;
}

double bound_of(const FunctionCall& call, size_t index, std::string_view which, double otherwise) {
  const double bound = call.arguments[index].number();
  return std::isfinite(bound) ? bound : reset_bound(call, which, otherwise);
}

size_t count_of(const FunctionCall& call) {
  const double count = std::trunc(std::abs(call.arguments[2].number()));
  constexpr double kEnd = 18446744073709551616.0;  // 2^64
  if (count < kEnd) return static_cast<size_t>(count);
  if (std::isfinite(count)) return std::numeric_limits<size_t>::max();
  call.warn("rands() cannot create an infinite number of results");
  call.environment.messages.say(MessageGroup::kWarning, "resetting number of results to 1");
  return 1;
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

Value random_numbers(const FunctionCall& call) {
  constexpr double kMostBound = std::numeric_limits<double>::max() / 2;
  const auto arguments = call.arguments;
  const auto has_number = [&](size_t i) {
    return i < arguments.size() && arguments[i].is_number();
  };
  if (!has_number(0)) return Value::undef();
  double least = bound_of(call, 0, "min", -kMostBound);
  if (!has_number(1)) return Value::undef();
  double most = bound_of(call, 1, "max", kMostBound);
  if (most < least) std::swap(least, most);
  if (!has_number(2)) return Value::undef();
  const size_t count = count_of(call);
  std::mt19937& random = call.environment.random;
  if (call.written > 3) {
    if (!has_number(3)) return Value::undef();
    random.seed(seed_of(arguments[3].number()));
  }
  Value result = make_vector(count);
  for (size_t i = 0; i < count; ++i)
    append_element(result, least == most ? least : draw(random) * (most - least) + least);
  return result;
}

}  // namespace language::functions
