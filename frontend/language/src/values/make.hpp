// How strings and vectors are made.
#pragma once

#include <span>
#include <string_view>

#include "language/value.hpp"

namespace language {

Value make_string(std::string_view text);
/// Returns an empty vector with room for `capacity` elements.
Value make_vector(size_t capacity = 0);
Value make_vector(std::span<const Value> elements);

/// Appends to a vector: in place, in amortised constant time, if `vector` is its only reference;
/// else `vector` becomes a copy with one more element.
void append_element(Value& vector, Value element);
/// The same with all elements of a span, which may be the vector's own.
void append_elements(Value& vector, std::span<const Value> elements);
/// Makes room for `count` more elements.
void reserve_elements(Value& vector, size_t count);

}  // namespace language
