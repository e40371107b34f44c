#include "lower/resolved_modifiers.hpp"

#include <algorithm>

#include "subtrees/inner_parts.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {

/// A node whose operands are being looked at.
struct OpenOperation {
  uint32_t node;
  NodeKind kind;
  uint32_t end;
  bool any_background = false, any_left_out = false, any_empty = false, any_solid = false;
  csgcore::Box box{};  // of the result: an intersection of boxes that are disjoint is empty
  bool all_highlighted = true;  // of the solid operands
  bool has_first = false;       // of a difference: what the rest is cut from
  ResolvedNode first{};
};

void add_box(OpenOperation& open, const csgcore::Box& box) {
  if (!open.any_solid) {
    open.box = box;
  } else if (open.kind != NodeKind::kIntersection) {
    if (open.kind != NodeKind::kDifference) open.box.merge(box);
  } else {
    open.box = csgcore::intersection(open.box, box);
    open.any_empty = open.any_empty || open.box.empty();
  }
}

void add_operand(OpenOperation& open, const ResolvedNode& node_state, const csgcore::Box& box) {
  if (node_state.presence == Presence::kAbsent) return;
  if (node_state.presence == Presence::kBackground) {
    open.any_background = true;
    return;
  }
  if (!open.has_first) {
    open.has_first = true;
    open.first = node_state;
  }
  open.any_left_out = open.any_left_out || node_state.presence == Presence::kLeftOut;
  open.any_empty = open.any_empty || node_state.presence == Presence::kEmpty;
  if (node_state.presence == Presence::kSolid) {
    add_box(open, box);
    open.any_solid = true;
    open.all_highlighted = open.all_highlighted && node_state.highlighted;
  }
}

Presence presence_of(const OpenOperation& open) {
  if (open.kind == NodeKind::kDifference) {
    if (open.has_first) return open.first.presence;
    return open.any_background ? Presence::kBackground : Presence::kEmpty;
  }
  if (open.kind == NodeKind::kIntersection && open.any_empty) return Presence::kEmpty;
  if (open.any_solid) return Presence::kSolid;
  if (open.any_left_out) return Presence::kLeftOut;
  return open.any_background && !open.any_empty ? Presence::kBackground : Presence::kEmpty;
}

/// The node as an operand, before its own modifiers count.
ResolvedNode close(const OpenOperation& open) {
  ResolvedNode node_state;
  node_state.presence = presence_of(open);
  if (node_state.presence == Presence::kSolid && !row_of(open.kind).is_one_leaf) {
    node_state.keeps_highlighted = open.kind == NodeKind::kDifference
                                       ? open.first.highlighted
                                       : open.all_highlighted && open.any_solid;
    node_state.highlighted = node_state.keeps_highlighted;
  }
  return node_state;
}

void apply_modifiers(ResolvedNode& node_state, uint8_t modifiers) {
  if ((modifiers & language::kHighlightModifier) != 0) {
    node_state.highlighted = node_state.presence == Presence::kSolid;
  }
  if ((modifiers & language::kBackgroundModifier) != 0 &&
      node_state.presence != Presence::kLeftOut) {
    node_state.presence = Presence::kBackground;
  }
}

/// Walks the nodes and closes each after its last descendant.
class ModifierResolver {
 public:
  ModifierResolver(const NodeTree& tree, NodeRange selected, std::span<const LeafState> leaves,
                   PictureKind picture)
      : tree_(tree), selected_(selected), leaves_(leaves), picture_(picture) {}

  ResolvedModifiers find() {
    resolved_.nodes.resize(tree_.nodes.size(), ResolvedNode{Presence::kAbsent, false, false});
    open_.push_back({0, NodeKind::kGroup, selected_.end});  // the top level is a union
    for (uint32_t i = selected_.begin; i < selected_.end;) {
      const Node& node = tree_.nodes[i];
      close_until(i);
      if (node.end > i + 1 && !leaves_[i].is_whole && leaves_[i].presence != Presence::kLeftOut) {
        open_.push_back({i, node.kind, node.end});
        ++i;
      } else {
        finish(i, {leaves_[i].presence, false, false}, leaves_[i].box);
        i = node.end;
      }
    }
    close_until(selected_.end);
    const OpenOperation& top = open_.back();
    resolved_.keeps_highlighted = top.any_solid && top.all_highlighted;
    collect_roots();
    return std::move(resolved_);
  }

 private:
  void close_until(uint32_t position) {
    while (open_.size() > 1 && open_.back().end <= position) {
      const OpenOperation done = open_.back();
      open_.pop_back();
      ResolvedNode node_state = close(done);
      // A preview passes over an operation of `%` parts alone. A rendering makes an empty solid of
      // it, which empties an intersection.
      if (picture_ == PictureKind::kRendered && node_state.presence == Presence::kBackground)
        node_state.presence = Presence::kEmpty;
      finish(done.node, node_state, done.box);
    }
  }

  void finish(uint32_t node, ResolvedNode node_state, const csgcore::Box& box) {
    apply_modifiers(node_state, modifiers_of(tree_, selected_, node));
    resolved_.nodes[node] = node_state;
    add_operand(open_.back(), node_state, box);
  }

  /// The parts to be overlaid: each highlighted node that its parent does not carry on.
  void collect_roots() {
    struct Parent {
      uint32_t end;
      NodeKind kind;
      bool keeps_highlighted;
    };
    std::vector<Parent> parents{
        {selected_.end, NodeKind::kGroup, false}};  // overlaid whatever it consists of
    std::vector<uint32_t> highlight_ends;
    for (uint32_t i = selected_.begin; i < selected_.end;) {
      const Node& node = tree_.nodes[i];
      const ResolvedNode& node_state = resolved_.nodes[i];
      while (parents.size() > 1 && parents.back().end <= i) parents.pop_back();
      while (!highlight_ends.empty() && highlight_ends.back() <= i) highlight_ends.pop_back();
      if (node_state.presence == Presence::kAbsent || node_state.presence == Presence::kLeftOut) {
        i = node.end;
        continue;
      }
      Parent& parent = parents.back();
      const bool own_background =
          (modifiers_of(tree_, selected_, i) & language::kBackgroundModifier) != 0 &&
          node_state.presence == Presence::kBackground;
      const bool carried_on = !own_background && parent.keeps_highlighted;
      const bool in_leaf = row_of(parent.kind).is_one_leaf;
      if (own_background && !in_leaf) resolved_.background.push_back(i);
      if (node_state.highlighted && !carried_on && !in_leaf &&
          highlight_ends.size() < kMostNestedHighlights) {
        resolved_.highlight.push_back(i);
        highlight_ends.push_back(node.end);
      }
      parents.push_back({node.end, node.kind, node_state.keeps_highlighted});
      ++i;
    }
  }

  const NodeTree& tree_;
  NodeRange selected_;
  std::span<const LeafState> leaves_;
  PictureKind picture_;
  ResolvedModifiers resolved_;
  std::vector<OpenOperation> open_;
};

}  // namespace

ResolvedModifiers resolve_modifiers(const NodeTree& tree, NodeRange selected,
                                    std::span<const LeafState> leaves, PictureKind picture) {
  return ModifierResolver(tree, selected, leaves, picture).find();
}

}  // namespace frontend
