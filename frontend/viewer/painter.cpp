#include "painter.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <utility>

#include "base/elapsed.hpp"
#include "csgcore/stop_scope.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "frontend/picture_file.hpp"
#include "section_hatch.hpp"
#include "section_plane.hpp"
#include "snap.hpp"

namespace window {
namespace {

using frontend::Clock;
using frontend::ms_since;
using frontend::Show;

/// A moving picture is refined once none was ordered for this long, which is longer than the time
/// between two events of a moving mouse.
constexpr std::chrono::milliseconds kRest{80};

/// The least share of the picture's width and height: in a coarser picture nothing could be
/// recognised.
constexpr double kLeastShare = 1.0 / 6;
/// An edit of the design is drawn in the whole size at first, which shows how much it changes, if
/// that cannot take longer than this.
constexpr double kLongFirstEdit_ms = 100;
/// The time of a pixel is known from pictures of which this share was traced: what does not depend
/// on the pixels counts little then.
constexpr double kMostOfPicture = 0.5;

/// A share this near to 1 is drawn in full: a little late is better than blurred.
constexpr double kWholeShare = 0.85;

/// A ray through a large mesh takes some four times as long as through other solids. Meshes of more
/// triangles than this in all get fewer directions in the first picture.
constexpr size_t kManyTriangles = 10'000;
constexpr uint32_t kFewMeshDirections = 45;

/// Returns the settings of the picture that all steps lead to.
frontend::RenderSettings last_settings(const PaintOrder& order) {
  frontend::RenderSettings settings = order.settings;
  if (order.overlays.edges) settings.studio.edges = 0;  // the overlay draws them
  if (draws_studio(settings)) {
    settings.samples = std::max(settings.samples, frontend::kStudioSamples);
    settings.studio.directions = kLastDirections;
    settings.studio.shares_light = false;
  }
  return settings;
}

/// Returns the settings of the picture that a step draws.
frontend::RenderSettings settings_of(const PaintOrder& order, Step step) {
  frontend::RenderSettings settings = last_settings(order);
  if (order.is_moving) settings.samples = 1;
  if (!draws_studio(settings) || step == Step::kFinal) return settings;
  settings.studio = first_light(order.design->scene, settings.studio);
  if (step == Step::kColors) {
    settings.samples = 1;
    settings.studio.shadows = settings.studio.occlusion = settings.studio.edges = 0;
  }
  return settings;
}

bool is_channel(Show show) { return show != Show::kSurface && show != Show::kCells; }

}  // namespace

csgcore::StudioSettings first_light(const csgcore::Scene& scene, csgcore::StudioSettings settings) {
  size_t triangles = 0;
  for (const csgcore::Primitive& primitive : scene.primitives) {
    if (const csgcore::TriangleMesh* mesh = primitive.mesh()) triangles += mesh->triangles().size();
  }
  const bool has_large_mesh = triangles > kManyTriangles;
  settings.directions = has_large_mesh ? kFewMeshDirections : csgcore::kFewDirections;
  settings.largest_noise = has_large_mesh ? 0 : csgcore::kFewDirectionsNoise;
  settings.shares_light = true;
  return settings;
}

bool show_the_same(const PaintOrder& a, const PaintOrder& b) {
  return a.design == b.design && a.recolored == b.recolored && a.section == b.section &&
         a.size == b.size && a.overlays == b.overlays &&
         frontend::draw_the_same(a.settings, b.settings) && a.navigation == b.navigation;
}

Painter::Painter(double frame_ms, std::function<void()> on_news)
    : frame_ms_(frame_ms), on_news_(std::move(on_news)), thread_([this] { run(); }) {}

Painter::~Painter() {
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
    outdated_.request_stop();
    given_up_.request_stop();
  }
  wake_.notify_all();
  thread_.join();
}

void Painter::order(PaintOrder order) {
  {
    const std::lock_guard lock(mutex_);
    ordered_ = std::move(order);
    outdated_.request_stop();
  }
  wake_.notify_all();
}

void Painter::stop() {
  {
    const std::lock_guard lock(mutex_);
    ordered_.reset();
    drops_coarse_ = true;
    outdated_.request_stop();
    given_up_.request_stop();
  }
  activity_.end();
  wake_.notify_all();
}

void Painter::probe(Probe probe) {
  {
    const std::lock_guard lock(mutex_);
    probes_.push_back(std::move(probe));
    if (is_refining_) outdated_.request_stop();
  }
  wake_.notify_all();
}

std::optional<Painting> Painter::take_painting() {
  const std::lock_guard lock(mutex_);
  return std::exchange(painted_, std::nullopt);
}

std::optional<Finding> Painter::take_finding() {
  const std::lock_guard lock(mutex_);
  if (findings_.empty()) return std::nullopt;
  Finding finding = std::move(findings_.front());
  findings_.erase(findings_.begin());
  return finding;
}

/// Waits for work. Returns true if there is none, and the coarse picture is to be refined.
bool Painter::waits_for_refinement(std::unique_lock<std::mutex>& lock) {
  if (std::exchange(drops_coarse_, false)) coarse_.reset();
  const auto has_work = [this] {
    return is_stopping_ || ordered_ || drops_coarse_ || !probes_.empty();
  };
  if (!coarse_) {
    wake_.wait(lock, has_work);
    return false;
  }
  return !wake_.wait_for(lock, coarse_->is_moving ? kRest : kRest.zero(), has_work);
}

/// Returns what stops the painting of an order, which begins now.
Painter::Stops Painter::stops_of(const PaintOrder& order) {
  outdated_ = {};
  given_up_ = {};
  // While the view moves, every picture is shown, even if others have been ordered.
  return {order.is_moving ? given_up_.get_token() : outdated_.get_token(), given_up_.get_token()};
}

/// Paints what comes after the coarse picture. `lock` is unlocked meanwhile.
void Painter::refine(std::unique_lock<std::mutex>& lock) {
  PaintOrder order = *std::exchange(coarse_, std::nullopt);
  order.is_moving = false;
  const Step step = next_step_;
  const Stops stops = stops_of(order);
  is_refining_ = true;
  lock.unlock();
  const bool is_painted = paint(order, step, stops);
  lock.lock();
  is_refining_ = false;
  if (is_painted || ordered_ || drops_coarse_) return;
  coarse_ = std::move(order);  // a probe came in between
  next_step_ = step;
}

void Painter::run() {
  std::unique_lock lock(mutex_);
  while (!is_stopping_) {
    if (waits_for_refinement(lock)) {
      refine(lock);
      continue;
    } else if (ordered_ && !is_stopping_) {
      PaintOrder order = *std::exchange(ordered_, std::nullopt);
      coarse_.reset();
      const Stops stops = stops_of(order);
      lock.unlock();
      paint(std::move(order), Step::kColors, stops);
    } else if (!probes_.empty() && !is_stopping_) {
      const Probe probe = std::move(probes_.front());
      probes_.erase(probes_.begin());
      lock.unlock();
      Finding finding = find(probe);
      {
        const std::lock_guard again(mutex_);
        findings_.push_back(std::move(finding));
      }
      on_news_();
    } else {
      continue;
    }
    lock.lock();
  }
}

/// Returns whether the design has changed, and the view has not, since a picture was drawn in its
/// whole size.
bool Painter::is_edit_of_drawn(const PaintOrder& order) const {
  return drawn_.design && drawn_.design != order.design.get() &&
         drawn_.navigation == order.navigation && drawn_.size == order.size;
}

/// Returns the time that a picture takes in its whole size; after an edit only what it changes is
/// traced, and the first one shows how much that is.
double Painter::expected_ms(const PaintOrder& order) const {
  const double all_ms = ms_per_pixel_ * order.size.width_px * order.size.height_px;
  if (!is_edit_of_drawn(order)) return all_ms;
  if (!drawn_.edit_ms) return all_ms <= kLongFirstEdit_ms ? 0 : all_ms;
  return std::min(*drawn_.edit_ms, all_ms);
}

void Painter::note_drawn(const PaintOrder& order, double ms) {
  const std::optional<double> edit_ms = is_edit_of_drawn(order) ? ms : drawn_.edit_ms;
  const bool is_same_view = drawn_.navigation == order.navigation && drawn_.size == order.size;
  drawn_ = {order.design.get(), order.navigation, order.size,
            is_same_view ? edit_ms : std::nullopt};
}

/// Returns the share of the picture's width and height that can be drawn within a frame.
double Painter::affordable_share(const PaintOrder& order) const {
  if (!order.is_moving) return 1;
  const double whole_ms = expected_ms(order);
  const double share = whole_ms > 0 ? std::sqrt(frame_ms_ / whole_ms) : 1;
  return share >= kWholeShare ? 1 : std::max(share, kLeastShare);
}

/// Returns false if it was stopped before there was a picture.
bool Painter::paint(PaintOrder order, Step step, const Stops& stops) {
  const double share = affordable_share(order);
  const auto side = [share](uint32_t px) {
    return std::max(1u, static_cast<uint32_t>(std::lround(share * px)));
  };
  const Size size{side(order.size.width_px), side(order.size.height_px)};
  const frontend::RenderSettings settings = settings_of(order, step);
  // While the studio's light is made, a picture stands already: that is no work to be shown.
  if (!draws_studio(settings)) activity_.begin("drawing");
  std::optional<Painting> painting;
  try {
    const csgcore::StopScope scope(&stops.all);
    painting = paint_at(order, size, settings, stops.drawing);
  } catch (const csgcore::Stopped&) {
  }
  activity_.end();
  if (!painting || stops.drawing.stop_requested()) return false;
  if (draws_studio(settings)) {
    painting->light_ms = painting->stats.traverse_ms + painting->stats.render_ms;
    painting->stats = color_stats_;
  } else {
    color_stats_ = painting->stats;
  }
  painting->is_final = size == order.size && draw_the_same(settings, last_settings(order));
  if (!painting->is_final && painting->error.empty()) {
    coarse_ = std::move(order);
    next_step_ = draws_studio(settings) ? Step::kFinal : Step::kLit;
  }
  publish(std::move(*painting));
  return true;
}

void Painter::load(const PaintOrder& order) {
  if (loaded_ == order.design && loaded_section_ == order.section &&
      loaded_colors_ == order.recolored) {
    return;
  }
  loaded_.reset();
  ScenePointer scene =
      order.recolored ? order.recolored : ScenePointer(order.design, &order.design->scene);
  section_parts_.clear();
  if (order.section.is_on) {
    CutScene cut = cut_open(*scene, order.section, order.design->view_box, order.design->parts);
    scene = std::make_shared<const csgcore::Scene>(std::move(cut.scene));
    section_parts_ = std::move(cut.parts);
  }
  renderer_.load(scene);
  scene_ = std::move(scene);
  loaded_ = order.design;
  loaded_section_ = order.section;
  loaded_colors_ = order.recolored;
}

Painting Painter::paint_at(const PaintOrder& order, Size size, frontend::RenderSettings settings,
                           const std::stop_token& stop) {
  Painting painting;
  painting.order = order;
  settings.stop = stop;
  settings.waits_for_shaders = false;
  settings.progress = [this, &order, &stop](const char* stage, double fraction) {
    if (stop.stop_requested()) throw csgcore::Stopped();
    activity_.update(stage, fraction);
    if (order.settings.progress) order.settings.progress(stage, fraction);
  };
  const bool has_section = order.section.is_on && settings.show == Show::kSurface;
  const frontend::Overlays& overlays = order.overlays;
  settings.measured_channels |= is_channel(settings.show) || overlays.axes || overlays.crosshairs ||
                                overlays.edges || overlays.scales;
  settings.depth_and_id = has_section || overlays.grid;
  if (overlays.grid) settings.shares_from = csgcore::kNoPrimitive;
  if (has_section) settings.shares_from = kFirstSectionFace;
  const Clock::time_point start = Clock::now();
  try {
    load(order);
    const Clock::time_point loaded = Clock::now();
    const csgcore::View view = order.navigation.view(size);
    // What is kept for the next edit is a picture without the studio's light, as that edit's first.
    painting.image = size == order.size && !draws_studio(settings)
                         ? renderer_.redraw(view, settings, painting.stats)
                         : renderer_.draw(view, settings, painting.stats);
    frontend::show_channel(painting.image, settings.show, settings.scheme.background);
    const auto draw_overlays = [&](const frontend::Overlays& some) {
      frontend::draw_overlays(painting.image, view, order.navigation.camera(), some,
                              settings.scheme, *order.design);
    };
    // What is hatched has its colour yet where edges are drawn, and hides no axes.
    frontend::Overlays edges{.edges = overlays.edges, .edge_color = overlays.edge_color};
    draw_overlays(edges);
    if (has_section) {
      const double distance = order.navigation.camera().distance;
      draw_section_faces(painting.image, view, order.section, section_parts_,
                         hatch_spacing(order.navigation.view(order.size), distance));
    }
    frontend::Overlays others = overlays;
    others.edges = false;
    others.grid &= settings.show == Show::kSurface;
    others.grid_line_px = static_cast<double>(size.height_px) / order.size.height_px;
    draw_overlays(others);
    const auto traced = static_cast<double>(painting.stats.edit.pixels_traced);
    const bool is_most = traced >= kMostOfPicture * size.width_px * size.height_px;
    const bool is_plain = settings.samples == 1 && !draws_studio(settings);
    if (is_plain && is_most) ms_per_pixel_ = ms_since(loaded) / traced;
    if (is_plain && size == order.size) note_drawn(order, ms_since(start));
  } catch (const std::bad_alloc&) {
    painting.error = "error: out of memory (make the window or the design smaller)";
  } catch (const std::exception& error) {
    painting.error = error.what();
  }
  painting.draw_ms = ms_since(start);
  return painting;
}

Finding Painter::find(const Probe& probe) {
  Finding finding;
  finding.probe = probe;
  try {
    load(probe.order);
    const csgcore::View view = probe.order.navigation.view(probe.order.size);
    const ModelRays rays([this](const csgcore::View& look) { return renderer_.look(look); },
                         scene_->primitives);
    const auto feature =
        probe.snap_px > 0 ? snap(rays, view, probe.place, probe.snap_px) : std::nullopt;
    const auto hit = feature ? feature : rays.seen_at(view, probe.place);
    if (!hit) return finding;
    describe(*hit, finding);
    finding.is_hit = true;
  } catch (const std::exception&) {
    // There is no picture either in this case, and its error is shown.
  }
  return finding;
}

/// Says which leaf a hit primitive of the scene belongs to. On the section plane it is the one
/// whose inside is seen there.
void Painter::describe(const RayHit& hit, Finding& finding) const {
  const frontend::ImportedDesign& design = *finding.probe.order.design;
  uint32_t primitive = hit.primitive;
  finding.position = hit.position;
  finding.normal = hit.normal;
  finding.surface = hit.surface;
  finding.is_cut = is_section_face(scene_->primitives[primitive].id);
  if (finding.is_cut) {
    const std::optional<uint32_t> around = primitive_around(
        design.scene.model,
        [&](uint32_t operand) { return renderer_.contains(operand, finding.position); });
    finding.place.trail.push_back({"section plane", {}});
    if (!around) return;
    primitive = *around;
  }
  finding.primitive = primitive;
  finding.place = frontend::leaf_place(finding.probe.tree,
                                       design.places.at(design.scene.primitives[primitive].id));
}

void Painter::publish(Painting painting) {
  {
    const std::lock_guard lock(mutex_);
    painted_ = std::move(painting);
  }
  on_news_();
}

}  // namespace window
