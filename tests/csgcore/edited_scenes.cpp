#include "edited_scenes.hpp"

#include <algorithm>

#include "checks.hpp"
#include "trace_scenes.hpp"

namespace csgcore::checks {
namespace {

size_t pick(std::mt19937& random, size_t count) { return random() % count; }

Color random_color(std::mt19937& random) {
  const auto channel = [&] { return static_cast<float>(uniform(random, 0, 1)); };
  return {channel(), channel(), channel(), 1};
}

/// Returns a primitive of any kind, smaller than most in the scene.
Primitive new_primitive(std::mt19937& random) {
  Primitive primitive = random_primitive(random, {.most_fragments = 8});
  const double scale = uniform(random, 0.1, 0.8);
  primitive.local_to_world = compose({Mat3{scale}, {}}, primitive.local_to_world);
  primitive.local_to_world.translation += random_point(random, {Vec3(-4.0), Vec3(4.0)});
  return primitive;
}

}  // namespace

Design::Design(const Scene& scene) {
  // Subtrees that wait for their operation.
  std::vector<std::vector<Node>> stack;
  for (const CsgToken& token : scene.model.tokens()) {
    std::vector<Node> subtree(1);
    subtree[0].is_primitive = token.is_primitive;
    subtree[0].op = token.op;
    if (token.is_primitive) {
      subtree[0].primitive = scene.primitives[token.value];
    } else {
      for (auto it = stack.end() - token.value; it != stack.end(); ++it) {
        subtree.insert(subtree.end(), it->begin(), it->end());
      }
      stack.resize(stack.size() - token.value);
    }
    subtree[0].size = static_cast<uint32_t>(subtree.size());
    stack.push_back(std::move(subtree));
  }
  if (!stack.empty()) nodes_ = std::move(stack.front());
}

std::vector<size_t> Design::places_of(bool primitives) const {
  std::vector<size_t> places;
  for (size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].is_primitive == primitives) places.push_back(i);
  }
  return places;
}

/// Resizes all subtrees that contain the place by that many nodes.
void Design::resize_around(size_t place, int by) {
  for (size_t i = 0; i < place; ++i) {
    if (i + nodes_[i].size > place) nodes_[i].size += static_cast<uint32_t>(by);
  }
}

void Design::edit(std::mt19937& random) {
  const size_t kind = pick(random, 20);
  if (kind < 7) return move(random);
  if (kind < 11) return insert(random);
  if (kind < 15) return remove(random);
  if (kind < 19) return recolor(random);
  change_operation(random);
}

void Design::move(std::mt19937& random) {
  const auto places = places_of(true);
  if (places.empty()) return;
  Primitive& primitive = nodes_[places[pick(random, places.size())]].primitive;
  if (random() % 2) {
    const std::optional<Color> color = primitive.color;
    primitive = new_primitive(random);
    primitive.color = color;
  } else {
    primitive.local_to_world.translation += 0.3 * random_direction(random);
  }
}

void Design::insert(std::mt19937& random) {
  const auto places = places_of(false);
  if (places.empty()) return;
  const size_t parent = places[pick(random, places.size())];
  // Gaps before each operand, and after the last.
  std::vector<size_t> gaps{parent + 1};
  while (gaps.back() < parent + nodes_[parent].size) {
    gaps.push_back(gaps.back() + nodes_[gaps.back()].size);
  }
  const size_t place = gaps[pick(random, gaps.size())];
  Node node;
  node.is_primitive = true;
  node.primitive = new_primitive(random);
  nodes_[parent].size += 1;
  resize_around(parent, 1);
  nodes_.insert(nodes_.begin() + static_cast<long>(place), std::move(node));
}

void Design::remove(std::mt19937& random) {
  const auto places = places_of(true);
  if (places.size() < 2) return;
  const size_t place = places[pick(random, places.size())];
  resize_around(place, -1);
  nodes_.erase(nodes_.begin() + static_cast<long>(place));
}

void Design::recolor(std::mt19937& random) {
  const auto places = places_of(true);
  if (places.empty()) return;
  nodes_[places[pick(random, places.size())]].primitive.color = random_color(random);
}

void Design::change_operation(std::mt19937& random) {
  const auto places = places_of(false);
  if (places.empty()) return;
  constexpr Op kOps[] = {Op::kUnion, Op::kIntersection, Op::kDifference};
  nodes_[places[pick(random, places.size())]].op = kOps[random() % 3];
}

void Design::build(std::vector<Primitive>& primitives, CsgTreeBuilder& builder) const {
  std::vector<size_t> ends;
  for (size_t i = 0; i <= nodes_.size(); ++i) {
    for (; !ends.empty() && ends.back() == i; ends.pop_back()) builder.close();
    if (i == nodes_.size()) break;
    const Node& node = nodes_[i];
    if (node.is_primitive) {
      const uint32_t index = static_cast<uint32_t>(primitives.size());
      primitives.push_back(node.primitive);
      primitives.back().id = index;
      builder.primitive(index);
    } else {
      builder.open(node.op);
      ends.push_back(i + node.size);
    }
  }
}

Scene Design::scene() const {
  Scene scene;
  CsgTreeBuilder builder;
  build(scene.primitives, builder);
  scene.model = builder.finish();
  return scene;
}

Scene framed_tree(uint32_t primitives, uint32_t seed) {
  const bool cut_out = seed % 2 != 0;
  std::vector<Primitive> frame = {make_sphere(8)};
  if (!cut_out) frame = {make_sphere(1, moved(Vec3(-20.0))), make_sphere(1, moved(Vec3(20.0)))};
  Scene scene;
  CsgTreeBuilder builder;
  builder.open(cut_out ? Op::kDifference : Op::kUnion);
  for (const Primitive& primitive : frame) {
    const uint32_t index = static_cast<uint32_t>(scene.primitives.size());
    scene.primitives.push_back(primitive);
    scene.primitives.back().id = index;
    builder.primitive(index);
  }
  Design(test_support::random_tree(primitives, seed)).build(scene.primitives, builder);
  builder.close();
  scene.model = builder.finish();
  return scene;
}

}  // namespace csgcore::checks
