// A set of kinds of primitives, for which a shader is compiled.
#pragma once

#include <compare>
#include <cstdint>
#include <initializer_list>

#include "csgcore/shape.hpp"

namespace glrender {

class KindSet {
 public:
  constexpr KindSet() = default;
  constexpr KindSet(std::initializer_list<csgcore::Shape> kinds) {
    for (const csgcore::Shape kind : kinds) add(kind);
  }

  constexpr void add(csgcore::Shape kind) { bits_ |= bit(kind); }
  constexpr bool has(csgcore::Shape kind) const { return (bits_ & bit(kind)) != 0; }
  constexpr bool empty() const { return bits_ == 0; }

  auto operator<=>(const KindSet&) const = default;

 private:
  static constexpr uint32_t bit(csgcore::Shape kind) { return uint32_t{1} << int(kind); }

  uint32_t bits_ = 0;
};

}  // namespace glrender
