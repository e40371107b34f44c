// Changes of designs, by structure.
#pragma once

#include "design.hpp"
#include "random.hpp"

namespace slow_search {

/// No design grows beyond this many bytes of text.
constexpr std::size_t kMostBytes = 200'000;

/// The design after one to four changes: a subtree duplicated, repeated with a shift, removed,
/// unwrapped, wrapped, moved or taken from `other`; an operation exchanged; numbers jittered,
/// scaled, zeroed, rounded or copied. A change that would make it too large is left out.
Design mutated(const Design& design, const Design& other, Random& random);

}  // namespace slow_search
