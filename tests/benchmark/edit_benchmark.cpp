// Measures the cost of an edit of one primitive, of which the changed areas are drawn, compared
// with drawing the whole picture: from the later scene to its picture, by screen tiles. Each
// iteration edits another primitive of the same design, and draws it in both ways; their pictures
// are compared before any time is taken. `ratio` and `least_ratio` are the edit's median and
// minimum over those of the whole; the time that Google Benchmark prints is the edit's.
#include <benchmark/benchmark.h>

#include <memory>
#include <random>
#include <string>

#include "csgcore/changed_areas.hpp"
#include "frame.hpp"
#include "support/models.hpp"

namespace {

using csgcore::FrameSettings;
using csgcore::Image;
using csgcore::Primitive;
using csgcore::Scene;
using csgcore::SceneEdit;
using csgcore::Solid;
using csgcore::TraceOptions;
using csgcore::TraceStats;
using csgcore::View;
using frame_benchmark::Times;

enum class Kind { kMoved, kInserted, kRecolored };

constexpr unsigned kThreads = 2;

/// A scene, and what is made of it for a picture.
struct Made {
  explicit Made(const Scene& anew)
      : scene(anew),
        primitives(csgcore::canonical_primitives(scene)),
        solid(primitives, scene.model) {}

  Scene scene;
  std::shared_ptr<const csgcore::CanonicalPrimitives> primitives;
  Solid solid;
};

/// A design that is a difference, whose holes are edited.
class Edits {
 public:
  Edits(Scene scene, Kind kind) : kind_(kind), earlier_(scene), scene_(std::move(scene)) {
    view_ = frame_benchmark::default_view(earlier_.solid.bounds());
    whole_.threads = kThreads;
  }

  /// Makes the next later scene.
  void next() {
    later_ = scene_;
    const size_t index = 1 + random_() % (scene_.primitives.size() - 1);
    Primitive& primitive = later_.primitives[index];
    if (kind_ == Kind::kRecolored) {
      primitive.color = csgcore::Color{1, 0, 0, 1};
      return;
    }
    if (kind_ == Kind::kInserted) {
      const Primitive copy = primitive;
      later_.primitives.insert(later_.primitives.begin() + static_cast<long>(index), copy);
      csgcore::CsgTreeBuilder builder;
      builder.open(csgcore::Op::kDifference);
      for (uint32_t i = 0; i < later_.primitives.size(); ++i) {
        later_.primitives[i].id = i;
        builder.primitive(i);
      }
      builder.close();
      later_.model = builder.finish();
    }
    std::uniform_real_distribution<double> by(-0.1, 0.1);
    for (int axis = 0; axis < 3; ++axis) {
      later_.primitives[index].local_to_world.translation[axis] += by(random_);
    }
  }

  /// Draws the later scene, with all of it made anew.
  void draw_whole(Image& image) {
    made_ = std::make_unique<Made>(later_);
    draw(whole_, image);
  }

  /// Draws the later scene where its picture differs from the earlier one's, which `image` is.
  void draw_edit(Image& image) {
    const SceneEdit edit = csgcore::compare(earlier_.scene, later_);
    made_ = std::make_unique<Made>(later_);
    TraceOptions options = whole_;
    const auto areas = csgcore::changed_areas(earlier_.solid, made_->solid, edit, edit.model, view_,
                                              FrameSettings{});
    for (const csgcore::PixelArea& area : areas) {
      options.area = area;
      draw(options, image);
    }
    pixels_traced_ = csgcore::count_pixels(areas);
  }

  void draw_earlier(Image& image) {
    TraceStats stats;
    csgcore::draw(earlier_.solid, view_, FrameSettings{}, whole_, image, stats);
  }

  uint64_t pixels_traced() const { return pixels_traced_; }

 private:
  void draw(const TraceOptions& options, Image& image) {
    TraceStats stats;
    csgcore::draw(made_->solid, view_, FrameSettings{}, options, image, stats);
  }

  const Kind kind_;
  const Made earlier_;
  const Scene scene_;
  View view_;
  TraceOptions whole_;
  std::mt19937 random_{1};
  Scene later_;
  std::unique_ptr<Made> made_;
  uint64_t pixels_traced_ = 0;
};

void report(const Times& whole, const Times& edit, benchmark::State& state) {
  state.counters["whole_ms"] = whole.median();
  state.counters["edit_ms"] = edit.median();
  state.counters["least_whole_ms"] = whole.least();
  state.counters["least_edit_ms"] = edit.least();
  state.counters["ratio"] = edit.median() / whole.median();
  state.counters["least_ratio"] = edit.least() / whole.least();
}

void draw(benchmark::State& state, const Scene& scene, Kind kind) {
  Edits edits(scene, kind);
  Image earlier, whole_image, edit_image;
  edits.draw_earlier(earlier);
  for (int i = 0; i < 5; ++i) {
    edits.next();
    edits.draw_whole(whole_image);
    edit_image = earlier;
    edits.draw_edit(edit_image);
    if (whole_image.rgb != edit_image.rgb) frame_benchmark::give_up("an edit's other picture");
  }
  Times whole, edit;
  for (auto _ : state) {
    edits.next();
    edit_image = earlier;
    whole.measure([&] { edits.draw_whole(whole_image); });
    edit.measure([&] { edits.draw_edit(edit_image); });
    state.SetIterationTime(edit.last() / 1000);
  }
  report(whole, edit, state);
  state.counters["pixels"] = static_cast<double>(edits.pixels_traced());
}

template <typename Run>
void add(const std::string& name, Run&& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond)->UseManualTime();
}

void add_all() {
  const std::pair<const char*, Kind> kinds[] = {
      {"moved", Kind::kMoved}, {"inserted", Kind::kInserted}, {"recolored", Kind::kRecolored}};
  for (const uint32_t n : {1'000u, 10'000u}) {
    for (const bool cones : {false, true}) {
      const Scene scene =
          cones ? test_support::cylinder_minus_cones(n) : test_support::cylinder_minus_spheres(n);
      const std::string design = (cones ? "CC" : "CS") + std::to_string(n);
      for (const auto& [what, kind] : kinds) {
        const std::string name = design + "/" + what;
        const Kind of = kind;
        add(name + "/tiles", [=](benchmark::State& s) { draw(s, scene, of); });
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  add_all();
  benchmark::RunSpecifiedBenchmarks();
}
