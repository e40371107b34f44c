// How the arguments of nodes are looked up, and how wrong ones are told.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "csg/argument_value.hpp"
#include "frontend/design_tree.hpp"
#include "lower/node_problems.hpp"

namespace frontend {

/// Says what a value is: "a number", "undef".
std::string_view name_of(ValueKind kind);

/// Returns undef, a boolean or a number as OpenSCAD writes it. The value must be one of these.
std::string scalar_text(const ArgumentValue& value);

/// In place of the place of an argument that has a name only.
constexpr size_t kByNameOnly = std::numeric_limits<size_t>::max();

constexpr std::string_view kMissing = "counts as missing";

/// Tells that an argument, or a part of one, is not what is wanted.
void note_wrong(NodeProblems& problems, const Node& node, std::string_view argument,
                const std::string& found, std::string_view consequence, std::string_view wanted);

/// Tells that an argument has a type that is not wanted. `undef` is no wrong type: it means that
/// the argument is missing.
void note_wrong_type(NodeProblems& problems, const Node& node, std::string_view argument,
                     const ArgumentValue& found, std::string_view wanted);

/// Reads `center`; only `true` is true.
bool read_center(const Node& node, const ArgumentValue& value, NodeProblems& problems);

/// Returns the argument of that name, or else the one at that place among those without a name;
/// undef if there is none.
ArgumentValue find_argument(const NodeTree& tree, const Node& node, language::ArgumentName name,
                            size_t position = kByNameOnly);

/// Returns the number of that name or place; nothing where it is missing, or is none.
std::optional<double> number_argument(const NodeTree& tree, const Node& node,
                                      language::ArgumentName name, size_t position = kByNameOnly);

/// Returns the elements of the list of that name or place; none where it is missing.
ValueList list_argument(const NodeTree& tree, const Node& node, language::ArgumentName name,
                        size_t position, NodeProblems& problems);

}  // namespace frontend
