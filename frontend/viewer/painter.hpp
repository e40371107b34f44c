// Draws the window's pictures in a thread of its own, so that the window never waits for one.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "csgcore/image.hpp"
#include "frontend/activity.hpp"
#include "frontend/design_version.hpp"
#include "frontend/files.hpp"
#include "frontend/importer.hpp"
#include "frontend/overlays.hpp"
#include "frontend/scene_renderer.hpp"
#include "frontend/source_place.hpp"
#include "model_rays.hpp"
#include "navigation.hpp"
#include "projection.hpp"
#include "section_plane.hpp"
#include "surface.hpp"

namespace window {

/// A picture that is to be drawn.
struct PaintOrder {
  uint64_t number = 0;
  std::shared_ptr<const frontend::ImportedDesign> design;
  /// The design's scene in other colours; null: in its own.
  std::shared_ptr<const csgcore::Scene> recolored{};
  SectionPlane section;
  Navigation navigation{{}, csgcore::Projection::kPerspective};
  Size size;
  frontend::RenderSettings settings;
  frontend::Overlays overlays;
  /// Other orders follow at the display's rate. The picture may be coarse, and is refined once none
  /// follows.
  bool is_moving = false;
};

/// Returns whether both give the same picture.
bool show_the_same(const PaintOrder& a, const PaintOrder& b);

/// The steps to a picture in the studio's light: its colours alone by one ray a pixel, then what
/// hides light, by few directions that pixels share, then by many of each pixel's own.
enum class Step : uint8_t { kColors, kLit, kFinal };

struct Painting {
  PaintOrder order;
  csgcore::Image image;  // smaller than the order's size where it is coarse
  bool is_final = false;
  frontend::RenderStats stats;  // of the colours alone, which come before the studio's light
  double light_ms = 0;          // of the picture in that light; 0 if it has none
  double draw_ms = 0;
  std::string error;  // why there is no picture; then `image` is empty
};

/// A place in a picture, to be examined.
struct Probe {
  enum class Purpose : uint8_t { kMeasure, kCenter, kHover, kPan };
  uint64_t number = 0;
  Purpose purpose = Purpose::kMeasure;
  PaintOrder order;
  PicturePoint place{};
  double snap_px = 0;         // kMeasure: how far a feature may be that it snaps to; 0: it doesn't
  frontend::DesignTree tree;  // for the places in the design
};

/// The point that is seen at a probe's place.
struct Finding {
  Probe probe;
  bool is_hit = false;
  csgcore::Vec3 position{0.0};  // world space
  csgcore::Vec3 normal{0.0};    // unit, outward
  bool is_cut = false;          // the section plane shows the inside of the leaf there
  /// That the leaf has there, by its index in the design; nothing on a cut through nothing.
  std::optional<uint32_t> primitive{};
  frontend::LeafPlace place;
  Surface surface;
};

/// Returns the settings of a first picture in the studio's light: fewer directions where rays go
/// through large meshes.
csgcore::StudioSettings first_light(const csgcore::Scene& scene, csgcore::StudioSettings settings);
/// The directions of its last picture.
constexpr uint32_t kLastDirections = 256;

class Painter {
 public:
  /// `frame_ms` is the time that a picture may take while the camera moves. `on_news` is called
  /// from the painter's thread whenever take_painting() or take_finding() has something; it must
  /// not block.
  Painter(double frame_ms, std::function<void()> on_news);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  // None of these functions waits.

  /// Replaces an order that was not begun yet. A refinement that is under way is given up.
  void order(PaintOrder order);
  void probe(Probe probe);
  /// Returns the newest painting, once.
  std::optional<Painting> take_painting();
  std::optional<Finding> take_finding();
  /// Returns what is being drawn.
  std::optional<frontend::Activity> activity() const { return activity_.current(); }
  /// Ends what is being drawn. The picture before it stays.
  void stop();

 private:
  using ScenePointer = std::shared_ptr<const csgcore::Scene>;

  struct Stops {
    std::stop_token drawing;
    std::stop_token all;  // what comes before it, too, which other orders may need
  };

  void run();
  Stops stops_of(const PaintOrder& order);
  void refine(std::unique_lock<std::mutex>& lock);
  bool paint(PaintOrder order, Step step, const Stops& stops);
  Painting paint_at(const PaintOrder& order, Size size, frontend::RenderSettings settings,
                    const std::stop_token& stop);
  void load(const PaintOrder& order);
  bool is_edit_of_drawn(const PaintOrder& order) const;
  double expected_ms(const PaintOrder& order) const;
  double affordable_share(const PaintOrder& order) const;
  void note_drawn(const PaintOrder& order, double ms);
  Finding find(const Probe& probe);
  void describe(const RayHit& hit, Finding& finding) const;
  void publish(Painting painting);
  bool waits_for_refinement(std::unique_lock<std::mutex>& lock);

  const double frame_ms_;
  const std::function<void()> on_news_;

  std::mutex mutex_;
  std::condition_variable wake_;
  bool is_stopping_ = false;
  std::optional<PaintOrder> ordered_;
  std::vector<Probe> probes_;
  std::optional<Painting> painted_;
  std::vector<Finding> findings_;
  frontend::ActivityMeter activity_;
  bool drops_coarse_ = false;  // what is coarse_ is not to be refined
  bool is_refining_ = false;   // a probe goes before that
  std::stop_source given_up_;  // stops what is being painted, at the user's wish
  std::stop_source outdated_;  // stops it if another picture is to be painted

  // Used by the painter's thread alone.
  frontend::SceneRenderer renderer_;
  std::shared_ptr<const frontend::ImportedDesign> loaded_;
  SectionPlane loaded_section_;
  std::shared_ptr<const csgcore::Scene> loaded_colors_;  // PaintOrder::recolored
  ScenePointer scene_;                   // the loaded design's, cut by the section plane
  std::vector<uint32_t> section_parts_;  // CutScene::parts of it
  frontend::RenderStats color_stats_;    // of the last picture without the studio's light
  double ms_per_pixel_ = 0;              // of the last picture of which most was traced; 0: unknown
  /// The last picture that was drawn in its whole size.
  struct Drawn {
    const frontend::ImportedDesign* design = nullptr;  // to compare with: it may be gone
    Navigation navigation{{}, csgcore::Projection::kPerspective};
    Size size{};
    std::optional<double> edit_ms{};  // what the last edit of the design took in this view
  } drawn_;
  std::optional<PaintOrder> coarse_;  // what was painted last, where it is to be refined
  Step next_step_ = Step::kFinal;     // of coarse_

  std::thread thread_;
};

}  // namespace window
