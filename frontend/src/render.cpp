// The OpenGL drawing of a scene: the model, and over it the translucent `%` and `#` parts.
#include "frontend/render.hpp"

#include <algorithm>
#include <memory>
#include <optional>

#include "csgcore/solid.hpp"
#include "csgcore/subdivision.hpp"
#include "frontend/error.hpp"
#include "glrender/renderer.hpp"
#include "glrender/stopwatch.hpp"
#include "scene_scale.hpp"
#include "translucent_layer.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using csgcore::LeafKind;
using csgcore::Solid;
using csgcore::Subdivision;

glm::vec3 to_vec3(const Rgb& color) { return glm::vec3(color.r, color.g, color.b) / 255.0f; }

csgcore::SubdivisionOptions subdivision_options(const csgcore::View& view,
                                                const RenderSettings& settings) {
  csgcore::SubdivisionOptions options;
  if (settings.leaf_primitives == 2 && settings.threshold_px > 0) {
    // K = 2 with a threshold is the paper's rule (§2.1, §2.2).
    options = csgcore::SubdivisionOptions::paper(settings.threshold_px, view);
  } else {
    options.leaf_primitives = settings.leaf_primitives;
    options.threshold_px = settings.threshold_px;
    options.view = view;
  }
  options.threads = settings.threads;
  return options;
}

void count_cells(const Subdivision& subdivision, RenderStats& stats) {
  const csgcore::LeafCensus leaves = csgcore::census(subdivision);
  const auto of = [&](LeafKind kind) { return leaves.by_kind[static_cast<size_t>(kind)]; };
  stats.cells = subdivision.nodes().size();
  stats.leaves = leaves.leaves();
  stats.leaves_empty = of(LeafKind::kEmpty);
  stats.leaves_union = of(LeafKind::kUnion);
  stats.leaves_pair = of(LeafKind::kPair);
  stats.leaves_general = of(LeafKind::kGeneral);
  stats.leaves_full = of(LeafKind::kFull);
  stats.leaves_dropped = of(LeafKind::kDropped);
  stats.leaf_primitives = leaves.literals;
  stats.bytes = subdivision.bytes();
}

/// Reports the share of the scene's volume that is subdivided.
class SubdivisionProgress {
 public:
  SubdivisionProgress(const Solid& solid, const RenderSettings& settings)
      : settings_(settings), volume_(volume(solid.bounds())) {}

  csgcore::BatchSink sink() {
    if (!settings_.progress) return {};
    return [this](const csgcore::LeafBatch& batch) {
      for (const csgcore::Leaf& leaf : batch.leaves) done_ += volume(leaf.box);
      settings_.progress("subdividing", std::min(done_ / volume_, 1.0));
    };
  }

 private:
  static double volume(const csgcore::Box& box) {
    const csgcore::Vec3 size = box.size();
    return size.x * size.y * size.z;
  }
  const RenderSettings& settings_;
  double volume_;
  double done_ = 0;
};

/// Draws one tree of the scene after another with one context.
class SceneRenderer {
 public:
  SceneRenderer(const csgcore::Scene& scene, const csgcore::View& view,
                const RenderSettings& settings, RenderStats& stats)
      : scene_(scene), view_(view), settings_(settings), stats_(stats) {
    glrender::Stopwatch watch;
    context_.emplace();
    stats_.context_ms = watch.lap();
    stats_.renderer = "gl: " + context_->renderer_name();
    primitives_ = csgcore::canonical_primitives(scene);
    stats_.primitives = scene.primitives.size();
    frame_.background = to_vec3(settings.scheme.background);
    frame_.front = to_vec3(settings.scheme.front);
    frame_.back = to_vec3(settings.scheme.back);
    frame_.edge = to_vec3(settings.scheme.axes);
    frame_.shading = settings.shading == Shading::kPhong ? glrender::Shading::kPhong
                                                         : glrender::Shading::kOpenScad;
    frame_.subject =
        settings.show == Show::kCells ? glrender::Subject::kCells : glrender::Subject::kSurface;
    frame_.measured_channels = settings.measured_channels;
    if (has_translucent_parts()) {
      frame_.measured_channels = true;
      for (const auto* tree : {&scene.model, &scene.background, &scene.highlight}) {
        frame_.scene_box.merge(Solid(primitives_, *tree).bounds());
      }
    }
  }

  Image draw() {
    Image image = draw_model();
    if (settings_.show == Show::kCells) return image;
    if (!scene_.background.empty()) draw_layer(scene_.background, LayerKind::kBackground, image);
    if (!scene_.highlight.empty()) draw_layer(scene_.highlight, LayerKind::kHighlight, image);
    return image;
  }

 private:
  bool has_translucent_parts() const {
    return !scene_.background.empty() || !scene_.highlight.empty();
  }

  void add(const glrender::FrameStats& frame) {
    stats_.draw_calls += frame.draw_calls;
    stats_.cells_drawn += frame.cells_drawn;
    stats_.traverse_ms += frame.traverse_ms;
    stats_.render_ms += frame.draw_ms + frame.read_ms;
  }

  Image draw_model() {
    const Solid solid(primitives_, scene_.model);
    const auto options = subdivision_options(view_, settings_);
    SubdivisionProgress progress(solid, settings_);
    glrender::Stopwatch watch;
    const Subdivision subdivision(solid, options, progress.sink());
    stats_.subdivide_ms = watch.lap();
    count_cells(subdivision, stats_);
    if (settings_.progress) settings_.progress("drawing", 0.0);
    glrender::Renderer renderer(*context_, solid);
    renderer.load(subdivision);
    glrender::FrameStats frame;
    Image image = renderer.draw(view_, frame_, frame);
    add(frame);
    if (settings_.measure_paper_times) measure(renderer, options);
    return image;
  }

  /// Draws again: by now every shader is compiled.
  void measure(glrender::Renderer& renderer, const csgcore::SubdivisionOptions& options) {
    glrender::FrameStats frame;
    renderer.draw(view_, frame_, frame);
    stats_.paper_tr_ms = frame.traverse_ms + frame.draw_ms;
    stats_.paper_ts_ms = renderer.traversal_ms(view_);
    renderer.draw_while_subdividing(options, view_, frame_, frame);
    stats_.paper_sr_ms = frame.draw_ms;
  }

  void draw_layer(const csgcore::CsgTree& tree, LayerKind kind, Image& image) {
    const Solid solid(layer_primitives(primitives_, kind), tree);
    const Subdivision subdivision(solid, subdivision_options(view_, settings_));
    glrender::FrameSettings frame = frame_;
    frame.front = frame.back = layer_color(kind);
    frame.subject = glrender::Subject::kSurface;
    glrender::Renderer renderer(*context_, solid);
    renderer.load(subdivision);
    glrender::FrameStats frame_stats;
    const Image front = renderer.draw(view_, frame, frame_stats);
    add(frame_stats);
    const Image behind = renderer.draw_behind(view_, frame, frame_stats);
    add(frame_stats);
    // openscad.md §4: of a translucent body the back faces first.
    const LayerOpacity opacity(solid, kind);
    const double scene_size = frame_.scene_box.diagonal();
    blend_layer(behind, opacity, scene_size, image);
    blend_layer(front, opacity, scene_size, image);
  }

  const csgcore::Scene& scene_;
  const csgcore::View& view_;
  const RenderSettings& settings_;
  RenderStats& stats_;
  std::optional<glrender::HeadlessContext> context_;
  std::shared_ptr<const csgcore::CanonicalPrimitives> primitives_;
  glrender::FrameSettings frame_;
};

}  // namespace

Image render(const csgcore::Scene& scene, const csgcore::View& view, const RenderSettings& settings,
             RenderStats& stats) {
  try {
    stats = {};
    const int exponent = scale_exponent(scene);
    if (exponent == 0) return SceneRenderer(scene, view, settings, stats).draw();
    const csgcore::Scene scaled_scene = scaled(scene, exponent);
    const csgcore::View scaled_view = scaled(view, exponent);
    Image image = SceneRenderer(scaled_scene, scaled_view, settings, stats).draw();
    undo_scale(exponent, image);
    return image;
  } catch (const glrender::GlError& error) {
    throw Error({}, {}, error.what(), {});
  }
}

}  // namespace frontend
