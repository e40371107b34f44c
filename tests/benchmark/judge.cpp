// Says what a design's picture has to be, for tests/benchmark/measure.py:
//   benchmark_judge FILE PREFIX WIDTH HEIGHT [TX TY TZ RX RY RZ DISTANCE ZOOM]
// Without a camera it is OpenSCAD's default one. Rays in exact arithmetic see the design, and its
// pictures by the CPU, in double, and by OpenGL, in float, are compared with them. Standard output
// is JSON:
// {"primitives", "camera": its 7 numbers, "pixels", "hits": of the exact picture, "size": the
// model's,
//  "double", "float": {"wrong": pixels that show a hit for a miss, a miss for a hit, another
//  primitive, or a
//    place or a normal beyond the tolerance; "undecided": those beside which, 1e-12 of the size
//    aside, exact rays see something else, too, which are not counted as wrong; "median_error",
//    "worst_error": of the places of pixels that show the right primitive, as shares of the size,
//    null if there are none; "rounding": what the rounding of coordinates alone may do to those},
//  "tolerances": {"double", "float"}: of places, as shares of the size,
//  "gl": OpenGL's renderer, or "no_gl": why there is none, and then no "float"}
// Unless PREFIX is -, files are written, too, and OpenGL is not asked:
//   PREFIX.exact, PREFIX.traced   the node of each pixel (uint32; 2^32 - 1: a miss), then the
//   distance along the
//                                 view axis of each (double): of the exact rays, and of the CPU's
//   PREFIX.pov, PREFIX.id.pov     the scene for POV-Ray, with OpenSCAD's shading; and with each
//   primitive in a
//                                 colour of its own: its index plus one, whose nodes are in
//                                 PREFIX.nodes (uint32)
#include "judge.hpp"

#include <cstdlib>
#include <exception>
#include <fstream>
#include <glm/geometric.hpp>
#include <iostream>
#include <nlohmann/json.hpp>
#include <span>

#include "csgcore/solid.hpp"
#include "frontend/camera.hpp"
#include "frontend/design_file.hpp"
#include "frontend/design_file_options.hpp"
#include "frontend/error.hpp"
#include "frontend/render.hpp"
#include "povray/povray.hpp"

namespace {

using csgcore::Hits;
using csgcore::Scene;
using nlohmann::json;

/// OpenSCAD's default colours.
csgcore::ReferenceColors cornfield() {
  const frontend::ColorScheme scheme = frontend::RenderSettings{}.scheme;
  const auto color = [](const frontend::Rgb& rgb) {
    return csgcore::Vec3(rgb.r, rgb.g, rgb.b) / 255.0;
  };
  return {color(scheme.background), color(scheme.front), color(scheme.back)};
}

Hits by_cpu(const Scene& scene, const csgcore::View& view) {
  const csgcore::Solid solid(csgcore::canonical_primitives(scene), scene.model);
  Hits hits;
  csgcore::TraceStats stats;
  csgcore::trace(solid, view, {}, hits, stats);
  return hits;
}

Hits by_gl(const Scene& scene, const csgcore::View& view, std::string& renderer) {
  frontend::RenderSettings settings;
  settings.renderer = frontend::RendererKind::kGl;
  settings.technique = frontend::Technique::kCells;
  settings.measured_channels = true;
  frontend::RenderStats stats;
  const csgcore::Image image = frontend::render(scene, view, settings, stats);
  renderer = stats.renderer;
  return csgcore::hits_of(image, scene);
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

template <typename Value>
void append(std::ofstream& file, const std::vector<Value>& values) {
  file.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(Value)));
}

void write_hits(const std::string& path, const Scene& scene, const Hits& hits) {
  std::vector<uint32_t> nodes;
  for (const uint32_t index : hits.primitive) {
    nodes.push_back(index == Hits::kMiss ? csgcore::kNoPrimitive : scene.primitives[index].id);
  }
  std::ofstream file(path, std::ios::binary);
  append(file, nodes);
  append(file, hits.s);
}

void write_files(const std::string& prefix, const Scene& scene, const csgcore::View& view,
                 const stress::Oracle& oracle, const Hits& traced) {
  Hits exact;
  for (size_t i = 0; i < traced.primitive.size(); ++i) {
    const oracle::ExactHit& hit = oracle.hit(i);
    exact.primitive.push_back(hit.primitive);
    exact.s.push_back(0.5 * hit.s.lower + 0.5 * hit.s.upper);
  }
  write_hits(prefix + ".exact", scene, exact);
  write_hits(prefix + ".traced", scene, traced);
  std::ofstream(prefix + ".pov") << povray::openscad_scene_text(scene, view, cornfield());
  std::ofstream(prefix + ".id.pov") << povray::id_scene_text(scene, view);
  std::vector<uint32_t> nodes;
  for (const csgcore::Primitive& primitive : scene.primitives) nodes.push_back(primitive.id);
  std::ofstream file(prefix + ".nodes", std::ios::binary);
  append(file, nodes);
}

json judged(const std::vector<std::string>& words) {
  frontend::DesignFileOptions reading;
  reading.evaluator = frontend::kDefaultEvaluator;  // all digits
  reading.message = [](const std::string&) {};
  reading.progress = [](const char*) {};
  frontend::DesignFile file = frontend::read_design(words[0], reading);
  const frontend::ImportedDesign design = frontend::import_design(file);
  const Scene& scene = design.scene;
  frontend::CameraOptions options;
  options.width_px = static_cast<uint32_t>(std::stoul(words[2]));
  options.height_px = static_cast<uint32_t>(std::stoul(words[3]));
  std::vector<double> numbers;
  for (size_t i = 4; i < words.size(); ++i) numbers.push_back(std::stod(words[i]));
  if (!numbers.empty()) options.camera = frontend::camera_from_numbers(std::span(numbers).first(7));
  const frontend::Camera camera = frontend::choose_camera(options, design.view_box);
  csgcore::View view = frontend::make_view(camera, options);
  if (!numbers.empty()) view.half_height /= numbers.back();

  stress::Oracle oracle(scene, view);
  const Hits traced = by_cpu(scene, view);
  const csgcore::Vec3 &at = camera.target, &turned = camera.rotation_deg;
  json result = {{"primitives", scene.primitives.size()},
                 {"camera", {at.x, at.y, at.z, turned.x, turned.y, turned.z, camera.distance}},
                 {"pixels", traced.primitive.size()},
                 {"hits", oracle.hits()},
                 {"size", oracle.model_size()},
                 {"double", errors_of(oracle, traced, stress::kDoubleTolerance)},
                 {"tolerances",
                  {{"double", stress::kDoubleTolerance.position},
                   {"float", stress::kFloatTolerance.position}}}};
  if (words[1] != "-") {
    write_files(words[1], scene, view, oracle, traced);
    return result;
  }
  try {
    std::string renderer;
    const Hits drawn = by_gl(scene, view, renderer);
    result["float"] = errors_of(oracle, drawn, stress::kFloatTolerance);
    result["gl"] = renderer;
  } catch (const frontend::Error& error) {
    result["no_gl"] = error.what();
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() != 4 && words.size() != 12) {
    std::cerr << "usage: benchmark_judge FILE PREFIX WIDTH HEIGHT [a camera's 7 numbers, ZOOM]\n";
    return EXIT_FAILURE;
  }
  try {
    std::cout << judged(words).dump() << '\n';
    return std::cout.flush() ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::exception& error) {
    std::cerr << "benchmark_judge: error: " << error.what() << '\n';
  }
  return EXIT_FAILURE;
}
