// What a design lets its user choose: the variables of its main file that a parameter set can give
// values to, and what the comments around them say (`openscad -o x.ast` shows OpenSCAD's
// reading).
// - Parameters are the variables of the main file's top level whose value is a literal that a
//   parameter set can replace, in lines before that of the first `{`; includes do not count.
//   OpenSCAD takes a `{` within a string for the first, too.
// - The description is the comment `//` that begins in the first column of the line above. The
//   group is what stands in brackets in the last `/* … */` of one line in the lines before; one
//   without brackets ends a group, one of several lines does nothing. Parameters of `[Hidden]` are
//   not shown.
// - The comment `//` in the assignment's line counts if that is the line's first statement and ends
//   there alone: a number is the step, or the most characters of a string; `[max]`, `[min:max]`,
//   `[min:step:max]` are a range of numbers, also of a vector's; other lists `[value, value:label,
//   …]` are choices. Texts need no quotes, several blanks are one, parentheses vanish. An empty
//   entry, or a colon or bracket too many, spoils the whole comment.
// - A file of sets is `{"parameterSets": {set: {variable: text}}, "fileFormatVersion": "1"}`;
//   OpenSCAD writes "" where there is no set.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "language/customizer_parameter.hpp"
#include "language/language_version.hpp"

namespace language {

/// Returns the parameters in the text of a main file, in its order. Nothing if it cannot be parsed.
/// Files that it includes are not looked at.
std::optional<std::vector<CustomizerParameter>> customizer_parameters(
    std::string_view text, LanguageVersion version = LanguageVersion::k2021);

/// Returns the parameters that are shown, and whose values can be set one by one, as `openscad -o
/// x.param` writes them: JSON with the design's name as its title.
std::string parameters_text(std::span<const CustomizerParameter> parameters,
                            std::string_view title);

}  // namespace language
