// The drawing of a scene by one renderer or the other.
#include "frontend/scene_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/elapsed.hpp"
#include "render/prepared_scene.hpp"
#include "render/renderer_choice.hpp"
#include "render/scene_scale.hpp"
#include "render/solid_renderer.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using ScenePointer = std::shared_ptr<const csgcore::Scene>;

}  // namespace

class SceneRenderer::Impl {
 public:
  Impl(const GpuFolders& folders, const GlDemands& demands)
      : folders_(folders), demands_(demands) {}

  void load(ScenePointer scene) {
    const Clock::time_point start = Clock::now();
    const int exponent = scale_exponent(*scene);
    if (exponent != 0) scene = std::make_shared<const csgcore::Scene>(scaled(*scene, exponent));
    auto prepared = std::make_shared<const PreparedScene>(std::move(scene));
    prepare_ms_ = ms_since(start);
    if (renderer_) renderer_->forget();
    scene_ = std::move(prepared);
    exponent_ = exponent;
  }

  Image draw(const csgcore::View& view, const RenderSettings& settings, RenderStats& stats) {
    Image image = draw_whole(view, settings, stats);
    if (exponent_ != 0) undo_scale(exponent_, image);
    return image;
  }

  Image redraw(const csgcore::View& view, const RenderSettings& settings, RenderStats& stats) {
    Kept before = std::exchange(kept_, {});
    const bool is_kept = before.scene && before.exponent == exponent_ && before.view == view &&
                         draw_the_same(before.settings, settings);
    Image image = is_kept ? draw_changes(std::move(before), settings, stats)
                          : draw_whole(view, settings, stats);
    if (!settings.stop.stop_requested()) kept_ = {scene_, exponent_, view, settings, image};
    if (exponent_ != 0) undo_scale(exponent_, image);
    return image;
  }

  csgcore::Hits look(const csgcore::View& view) const {
    csgcore::Hits hits;
    csgcore::TraceStats stats;
    csgcore::TraceOptions options;
    options.threads = 1;  // few pixels take less time than to start threads
    csgcore::trace(scene_->model(), scaled_view(view), options, hits, stats);
    if (exponent_ == 0) return hits;
    for (std::size_t pixel = 0; pixel < hits.s.size(); ++pixel) {
      hits.s[pixel] = std::ldexp(hits.s[pixel], -exponent_);
      for (int axis = 0; axis < 3; ++axis) {
        hits.position[pixel][axis] = std::ldexp(hits.position[pixel][axis], -exponent_);
      }
    }
    return hits;
  }

  bool contains(uint32_t primitive, const csgcore::Vec3& point) const {
    return csgcore::contains(scene_->model().primitives()[primitive],
                             std::ldexp(1, exponent_) * point);
  }

 private:
  /// A picture, not scaled back, and what it shows.
  struct Kept {
    std::shared_ptr<const PreparedScene> scene;
    int exponent = 0;
    csgcore::View view;
    RenderSettings settings;
    Image image;
  };

  csgcore::View scaled_view(const csgcore::View& view) const {
    return exponent_ == 0 ? view : scaled(view, exponent_);
  }

  Image draw_whole(const csgcore::View& view, const RenderSettings& settings, RenderStats& stats) {
    const csgcore::View drawn = scaled_view(view);
    Image image;
    with_renderer(settings, stats, [&] {
      image = scene_->draw(*renderer_, {drawn, settings, stats});
    });
    return image;
  }

  Image draw_changes(Kept before, const RenderSettings& settings, RenderStats& stats) {
    const csgcore::View drawn = scaled_view(before.view);
    const Clock::time_point start = Clock::now();
    const csgcore::SceneEdit edit = csgcore::compare(before.scene->scene(), scene_->scene());
    prepare_ms_ += ms_since(start);
    with_renderer(settings, stats, [&] {
      stats.edit.primitives_changed =
          std::max(edit.removed.size(), edit.added.size()) + edit.recolored.size();
      scene_->redraw(*renderer_, {drawn, settings, stats}, *before.scene, edit, before.image);
    });
    return std::move(before.image);
  }

  /// Calls `draw`, again with the CPU where kAuto took OpenGL and that fails.
  template <typename Draw>
  void with_renderer(const RenderSettings& settings, RenderStats& stats, Draw draw) {
    start_stats(stats);
    if (!renderer_) renderer_ = make_renderer(settings.renderer, stats);
    stats.reason = reason_;
    const RenderStats before = stats;
    try {
      draw();
      return;
    } catch (const GlFailure& failure) {
      if (!is_replaceable_) throw;
      reason_ = failure.reason();
    }
    is_replaceable_ = false;
    renderer_ = make_cpu_renderer();
    stats = before;
    stats.reason = reason_;
    draw();
  }

  void start_stats(RenderStats& stats) {
    stats = {};
    stats.primitives = scene_->scene().primitives.size();
    stats.edit.primitives = stats.edit.primitives_changed = stats.primitives;
    stats.prepare_ms = std::exchange(prepare_ms_, 0.0);
  }

  std::unique_ptr<SolidRenderer> make_renderer(RendererKind kind, RenderStats& stats) {
    if (kind == RendererKind::kCpu) return make_cpu_renderer();
    if (kind == RendererKind::kAuto) {
      if (const std::optional<std::string> reason = why_no_gpu(folders_)) {
        reason_ = *reason;
        return make_cpu_renderer();
      }
    }
    const Clock::time_point start = Clock::now();
    try {
      GlDemands demands = demands_;
      demands.takes_software |= kind == RendererKind::kGl;
      auto renderer = make_gl_renderer(demands);
      stats.context_ms = ms_since(start);
      is_replaceable_ = kind == RendererKind::kAuto;
      return renderer;
    } catch (const GlFailure& failure) {
      if (kind == RendererKind::kGl) throw;
      stats.context_ms = ms_since(start);
      reason_ = failure.reason();
    }
    return make_cpu_renderer();
  }

  const GpuFolders folders_;
  const GlDemands demands_;
  std::shared_ptr<const PreparedScene> scene_;
  int exponent_ = 0;       // of 2, by which the scene is scaled
  double prepare_ms_ = 0;  // not reported yet
  std::unique_ptr<SolidRenderer> renderer_;
  bool is_replaceable_ = false;  // by the CPU, should it fail
  std::string reason_;           // for which kAuto chose it
  Kept kept_;                    // redraw()'s last
};

SceneRenderer::SceneRenderer() : SceneRenderer(GpuFolders{}) {}
SceneRenderer::SceneRenderer(const GpuFolders& folders) : SceneRenderer(folders, GlDemands{}) {}
SceneRenderer::SceneRenderer(const GpuFolders& folders, const GlDemands& demands)
    : impl_(std::make_unique<Impl>(folders, demands)) {}
SceneRenderer::~SceneRenderer() = default;
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;

void SceneRenderer::load(ScenePointer scene) { impl_->load(std::move(scene)); }

Image SceneRenderer::draw(const csgcore::View& view, const RenderSettings& settings,
                          RenderStats& stats) {
  return impl_->draw(view, settings, stats);
}

Image SceneRenderer::redraw(const csgcore::View& view, const RenderSettings& settings,
                            RenderStats& stats) {
  return impl_->redraw(view, settings, stats);
}

csgcore::Hits SceneRenderer::look(const csgcore::View& view) const { return impl_->look(view); }

bool SceneRenderer::contains(uint32_t primitive, const csgcore::Vec3& point) const {
  return impl_->contains(primitive, point);
}

}  // namespace frontend
