// Writing systems, by Unicode and ISO 15924, as text() tells and names them.
#pragma once

#include <string>
#include <string_view>

namespace language {

/// Returns the four letters of the one script that a text's letters are of ("Latn"). Empty if there
/// are none, or of several scripts. Digits, signs and accents are of no script.
std::string_view script_of(std::string_view text);

/// Returns a script's code by its first four letters, in any case: "latn" is Latn; some stand for
/// another script, as Hans for Hani. Empty where there are no four letters, and of codes that mean
/// no script of letters (Zyyy, Zinh, Zzzz).
std::string script_code(std::string_view name);

/// Returns "ltr", "rtl", or "invalid" for a script that is written in both directions.
std::string_view direction_of_script(std::string_view code);

}  // namespace language
