#include "heal/frames.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace frontend {
namespace {

using csgcore::Mat3;
using csgcore::Vec3;

Mat3 absolute(const Mat3& m) { return Mat3(glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])); }

}  // namespace

double stretch_bound(const Mat3& m) {
  // |M|² = |MᵀM| is at most the largest row sum of |MᵀM|.
  const Mat3 square = absolute(glm::transpose(m) * m);
  const Vec3 sums = square[0] + square[1] + square[2];
  return std::sqrt(std::max(sums.x, std::max(sums.y, sums.z)));
}

csgcore::Affine inverse_of(const csgcore::Affine& map) {
  const Mat3 linear = csgcore::inverse(map.linear);
  return {linear, -(linear * map.translation)};
}

FrameTree::FrameTree() : frames_(1), errors_(1) {}

void FrameTree::reserve(size_t frames) { frames_.reserve(frames + 1); }

uint32_t FrameTree::add(uint32_t parent, const HealedMatrix& matrix) {
  const Frame& outer = frames_[parent];
  Frame frame;
  frame.parent = parent;
  frame.depth = outer.depth + 1;
  frame.to_parent = matrix.map;
  frame.to_world = compose(outer.to_world, matrix.map);
  if (!matrix.exact) {
    frame.errors = static_cast<uint32_t>(errors_.size());
    errors_.push_back({matrix.linear_error, matrix.translation_error});
  }
  const bool is_translation = matrix.map.linear == Mat3(1.0);
  const double stretch = is_translation ? 1 : stretch_bound(matrix.map.linear);
  frame.stretch = outer.stretch * stretch;
  if (!matrix.exact || outer.linear_error > 0 || outer.point_error > 0) {
    const double own_error = matrix.exact ? 0 : stretch_bound(matrix.linear_error);
    frame.linear_error = outer.linear_error * stretch + outer.stretch * own_error;
    frame.point_error = outer.point_error +
                        outer.linear_error * glm::length(matrix.map.translation) +
                        outer.stretch * glm::length(matrix.translation_error);
  }
  frames_.push_back(frame);
  return static_cast<uint32_t>(frames_.size() - 1);
}

std::optional<uint32_t> FrameTree::common(uint32_t a, uint32_t b) const {
  for (uint32_t step = 0; a != b; ++step) {
    if (step == 2 * kMostSteps) return std::nullopt;
    if (frames_[a].depth >= frames_[b].depth) {
      a = frames_[a].parent;
    } else {
      b = frames_[b].parent;
    }
  }
  return a;
}

Vec3 FrameTree::error_of_point(uint32_t frame, uint32_t ancestor, const Vec3& local) const {
  Vec3 point = local;
  Vec3 error(0.0);
  for (; frame != ancestor; frame = frames_[frame].parent) {
    const Frame& step = frames_[frame];
    const Errors& own = errors_[step.errors];
    error =
        absolute(step.to_parent.linear) * error + own.linear * glm::abs(point) + own.translation;
    point = step.to_parent.point(point);
  }
  return error;
}

Vec3 FrameTree::error_of_vector(uint32_t frame, uint32_t ancestor, const Vec3& local) const {
  Vec3 vector = local;
  Vec3 error(0.0);
  for (; frame != ancestor; frame = frames_[frame].parent) {
    const Frame& step = frames_[frame];
    error =
        absolute(step.to_parent.linear) * error + errors_[step.errors].linear * glm::abs(vector);
    vector = step.to_parent.direction(vector);
  }
  return error;
}

}  // namespace frontend
