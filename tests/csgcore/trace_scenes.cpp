#include "trace_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "checks.hpp"
#include "support/models.hpp"

namespace csgcore::checks {
namespace {

Scene finished(std::vector<Primitive> primitives, CsgTreeBuilder& builder) {
  Scene scene;
  for (uint32_t i = 0; i < primitives.size(); ++i) primitives[i].id = 100 + i;
  scene.primitives = std::move(primitives);
  scene.model = builder.finish();
  return scene;
}

void add_all(CsgTreeBuilder& builder, std::initializer_list<uint32_t> primitives) {
  for (const uint32_t primitive : primitives) builder.primitive(primitive);
}

/// A plate with holes flush with its faces, a boss and a pin on it, and a pocket's floor at its
/// bottom face.
Scene flush() {
  std::vector<Primitive> parts = {make_frustum(0, 1, 10, 10),
                                  make_frustum(0, 1, 2, 2, moved({5, 0, 0})),
                                  make_frustum(0, 1, 2, 1, moved({-5, 0, 0})),
                                  make_frustum(1, 3, 3, 3, moved({0, 5, 0})),
                                  make_frustum(1, 4, 3, 3, moved({0, 5, 0})),
                                  make_frustum(1, 2, 3, 3, moved({0, -5, 0})),
                                  make_frustum(0, 2, 10, 10)};
  CsgTreeBuilder builder;
  builder.open(Op::kDifference);
  builder.open(Op::kUnion);
  add_all(builder, {0, 3, 4, 5});
  builder.close();
  add_all(builder, {1, 2});
  builder.open(Op::kDifference);  // what of the second slab the first leaves: its upper half
  add_all(builder, {6, 0, 3, 4, 5});
  builder.close();
  builder.close();
  return finished(std::move(parts), builder);
}

/// Coaxial walls and nested balls of one radius, each twice, as union, difference, intersection.
Scene twins() {
  std::vector<Primitive> parts = {make_sphere(2),
                                  make_sphere(2),
                                  make_frustum(-3, 3, 1, 1),
                                  make_frustum(-3, 4, 1, 1),
                                  make_sphere(2, moved({5, 0, 0})),
                                  make_sphere(2, moved({5, 0, 0})),
                                  make_sphere(2, moved({0, 5, 0})),
                                  make_sphere(2, {Mat3{-1.0}, {0, 5, 0}})};
  CsgTreeBuilder builder;
  builder.open(Op::kUnion);
  builder.open(Op::kDifference);
  add_all(builder, {0, 2, 3});
  builder.close();
  builder.open(Op::kIntersection);
  add_all(builder, {0, 1});
  builder.close();
  builder.open(Op::kDifference);  // nothing
  add_all(builder, {4, 5});
  builder.close();
  add_all(builder, {7, 6});
  builder.close();
  return finished(std::move(parts), builder);
}

/// Balls within a shell, shell and gap both 0.1, 0.5, 2 and 10 times the thinnest piece of a scene
/// of diagonal 20·√3.
Scene thin() {
  const double thinnest = 1e-9 * 20 * std::sqrt(3.0);
  // The first is there for the size: it is cut away but for a sliver.
  std::vector<Primitive> parts{make_sphere(10), make_sphere(10, moved({0.1, 0, 0}))};
  CsgTreeBuilder builder;
  builder.open(Op::kUnion);
  builder.open(Op::kDifference);
  add_all(builder, {0, 1});
  builder.close();
  for (const double thickness : {0.1 * thinnest, 0.5 * thinnest, 2 * thinnest, 10 * thinnest}) {
    const uint32_t first = static_cast<uint32_t>(parts.size());
    const Affine place = moved({0, first % 2 ? 4 : -4, first < 6 ? 4 : -4});
    for (int i = 0; i < 3; ++i) parts.push_back(make_sphere(3 - i * thickness, place));
    builder.open(Op::kDifference);
    builder.primitive(first);
    builder.open(Op::kDifference);
    add_all(builder, {first + 1, first + 2});
    builder.close();
    builder.close();
  }
  builder.close();
  return finished(std::move(parts), builder);
}

/// One primitive in several places of the tree, on both sides of differences.
Scene repeated() {
  std::vector<Primitive> parts = {make_sphere(2), make_sphere(2, moved({1.5, 0, 0})),
                                  make_frustum(-3, 3, 1, 0.2), make_sphere(1.2, moved({0, 0, 2}))};
  CsgTreeBuilder builder;
  builder.open(Op::kUnion);
  builder.open(Op::kDifference);
  add_all(builder, {0, 1, 2});
  builder.close();
  builder.open(Op::kDifference);
  add_all(builder, {1, 0, 3});
  builder.close();
  builder.open(Op::kIntersection);
  add_all(builder, {2, 3});
  builder.close();
  builder.close();
  return finished(std::move(parts), builder);
}

/// A primitive of whole numbers, along an axis, moved by up to three times `jitter`, or not, along
/// each: many of them share planes, axes and radii.
Primitive grid_primitive(std::mt19937& random, double jitter) {
  const auto whole = [&](int low, int high) {
    return double(low + static_cast<int>(random() % static_cast<uint32_t>(high - low + 1)));
  };
  const auto moved_whole = [&](int low, int high) {
    return whole(low, high) + whole(-1, 1) * uniform(random, 0, 3 * jitter);
  };
  const Mat3 turns[] = {Mat3{1.0}, {0, 1, 0, 0, 0, 1, 1, 0, 0}, {0, 0, 1, 1, 0, 0, 0, 1, 0}};
  Affine map{turns[random() % 3], {}};
  for (int axis = 0; axis < 3; ++axis) map.translation[axis] = moved_whole(-3, 3);
  const double bottom = whole(-3, 0), top = whole(1, 3);
  switch (random() % 5) {
    case 0:
      return make_sphere(moved_whole(1, 4), map);
    case 1:
      return make_frustum(bottom, top, whole(0, 3), whole(1, 4), map);
    default: {
      const double radius = moved_whole(1, 4);
      return make_frustum(bottom, top, radius, radius, map);
    }
  }
}

/// A random tree of such primitives.
Scene grid(uint32_t primitives, uint32_t seed, double jitter) {
  Scene scene = test_support::random_tree(primitives, seed);
  std::mt19937 random(seed);
  for (Primitive& primitive : scene.primitives) {
    const uint32_t id = primitive.id;
    primitive = grid_primitive(random, jitter);
    primitive.id = id;
  }
  return scene;
}

Scene colored(Scene scene) {
  for (size_t i = 0; i < scene.primitives.size(); i += 2) {
    const float share = static_cast<float>(i) / static_cast<float>(scene.primitives.size());
    scene.primitives[i].color = Color{share, 1 - share, 0.5f, 1};
  }
  return scene;
}

}  // namespace

Affine moved(const Vec3& by) { return {Mat3{1.0}, by}; }

Scene crowd(uint32_t seed) {
  std::mt19937 random(seed);
  Scene scene;
  CsgTreeBuilder builder;
  const auto add = [&](const Primitive& primitive) {
    scene.primitives.push_back(primitive);
    builder.primitive(static_cast<uint32_t>(scene.primitives.size() - 1));
  };
  const auto within = [&](double reach) {
    return moved(random_point(random, {Vec3(-reach), Vec3(reach)}));
  };
  const auto add_sphere = [&](double least, double most, double reach) {
    const double radius = uniform(random, least, most);  // before the place, by every compiler
    add(make_sphere(radius, within(reach)));
  };
  builder.open(Op::kUnion);
  for (int group = 0; group < 3; ++group) {
    builder.open(Op::kDifference);
    builder.open(Op::kUnion);
    for (int i = 0; i < 150; ++i) add_sphere(0.1, 1, 4);
    add_sphere(3, 5, 2);
    builder.close();
    for (int i = 0; i < 50; ++i) add(make_frustum(-1, 1, 0.3, 0.2, within(4)));
    add_sphere(2, 5, 4);
    builder.close();
  }
  builder.close();
  scene.model = builder.finish();
  return scene;
}

std::vector<NamedScene> trace_scenes() {
  std::vector<NamedScene> scenes = {
      {"Empty", Scene{}},
      {"NothingLeft", scene_of(Op::kDifference, {make_sphere(1), make_sphere(2)})},
      {"Ball", scene_of(Op::kUnion, {make_sphere(3)})},
      {"Flush", flush()},
      {"Twins", twins()},
      {"Thin", thin()},
      {"Repeated", repeated()},
      {"Spheres", test_support::cylinder_minus_spheres(100)},
      {"Cones", colored(test_support::cylinder_minus_cones(60))}};
  // All crossings that coincide, and crossings that lie around the thinnest piece apart.
  for (const uint32_t primitives : {30, 200}) {
    const std::string number = std::to_string(primitives);
    scenes.push_back({"Grid" + number, colored(grid(primitives, 5, 0))});
    scenes.push_back({"Jitter" + number, colored(grid(primitives, 6, 3e-9))});
  }
  scenes.push_back({"Crowd", crowd(1)});
  for (const uint32_t primitives : {3, 10, 40, 150}) {
    scenes.push_back({"Random" + std::to_string(primitives),
                      colored(test_support::random_tree_of_all_kinds(primitives, primitives))});
  }
  return scenes;
}

NamedScene trace_scene(const std::string& name) {
  const std::vector<NamedScene> scenes = trace_scenes();
  return *std::find_if(scenes.begin(), scenes.end(),
                       [&](const NamedScene& scene) { return scene.name == name; });
}

std::vector<NamedView> trace_views(const Box& bounds, uint32_t width_px, uint32_t height_px) {
  const Box box = bounds.empty() ? Box{Vec3(-1.0), Vec3(1.0)} : bounds;
  const double size = box.diagonal();
  std::vector<NamedView> views;
  const auto add = [&](const char* name, const Vec3& direction, double distance, double half_height,
                       Projection projection) {
    View view = view_of(box, glm::normalize(direction), distance);
    view.projection = projection;
    view.half_height = half_height;
    view.width_px = width_px;
    view.height_px = height_px;
    views.push_back({name, view});
  };
  constexpr Projection kPerspective = Projection::kPerspective;
  constexpr Projection kOrthographic = Projection::kOrthographic;
  add("Perspective", {0.5, 0.7, -0.6}, 2 * size, 0.25, kPerspective);
  add("CloseUp", {-0.5, 0.2, -0.8}, 0.6 * size, 0.1, kPerspective);
  add("FromWithin", {0.3, -0.7, 0.2}, 0.02 * size, 1.0, kPerspective);
  add("FromFarAway", {0.1, 0.9, -0.3}, 1e6 * size, 5e-7, kPerspective);
  add("Orthographic", {-0.4, 0.3, -0.5}, 0, 0.5 * size, kOrthographic);
  add("AlongAxis", {0, 0, -1}, size, 0.4 * size, kOrthographic);
  add("Sideways", {0, 1, 0}, size, 0.4 * size, kOrthographic);
  return views;
}

CsgTree tree_of(const std::string& text) {
  CsgTreeBuilder builder;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '(') {
      const char op = text[++i];
      builder.open(op == '+' ? Op::kUnion : op == '-' ? Op::kDifference : Op::kIntersection);
    }
    if (c == ')') builder.close();
    if (c >= '0' && c <= '9') builder.primitive(static_cast<uint32_t>(c - '0'));
  }
  return builder.finish();
}

}  // namespace csgcore::checks
