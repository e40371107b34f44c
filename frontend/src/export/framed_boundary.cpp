#include "export/framed_boundary.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <utility>
#include <vector>

#include "csgcore/boundary_mesh.hpp"
#include "csgcore/stop_scope.hpp"
#include "export/flush_faces.hpp"
#include "heal/frames.hpp"
#include "solids/csg_subtrees.hpp"
#include "solids/triangles_of.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::CsgToken;
using csgcore::CsgTree;
using csgcore::CsgTreeBuilder;
using csgcore::Op;
using csgcore::TriangleSet;
using csgcore::Vec3;

/// Makes coordinates along an axis equal that differ by rounding.
void align(std::vector<TriangleSet>& surfaces, int axis, double rounding) {
  std::vector<double> values;
  for (const TriangleSet& surface : surfaces) {
    for (const Vec3& vertex : surface.vertices) values.push_back(vertex[axis]);
  }
  std::ranges::sort(values);
  size_t count = 0;
  for (const double value : values) {
    if (count == 0 || value - values[count - 1] > rounding) values[count++] = value;
  }
  values.resize(count);
  for (TriangleSet& surface : surfaces) {
    for (Vec3& vertex : surface.vertices) {
      vertex[axis] = *std::prev(std::ranges::upper_bound(values, vertex[axis]));
    }
  }
}

/// Takes surfaces from the world into a frame.
void place_in_frame(std::vector<TriangleSet>& surfaces, const Affine& to_world) {
  const Affine to_frame = inverse_of(to_world);
  double size = 0;
  for (TriangleSet& surface : surfaces) {
    for (const Vec3& vertex : surface.vertices) size = std::max(size, glm::length(vertex));
    place(surface, to_frame);
  }
  // What the map and its inverse round away, of numbers of that size.
  constexpr double kRounding = 0x1p-47;
  const double rounding =
      kRounding * stretch_bound(to_frame.linear) * (size + glm::length(to_world.translation));
  for (int axis = 0; axis < 3; ++axis) align(surfaces, axis, rounding);
}

/// A tree of operations that is evaluated frame by frame.
class FramedTree {
 public:
  FramedTree(std::span<const TriangleSet> operands, const CsgTree& tree, const TurnedFrames& frames,
             const FlushFaces& flush_faces)
      : operands_(operands),
        tree_(tree),
        tokens_(tree.tokens()),
        frames_(frames),
        flush_faces_(flush_faces),
        subtrees_(tokens_),
        frame_of_(tokens_.size()) {
    std::vector<uint32_t> open;
    for (uint32_t i = 0; i < tokens_.size(); ++i) {
      if (tokens_[i].is_primitive) {
        frame_of_[i] = frames.of_primitive[tokens_[i].value];
      } else {
        const auto inner = std::span(open).last(tokens_[i].value);
        frame_of_[i] = common(inner);
        open.resize(open.size() - inner.size());
      }
      open.push_back(frame_of_[i]);
    }
  }

  TriangleSet boundary() const {
    const auto root = static_cast<uint32_t>(tokens_.size() - 1);
    const Level level = level_of({Op::kUnion, {root}, 0});
    const bool has_no_group =
        std::ranges::all_of(level.parts, [](const Part& part) { return part.group.empty(); });
    return has_no_group ? csgcore::boundary_mesh(operands_, tree_) : boundary_of(level);
  }

 private:
  /// Subtrees, by their roots, and the operation on them, in the frame that holds them all.
  struct Group {
    Op op = Op::kUnion;
    std::vector<uint32_t> members;
    uint32_t frame = 0;

    bool empty() const { return members.empty(); }
  };

  /// What is one operand in the frame around it: a group, or otherwise an operand of the tree.
  struct Part {
    Group group{};
    uint32_t operand = 0;
  };

  /// What is evaluated at once, in one frame.
  struct Level {
    uint32_t frame;
    CsgTree tree;  // over the parts
    std::vector<Part> parts;
  };

  struct Step {
    enum Kind : uint8_t { kOpen, kWhole, kSubtree, kGroup, kClose } kind;
    Op op = Op::kUnion;
    uint32_t subtree = 0;
    Group group{};
  };

  /// Returns the innermost frame that holds all of them.
  uint32_t common(std::span<const uint32_t> frames) const {
    uint32_t result = frames.front();
    for (uint32_t other : frames) {
      while (result != other) {
        uint32_t& inner = depth(result) >= depth(other) ? result : other;
        inner = frames_.frames[inner].parent;
      }
    }
    return result;
  }

  uint32_t depth(uint32_t frame) const { return frames_.frames[frame].depth; }

  /// Returns the frame directly within `around` that `frame` is, or is in, or `around` itself.
  uint32_t branch(uint32_t frame, uint32_t around) const {
    while (depth(frame) > depth(around) + 1) frame = frames_.frames[frame].parent;
    return frame;
  }

  bool is_worth_a_frame(const Group& group) const {
    std::vector<uint32_t> primitives;
    for (const uint32_t member : group.members) {
      for (const CsgToken& token : subtrees_.tokens(member)) {
        if (token.is_primitive) primitives.push_back(token.value);
      }
    }
    return flush_faces_.are_among(primitives);
  }

  /// Returns the operands of an operation in a frame, those of one turned frame within it together.
  /// The operation is on the first one of them and the others. A difference is on its first operand
  /// minus what is turned as that is, and then minus the others.
  std::vector<Group> groups_of(Op op, const std::vector<uint32_t>& members, uint32_t frame) const {
    std::vector<Group> groups;
    std::unordered_map<uint32_t, size_t> known;  // by branch
    for (const uint32_t member : members) {
      const uint32_t turned = branch(frame_of_[member], frame);
      const bool is_turned = turned != frame;
      const auto [entry, is_new] =
          is_turned ? known.emplace(turned, groups.size()) : std::pair{known.end(), true};
      if (is_new) {
        const bool is_subtracted = op == Op::kDifference && !groups.empty();
        groups.push_back({is_subtracted ? Op::kUnion : op, {}, frame_of_[member]});
      }
      Group& group = is_new ? groups.back() : groups[entry->second];
      group.members.push_back(member);
      group.frame = common(std::array{group.frame, frame_of_[member]});
    }
    return groups;
  }

  Level level_of(const Group& group) const {
    Level level{group.frame, {}, {}};
    CsgTreeBuilder builder;
    std::unordered_map<uint32_t, uint32_t> part_of;  // by operand
    std::vector<Step> steps;                         // the next one last
    add_steps(group.op, group.members, group.frame, steps);
    while (!steps.empty()) {
      Step step = std::move(steps.back());
      steps.pop_back();
      const auto next = static_cast<uint32_t>(level.parts.size());
      switch (step.kind) {
        case Step::kOpen:
          builder.open(step.op);
          break;
        case Step::kClose:
          builder.close();
          break;
        case Step::kGroup:
          builder.primitive(next);
          level.parts.push_back({std::move(step.group)});
          break;
        case Step::kSubtree:
          if (!tokens_[step.subtree].is_primitive) {
            add_steps(tokens_[step.subtree].op, subtrees_.operands(step.subtree), level.frame,
                      steps);
            break;
          }
          [[fallthrough]];
        case Step::kWhole:
          rebuild(subtrees_.tokens(step.subtree), builder,
                  [&](CsgTreeBuilder& to, uint32_t operand) {
                    const auto [entry, is_new] =
                        part_of.emplace(operand, static_cast<uint32_t>(level.parts.size()));
                    if (is_new) level.parts.push_back({{}, operand});
                    to.primitive(entry->second);
                  });
          break;
      }
    }
    level.tree = builder.finish();
    return level;
  }

  /// Adds what makes an operation in a frame: each group of its operands as a whole, or, where that
  /// gains nothing, its members.
  void add_steps(Op op, const std::vector<uint32_t>& members, uint32_t frame,
                 std::vector<Step>& steps) const {
    const size_t begin = steps.size();
    steps.push_back({Step::kOpen, op});
    for (Group& group : groups_of(op, members, frame)) {
      const bool is_turned = group.frame != frame;
      if (is_turned && is_worth_a_frame(group)) {
        steps.push_back({Step::kGroup, op, 0, std::move(group)});
        continue;
      }
      // A group that is none in this frame has one member.
      for (const uint32_t member : group.members) {
        steps.push_back({is_turned ? Step::kWhole : Step::kSubtree, op, member});
      }
    }
    steps.push_back({Step::kClose});
    std::reverse(steps.begin() + static_cast<long>(begin), steps.end());
  }

  TriangleSet boundary_of(const Level& level) const {
    std::vector<TriangleSet> surfaces(level.parts.size());
    tbb::parallel_for(size_t{0}, surfaces.size(), [&, stop = csgcore::stop_of_work](size_t i) {
      const csgcore::StopScope scope(stop);
      csgcore::stop_point();
      const Part& part = level.parts[i];
      surfaces[i] =
          part.group.empty() ? operands_[part.operand] : boundary_of(level_of(part.group));
    });
    const Affine& to_world = frames_.frames[level.frame].to_world;
    if (level.frame != 0) place_in_frame(surfaces, to_world);
    TriangleSet result = csgcore::boundary_mesh(surfaces, level.tree);
    if (level.frame != 0) place(result, to_world);
    return result;
  }

  std::span<const TriangleSet> operands_;
  const CsgTree& tree_;
  std::span<const CsgToken> tokens_;
  const TurnedFrames& frames_;
  const FlushFaces& flush_faces_;
  CsgSubtrees subtrees_;
  std::vector<uint32_t> frame_of_;  // by subtree: the innermost frame that holds it all
};

}  // namespace

TriangleSet framed_boundary(std::span<const TriangleSet> operands, const CsgTree& tree,
                            const TurnedFrames& frames) {
  std::vector<uint32_t> turned = primitives_of(tree.tokens());
  std::erase_if(turned, [&](uint32_t operand) { return frames.of_primitive[operand] == 0; });
  if (turned.size() > 1) {
    const FlushFaces flush_faces(operands, turned);
    if (!flush_faces.empty()) return FramedTree(operands, tree, frames, flush_faces).boundary();
  }
  return csgcore::boundary_mesh(operands, tree);
}

}  // namespace frontend
