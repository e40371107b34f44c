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
#include "frontend/files.hpp"
#include "frontend/importer.hpp"
#include "frontend/overlays.hpp"
#include "frontend/scene_renderer.hpp"
#include "navigation.hpp"
#include "section_plane.hpp"

namespace window {

/// A picture that is wanted.
struct PaintOrder {
  uint64_t number = 0;
  std::shared_ptr<const frontend::ImportedDesign> design;
  SectionPlane section;
  Navigation navigation{{}, csgcore::Projection::kPerspective};
  Size size;
  frontend::RenderSettings settings;
  frontend::Overlays overlays;
  /// Others follow at the display's rate: it may be coarse, and is refined once none does.
  bool is_moving = false;
};

struct Painting {
  PaintOrder order;
  csgcore::Image image;  // smaller than the order's size where it is coarse
  bool is_final = false;
  frontend::RenderStats stats;
  double draw_ms = 0;
  std::string error;  // why there is no picture; then `image` is empty
};

/// A place in a picture.
struct Probe {
  uint64_t number = 0;
  PaintOrder order;
  double x_px = 0;
  double y_px = 0;
  std::shared_ptr<const frontend::FileText> csg;  // the design's text; the design has its places
};

/// What lies there.
struct Finding {
  Probe probe;
  bool is_hit = false;
  csgcore::Vec3 position{0.0};  // world space
  csgcore::Vec3 normal{0.0};    // unit, outward
  uint32_t id = 0;              // Primitive::id, or kSectionId
  std::string line;             // the primitive's number and text in the .csg
};

class Painter {
 public:
  /// `frame_ms`: the time that a picture may take while the camera moves. `on_news` is called from
  /// the painter's thread whenever one of the two take() has something; it must not block.
  Painter(double frame_ms, std::function<void()> on_news);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  // None of these waits.

  /// In place of an order that was not begun yet. A refinement that is under way is given up.
  void order(PaintOrder order);
  void probe(Probe probe);
  /// The newest painting, once.
  std::optional<Painting> take_painting();
  std::optional<Finding> take_finding();

 private:
  using ScenePointer = std::shared_ptr<const csgcore::Scene>;

  void run();
  void paint(PaintOrder order, const std::stop_token& stop);
  Painting paint_at(const PaintOrder& order, Size size, uint32_t samples,
                    const std::stop_token& stop);
  void load(const PaintOrder& order);
  double affordable_share(const PaintOrder& order) const;
  Finding find(const Probe& probe);
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
  std::stop_source outdated_;  // what is being painted, if it is not to be finished

  // The thread's own.
  frontend::SceneRenderer renderer_;
  std::shared_ptr<const frontend::ImportedDesign> loaded_;
  SectionPlane loaded_section_;
  ScenePointer scene_;       // the loaded design's, cut open
  double ms_per_pixel_ = 0;  // of the last picture; 0: not known
  std::optional<PaintOrder> coarse_;

  std::thread thread_;
};

}  // namespace window
