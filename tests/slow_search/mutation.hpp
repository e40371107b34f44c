// Changes the structure of designs.
#pragma once

#include "design.hpp"
#include "random.hpp"

namespace slow_search {

/// The most bytes of text of a design.
constexpr std::size_t kMostBytes = 200'000;

/// The design after one to four changes: a subtree duplicated, repeated with a shift, removed,
/// unwrapped, wrapped, moved or taken from `other`; an operation exchanged; numbers jittered,
/// scaled, zeroed, rounded or copied. A change that would make it too large is left out.
Design mutated(const Design& design, const Design& other, Random& random);

}  // namespace slow_search
