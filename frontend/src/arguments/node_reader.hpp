// Reads the arguments of a node as OpenSCAD binds them, and tells of wrong ones: an argument of the
// wrong type counts as missing, as in OpenSCAD.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "arguments/node_problems.hpp"
#include "csg/argument_value.hpp"
#include "csgcore/facets.hpp"
#include "frontend/design_tree.hpp"

namespace frontend {

/// Says what a value is: "a number", "undef".
std::string_view name_of(ValueKind kind);

/// Returns undef, a boolean or a number as OpenSCAD writes it. The value must be one of these.
std::string scalar_text(const ArgumentValue& value);

constexpr std::string_view kMissing = "counts as missing";

class NodeReader {
 public:
  /// In place of the place of an argument that has a name only.
  static constexpr size_t kByNameOnly = std::numeric_limits<size_t>::max();

  /// Keeps references to all.
  NodeReader(const NodeTree& tree, const Node& node, NodeProblems& problems)
      : tree_(tree), node_(node), problems_(problems) {}

  const NodeTree& tree() const { return tree_; }
  const Node& node() const { return node_; }
  auto arguments() const { return tree_.arguments_of(node_); }

  /// Returns the argument of that name, or else the one at that place among those without a name;
  /// undef if there is none.
  ArgumentValue find(language::ArgumentName name, size_t position = kByNameOnly) const;
  /// Returns the number of that name or place; nothing where it is missing, or is none.
  std::optional<double> number(language::ArgumentName name, size_t position = kByNameOnly) const;
  /// Returns the string of that name or place; an empty one where it is missing, or is none.
  std::string_view text(language::ArgumentName name, size_t position = kByNameOnly) const;
  /// Returns the elements of the list of that name or place; none where it is missing.
  ValueList list(language::ArgumentName name, size_t position);
  /// Returns whether an argument is the boolean true.
  bool is_true(language::ArgumentName name, size_t position = kByNameOnly) const {
    return find(name, position).is_true();
  }
  /// Returns `center`; only `true` is true.
  bool center(size_t position = kByNameOnly) { return center(find("center", position)); }
  bool center(const ArgumentValue& value);
  /// Returns $fn, $fa and $fs.
  csgcore::FacetSettings facets() const;

  void tell(NodeProblems::Description problem) { problems_.add(node_, std::move(problem)); }
  void tell_first(const ElementProblem& problem) { problem.tell(node_, problems_); }
  /// Tells that an argument, or a part of one, is not what is wanted.
  void tell_wrong(std::string_view argument, const std::string& found, std::string_view consequence,
                  std::string_view wanted);
  /// Tells that an argument has a type that is not wanted. `undef` is no wrong type: it means that
  /// the argument is missing.
  void tell_wrong_type(std::string_view argument, const ArgumentValue& found,
                       std::string_view wanted);

 private:
  const NodeTree& tree_;
  const Node& node_;
  NodeProblems& problems_;
};

}  // namespace frontend
