#include "seen_box.hpp"

#include <optional>
#include <vector>

#include "csgcore/tight_bounds.hpp"

namespace window {
namespace {

using csgcore::Box;
using csgcore::Layer;
using csgcore::Mat3;
using csgcore::Vec3;

/// Some 15 ms: a view waits for them.
constexpr uint64_t kMostTests = 1 << 17;
/// Where there are more primitives, which take a microsecond each, the box in the world's frame has
/// to do for all frames.
constexpr std::size_t kMostPrimitives = 4096;

Box box_of_image(const Mat3& to_frame, const Box& box) {
  Box result;
  if (box.empty()) return result;
  for (int corner = 0; corner < 8; ++corner) {
    result.merge(to_frame * Vec3((corner & 1 ? box.max : box.min).x,
                                 (corner & 2 ? box.max : box.min).y,
                                 (corner & 4 ? box.max : box.min).z));
  }
  return result;
}

/// Returns the box in the frame; nothing if the frame is beyond what doubles hold.
std::optional<Box> tight_box_in(const csgcore::Scene& scene, const Mat3& to_frame) {
  std::vector<csgcore::CanonicalPrimitive> in_frame;
  in_frame.reserve(scene.primitives.size());
  for (csgcore::Primitive primitive : scene.primitives) {
    primitive.local_to_world = csgcore::compose({to_frame, Vec3(0.0)}, primitive.local_to_world);
    if (!csgcore::is_valid(primitive)) return std::nullopt;
    in_frame.push_back(csgcore::canonicalize(primitive));
  }
  csgcore::BoundsBudget budget{kMostTests};
  Box box;
  const auto add = [&](const csgcore::CsgTree& solid) {
    box.merge(csgcore::tight_bounds(in_frame, solid, budget));
  };
  add(scene.model);
  for (const Layer& layer : scene.layers) {
    if (layer.kind != Layer::Kind::kModel) add(layer.solid);
  }
  return box;
}

}  // namespace

Box seen_box(const csgcore::Scene& scene) { return tight_box_in(scene, Mat3(1.0)).value_or(Box{}); }

Box seen_box(const csgcore::Scene& scene, const Box& bounds, const Mat3& to_frame) {
  // Each of the two may be tighter: surfaces that coincide along the world's axes do not divide
  // cells of another frame.
  const Box image = box_of_image(to_frame, bounds);
  if (scene.primitives.size() > kMostPrimitives) return image;
  return csgcore::intersection(tight_box_in(scene, to_frame).value_or(image), image);
}

}  // namespace window
