#include "glrender/renderer.hpp"

#include <algorithm>
#include <cassert>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <iterator>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "csgcore/phong.hpp"
#include "frame.hpp"
#include "glrender/stopwatch.hpp"
#include "render_target.hpp"
#include "shader_program.hpp"
#include "solid_buffers.hpp"
#include "traversal.hpp"

namespace glrender {
namespace {

using csgcore::Image;
using csgcore::Leaf;
using csgcore::LeafBatch;
using csgcore::Literal;
using csgcore::Solid;
using csgcore::Subdivision;
using csgcore::SubdivisionOptions;
using csgcore::View;

/// Pieces of the solid thinner than this, along the normal, do not exist in a GL picture (design.md
/// §3), as a fraction of the scene's largest side. The two ends of a piece each carry the rounding
/// of a float t: about 2^-24 of the scene's size, times the few operations that lead to it.
/// (Measured on coincident faces at several angles: no speckle down to 2^-22, some at 2^-23.)
constexpr double kThinnestPiece = 0x1p-21;

/// The corners of a box as one triangle strip, wound counter-clockwise as seen from outside. Corner
/// i is at the upper end of x, y, z where bits 0, 1, 2 of i are set.
constexpr uint8_t kBoxStrip[] = {3, 7, 1, 5, 4, 7, 6, 3, 2, 1, 0, 4, 2, 6};

/// Batches on their way from the thread that subdivides to the one that draws.
class BatchQueue {
 public:
  struct Batch {
    std::vector<Leaf> leaves;
    std::vector<Literal> literals;
  };

  void push(const LeafBatch& batch) {
    const std::lock_guard lock(mutex_);
    batches_.push_back({{batch.leaves.begin(), batch.leaves.end()},
                        {batch.literals.begin(), batch.literals.end()}});
    ready_.notify_one();
  }
  void close(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    error_ = error;
    ready_.notify_one();
  }
  /// All that has come, as one batch; waits for some; none after close(). Rethrows its error.
  std::optional<Batch> pop() {
    std::unique_lock lock(mutex_);
    ready_.wait(lock, [&] { return closed_ || !batches_.empty(); });
    if (batches_.empty()) {
      if (error_) std::rethrow_exception(error_);
      return std::nullopt;
    }
    Batch all = std::move(batches_.front());
    batches_.pop_front();
    for (; !batches_.empty(); batches_.pop_front()) {
      const Batch& next = batches_.front();
      const uint64_t base = all.literals.size();
      all.literals.insert(all.literals.end(), next.literals.begin(), next.literals.end());
      for (Leaf leaf : next.leaves) {
        leaf.first_literal += base;
        all.leaves.push_back(leaf);
      }
    }
    return all;
  }

 private:
  std::mutex mutex_;
  std::condition_variable ready_;
  std::deque<Batch> batches_;
  bool closed_ = false;
  std::exception_ptr error_;
};

}  // namespace

class Renderer::Impl {
 public:
  explicit Impl(const Solid& solid)
      : solid_(solid),
        buffers_(solid),
        instances_(Buffer::make()),
        strip_(Buffer::make()),
        vertex_array_(VertexArray::make()),
        conservative_depth_(epoxy_has_gl_extension("GL_ARB_conservative_depth") &&
                            epoxy_has_gl_extension("GL_ARB_clip_control")) {
    glBindVertexArray(vertex_array_.name());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, strip_.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof kBoxStrip, kBoxStrip, GL_STATIC_DRAW);
    for (const GLuint location : {kLocationBoxMin, kLocationBoxMax, kLocationList}) {
      glEnableVertexAttribArray(location);
      glVertexAttribDivisor(location, 1);
    }
    const csgcore::Vec3 size = solid.bounds().empty() ? csgcore::Vec3{0} : solid.bounds().size();
    tolerance_ = kThinnestPiece * std::max({size.x, size.y, size.z});
  }

  void load(const Subdivision& subdivision) {
    subdivision_ = &subdivision;
    buffers_.upload_literals(subdivision.literals());
  }

  Image draw(const View& view, const FrameSettings& settings, FrameStats& stats) {
    first_target_.reset();
    return draw_loaded(view, settings, stats);
  }

  Image draw_behind(const View& view, const FrameSettings& settings, FrameStats& stats) {
    assert(target_ && target_->measured_texture() != 0);
    first_target_ = std::move(target_);
    target_.reset();
    // Whatever happens, later pictures lie behind nothing.
    struct Forget {
      std::optional<RenderTarget>& target;
      ~Forget() { target.reset(); }
    } forget{first_target_};
    return draw_loaded(view, settings, stats);
  }

  double traversal_ms(const View& view) {
    const FrameSettings settings;
    double ms = 0;
    // The first pass compiles what is not compiled yet.
    for (int pass = 0; pass < 2; ++pass) {
      FrameStats stats;
      const Frame frame = begin(view, settings);
      glFinish();
      Stopwatch watch;
      traverse(frame, settings.subject);
      upload_instances();
      {
        struct Discard {
          Discard() { glEnable(GL_RASTERIZER_DISCARD); }
          ~Discard() { glDisable(GL_RASTERIZER_DISCARD); }
        } discard;
        draw_streams(frame, settings, stats);
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
    const Frame frame = begin(view, settings);
    BatchQueue queue;
    std::thread subdividing([&] {
      std::exception_ptr error;
      try {
        const Subdivision subdivision(solid_, options,
                                      [&](const LeafBatch& batch) { queue.push(batch); });
      } catch (...) {
        error = std::current_exception();
      }
      queue.close(error);
    });
    std::exception_ptr error;
    try {
      while (auto batch = queue.pop()) draw_batch(*batch, frame, settings, stats);
    } catch (...) {
      error = std::current_exception();
    }
    subdividing.join();
    if (error) std::rethrow_exception(error);
    glFinish();
    stats.draw_ms = watch.lap();
    Image image = target_->read(frame);
    stats.read_ms = watch.lap();
    return image;
  }

 private:
  Image draw_loaded(const View& view, const FrameSettings& settings, FrameStats& stats) {
    stats = {};
    Stopwatch watch;
    const Frame frame = begin(view, settings);
    traverse(frame, settings.subject);
    upload_instances();
    glFinish();
    stats.traverse_ms = watch.lap();
    draw_streams(frame, settings, stats);
    glFinish();
    stats.draw_ms = watch.lap();
    Image image = target_->read(frame);
    stats.read_ms = watch.lap();
    return image;
  }

  /// What the frame and its light are fitted to.
  const csgcore::Box& scene_box(const FrameSettings& settings) const {
    return settings.scene_box.empty() ? solid_.bounds() : settings.scene_box;
  }

  /// The same with the cells' overlap, which is drawn too.
  csgcore::Box drawn_box(const FrameSettings& settings) const {
    csgcore::Box box = scene_box(settings);
    if (!box.empty()) box = {box.min - overlap(), box.max + overlap()};
    return box;
  }

  double overlap() const { return csgcore::cell_overlap(solid_.bounds()); }

  /// Prepares the target, the state and the primitives for a frame.
  Frame begin(const View& view, const FrameSettings& settings) {
    const Frame frame = make_frame(view, drawn_box(settings));
    if (!target_ || !target_->fits(view.width_px, view.height_px, settings.measured_channels)) {
      target_.reset();
      target_.emplace(view.width_px, view.height_px, settings.measured_channels);
    }
    target_->begin(settings.background);
    glBindVertexArray(vertex_array_.name());
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glEnable(GL_DEPTH_CLAMP);
    glEnable(GL_CULL_FACE);
    if (conservative_depth_) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    buffers_.place(frame);
    // An orthographic ray comes from infinity, so that it starts outside any solid.
    eye_inside_ = frame.perspective() && solid_.contains(view.eye);
    // Behind a front, rays start on the other side of it.
    if (first_target_) eye_inside_ = !eye_inside_;
    return frame;
  }

  InstanceSorter sorter(const Frame& frame, Subject subject) {
    return {frame, solid_, overlap(), eye_inside_, subject == Subject::kCells, streams_};
  }

  void traverse(const Frame& frame, Subject subject) {
    streams_.clear();
    if (!subdivision_) return;
    InstanceSorter into = sorter(frame, subject);
    traverse_front_to_back(*subdivision_, frame, into);
  }

  /// All streams into one buffer, in the order in which draw_streams takes them.
  void upload_instances() {
    glBindBuffer(GL_ARRAY_BUFFER, instances_.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(streams_.size() * sizeof(Instance)),
                 nullptr, GL_STREAM_DRAW);
    GLintptr offset = 0;
    for (const auto* group : {&streams_.front_faces, &streams_.back_faces}) {
      for (const auto& stream : *group) {
        const auto bytes = static_cast<GLsizeiptr>(stream.size() * sizeof(Instance));
        if (bytes > 0) glBufferSubData(GL_ARRAY_BUFFER, offset, bytes, stream.data());
        offset += bytes;
      }
    }
  }

  /// One instanced draw a path and side: the number of calls does not grow with the cells.
  void draw_streams(const Frame& frame, const FrameSettings& settings, FrameStats& stats) {
    size_t offset = 0;
    for (const bool front : {true, false}) {
      // The vertex order turns round under a mirror; ours has none.
      glCullFace(front ? GL_BACK : GL_FRONT);
      const auto& group = front ? streams_.front_faces : streams_.back_faces;
      for (int path = 0; path < kPaths; ++path) {
        const size_t count = group[static_cast<size_t>(path)].size();
        if (count == 0) continue;
        use_program(static_cast<Path>(path), front, frame, settings);
        point_attributes(offset);
        glDrawElementsInstanced(GL_TRIANGLE_STRIP, std::size(kBoxStrip), GL_UNSIGNED_BYTE, nullptr,
                                static_cast<GLsizei>(count));
        offset += count * sizeof(Instance);
        ++stats.draw_calls;
        stats.cells_drawn += count;
      }
    }
  }

  void use_program(Path path, bool front, const Frame& frame, const FrameSettings& settings) {
    ProgramKey key;
    key.path = path;
    key.shading = settings.shading;
    key.perspective = frame.perspective();
    key.measured = settings.measured_channels;
    key.has_sphere = buffers_.has_sphere();
    key.has_frustum = buffers_.has_frustum();
    key.clip_zero_to_one = conservative_depth_;
    // A back face lies behind the hit, so that its depth promises nothing; a box's own face is at
    // the depth of the fragment, but for rounding.
    key.behind = first_target_.has_value();
    key.conservative_depth = conservative_depth_ && front && path != Path::kBoxes;
    const GLuint program = programs_.get(key);
    glUseProgram(program);
    set_frame_uniforms(program, frame, overlap());
    buffers_.bind(program);
    const auto set_color = [&](const char* name, const glm::vec3& c) {
      glUniform3f(glGetUniformLocation(program, name), c.r, c.g, c.b);
    };
    set_color("u_front", settings.front);
    set_color("u_back", settings.back);
    set_color("u_edge", settings.edge);
    const csgcore::Vec3 light =
        csgcore::phong_light(frame.view, scene_box(settings)).position_world;
    set_color("u_light_position", frame.relative(light));
    glUniform1f(glGetUniformLocation(program, "u_tolerance"), static_cast<float>(tolerance_));
    glUniform1i(glGetUniformLocation(program, "u_eye_inside"), eye_inside_);
    if (first_target_) {
      glActiveTexture(GL_TEXTURE0 + SolidBuffers::kTextureUnits);
      glBindTexture(GL_TEXTURE_2D, first_target_->measured_texture());
      glUniform1i(glGetUniformLocation(program, "u_first"), SolidBuffers::kTextureUnits);
    }
  }

  void point_attributes(size_t offset) const {
    glBindBuffer(GL_ARRAY_BUFFER, instances_.name());
    const auto at = [&](size_t member) { return reinterpret_cast<const void*>(offset + member); };
    constexpr GLsizei kStride = sizeof(Instance);
    glVertexAttribPointer(kLocationBoxMin, 3, GL_FLOAT, GL_FALSE, kStride,
                          at(offsetof(Instance, box_min)));
    glVertexAttribPointer(kLocationBoxMax, 3, GL_FLOAT, GL_FALSE, kStride,
                          at(offsetof(Instance, box_max)));
    glVertexAttribIPointer(kLocationList, 2, GL_UNSIGNED_INT, kStride,
                           at(offsetof(Instance, first_literal)));
  }

  void draw_batch(const BatchQueue::Batch& batch, const Frame& frame, const FrameSettings& settings,
                  FrameStats& stats) {
    streams_.clear();
    if (!frame.visible) return;
    InstanceSorter into = sorter(frame, settings.subject);
    const std::span<const Literal> literals(batch.literals);
    for (const Leaf& leaf : batch.leaves) {
      into.add(leaf, literals.subspan(leaf.first_literal, leaf.literal_count));
    }
    buffers_.upload_literals(literals);
    upload_instances();
    draw_streams(frame, settings, stats);
  }

  const Solid& solid_;
  SolidBuffers buffers_;
  Buffer instances_, strip_;
  VertexArray vertex_array_;
  ProgramCache programs_;
  std::optional<RenderTarget> target_;
  std::optional<RenderTarget> first_target_;  // draw_behind: the picture in front
  InstanceStreams streams_;
  const Subdivision* subdivision_ = nullptr;
  double tolerance_ = 0;
  bool eye_inside_ = false;
  bool conservative_depth_;
};

Renderer::Renderer(HeadlessContext&, const Solid& solid) : impl_(std::make_unique<Impl>(solid)) {}
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
