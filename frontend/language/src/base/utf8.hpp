// UTF-8, as OpenSCAD steps through it: bytes that are no UTF-8 are not refused (LANGUAGE.md,
// "Values").
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace language {

/// Returns whether a byte is a code point in itself.
inline bool is_ascii(char byte) { return static_cast<unsigned char>(byte) < 0x80; }

/// Returns how many bytes the code point at the front of a text has: as many as its first byte
/// announces, whatever follows. 0: the text ends before.
size_t code_point_length(std::string_view text);

/// Returns how many code points a text has. What is cut off at its end is none.
size_t count_code_points(std::string_view text);

/// Returns the offset of a code point below count_code_points(text).
size_t code_point_offset(std::string_view text, size_t index);

/// What stands for bytes that are no UTF-8: they are all alike.
constexpr uint32_t kNoCodePoint = 0xFFFFFFFFu;

/// Returns the code point at the front of a text, or kNoCodePoint. Surrogates, and code points that
/// are written longer than needed, are not refused.
uint32_t first_code_point(std::string_view text);

/// Returns whether a text is valid UTF-8 throughout.
bool is_valid_utf8(std::string_view text);

/// Returns whether a number may be encoded: up to 10FFFF, no surrogate.
bool is_code_point(uint32_t number);

/// Appends a code point's bytes.
void append_code_point(std::string& out, uint32_t code_point);

}  // namespace language
