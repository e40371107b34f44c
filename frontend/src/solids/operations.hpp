// Set operations on parts of any type: figures, or solids.
#pragma once

#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "csgcore/csg_tree.hpp"
#include "plane/figure.hpp"
#include "solids/csg_subtrees.hpp"

namespace frontend {

/// Parts, and a tree over the indices of some of them.
template <typename Part>
struct Operations {
  std::vector<Part> parts;
  csgcore::CsgTree tree;

  bool is_empty() const { return tree.empty(); }
  bool is_union() const { return frontend::is_union(tree); }
};

/// Returns the union of the parts.
template <typename Part>
Operations<Part> union_of(std::vector<Part> parts) {
  csgcore::CsgTreeBuilder builder;
  for (uint32_t i = 0; i < parts.size(); ++i) builder.primitive(i);
  return {std::move(parts), builder.finish()};
}

template <typename Part>
Operations<Part> value_of(Part part) {
  std::vector<Part> parts;
  parts.push_back(std::move(part));
  return union_of(std::move(parts));
}

/// Returns what the operation makes of the operands, of which some may be empty.
template <typename Part>
Operations<Part> combined(csgcore::Op op, std::vector<Operations<Part>> operands) {
  if (operands.empty()) return {};
  if (operands.size() == 1) return std::move(operands.front());
  Operations<Part> result;
  csgcore::CsgTreeBuilder builder;
  builder.open(op);
  for (Operations<Part>& operand : operands) {
    if (operand.is_empty()) {
      builder.empty();
      continue;
    }
    const auto first = static_cast<uint32_t>(result.parts.size());
    rebuild(operand.tree.tokens(), builder,
            [first](csgcore::CsgTreeBuilder& to, uint32_t part) { to.primitive(first + part); });
    result.parts.insert(result.parts.end(), std::make_move_iterator(operand.parts.begin()),
                        std::make_move_iterator(operand.parts.end()));
  }
  builder.close();
  result.tree = builder.finish();
  return result;
}

/// Returns the operations on the unions of those parts that make(part, made) adds to `made`.
template <typename Made, typename Part, typename Make>
Operations<Made> replaced(const Operations<Part>& operations, const Make& make) {
  Operations<Made> result;
  result.parts.reserve(operations.parts.size());
  csgcore::CsgTreeBuilder builder;
  rebuild(operations.tree.tokens(), builder, [&](csgcore::CsgTreeBuilder& to, uint32_t part) {
    auto next = static_cast<uint32_t>(result.parts.size());
    make(operations.parts[part], result.parts);
    to.open(csgcore::Op::kUnion);
    while (next < result.parts.size()) to.primitive(next++);
    to.close();
  });
  result.tree = builder.finish();
  return result;
}

/// Returns figures whose union the operations leave; nothing if their edges cross too often
/// (kMostCrossings).
std::optional<std::vector<Figure>> outcome_of(const Operations<Figure>& operations);

}  // namespace frontend
