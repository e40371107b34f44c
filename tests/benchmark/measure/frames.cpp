// A moved camera, the tree in memory: scadray's frame beside Embree's on a finished mesh.
//
// {"design", "width_px", "height_px", "frames", "turn_deg": from frame to frame, "threads",
//  "programs": [{"name", "frame_ms": Summary, "prepare_ms": Summary, "prepares": what is made once,
//    "ratio": to Embree's frame}],
//  "mesh": {"method", "fragments", "triangles", "made_ms"},
//  "agreement": {"pixels", "hits": scadray's of the same facets, "other_hit", "other_depth",
//    "other_hit_round": against the round design},
//  "ratio": {"what", "value", "at_most"},
//  "left_out": ["what: why"]}
// "mesh", "agreement", "ratio" and the programs' "ratio" are not there without Embree.
#include <cmath>
#include <memory>
#include <optional>

#include "csgcore/solid.hpp"
#include "csgcore/subdivision.hpp"
#include "csgcore/tracer.hpp"
#include "designs.hpp"
#include "exact_design.hpp"
#include "frontend/camera.hpp"
#include "section.hpp"
#ifdef MEASURE_HAS_EMBREE
#include "embree_frame.hpp"
#include "support/reference.hpp"
#endif

namespace measure {
namespace {

using csgcore::Image;
using csgcore::View;
using nlohmann::json;

constexpr const char* kDesign = "cs1000";
constexpr double kTurn_deg = 1;
constexpr size_t kFrames = 60;
/// The share of Embree's time for a frame that scadray may take: the bar that the report names.
constexpr double kMostOfEmbree = 0.5;

/// OpenSCAD's default colours.
csgcore::FrameSettings cornfield() {
  const frontend::ColorScheme scheme = frontend::RenderSettings{}.scheme;
  const auto color = [](const frontend::Rgb& rgb) {
    return glm::vec3(rgb.r, rgb.g, rgb.b) / 255.0f;
  };
  csgcore::FrameSettings settings;
  settings.background = color(scheme.background);
  settings.front = color(scheme.front);
  settings.back = color(scheme.back);
  return settings;
}

/// OpenSCAD's default camera, turned.
class Turntable {
 public:
  explicit Turntable(const csgcore::Box& view_box) {
    options_.width_px = 640;
    options_.height_px = 480;
    camera_ = frontend::choose_camera(options_, view_box);
  }
  View at(size_t frame) const {
    frontend::Camera turned = camera_;
    turned.rotation_deg.z += kTurn_deg * static_cast<double>(frame);
    return frontend::make_view(turned, options_);
  }

 private:
  frontend::CameraOptions options_;
  frontend::Camera camera_;
};

struct Program {
  std::string name, prepares;
  std::function<double()> prepare;  // returns ms
  std::function<void(const View&, Image&)> draw;
};

csgcore::Solid solid_of(const csgcore::Scene& scene) {
  return csgcore::Solid(csgcore::canonical_primitives(scene), scene.model);
}

/// Measures both techniques of scadray.
class Scadray {
 public:
  Scadray(const csgcore::Scene& scene, unsigned threads) : scene_(scene), solid_(solid_of(scene)) {
    options_.threads = threads;
    prepare_cells();
  }

  std::vector<Program> programs() {
    return {
        {"scadray, kd-tree", "its kd-tree", timed([this] { prepare_cells(); }),
         [this](const View& view, Image& image) { draw(*cells_, view, image); }},
        {"scadray, tiles", "canonical primitives and lists", timed([this] { solid_of(scene_); }),
         [this](const View& view, Image& image) { draw(solid_, view, image); }}};
  }

 private:
  void prepare_cells() {
    csgcore::SubdivisionOptions options;
    options.threads = options_.threads;
    cells_ = std::make_unique<csgcore::Subdivision>(solid_, options);
  }
  template <typename Drawn>
  void draw(const Drawn& drawn, const View& view, Image& image) {
    csgcore::TraceStats stats;
    csgcore::draw(drawn, view, settings_, options_, image, stats);
  }

  const csgcore::Scene& scene_;
  csgcore::Solid solid_;
  std::unique_ptr<csgcore::Subdivision> cells_;
  csgcore::TraceOptions options_;
  const csgcore::FrameSettings settings_ = cornfield();
};

#ifdef MEASURE_HAS_EMBREE
constexpr int kFragments = 48;
/// The share of the hits that may differ from scadray's picture of the same facets, since rays are
/// in float, and neighbours do not share their vertices.
constexpr double kMostDiffering = 2e-3;
/// Depths that differ by more than this share of the distance are different places.
constexpr double kSameDepth = 1e-4;

class Embree {
 public:
  Embree(const csgcore::Scene& scene, unsigned threads) : threads_(threads) {
    for (const bool is : csgcore::subtracted_primitives(scene)) is_cut_.push_back(is);
    mesh_ms_ = timed([&] { mesh_ = cut_mesh(scene, kFragments); })();
    frame_ = std::make_unique<EmbreeFrame>(mesh_, is_cut_, threads_);
  }

  Program program() {
    const auto prepare = [this] {
      frame_ = std::make_unique<EmbreeFrame>(mesh_, is_cut_, threads_);
      return frame_->build_ms();
    };
    return {"Embree", "its tree of the finished mesh, at the highest quality", prepare,
            [this](const View& view, Image& image) { frame_->draw(view, settings_, image); }};
  }

  json mesh() const {
    return {{"method",
             "every primitive in OpenSCAD's facets, each facet cut exactly along the planes of the "
             "primitives that it meets, and what lies on the solid's boundary kept: CGAL takes "
             "more than 600 s for it"},
            {"fragments", kFragments},
            {"triangles", mesh_.size()},
            {"made_ms", mesh_ms_}};
  }

  /// Compares the pictures. Throws WrongAnswer.
  json agreement(const View& view, const csgcore::Hits& facets, const csgcore::Hits& round) const {
    csgcore::FrameSettings settings = settings_;
    settings.measured_channels = true;
    Image image;
    frame_->draw(view, settings, image);
    uint64_t hits = 0, other_hit = 0, other_depth = 0, other_hit_round = 0;
    for (size_t i = 0; i < image.z.size(); ++i) {
      const bool is_hit = std::isfinite(image.z[i]);
      const bool should_hit = facets.primitive[i] != csgcore::Hits::kMiss;
      hits += should_hit;
      other_hit += is_hit != should_hit;
      other_hit_round += is_hit != (round.primitive[i] != csgcore::Hits::kMiss);
      other_depth +=
          is_hit && should_hit && std::abs(image.z[i] - facets.s[i]) > kSameDepth * facets.s[i];
    }
    if (static_cast<double>(other_hit + other_depth) > kMostDiffering * static_cast<double>(hits)) {
      throw WrongAnswer("Embree's frame is not that of the facets");
    }
    return {{"pixels", image.z.size()},
            {"hits", hits},
            {"other_hit", other_hit},
            {"other_depth", other_depth},
            {"other_hit_round", other_hit_round}};
  }

 private:
  unsigned threads_;
  std::vector<CutTriangle> mesh_;
  std::vector<char> is_cut_;  // by primitive
  double mesh_ms_ = 0;
  std::unique_ptr<EmbreeFrame> frame_;
  const csgcore::FrameSettings settings_ = cornfield();
};

csgcore::Hits hits_of(const csgcore::Scene& scene, const View& view) {
  csgcore::Hits hits;
  csgcore::TraceStats stats;
  csgcore::trace(solid_of(scene), view, {}, hits, stats);
  return hits;
}
#endif

struct Times {
  std::vector<Summary> frames, preparations;
};

/// Measures all programs, which draw the same frames one after the other.
Times measure_all(const std::vector<Program>& programs, const Turntable& turntable, size_t frames) {
  Times times;
  for (const Program& program : programs) {
    times.preparations.push_back(measure(program.prepare, {3, 3, 0}));
  }
  std::vector<Image> images(programs.size());
  std::vector<size_t> next(programs.size());
  std::vector<Timed> works;
  for (size_t i = 0; i < programs.size(); ++i) {
    works.push_back([&, i] {
      const View view = turntable.at(next[i]++);
      return timed([&] { programs[i].draw(view, images[i]); })();
    });
  }
  times.frames = measure_in_turn(works, {frames, frames, 0});
  return times;
}

}  // namespace

json measure_frames(const Settings& settings) {
  const frontend::ImportedDesign design = read_csg(csg_of(kDesign, settings), {});
  const Turntable turntable(design.view_box);
  const View first = turntable.at(0);
  Scadray scadray(design.scene, settings.threads);
  std::vector<Program> programs = scadray.programs();
  Image by_cells, by_tiles;
  programs[0].draw(first, by_cells);
  programs[1].draw(first, by_tiles);
  if (by_cells.rgb != by_tiles.rgb) throw WrongAnswer("the kd-tree and tiles differ");

  LeftOut left_out;
  const size_t frames = settings.quick ? 5 : kFrames;
  json result = {{"design", kDesign}, {"width_px", first.width_px}, {"height_px", first.height_px},
                 {"frames", frames},  {"turn_deg", kTurn_deg},      {"threads", settings.threads}};
#ifdef MEASURE_HAS_EMBREE
  Embree embree(design.scene, settings.threads);
  frontend::ImportOptions facets;
  facets.facets = frontend::Facets::kAll;
  facets.fn = kFragments;
  const csgcore::Scene faceted = read_csg(csg_of(kDesign, settings), facets).scene;
  result["mesh"] = embree.mesh();
  result["agreement"] =
      embree.agreement(first, hits_of(faceted, first), hits_of(design.scene, first));
  programs.push_back(embree.program());
#else
  left_out.add("Embree", "libembree-dev was not there when this program was built");
#endif
  const Times times = measure_all(programs, turntable, frames);
#ifdef MEASURE_HAS_EMBREE
  const double embree_ms = times.frames.back().median;
#endif
  for (size_t i = 0; i < programs.size(); ++i) {
    json program = {{"name", programs[i].name},
                    {"frame_ms", times.frames[i]},
                    {"prepare_ms", times.preparations[i]},
                    {"prepares", programs[i].prepares}};
#ifdef MEASURE_HAS_EMBREE
    program["ratio"] = times.frames[i].median / embree_ms;
#endif
    result["programs"].push_back(std::move(program));
  }
#ifdef MEASURE_HAS_EMBREE
  const double ours_ms = std::min(times.frames[0].median, times.frames[1].median);
  result["ratio"] = {{"what", "scadray's frame to Embree's"},
                     {"value", ours_ms / embree_ms},
                     {"at_most", kMostOfEmbree}};
#endif
  result["left_out"] = left_out.reasons;
  return result;
}

}  // namespace measure
