// What is wrong with the nodes of a file: one warning for each kind of node and each text, however
// often it occurs.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "frontend/design_tree.hpp"
#include "frontend/error.hpp"

namespace frontend {

class NodeProblems {
 public:
  struct Description {
    std::string what;  // follows the node's name
    std::string todo;
    bool is_note = false;  // make_note()
  };

  /// Adds a problem that occurs `count` times in the node. Only equal ones of a kind of node are
  /// folded into one warning, so that none hides another file, or another cause.
  void add(const Node& node, Description description, uint64_t count = 1);

  void clear() { *this = {}; }

  /// In the order of the places where each occurs first.
  std::vector<Warning> warnings(const DesignTree& tree) const;

 private:
  struct Problem {
    language::Place first;
    uint64_t count = 0;
    uint64_t order = 0;  // among all, of the first
    bool is_note = false;
  };
  std::map<std::tuple<NodeKind, std::string, std::string>, Problem> problems_;  // by text and todo
};

/// A problem of the elements of one node, which is told once for all of them: each of a million
/// indices may be wrong in a way of its own.
struct ElementProblem {
  NodeProblems::Description first;
  uint64_t count = 0;

  /// `describe` is asked for the Description of the first alone.
  template <typename Describe>
  void add(const Describe& describe) {
    if (count++ == 0) first = describe();
  }
  void tell(const Node& node, NodeProblems& problems) const {
    if (count > 0) problems.add(node, first, count);
  }
};

}  // namespace frontend
