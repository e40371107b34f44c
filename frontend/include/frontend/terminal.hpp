// Text for people that may show on a terminal, which what a design says must not steer.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace frontend {

/// Returns a text with what it must not do to a terminal spelled as in a string of a design:
/// control characters but line feeds and tabs, marks that turn the direction of writing, and bytes
/// that are no UTF-8. "\x1b[2J" is eight characters then.
std::string visible(std::string_view text);

/// Writes a text to a stream: as it is to a file or a pipe, visible() to a terminal.
void print_text(std::FILE* stream, std::string_view text);

}  // namespace frontend
