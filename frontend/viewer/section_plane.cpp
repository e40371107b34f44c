#include "section_plane.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <tuple>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/polyhedron.hpp"

namespace window {
namespace {

using csgcore::Box;
using csgcore::CsgToken;
using csgcore::CsgTree;
using csgcore::Op;
using csgcore::Vec3;

/// The distance that the kept half-space reaches beyond the scene, as a share of the scene's size:
/// the plane is its only face near the scene.
constexpr double kMargin = 1;

/// Returns the half-space that is kept, as far as the scene reaches.
csgcore::Primitive kept_half_space(const SectionPlane& plane, const Box& bounds) {
  const double reach = kMargin * bounds.diagonal();
  if (const auto axis = plane.axis()) {
    Box block{bounds.min - reach, bounds.max + reach};
    double& side = plane.cut_off()[*axis] > 0 ? block.max[*axis] : block.min[*axis];
    side = plane.position * plane.normal[*axis];
    return csgcore::make_polyhedron(csgcore::Polyhedron::box(block));
  }
  const csgcore::Mat3 to_world = frame_with(plane.cut_off());
  const Vec3 center = bounds.center() * to_world;
  Box block{center - bounds.diagonal() - reach, center + bounds.diagonal() + reach};
  block.max.z = plane.is_flipped ? -plane.position : plane.position;
  return csgcore::make_polyhedron(csgcore::Polyhedron::box(block), {to_world, Vec3(0.0)});
}

/// Cuts the trees of a scene. It intersects subtrees with the half-space, each of which has one
/// look on the plane, and shows that by a half-space of its own.
class Cutter {
 public:
  Cutter(const csgcore::Scene& scene, const SectionPlane& plane, const Box& bounds,
         std::span<const uint32_t> parts)
      : plane_(plane), half_space_(kept_half_space(plane, bounds)) {
    half_space_.cut_faces = csgcore::CutFaces::kNever;
    next_primitive_ = static_cast<uint32_t>(scene.primitives.size());
    for (const csgcore::Primitive& primitive : scene.primitives) {
      boxes_.push_back(csgcore::canonicalize(primitive).bounds);
      looks_.push_back(
          look_of(primitive.id < parts.size() ? parts[primitive.id] : 0, primitive.color));
    }
  }

  CsgTree cut(const CsgTree& tree) {
    tokens_ = tree.tokens();
    if (tokens_.empty()) return {};
    survey();
    steps_.assign(1, {Action::kCut, static_cast<uint32_t>(tokens_.size()) - 1});
    while (!steps_.empty()) {
      const Step step = steps_.back();
      steps_.pop_back();
      take(step);
    }
    return builder_.finish();
  }

  /// By face, which the cut trees name behind all of the scene's primitives.
  std::vector<csgcore::Primitive> faces;
  std::vector<uint32_t> parts_of_faces;

 private:
  /// The number of a part and a colour.
  using Look = uint32_t;
  static constexpr Look kMixed = 0xFFFFFFFFu;

  struct Subtree {
    uint32_t begin;  // its first token
    Box box;
    Look look;
  };
  enum class Side : uint8_t { kKept, kCut, kGone };
  enum class Action : uint8_t { kCut, kCopy, kOpen, kFace, kClose };
  struct Step {
    Action action;
    uint32_t value = 0;  // a token, an operation or a look
  };

  Look look_of(uint32_t part, const std::optional<csgcore::Color>& color) {
    const csgcore::Color own = color.value_or(csgcore::Color{-1, -1, -1, 1});
    const auto next = static_cast<Look>(parts_and_colors_.size());
    const auto [entry, is_new] = known_looks_.try_emplace(
        std::tuple(part, color.has_value(), own.r, own.g, own.b, own.a), next);
    if (is_new) parts_and_colors_.emplace_back(part, color);
    return entry->second;
  }

  void survey() {
    subtrees_.clear();
    std::vector<uint32_t> operands;  // of the operations that are not complete
    for (uint32_t i = 0; i < tokens_.size(); ++i) {
      const CsgToken& token = tokens_[i];
      if (token.is_primitive) {
        subtrees_.push_back({i, boxes_[token.value], looks_[token.value]});
        operands.push_back(i);
        continue;
      }
      const auto first = operands.end() - token.value;
      Subtree whole = subtrees_[*first];
      for (auto operand = first + 1; operand != operands.end(); ++operand) {
        const Subtree& other = subtrees_[*operand];
        if (token.op == Op::kIntersection) whole.box = intersection(whole.box, other.box);
        if (token.op != Op::kUnion) continue;
        if (!other.box.empty()) whole.box.merge(other.box);
        if (other.look != whole.look) whole.look = kMixed;
      }
      operands.erase(first, operands.end());
      subtrees_.push_back(whole);
      operands.push_back(i);
    }
  }

  Side side_of(uint32_t token) const {
    const Box& box = subtrees_[token].box;
    if (box.empty()) return Side::kKept;
    const auto [least, largest] = positions_in(box, plane_.cut_off());
    const double position = plane_.is_flipped ? -plane_.position : plane_.position;
    return largest <= position ? Side::kKept : least >= position ? Side::kGone : Side::kCut;
  }

  /// Returns the tokens of an operation's operands, in their order.
  std::vector<uint32_t> operands_of(uint32_t token) const {
    std::vector<uint32_t> operands(tokens_[token].value);
    uint32_t next = token - 1;
    for (auto operand = operands.rbegin(); operand != operands.rend(); ++operand) {
      *operand = next;
      next = subtrees_[next].begin - 1;
    }
    return operands;
  }

  /// Has these steps taken next, in their order.
  void push(std::span<const Step> steps) {
    steps_.insert(steps_.end(), steps.rbegin(), steps.rend());
  }

  void take(const Step& step) {
    switch (step.action) {
      case Action::kCut:
        return cut(step.value);
      case Action::kCopy:
        return tokens_[step.value].is_primitive ? builder_.primitive(tokens_[step.value].value)
                                                : open(step.value, Action::kCopy);
      case Action::kOpen:
        return builder_.open(static_cast<Op>(step.value));
      case Action::kFace:
        return add_face(step.value);
      case Action::kClose:
        return builder_.close();
    }
  }

  void cut(uint32_t token) {
    const Side side = side_of(token);
    if (side == Side::kGone) return builder_.empty();
    if (side == Side::kKept) return take({Action::kCopy, token});
    const bool is_primitive = tokens_[token].is_primitive;
    if (!is_primitive && tokens_[token].op == Op::kUnion) return cut_union(token);
    const Look look = subtrees_[token].look;
    if (look == kMixed) return open(token, Action::kCut);
    cut_together({&token, 1}, look);
  }

  /// Does an operation again with its first operand cut, or not, and the others as they are: where
  /// they are cut, too, they show nothing.
  void open(uint32_t token, Action first) {
    std::vector<Step> steps{{Action::kOpen, static_cast<uint32_t>(tokens_[token].op)}};
    for (const uint32_t operand : operands_of(token)) {
      steps.push_back({steps.size() == 1 ? first : Action::kCopy, operand});
    }
    steps.push_back({Action::kClose});
    push(steps);
  }

  /// Operands that follow one another and look the same have one face.
  void cut_union(uint32_t token) {
    std::vector<uint32_t> rest = operands_of(token);
    std::erase_if(rest, [this](uint32_t operand) { return side_of(operand) == Side::kGone; });
    if (rest.empty()) return builder_.empty();
    std::vector<std::span<const uint32_t>> runs;
    for (auto begin = rest.begin(); begin != rest.end();) {
      const Look look = subtrees_[*begin].look;
      auto end = begin + 1;
      while (look != kMixed && end != rest.end() && subtrees_[*end].look == look) ++end;
      runs.emplace_back(begin, end);
      begin = end;
    }
    builder_.open(Op::kUnion);
    steps_.push_back({Action::kClose});
    for (auto run = runs.rbegin(); run != runs.rend(); ++run) push_run(*run);
  }

  void push_run(std::span<const uint32_t> run) {
    const bool is_cut = std::ranges::any_of(
        run, [this](uint32_t operand) { return side_of(operand) == Side::kCut; });
    if (is_cut && run.size() > 1) return cut_together(run, subtrees_[run.front()].look);
    std::vector<Step> steps;
    for (const uint32_t operand : run) steps.push_back({Action::kCut, operand});
    push(steps);
  }

  /// Intersects the union of subtrees of one look with the half-space.
  void cut_together(std::span<const uint32_t> run, Look look) {
    std::vector<Step> steps{{Action::kOpen, static_cast<uint32_t>(Op::kIntersection)},
                            {Action::kOpen, static_cast<uint32_t>(Op::kUnion)}};
    for (const uint32_t operand : run) steps.push_back({Action::kCopy, operand});
    steps.insert(steps.end(), {{Action::kClose}, {Action::kFace, look}, {Action::kClose}});
    push(steps);
  }

  void add_face(Look look) {
    const auto& [part, color] = parts_and_colors_[look];
    csgcore::Primitive face = half_space_;
    face.id = kFirstSectionFace + static_cast<uint32_t>(faces.size());
    face.color = color;
    builder_.primitive(next_primitive_ + static_cast<uint32_t>(faces.size()));
    faces.push_back(std::move(face));
    parts_of_faces.push_back(part);
  }

  const SectionPlane plane_;
  csgcore::Primitive half_space_;
  uint32_t next_primitive_;  // the first face's index in the scene that is made
  std::vector<Box> boxes_;   // by primitive
  std::vector<Look> looks_;  // by primitive
  std::vector<std::pair<uint32_t, std::optional<csgcore::Color>>> parts_and_colors_;  // by look
  std::map<std::tuple<uint32_t, bool, float, float, float, float>, Look> known_looks_;

  // Of the tree at hand.
  std::span<const CsgToken> tokens_;
  std::vector<Subtree> subtrees_;  // by token: of the subtree that it is the root of
  std::vector<Step> steps_;        // the next one last
  csgcore::CsgTreeBuilder builder_;
};

}  // namespace

std::optional<uint8_t> SectionPlane::axis() const {
  for (uint8_t axis = 0; axis < 3; ++axis) {
    if (glm::abs(normal) == axis_of(axis)) return axis;
  }
  return std::nullopt;
}

csgcore::Mat3 frame_with(const Vec3& normal) {
  const Vec3 size = glm::abs(normal);
  const uint8_t least = size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2;
  const Vec3 across = glm::normalize(glm::cross(normal, axis_of(least)));
  return {across, glm::cross(normal, across), normal};
}

std::pair<double, double> positions_in(const Box& box, const Vec3& normal) {
  const double middle = glm::dot(box.center(), normal);
  const double reach = glm::dot(box.size() / 2.0, glm::abs(normal));
  return {middle - reach, middle + reach};
}

CutScene cut_open(const csgcore::Scene& scene, const SectionPlane& plane, const Box& bounds,
                  std::span<const uint32_t> parts) {
  CutScene result{scene, {}};
  if (bounds.empty()) return result;
  Cutter cutter(scene, plane, bounds, parts);
  result.scene.model = cutter.cut(scene.model);
  for (csgcore::Layer& layer : result.scene.layers) {
    layer.solid = cutter.cut(layer.solid);
    layer.parts.clear();  // they would show beyond the plane
  }
  std::ranges::move(cutter.faces, std::back_inserter(result.scene.primitives));
  result.parts = std::move(cutter.parts_of_faces);
  return result;
}

std::optional<uint32_t> primitive_around(const csgcore::CsgTree& tree,
                                         const std::function<bool(uint32_t primitive)>& contains) {
  using Found = std::optional<uint32_t>;
  std::vector<Found> operands;  // of the operations that are not complete
  for (const csgcore::CsgToken& token : tree.tokens()) {
    if (token.is_primitive) {
      operands.push_back(contains(token.value) ? Found(token.value) : std::nullopt);
      continue;
    }
    const auto first = operands.end() - token.value;
    const auto is_solid = [](const Found& operand) { return operand.has_value(); };
    Found result = *first;
    switch (token.op) {
      case csgcore::Op::kUnion:
        if (const auto last =
                std::find_if(operands.rbegin(), std::make_reverse_iterator(first), is_solid);
            last != std::make_reverse_iterator(first)) {
          result = *last;
        }
        break;
      case csgcore::Op::kIntersection:
        if (!std::all_of(first, operands.end(), is_solid)) result.reset();
        break;
      case csgcore::Op::kDifference:
        if (std::any_of(first + 1, operands.end(), is_solid)) result.reset();
        break;
    }
    operands.erase(first, operands.end());
    operands.push_back(result);
  }
  return operands.empty() ? std::nullopt : operands.front();
}

}  // namespace window
