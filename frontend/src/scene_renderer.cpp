// The drawing of a scene by one renderer or the other.
#include "frontend/scene_renderer.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "elapsed.hpp"
#include "prepared_scene.hpp"
#include "renderer_choice.hpp"
#include "scene_scale.hpp"

namespace frontend {

using csgcore::Image;

class SceneRenderer::Impl {
 public:
  explicit Impl(const GpuFolders& folders) : folders_(folders) {}

  void load(const csgcore::Scene& scene) {
    const Clock::time_point start = Clock::now();
    const int exponent = scale_exponent(scene);
    auto prepared =
        std::make_unique<PreparedScene>(exponent == 0 ? scene : scaled(scene, exponent));
    if (renderer_) renderer_->forget();
    scene_ = std::move(prepared);
    exponent_ = exponent;
    prepare_ms_ = ms_since(start);
  }

  Image draw(const csgcore::View& view, const RenderSettings& settings, RenderStats& stats) {
    stats = {};
    stats.primitives = scene_->primitive_count();
    stats.prepare_ms = std::exchange(prepare_ms_, 0.0);
    choose_renderer(settings, stats);
    Image image = draw_scaled(exponent_ == 0 ? view : scaled(view, exponent_), settings, stats);
    if (exponent_ != 0) undo_scale(exponent_, image);
    return image;
  }

  csgcore::Hits pick(const csgcore::View& view, double x_px, double y_px) const {
    csgcore::Hits hits;
    csgcore::TraceStats stats;
    const csgcore::View one_pixel = pixel_view(view, x_px, y_px);
    csgcore::trace(scene_->model(), exponent_ == 0 ? one_pixel : scaled(one_pixel, exponent_),
                   csgcore::TraceOptions{}, hits, stats);
    if (exponent_ != 0) {
      const double unit = std::ldexp(1.0, -exponent_);
      for (double& s : hits.s) s *= unit;
      for (csgcore::Vec3& position : hits.position) position *= unit;
    }
    return hits;
  }

 private:
  /// A picture of one pixel.
  static csgcore::View pixel_view(const csgcore::View& view, double x_px, double y_px) {
    const csgcore::Ray ray = csgcore::pixel_ray(view, x_px - 0.5, y_px - 0.5);
    csgcore::View result = view;
    result.width_px = result.height_px = 1;
    result.half_height = view.half_height / view.height_px;
    if (view.projection == csgcore::Projection::kOrthographic) {
      result.eye = ray.origin;
    } else {
      result.forward = glm::normalize(ray.direction);
      result.right = glm::normalize(glm::cross(result.forward, view.up));
      result.up = glm::cross(result.right, result.forward);
    }
    return result;
  }

  void choose_renderer(const RenderSettings& settings, RenderStats& stats) {
    if (!renderer_) renderer_ = make_renderer(settings.renderer, stats);
    stats.reason = reason_;
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
      auto renderer = make_gl_renderer(kind == RendererKind::kGl);
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

  Image draw_scaled(const csgcore::View& view, const RenderSettings& settings, RenderStats& stats) {
    const RenderStats before = stats;
    try {
      return scene_->draw(*renderer_, {view, settings, stats});
    } catch (const GlFailure& failure) {
      if (!is_replaceable_) throw;
      reason_ = failure.reason();
    }
    is_replaceable_ = false;
    renderer_ = make_cpu_renderer();
    stats = before;
    stats.reason = reason_;
    return scene_->draw(*renderer_, {view, settings, stats});
  }

  const GpuFolders folders_;
  std::unique_ptr<PreparedScene> scene_;
  int exponent_ = 0;       // of 2, by which the scene is scaled
  double prepare_ms_ = 0;  // not reported yet
  std::unique_ptr<SolidRenderer> renderer_;
  bool is_replaceable_ = false;  // by the CPU, should it fail
  std::string reason_;           // for which kAuto chose it
};

SceneRenderer::SceneRenderer() : SceneRenderer(GpuFolders{}) {}
SceneRenderer::SceneRenderer(const GpuFolders& folders) : impl_(std::make_unique<Impl>(folders)) {}
SceneRenderer::~SceneRenderer() = default;
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;

void SceneRenderer::load(const csgcore::Scene& scene) { impl_->load(scene); }

Image SceneRenderer::draw(const csgcore::View& view, const RenderSettings& settings,
                          RenderStats& stats) {
  return impl_->draw(view, settings, stats);
}

csgcore::Hits SceneRenderer::pick(const csgcore::View& view, double x_px, double y_px) const {
  return impl_->pick(view, x_px, y_px);
}

Image render(const csgcore::Scene& scene, const csgcore::View& view, const RenderSettings& settings,
             RenderStats& stats, const GpuFolders& folders) {
  SceneRenderer renderer(folders);
  renderer.load(scene);
  return renderer.draw(view, settings, stats);
}

Image render(const csgcore::Scene& scene, const csgcore::View& view, const RenderSettings& settings,
             RenderStats& stats) {
  return render(scene, view, settings, stats, GpuFolders{});
}

}  // namespace frontend
