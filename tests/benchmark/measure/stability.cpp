// Measures how far scenes can be pushed: the stress suite's kinds of hardness, each as a curve over
// its parameter, by the CPU in double and by OpenGL in float, against rays in exact arithmetic.
//
// {"width_px", "height_px", "gl_renderer" (if there is one),
//  "curves": [{"name", "title": what is drawn, "parameter": what is varied,
//    "rows": [{"value": of the parameter, "hits": of the exact picture,
//      "double", "float": {"wrong": pixels that show a hit for a miss, a miss for a hit, another
//        primitive, or a place or a normal beyond the tolerance, "undecided": those beside
//        which, 1e-12 of the size aside, exact rays see something else, too; they are not
//        counted as wrong, "median_error",
//        "worst_error": of the places of the pixels that show the right primitive, as a share of
//        the model's size; null if there are none, "rounding": what the rounding of the
//        picture's coordinates alone may do to those}}]}],
//  "tolerances": {"double", "float": {"position": a share of the model's size, "normal"}},
//  "left_out"}
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

#include "cases.hpp"
#include "judge.hpp"
#include "section.hpp"
#ifdef SCADRAY_MEASURE_GL
#include "glrender/renderer.hpp"
#endif

namespace measure {
namespace {

using csgcore::Hits;
using csgcore::Projection;
using csgcore::Scene;
using csgcore::Solid;
using csgcore::Vec3;
using csgcore::View;
using nlohmann::json;
using stress::Part;

constexpr stress::PictureSize kPicture{96, 72};

struct Subject {
  Scene scene;
  View view;
};

/// A parameter, and the subject for each of its values.
struct Curve {
  const char* name;
  const char* title;
  const char* parameter;
  std::vector<double> values;
  std::function<Subject(double value)> make;
};

View view_of(const Scene& scene, double above_deg = 35, double distance = 3) {
  return stress::view_around(stress::camera_box(scene), kPicture, Projection::kPerspective, 25,
                             above_deg, distance);
}

Subject seen(const Part& part) {
  Subject subject{part.scene(), {}};
  subject.view = view_of(subject.scene);
  return subject;
}

/// A block, drilled and filled, with faces that coincide, and bitten by balls.
Part block() {
  const Part body = stress::rod(0, 10, 8) - stress::rod(4, 10, 5) - stress::rod(0, 4, 2);
  std::vector<Part> bites;
  constexpr int kBites = 12;
  for (int i = 0; i < kBites; ++i) {
    const double angle = 2 * std::numbers::pi * i / kBites;
    bites.push_back(stress::ball(1.2, {8 * std::cos(angle), 8 * std::sin(angle), 0.8 * i}));
  }
  return (body + stress::rod(4, 10, 2.5, {2, 0, 0})) - stress::all_of(bites);
}

Subject far_camera(double distance) {
  Scene scene = block().scene();
  const View view = view_of(scene, 35, distance);
  return {std::move(scene), view};
}

/// A bowl and a cup, cut open, with walls of `share` of the model's size.
Subject thin_walls(double share) {
  const double wall = share * 12;  // about the model's diagonal
  const Part bowl = stress::ball(3) - stress::ball(3 - wall) - stress::rod(-4, 4, 3, {-3, 0, 0});
  const Part cup = stress::rod(0, 4, 2, {0, 6, 0}) - stress::rod(wall, 4, 2 - wall, {0, 6, 0});
  return seen(bowl + cup);
}

Subject scaled(double scale) { return seen(block().under({csgcore::Mat3{scale}, Vec3{0.0}})); }

Subject moved_away(double sizes) {
  const double far = sizes * 20;  // about the model's diagonal
  return seen(block().at({far, -far, far}));
}

/// Looks along faces that coincide: a plate with holes, filled flush, and a ball that touches it.
/// The lower the eye, the less of the plate's breadth is in the picture; its length is always
/// whole.
Subject grazed(double angle_deg) {
  std::vector<Part> holes;
  for (const double x : {-5.0, 0.0, 5.0}) holes.push_back(stress::rod(-2, 0, 1.5, {x, 0, 0}));
  const Part plate = stress::rod(-2, 0, 10) - stress::all_of(holes) + stress::all_of(holes) +
                     stress::ball(1, {-8, 0, 1});
  constexpr double kDistance = 3, kHalfHeight = 0.35;
  Subject subject{plate.scene(), {}};
  const csgcore::Box box = stress::camera_box(subject.scene);
  View view = stress::view_around(box, kPicture, Projection::kPerspective, 0, angle_deg, kDistance);
  view.eye = -kDistance * box.diagonal() * view.forward;  // towards the plate's top, in its middle
  view.half_height = kHalfHeight * std::sin(angle_deg * std::numbers::pi / 180);
  subject.view = view;
  return subject;
}

/// Returns 10^first, 10^(first + step), … 10^last.
std::vector<double> powers(int first, int last, int step = 1) {
  std::vector<double> values;
  for (int digits = first; digits <= last; digits += step) values.push_back(std::pow(10., digits));
  return values;
}

std::vector<Curve> curves() {
  return {{"distance", "a drilled block from afar", "camera's distance, in sizes of the model",
           powers(0, 9), far_camera},
          {"thickness", "walls of a bowl and a cup", "thickness, as a share of the model's size",
           powers(-9, -1), thin_walls},
          {"scale", "a drilled block, scaled", "scale", powers(-12, 12, 3), scaled},
          {"offset", "a drilled block far from the origin", "offset, in sizes of the model",
           powers(0, 11), moved_away},
          {"angle", "a plate with its holes filled flush, grazed", "angle of view, in degrees",
           powers(-6, 1), grazed}};
}

json errors_of(stress::Oracle& oracle, const Hits& picture, const stress::Tolerance& tolerance) {
  const stress::Tally tally = stress::judge(oracle, picture, tolerance);
  stress::ErrorHistogram errors;
  for (size_t i = 0; i < picture.primitive.size(); ++i) {
    const oracle::ExactHit& expected = oracle.hit(i);
    if (!expected.hit() || picture.primitive[i] != expected.primitive) continue;
    errors.add(glm::length(picture.position[i] - expected.position) / oracle.model_size());
  }
  const bool any = errors.count() > 0;
  return {{"wrong", tally.wrong_pixels()},
          {"undecided", tally.undecided},
          {"median_error", any ? json(errors.median()) : json()},
          {"worst_error", any ? json(errors.largest()) : json()},
          {"rounding", tally.position_rounding}};
}

Hits by_cpu(const Solid& solid, const View& view) {
  Hits hits;
  csgcore::TraceStats stats;
  csgcore::trace(solid, view, {}, hits, stats);
  return hits;
}

#ifdef SCADRAY_MEASURE_GL
Hits by_gl(glrender::HeadlessContext& context, const Scene& scene, const Solid& solid,
           const View& view) {
  const csgcore::Subdivision subdivision(solid, {});
  glrender::Renderer renderer(context, solid);
  renderer.load(subdivision);
  glrender::FrameSettings settings;
  settings.measured_channels = true;
  glrender::FrameStats stats;
  return csgcore::hits_of(renderer.draw(view, settings, stats), scene);
}
#endif

/// Draws in float, if there is an OpenGL.
class FloatRenderer {
 public:
  explicit FloatRenderer(LeftOut& left_out) {
#ifdef SCADRAY_MEASURE_GL
    try {
      context_ = std::make_unique<glrender::HeadlessContext>();
    } catch (const std::exception& error) {
      left_out.add("float", error.what());
    }
#else
    left_out.add("float", "built without OpenGL");
#endif
  }

  void describe([[maybe_unused]] json& result) const {
#ifdef SCADRAY_MEASURE_GL
    if (context_) result["gl_renderer"] = context_->renderer_name();
#endif
  }

  void add_to([[maybe_unused]] json& row, [[maybe_unused]] const Subject& subject,
              [[maybe_unused]] const Solid& solid, [[maybe_unused]] stress::Oracle& oracle) {
#ifdef SCADRAY_MEASURE_GL
    if (!context_) return;
    const Hits hits = by_gl(*context_, subject.scene, solid, subject.view);
    row["float"] = errors_of(oracle, hits, stress::kFloatTolerance);
#endif
  }

 private:
#ifdef SCADRAY_MEASURE_GL
  std::unique_ptr<glrender::HeadlessContext> context_;
#endif
};

json row_of(const Curve& curve, double value, FloatRenderer& in_float) {
  const Subject subject = curve.make(value);
  const Solid solid(csgcore::canonical_primitives(subject.scene), subject.scene.model);
  stress::Oracle oracle(subject.scene, subject.view);
  json row{{"value", value},
           {"hits", oracle.hits()},
           {"double", errors_of(oracle, by_cpu(solid, subject.view), stress::kDoubleTolerance)}};
  in_float.add_to(row, subject, solid, oracle);
  return row;
}

json tolerance(const stress::Tolerance& tolerance) {
  return {{"position", tolerance.position}, {"normal", tolerance.normal}};
}

}  // namespace

json measure_stability(const Settings& settings) {
  LeftOut left_out;
  FloatRenderer in_float(left_out);
  json all = json::array();
  for (Curve curve : curves()) {
    say(std::string("over the ") + curve.name);
    if (settings.quick) curve.values.resize(1);
    json rows = json::array();
    for (const double value : curve.values) rows.push_back(row_of(curve, value, in_float));
    all.push_back({{"name", curve.name},
                   {"title", curve.title},
                   {"parameter", curve.parameter},
                   {"rows", rows}});
  }
  json result{{"width_px", kPicture.width_px},
              {"height_px", kPicture.height_px},
              {"curves", all},
              {"tolerances",
               {{"double", tolerance(stress::kDoubleTolerance)},
                {"float", tolerance(stress::kFloatTolerance)}}},
              {"left_out", left_out.reasons}};
  in_float.describe(result);
  return result;
}

}  // namespace measure
