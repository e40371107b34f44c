// Scenes prepared for drawing, and the check of their pictures, for the tracer's benchmarks.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <string>

#include "csgcore/scene.hpp"
#include "csgcore/subdivision.hpp"
#include "csgcore/tracer.hpp"
#include "times.hpp"

namespace frame_benchmark {

using timing::give_up;
using timing::report;
using timing::time_ms;
using timing::Times;

/// Where a ray's candidate primitives come from.
enum class Method { kTiles, kCells };

struct Drawing {
  Method method = Method::kTiles;
  unsigned threads = 2;
};
/// Returns "tiles/threads=2".
std::string name_of(const Drawing& drawing);

struct PictureSize {
  uint32_t width_px = 640;
  uint32_t height_px = 480;
};

/// Returns OpenSCAD's default camera, which views all of the box (frontend/OPENSCAD.md, "Camera").
csgcore::View default_view(const csgcore::Box& view_box, const PictureSize& size = {});

/// A scene, prepared once, and its view.
class Subject {
 public:
  Subject(csgcore::Scene scene, const csgcore::View& view);

  const csgcore::Scene& scene() const { return scene_; }
  const csgcore::View& view() const { return view_; }
  const csgcore::Solid& solid() const { return solid_; }
  /// Returns the subdivision, which two threads make at the first call.
  const csgcore::Subdivision& subdivision() const;
  /// The time that it took.
  double subdivide_ms() const;

  csgcore::TraceStats draw(const Drawing& drawing, csgcore::Image& image) const;
  csgcore::Hits hits() const;

 private:
  csgcore::Scene scene_;
  csgcore::View view_;
  csgcore::Solid solid_;
  mutable std::unique_ptr<csgcore::Subdivision> subdivision_;
  mutable double subdivide_ms_ = 0;
};

/// Compares what the drawing sees at some hundred pixels with the reference, and then the whole
/// picture with the first that was drawn of the subject: all must be equal, bit for bit.
class AnswerCheck {
 public:
  explicit AnswerCheck(const Subject& subject) : subject_(subject) {}
  /// Gives up if the drawing is wrong.
  void require_right(const Drawing& drawing);

 private:
  const Subject& subject_;
  csgcore::Image first_;
};

/// Reports the counters of one frame.
void report(const csgcore::TraceStats& stats, benchmark::State& state);

}  // namespace frame_benchmark
