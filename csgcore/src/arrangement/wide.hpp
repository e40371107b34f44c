// Signed integers of a fixed number of 64-bit limbs, for exact predicates. Each operation returns
// a type that is wide enough for its result, so that nothing overflows.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace csgcore {

// The largest integers that both compilers have; -Wpedantic would object to the names.
__extension__ using Int128 = __int128;
__extension__ using UInt128 = unsigned __int128;

/// In two's complement, with the lowest limb first.
template <size_t N>
struct Wide {
  std::array<uint64_t, N> limbs{};

  Wide() = default;
  explicit Wide(Int128 value) {
    static_assert(N >= 2);
    limbs[0] = static_cast<uint64_t>(value);
    limbs[1] = static_cast<uint64_t>(value >> 64);
    for (size_t i = 2; i < N; ++i) limbs[i] = value < 0 ? ~uint64_t{0} : 0;
  }
  template <size_t M>
  requires(M < N) explicit Wide(const Wide<M>& value) {
    std::copy(value.limbs.begin(), value.limbs.end(), limbs.begin());
    std::fill(limbs.begin() + M, limbs.end(), value.is_negative() ? ~uint64_t{0} : 0);
  }

  bool is_negative() const { return static_cast<int64_t>(limbs[N - 1]) < 0; }
  int sign() const {
    if (is_negative()) return -1;
    for (const uint64_t limb : limbs) {
      if (limb != 0) return 1;
    }
    return 0;
  }

  Wide operator-() const {
    Wide result;
    uint64_t carry = 1;
    for (size_t i = 0; i < N; ++i) {
      result.limbs[i] = ~limbs[i] + carry;
      carry = carry != 0 && result.limbs[i] == 0 ? 1 : 0;
    }
    return result;
  }

  /// The nearest double but for one unit in the last place; beyond double's range it is infinite.
  double to_double() const {
    const Wide magnitude = is_negative() ? -*this : *this;
    size_t top = N;
    while (top > 0 && magnitude.limbs[top - 1] == 0) --top;
    if (top == 0) return 0;
    // A unit of the third limb is less than 2^-64 of the value of the upper two, if their top bit
    // is set: so the leading zeros are shifted out.
    const auto zeros = static_cast<unsigned>(std::countl_zero(magnitude.limbs[top - 1]));
    uint64_t leading = magnitude.limbs[top - 1] << zeros;
    if (zeros > 0 && top > 1) leading |= magnitude.limbs[top - 2] >> (64 - zeros);
    const double value = std::ldexp(static_cast<double>(leading),
                                    static_cast<int>(64 * (top - 1)) - static_cast<int>(zeros));
    return is_negative() ? -value : value;
  }
};

/// Returns the sum modulo 2^(64·N): the callers' bounds say that it fits.
template <size_t N>
Wide<N> operator+(const Wide<N>& a, const Wide<N>& b) {
  Wide<N> result;
  UInt128 carry = 0;
  for (size_t i = 0; i < N; ++i) {
    carry += UInt128{a.limbs[i]} + b.limbs[i];
    result.limbs[i] = static_cast<uint64_t>(carry);
    carry >>= 64;
  }
  return result;
}

template <size_t N>
Wide<N> operator-(const Wide<N>& a, const Wide<N>& b) {
  return a + -b;
}

template <size_t A, size_t B>
Wide<A + B> operator*(const Wide<A>& a, const Wide<B>& b) {
  const Wide<A> left = a.is_negative() ? -a : a;
  const Wide<B> right = b.is_negative() ? -b : b;
  Wide<A + B> result;
  for (size_t i = 0; i < A; ++i) {
    if (left.limbs[i] == 0) continue;
    uint64_t carry = 0;
    for (size_t j = 0; j < B; ++j) {
      const UInt128 term = UInt128{left.limbs[i]} * right.limbs[j] + result.limbs[i + j] + carry;
      result.limbs[i + j] = static_cast<uint64_t>(term);
      carry = static_cast<uint64_t>(term >> 64);
    }
    result.limbs[i + B] = carry;
  }
  return a.is_negative() != b.is_negative() ? -result : result;
}

}  // namespace csgcore
