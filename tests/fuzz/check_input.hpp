// Checks what must hold for any bytes that are read as a .csg, for libFuzzer and for mutate_test.
#pragma once

#include <string>
#include <string_view>

namespace fuzz {

/// Parses and imports `text`. Returns an empty text if it gave an Error with the file's name, or a
/// tree whose parts all lie within each other; else it says what is wrong. (Sanitizers see reads
/// out of bounds.)
std::string fault_of(std::string_view text);

}  // namespace fuzz
