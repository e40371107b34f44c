// What the tracer's benchmarks share: scenes made ready to be drawn, the check of their pictures,
// and times.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "csgcore/scene.hpp"
#include "csgcore/subdivision.hpp"
#include "csgcore/tracer.hpp"

namespace frame_benchmark {

/// How a ray finds what it can meet.
enum class Method { kTiles, kCells };

struct Drawing {
  Method method = Method::kTiles;
  unsigned threads = 2;
};
/// "tiles/threads=2".
std::string name_of(const Drawing& drawing);

struct PictureSize {
  uint32_t width_px = 640;
  uint32_t height_px = 480;
};

/// OpenSCAD's default camera, which views all of the box (frontend/OPENSCAD.md, "Camera").
csgcore::View default_view(const csgcore::Box& view_box, const PictureSize& size = {});

/// A scene, made ready once, and the view that it is drawn from.
class Subject {
 public:
  Subject(csgcore::Scene scene, const csgcore::View& view);

  const csgcore::Scene& scene() const { return scene_; }
  const csgcore::View& view() const { return view_; }
  const csgcore::Solid& solid() const { return solid_; }
  /// By two threads, at the first call.
  const csgcore::Subdivision& subdivision() const;
  /// What that took.
  double subdivide_ms() const;

  csgcore::TraceStats draw(const Drawing& drawing, csgcore::Image& image) const;
  /// A frame that finds out, too, what was skipped.
  csgcore::TraceStats count_skipped(const Drawing& drawing) const;
  csgcore::Hits hits() const;

 private:
  csgcore::TraceStats draw(const Drawing& drawing, const csgcore::TraceOptions& options,
                           csgcore::Image& image) const;

  csgcore::Scene scene_;
  csgcore::View view_;
  csgcore::Solid solid_;
  mutable std::unique_ptr<csgcore::Subdivision> subdivision_;
  mutable double subdivide_ms_ = 0;
};

/// Sees the same primitives at the same places, but for pixels on a silhouette: the grown solid's
/// larger box moves the rays' origins, and so their last bits.
bool sees_the_same(const Subject& alone, const Subject& grown);

/// Ends the program, so that no time of a wrong answer is seen.
[[noreturn]] void give_up(const std::string& what);

/// Holds what the drawing sees at some hundred pixels against the reference, then the whole picture
/// against the first that was drawn of the subject: all are the same, bit for bit.
class AnswerCheck {
 public:
  explicit AnswerCheck(const Subject& subject) : subject_(subject) {}
  /// Gives up if it is wrong.
  void require_right(const Drawing& drawing);

 private:
  const Subject& subject_;
  csgcore::Image first_;
};

/// What repetitions of the same work took, in ms.
class Times {
 public:
  void measure(const std::function<void()>& work);
  double last() const { return wall_.back(); }
  double least() const;
  double median() const;
  /// Median of the processor's time of all threads: what other programs on the machine take does
  /// not count, nor does it tell how well the threads share the work.
  double cpu() const;

 private:
  std::vector<double> wall_, cpu_;
};

double time_ms(const std::function<void()>& work);

/// The counters of one frame.
void report(const csgcore::TraceStats& stats, benchmark::State& state);

}  // namespace frame_benchmark
