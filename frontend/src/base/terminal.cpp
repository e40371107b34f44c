#include "frontend/terminal.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>

namespace frontend {
namespace {

/// A code point of a text, and how many bytes it takes.
struct CodePoint {
  uint32_t number;
  std::size_t length;  // 0: the text does not begin with UTF-8
};

CodePoint first_of(std::string_view text) {
  constexpr std::array<uint32_t, 4> kLeast = {0, 0x80, 0x800, 0x10000};  // of so many bytes
  constexpr uint32_t kFirstSurrogate = 0xD800, kLastSurrogate = 0xDFFF, kLast = 0x10FFFF;
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return {first, 1};
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC0 || first >= 0xF8 || length > text.size()) return {0, 0};
  uint32_t number = first & (0x7Fu >> length);
  for (const char c : text.substr(1, length - 1)) {
    if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) return {0, 0};
    number = number << 6 | (static_cast<unsigned char>(c) & 0x3F);
  }
  const bool is_surrogate = kFirstSurrogate <= number && number <= kLastSurrogate;
  if (number < kLeast[length - 1] || number > kLast || is_surrogate) return {0, 0};
  return {number, length};
}

bool is_harmless(uint32_t code_point) {
  const auto is_in = [code_point](uint32_t first, uint32_t last) {
    return first <= code_point && code_point <= last;
  };
  if (code_point == '\n' || code_point == '\t') return true;
  return !is_in(0, 0x1F) && !is_in(0x7F, 0x9F)                 // controls of ASCII and of Latin-1
         && !is_in(0x202A, 0x202E) && !is_in(0x2066, 0x2069);  // embeddings, overrides, isolates
}

void append_spelled(std::string& out, char letter, uint32_t number, std::size_t digits) {
  out += '\\';
  out += letter;
  while (digits-- > 0) out += "0123456789abcdef"[number >> 4 * digits & 0xF];
}

}  // namespace

std::string visible(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const CodePoint at = first_of(text);
    const std::size_t length = std::max<std::size_t>(at.length, 1);
    if (at.length == 0) {
      append_spelled(out, 'x', static_cast<unsigned char>(text[0]), 2);
    } else if (is_harmless(at.number)) {
      out += text.substr(0, length);
    } else if (length == 1) {
      append_spelled(out, 'x', at.number, 2);
    } else {
      append_spelled(out, 'u', at.number, 4);
    }
    text.remove_prefix(length);
  }
  return out;
}

void print_text(std::FILE* stream, std::string_view text) {
  const std::string shown = isatty(fileno(stream)) == 1 ? visible(text) : std::string();
  if (!shown.empty()) text = shown;
  std::fwrite(text.data(), 1, text.size(), stream);
}

void ProgressLine::update(const char* stage, double fraction) {
  if (!enabled_) return;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (now - start_ < kSilence || now - last_ < kInterval) return;
  last_ = now;
  shown_ = true;
  const std::string shown = visible(stage);
  if (fraction < 0) {
    std::fprintf(stderr, "\r\033[K%s ...", shown.c_str());
  } else {
    std::fprintf(stderr, "\r\033[K%s %3.0f%%", shown.c_str(), 100 * std::min(fraction, 1.0));
  }
  std::fflush(stderr);
}

void ProgressLine::clear() {
  const std::lock_guard lock(mutex_);
  if (!shown_) return;
  shown_ = false;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
}

}  // namespace frontend
