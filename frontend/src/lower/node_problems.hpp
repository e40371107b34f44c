// What is wrong with the nodes of a file: one warning for each kind of node and each thing that is
// wrong with it, however often it occurs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/error.hpp"
#include "frontend/syntax_tree.hpp"

namespace frontend {

class NodeProblems {
 public:
  struct Description {
    std::string what;  // follows the node's name
    std::string todo;
    bool is_note = false;  // make_note()
  };

  /// Counts a problem. `topic`, which must outlive this, tells it from others of such nodes;
  /// `describe` is asked for the Description of the first alone.
  template <typename Describe>
  void add(const SyntaxNode& node, std::string_view topic, const Describe& describe) {
    for (Problem& problem : problems_) {
      if (problem.kind != node.kind || problem.topic != topic) continue;
      ++problem.count;
      return;
    }
    problems_.push_back({node.kind, topic, node.location, describe(), 1});
  }

  void clear() { problems_.clear(); }

  /// In the order of the places where each occurs first.
  std::vector<Warning> warnings(const SyntaxTree& tree) const;

 private:
  struct Problem {
    NodeKind kind;
    std::string_view topic;
    Location first;
    Description description;  // of the first
    uint64_t count;
  };
  std::vector<Problem> problems_;
};

}  // namespace frontend
