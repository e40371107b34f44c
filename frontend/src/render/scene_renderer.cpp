// The drawing of a scene by one renderer or the other.
#include "frontend/scene_renderer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
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

/// Returns the renderer, or OpenGL's where that is null, with all that the picture needs. Another
/// thread may take it over.
std::unique_ptr<SolidRenderer> warmed(std::unique_ptr<SolidRenderer> renderer,
                                      const GlDemands& demands, const ScenePointer& scene,
                                      const csgcore::View& view, const RenderSettings& settings) {
  if (renderer) {
    renderer->take_thread();
  } else {
    renderer = make_gl_renderer(demands);
  }
  renderer->set_compiles(true);
  RenderStats stats;
  PreparedScene(scene).draw(*renderer, {view, settings, stats});
  renderer->forget();
  renderer->leave_thread();
  return renderer;
}

}  // namespace

class SceneRenderer::Impl {
 public:
  Impl(const GpuFolders& folders, const GlDemands& demands)
      : folders_(folders), demands_(demands) {}

  void load(ScenePointer scene) {
    const Clock::time_point start = Clock::now();
    const int exponent = scale_exponent(*scene);
    if (exponent != 0) scene = std::make_shared<const csgcore::Scene>(scaled(*scene, exponent));
    auto prepared = std::make_shared<const PreparedScene>(scene);
    prepare_ms_ = ms_since(start);
    if (renderer_) renderer_->forget();
    if (stand_in_) stand_in_->forget();
    scene_ = std::move(prepared);
    source_ = std::move(scene);
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
    with_renderer(drawn, settings, stats, [&](SolidRenderer& renderer) {
      image = scene_->draw(renderer, {drawn, settings, stats});
    });
    return image;
  }

  Image draw_changes(Kept before, const RenderSettings& settings, RenderStats& stats) {
    const csgcore::View drawn = scaled_view(before.view);
    const Clock::time_point start = Clock::now();
    const csgcore::SceneEdit edit = csgcore::compare(before.scene->scene(), scene_->scene());
    prepare_ms_ += ms_since(start);
    with_renderer(drawn, settings, stats, [&](SolidRenderer& renderer) {
      stats.edit.primitives_changed =
          std::max(edit.removed.size(), edit.added.size()) + edit.recolored.size();
      scene_->redraw(renderer, {drawn, settings, stats}, *before.scene, edit, before.image);
    });
    return std::move(before.image);
  }

  /// Calls draw(renderer), again with the CPU where kAuto took OpenGL and that fails, or where its
  /// shaders are not there yet.
  template <typename Draw>
  void with_renderer(const csgcore::View& view, const RenderSettings& settings, RenderStats& stats,
                     Draw draw) {
    start_stats(stats);
    RenderStats before = stats;
    try {
      choose_renderer(view, settings, stats);
      if (renderer_) {
        renderer_->set_compiles(settings.waits_for_shaders);
        stats.reason = reason_;
        draw(*renderer_);
        return;
      }
    } catch (const ShaderMissing&) {
      warm_up(std::move(renderer_), view, settings);
    } catch (const GlFailure& failure) {
      if (!is_replaceable_) throw;
      is_replaceable_ = false;
      reason_ = failure.reason();
      renderer_ = make_cpu_renderer();
    }
    before.context_ms = stats.context_ms;
    stats = before;
    stats.reason = renderer_ ? reason_ : "OpenGL's shaders are not compiled yet";
    if (!renderer_ && !stand_in_) stand_in_ = make_cpu_renderer();
    draw(renderer_ ? *renderer_ : *stand_in_);
  }

  void start_stats(RenderStats& stats) {
    stats = {};
    stats.primitives = scene_->scene().primitives.size();
    stats.edit.primitives = stats.edit.primitives_changed = stats.primitives;
    stats.prepare_ms = std::exchange(prepare_ms_, 0.0);
  }

  /// Sees to it that there is a renderer, or one that warms up.
  void choose_renderer(const csgcore::View& view, const RenderSettings& settings,
                       RenderStats& stats) {
    if (warming_.valid()) {
      const bool is_ready = warming_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
      if (!is_ready && !settings.waits_for_shaders) return;
      renderer_ = warming_.get();
      renderer_->take_thread();
      stand_in_.reset();
    }
    if (renderer_) return;
    if (!takes_gl(settings.renderer)) {
      renderer_ = make_cpu_renderer();
    } else if (settings.waits_for_shaders) {
      const Clock::time_point start = Clock::now();
      try {
        renderer_ = make_gl_renderer(demands_of(settings));
      } catch (...) {
        stats.context_ms = ms_since(start);
        throw;
      }
      stats.context_ms = ms_since(start);
    } else {
      warm_up(nullptr, view, settings);
    }
  }

  bool takes_gl(RendererKind kind) {
    if (kind == RendererKind::kCpu) return false;
    is_replaceable_ = kind == RendererKind::kAuto;
    if (!is_replaceable_) return true;
    const std::optional<std::string> reason = why_no_gpu(folders_);
    if (reason) reason_ = *reason;
    return !reason;
  }

  GlDemands demands_of(const RenderSettings& settings) const {
    GlDemands demands = demands_;
    demands.takes_software |= settings.renderer == RendererKind::kGl;
    return demands;
  }

  /// Lets another thread start OpenGL, unless it runs already, and draw the picture once, so that
  /// its shaders are compiled.
  void warm_up(std::unique_ptr<SolidRenderer> renderer, const csgcore::View& view,
               RenderSettings settings) {
    settings.stop = {};
    settings.progress = {};
    // The CPU adds the studio's light, which needs no shader: as little of it as can be asked for.
    settings.studio.directions = 1;
    settings.studio.shares_light = true;
    if (renderer) renderer->leave_thread();
    warming_ = std::async(std::launch::async, warmed, std::move(renderer), demands_of(settings),
                          source_, view, settings);
  }

  const GpuFolders folders_;
  const GlDemands demands_;
  ScenePointer source_;  // scaled
  std::shared_ptr<const PreparedScene> scene_;
  int exponent_ = 0;       // of 2, by which the scene is scaled
  double prepare_ms_ = 0;  // not reported yet
  std::unique_ptr<SolidRenderer> renderer_;
  std::unique_ptr<SolidRenderer> stand_in_;              // while `warming_` holds the renderer
  std::future<std::unique_ptr<SolidRenderer>> warming_;  // warm_up()
  bool is_replaceable_ = false;                          // by the CPU, should it fail
  std::string reason_;                                   // for which kAuto chose it
  Kept kept_;                                            // redraw()'s last
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
