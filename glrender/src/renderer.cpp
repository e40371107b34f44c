#include "glrender/renderer.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <exception>
#include <glm/vector_relational.hpp>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "batch_queue.hpp"
#include "csgcore/phong.hpp"
#include "csgcore/tracer.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "csgcore/view.hpp"
#include "frame.hpp"
#include "render_target.hpp"
#include "solid_buffers.hpp"
#include "stream_drawer.hpp"
#include "traversal.hpp"

namespace glrender {
namespace {

class Stopwatch {
 public:
  /// ms since the last call, or since construction.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

using csgcore::BlistTest;
using csgcore::Image;
using csgcore::Leaf;
using csgcore::LeafBatch;
using csgcore::Solid;
using csgcore::Subdivision;
using csgcore::SubdivisionOptions;
using csgcore::View;

/// Pieces of the solid thinner than this, along the normal, do not exist in a GL picture
/// (csgcore/NUMERICS.md, "OpenGL"). It is a fraction of the scene's largest side. The two ends of a
/// piece each carry the rounding of a float t: about 2^-24 of the scene's size, times the few
/// operations that lead to it. (Measured on coincident faces at several angles: no speckle down to
/// 2^-22, some at 2^-23.)
constexpr double kThicknessTolerance = 0x1p-21;

/// Doubtful pixels that are left alone, for each ray of a pixel: any picture may have some at its
/// edges, and at most 4 were seen in the examples. Only a wall has more of them.
constexpr uint32_t kFewDoubtful = 16;

/// In tolerances, more than the length of a sheet of an open mesh at the flattest angle at which
/// its thickness is measured along the normal (SHEET_THICKNESS, SHEET_COSINE).
constexpr double kLongestSheet = 2048;

double thickness_tolerance(const Solid& solid) {
  if (solid.bounds().empty()) return 0;
  const Vec3 size = solid.bounds().size();
  return kThicknessTolerance * std::max({size.x, size.y, size.z});
}

/// Returns the pass with its rays displaced to where sample i of n lies.
Pass displaced(Pass pass, uint32_t i, uint32_t n) {
  pass.frame.displacement_px = csgcore::sample_offset(i, n);
  return pass;
}

FrameSettings with_measured(FrameSettings settings, bool measured) {
  settings.measured_channels = measured;
  return settings;
}

TargetFormat format_of(const View& view, bool measured, bool exact_colors) {
  return {view.width_px, view.height_px, measured, exact_colors};
}

}  // namespace

class Renderer::Impl {
 public:
  Impl(HeadlessContext& context, const Solid& solid)
      : solid_(&solid),
        buffers_(solid, thickness_tolerance(solid), context.most_texels()),
        drawer_(context.programs()),
        tolerance_(thickness_tolerance(solid)) {}

  void load(const Subdivision& subdivision) {
    PackedTests packed = pack_tests(subdivision);
    buffers_.upload_tests(packed.tests);
    subdivision_ = &subdivision;
    first_test_ = std::move(packed.first_test);
  }

  Image draw(const View& view, const FrameSettings& settings, FrameStats& stats) {
    stats = {};
    const Pass pass = make_pass(view, settings, nullptr);
    prepare(pass, stats);
    Image image;
    doubts_ = doubts_at_eye(view);
    if (settings.samples > 1) draw_samples(pass, image, stats);
    // The pixels' centres are drawn last, since draw_behind() continues from that picture.
    if (settings.samples <= 1 || settings.measured_channels) {
      use_target(view, settings.measured_channels);
      shoot(pass, *target_, stats);
      read(pass, image, stats);
    }
    settle_doubts(pass, settings.samples, image, stats);
    return image;
  }

  Image draw_behind(const View& view, const FrameSettings& settings, FrameStats& stats) {
    assert(target_ && target_->format() == format_of(view, true, false));
    stats = {};
    Image image;
    if (settings.samples > 1) draw_samples_behind(view, settings, image, stats);
    const RenderTarget first = std::move(*target_);
    target_.reset();
    const Pass pass = make_pass(view, settings, &first);
    prepare(pass, stats);
    use_target(view, settings.measured_channels);
    shoot(pass, *target_, stats);
    read(pass, image, stats);
    settle_doubts(pass, settings.samples, image, stats);
    return image;
  }

  double traversal_ms(const View& view) {
    const Pass pass = make_pass(view, {}, nullptr);
    use_target(view, false);
    double ms = 0;
    // The first turn compiles the shaders; the second is timed.
    for (int turn = 0; turn < 2; ++turn) {
      FrameStats stats;
      begin(pass, *target_);
      glFinish();
      Stopwatch watch;
      traverse(pass);
      drawer_.upload(streams_);
      {
        struct Discard {
          Discard() { glEnable(GL_RASTERIZER_DISCARD); }
          ~Discard() { glDisable(GL_RASTERIZER_DISCARD); }
        } discard;
        drawer_.draw(streams_, pass, buffers_, stats);
      }
      glFinish();
      ms = watch.lap();
    }
    return ms;
  }

  Image draw_while_subdividing(const SubdivisionOptions& options, const View& view,
                               const FrameSettings& settings, FrameStats& stats) {
    stats = {};
    subdivision_ = nullptr;
    Stopwatch watch;
    Pass pass = make_pass(view, settings, nullptr);
    pass.tiles = false;
    doubts_ = doubts_at_eye(view);
    use_target(view, settings.measured_channels);
    begin(pass, *target_);
    BatchQueue queue;
    std::thread subdividing([&] {
      std::exception_ptr error;
      try {
        const Subdivision subdivision(*solid_, options,
                                      [&](const LeafBatch& batch) { queue.push(batch); });
      } catch (...) {
        error = std::current_exception();
      }
      queue.close(error);
    });
    std::exception_ptr error;
    try {
      while (auto batch = queue.pop()) draw_batch(*batch, pass, stats);
    } catch (...) {
      error = std::current_exception();
    }
    subdividing.join();
    if (error) std::rethrow_exception(error);
    glFinish();
    stats.draw_ms = watch.lap();
    Image image;
    read(pass, image, stats);
    settle_doubts(pass, 1, image, stats);
    return image;
  }

 private:
  /// The box to which the frame and its light are fitted.
  const csgcore::Box& scene_box(const FrameSettings& settings) const {
    return settings.scene_box.empty() ? solid_->bounds() : settings.scene_box;
  }

  /// The scene's box, enlarged by the cells' overlap, which is drawn too.
  csgcore::Box drawn_box(const FrameSettings& settings) const {
    csgcore::Box box = scene_box(settings);
    if (!box.empty()) box = {box.min - overlap(), box.max + overlap()};
    return box;
  }

  double overlap() const { return csgcore::cell_overlap(solid_->bounds()); }

  /// Returns a pass of the rays through the pixels' centres. `first` is the picture behind which
  /// they start, or null.
  Pass make_pass(const View& view, const FrameSettings& settings, const RenderTarget* first) const {
    Pass pass;
    pass.frame = make_frame(view, drawn_box(settings));
    pass.settings = settings;
    pass.tiles = settings.technique == Technique::kTiles && settings.subject == Subject::kSurface;
    pass.overlap = overlap();
    pass.tolerance = tolerance_;
    pass.light_world = csgcore::phong_light(view, scene_box(settings)).position_world;
    // An orthographic ray comes from infinity, so that it starts outside any solid. A perspective
    // one starts beyond what is too near to be told from the eye.
    pass.eye_inside =
        pass.frame.perspective() && solid_->contains(view.eye + tolerance_ * view.forward);
    if (first) {
      pass.first = first->measured_texture();
      // Rays that start at a front start on the other side of it.
      pass.eye_inside = !pass.eye_inside;
    }
    return pass;
  }

  /// Doubts all pixels if the eye may lie in an open mesh: whether it lies in the solid then
  /// differs from ray to ray.
  Doubts doubts_at_eye(const View& view) const {
    if (buffers_.nonconvex().empty() || view.projection != csgcore::Projection::kPerspective) {
      return {};
    }
    const double margin = kLongestSheet * tolerance_;
    for (const csgcore::CanonicalPrimitive& primitive : solid_->primitives()) {
      if (!primitive.mesh() || primitive.mesh()->is_closed()) continue;
      const csgcore::Box& bounds = primitive.bounds;
      if (glm::all(glm::greaterThan(view.eye, bounds.min - margin)) &&
          glm::all(glm::lessThan(view.eye, bounds.max + margin))) {
        return {std::vector<bool>(size_t{view.width_px} * view.height_px, true), true};
      }
    }
    return {};
  }

  void use_target(const View& view, bool measured) {
    const TargetFormat format = format_of(view, measured, false);
    if (target_ && target_->format() == format) return;
    target_.reset();
    target_.emplace(format);
  }

  InstanceSorter sorter(const Pass& pass) {
    const bool boxes = pass.settings.subject == Subject::kCells;
    return {pass.frame,   *solid_,         short_list(buffers_.are_segments_dear(), false),
            pass.overlap, pass.eye_inside, boxes,
            streams_};
  }

  void traverse(const Pass& pass) {
    streams_.clear();
    if (!subdivision_) return;
    InstanceSorter into = sorter(pass);
    traverse_front_to_back(*subdivision_, first_test_, pass.frame, into);
  }

  /// Uploads the cells or tiles that the pass draws. Displaced passes draw the same ones.
  void prepare(const Pass& pass, FrameStats& stats) {
    Stopwatch watch;
    if (pass.tiles) {
      list_tiles(pass);
      stats.list_ms += watch.lap();
      add_lists(pass);
    } else {
      traverse(pass);
    }
    drawer_.upload(streams_);
    glFinish();
    stats.traverse_ms += watch.lap();
  }

  void list_tiles(const Pass& pass) {
    csgcore::TileListOptions options;
    options.boundary = pass.first ? csgcore::Boundary::kBehind : csgcore::Boundary::kFirst;
    options.centers_only = pass.settings.samples <= 1;
    options.thickness_tolerance = pass.tolerance;
    options.short_list = short_list(buffers_.are_segments_dear(), true);
    options.threads = pass.settings.threads;
    options.longest_list = kLongList;
    if (!csgcore::list_tiles(*solid_, pass.frame.view, options, lists_)) refuse_lists();
  }

  void add_lists(const Pass& pass) {
    streams_.clear();
    if (!pass.frame.visible) return;
    add_tiles(lists_, pass.frame, *solid_, pass.eye_inside, streams_);
    buffers_.upload_tests(lists_.tests, ListsOf::kTiles);
  }

  void begin(const Pass& pass, const RenderTarget& target) {
    target.begin(pass.settings);
    drawer_.begin(pass);
    buffers_.place(pass.frame);
  }

  /// Draws what prepare() has uploaded.
  void shoot(const Pass& pass, const RenderTarget& target, FrameStats& stats) {
    Stopwatch watch;
    begin(pass, target);
    drawer_.draw(streams_, pass, buffers_, stats);
    glFinish();
    stats.draw_ms += watch.lap();
  }

  /// Adds target_'s channels to the image, and its colours if there are none yet.
  void read(const Pass& pass, Image& image, FrameStats& stats) {
    Stopwatch watch;
    Image centre = target_->read(pass.frame, doubts_);
    if (!image.rgb.empty()) centre.rgb = std::move(image.rgb);
    image = std::move(centre);
    stats.read_ms += watch.lap();
  }

  /// Draws by the CPU the pixels that the shaders have given up, and those in which float cannot
  /// tell whether a piece is thick enough to exist. The CPU applies the same rule in double, so
  /// that a wall is drawn whole or not at all.
  void settle_doubts(const Pass& pass, uint32_t samples, Image& image, FrameStats& stats) const {
    const auto doubtful = std::count(doubts_.pixels.begin(), doubts_.pixels.end(), true);
    if (!doubts_.has_unfinished && doubtful <= long{kFewDoubtful} * samples) return;
    Stopwatch watch;
    csgcore::TraceOptions options;
    options.threads = pass.settings.threads;
    options.samples = samples;
    options.boundary = pass.first ? csgcore::Boundary::kBehind : csgcore::Boundary::kFirst;
    options.thickness_tolerance = pass.tolerance;
    Image exact;
    csgcore::TraceStats trace_stats;
    csgcore::draw(*solid_, pass.frame.view, pass.settings, options, exact, trace_stats);
    for (size_t i = 0; i < doubts_.pixels.size(); ++i) {
      if (!doubts_.pixels[i]) continue;
      image.rgb[i] = exact.rgb[i];
      if (!pass.settings.measured_channels) continue;
      image.z[i] = exact.z[i];
      image.normal[i] = exact.normal[i];
      image.position[i] = exact.position[i];
      image.id[i] = exact.id[i];
    }
    stats.draw_ms += watch.lap();
  }

  /// Averages colours over the samples.
  class Average {
   public:
    void add(const RenderTarget& target, Doubts& doubts, FrameStats& stats) {
      Stopwatch watch;
      target.add_colors(sum_, doubts);
      ++samples_;
      stats.read_ms += watch.lap();
    }
    void store(const View& view, Image& image) const {
      image.width_px = view.width_px;
      image.height_px = view.height_px;
      image.rgb.resize(sum_.size());
      const float scale = 255.0f / static_cast<float>(samples_);
      for (size_t i = 0; i < sum_.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
          image.rgb[i][c] = static_cast<uint8_t>(std::lround(scale * sum_[i][c]));
        }
      }
    }

   private:
    std::vector<glm::vec3> sum_;
    uint32_t samples_ = 0;
  };

  void draw_samples(Pass pass, Image& image, FrameStats& stats) {
    const View& view = pass.frame.view;
    pass.settings.measured_channels = false;
    const RenderTarget target(format_of(view, false, true));
    Average average;
    for (uint32_t i = 0; i < pass.settings.samples; ++i) {
      shoot(displaced(pass, i, pass.settings.samples), target, stats);
      average.add(target, doubts_, stats);
    }
    average.store(view, image);
  }

  /// Draws each sample behind its own front.
  void draw_samples_behind(const View& view, const FrameSettings& settings, Image& image,
                           FrameStats& stats) {
    const RenderTarget front(format_of(view, true, false));
    const RenderTarget behind(format_of(view, false, true));
    const Pass to_front = make_pass(view, with_measured(settings, true), nullptr);
    const Pass to_behind = make_pass(view, with_measured(settings, false), &front);
    Average average;
    for (uint32_t i = 0; i < settings.samples; ++i) {
      prepare(to_front, stats);
      shoot(displaced(to_front, i, settings.samples), front, stats);
      prepare(to_behind, stats);
      shoot(displaced(to_behind, i, settings.samples), behind, stats);
      average.add(behind, doubts_, stats);
    }
    average.store(view, image);
  }

  void draw_batch(const BatchQueue::Batch& batch, const Pass& pass, FrameStats& stats) {
    streams_.clear();
    if (!pass.frame.visible) return;
    InstanceSorter into = sorter(pass);
    const std::span<const BlistTest> tests(batch.tests);
    for (const Leaf& leaf : batch.leaves) {
      into.add(leaf, tests.subspan(leaf.first_test, leaf.test_count), leaf.first_test);
    }
    buffers_.upload_tests(tests);
    drawer_.upload(streams_);
    drawer_.draw(streams_, pass, buffers_, stats);
  }

  const Solid* solid_;
  SolidBuffers buffers_;
  StreamDrawer drawer_;
  InstanceStreams streams_;
  csgcore::TileLists lists_;
  std::optional<RenderTarget> target_;  // the last picture
  const Subdivision* subdivision_ = nullptr;
  std::vector<uint64_t> first_test_;  // by leaf of the subdivision, in the buffers
  Doubts doubts_;                     // of the last picture, and of the front that it lies behind
  double tolerance_;
};

Renderer::Renderer(HeadlessContext& context, const Solid& solid)
    : impl_(std::make_unique<Impl>(context, solid)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::load(const Subdivision& subdivision) { impl_->load(subdivision); }

Image Renderer::draw(const View& view, const FrameSettings& settings, FrameStats& stats) {
  return impl_->draw(view, settings, stats);
}

Image Renderer::draw_behind(const View& view, const FrameSettings& settings, FrameStats& stats) {
  return impl_->draw_behind(view, settings, stats);
}

double Renderer::traversal_ms(const View& view) { return impl_->traversal_ms(view); }

Image Renderer::draw_while_subdividing(const SubdivisionOptions& options, const View& view,
                                       const FrameSettings& settings, FrameStats& stats) {
  return impl_->draw_while_subdividing(options, view, settings, stats);
}

}  // namespace glrender
