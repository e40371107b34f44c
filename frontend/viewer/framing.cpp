#include "framing.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <vector>

#include "csgcore/solid.hpp"

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

using csgcore::Projection;
using csgcore::View;

/// Returns the map to coordinates along three vectors.
Mat3 rows(const Vec3& a, const Vec3& b, const Vec3& c) { return glm::transpose(Mat3(a, b, c)); }

/// A pixel of the picture is seen at forward + x·right + y·up: the values of x and y at the part's
/// ends, in an orthographic view at a distance of 1.
struct Slopes {
  double left, right, lower, upper;
};

Slopes slopes_of(const PicturePart& part, double half_height) {
  const auto x = [&](double share) { return (2 * share - 1) * part.aspect * half_height; };
  const auto y = [&](double share) { return (1 - 2 * share) * half_height; };
  return {x(part.left), x(part.right), y(part.bottom), y(part.top)};
}

/// Where the eye stands: its coordinates along right, up and forward.
struct Eye {
  double x, y, z;
};

/// Each side of the part is a plane through the eye, whose normal does not depend on where that is,
/// and which must be beyond all of the solid. The two planes to the left and right leave the eye so
/// much room to go forward, those above and below so much; sideways it stands in the middle.
Eye eye_in_perspective(const View& view, const BoxInFrame& box, const Slopes& slopes) {
  const Box across = box(rows(view.right - slopes.right * view.forward,
                              -view.right + slopes.left * view.forward, view.up));
  const Box along = box(rows(view.up - slopes.upper * view.forward,
                             -view.up + slopes.lower * view.forward, view.right));
  const double right = across.max.x, left = across.max.y;
  const double upper = along.max.x, lower = along.max.y;
  const double z = std::min(-(right + left) / (slopes.right - slopes.left),
                            -(upper + lower) / (slopes.upper - slopes.lower));
  return {0.5 * (right + slopes.right * z + slopes.left * z - left),
          0.5 * (upper + slopes.upper * z + slopes.lower * z - lower), z};
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

Navigation framed(const Navigation& before, const Box& bounds, const BoxInFrame& box,
                  const PicturePart& part) {
  if (bounds.empty()) return before;
  const bool is_perspective = before.projection() == Projection::kPerspective;
  frontend::Camera camera = before.camera();
  camera.distance = 1;
  const View view = Navigation(camera, before.projection()).view({1, 1});
  const Slopes slopes = slopes_of(part, view.half_height);
  Eye eye{};
  double distance = 0;
  if (is_perspective) {
    eye = eye_in_perspective(view, box, slopes);
    distance = glm::dot(bounds.center(), view.forward) - eye.z;
  } else {
    const Box in_view = box(rows(view.right, view.up, view.forward));
    distance = std::max(in_view.size().x / (slopes.right - slopes.left),
                        in_view.size().y / (slopes.upper - slopes.lower));
    eye = {in_view.center().x - 0.5 * (slopes.right + slopes.left) * distance,
           in_view.center().y - 0.5 * (slopes.upper + slopes.lower) * distance,
           in_view.center().z - distance};
  }
  camera.distance = distance;
  camera.target = eye.x * view.right + eye.y * view.up + (eye.z + distance) * view.forward;
  return Navigation(camera, before.projection());
}

Navigation view_all(const Navigation& before, const frontend::ImportedDesign& design,
                    const Box& bounds, const SectionPlane& section, const PicturePart& part) {
  const auto shown = [&](const csgcore::Scene& scene, const Box& box) {
    return framed(
        before, box, [&](const Mat3& to_frame) { return seen_box(scene, box, to_frame); }, part);
  };
  if (!section.is_on) return shown(design.scene, bounds);
  const csgcore::Scene cut = cut_open(design.scene, section, design.view_box).scene;
  return shown(cut, seen_box(cut));
}

}  // namespace window
