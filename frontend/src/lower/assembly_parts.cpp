#include "lower/assembly_parts.hpp"

#include <algorithm>
#include <iterator>

namespace frontend {
namespace {

using language::Node;
using language::NodeKind;
using language::NodeTree;

struct Range {
  uint32_t begin, end;
};

class Divider {
 public:
  Divider(const NodeTree& tree, std::span<const uint32_t> places)
      : tree_(tree), places_(places.begin(), places.end()) {
    std::ranges::sort(places_);
  }

  /// Returns the parts' ranges of nodes, in the tree's order.
  std::vector<Range> divide(const Range& whole) const {
    std::vector<Range> parts;
    std::vector<Range> open{whole};  // the next one last
    bool is_whole = true;
    while (!open.empty()) {
      const Range range = open.back();
      open.pop_back();
      const std::vector<Range> children = operands(range);
      const bool is_divided = children.size() > 1 && (is_whole || are_calls(children));
      is_whole = false;
      if (is_divided) {
        open.insert(open.end(), children.rbegin(), children.rend());
      } else {
        parts.push_back(range);
      }
    }
    return parts;
  }

 private:
  bool holds_any(const Range& range) const {
    const auto first = std::ranges::lower_bound(places_, range.begin);
    return first != places_.end() && *first < range.end;
  }

  /// Returns the children of which the range, or the only node in it, is put together; none if it
  /// cannot be taken apart.
  std::vector<Range> operands(Range range) const {
    while (true) {
      std::vector<Range> children;
      for (uint32_t child = range.begin; child < range.end; child = tree_.nodes[child].end) {
        const Range one{child, tree_.nodes[child].end};
        if (holds_any(one)) children.push_back(one);
      }
      if (children.size() != 1) return children;
      const uint32_t only = children.front().begin;
      const Node& node = tree_.nodes[only];
      if (only + 1 == node.end) return {};
      switch (node.kind) {
        case NodeKind::kGroup:
        case NodeKind::kMultmatrix:
        case NodeKind::kColor:
        case NodeKind::kRender:
          range = {only + 1, node.end};
          break;
        case NodeKind::kDifference:
          range = {only + 1, tree_.nodes[only + 1].end};
          break;
        default:
          return {};
      }
    }
  }

  /// Returns whether all are calls of the design's modules, moved or coloured.
  bool are_calls(const std::vector<Range>& ranges) const {
    return std::ranges::all_of(ranges, [this](const Range& range) {
      for (uint32_t node = range.begin; node < range.end; ++node) {
        if (tree_.nodes[node].is_module_call) return true;
        const NodeKind kind = tree_.nodes[node].kind;
        const bool goes_on = kind == NodeKind::kMultmatrix || kind == NodeKind::kColor;
        if (!goes_on || tree_.nodes[node].end != range.end) return false;
      }
      return false;
    });
  }

  const NodeTree& tree_;
  std::vector<uint32_t> places_;  // ascending
};

}  // namespace

std::vector<uint32_t> assembly_parts(const NodeTree& tree, const NodeRange& range,
                                     std::span<const uint32_t> places) {
  const std::vector<Range> parts = Divider(tree, places).divide({range.begin, range.end});
  std::vector<uint32_t> result;
  result.reserve(places.size());
  for (const uint32_t place : places) {
    const auto next = std::ranges::upper_bound(parts, place, {}, &Range::begin);
    const bool is_in = next != parts.begin() && place < std::prev(next)->end;
    result.push_back(is_in ? static_cast<uint32_t>(next - parts.begin()) - 1 : 0);
  }
  return result;
}

}  // namespace frontend
