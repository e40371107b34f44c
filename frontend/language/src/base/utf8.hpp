// UTF-8, as OpenSCAD steps through it: bytes that are no UTF-8 are not refused.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace language {

/// Returns the length in bytes, at least 1, of the code point that begins at the front of a text
/// that is not empty: what its first byte announces, cut at the text's end.
size_t code_point_length(std::string_view text);

/// Returns how many code points a text has, when stepped through by code_point_length.
size_t count_code_points(std::string_view text);

/// Returns the offset of code point `index`, or the text's size if it has fewer.
size_t code_point_offset(std::string_view text, size_t index);

/// Returns whether a text is valid UTF-8, of code points up to 10FFFF without surrogates.
bool is_valid_utf8(std::string_view text);

/// Returns the code point at the front of a valid text that is not empty.
uint32_t first_code_point(std::string_view text);

/// Returns whether a number may be encoded: up to 10FFFF, no surrogate.
bool is_code_point(uint32_t number);

/// Appends a code point's bytes.
void append_code_point(std::string& out, uint32_t code_point);

}  // namespace language
