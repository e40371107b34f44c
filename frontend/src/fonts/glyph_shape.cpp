#include "fonts/glyph_shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace frontend {
namespace {

using csgcore::ProfileEdge;
using csgcore::ProfileLoop;

Vec2 point_of(const FT_Vector& v) { return {static_cast<double>(v.x), static_cast<double>(v.y)}; }

/// A curve of the third degree, by its control points.
struct Cubic {
  Vec2 p0, p1, p2, p3;

  Vec2 at(double t) const {
    const double s = 1 - t;
    return s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3;
  }
  /// The derivative by t.
  Vec2 slope(double t) const {
    const double s = 1 - t;
    return 3.0 * (s * s * (p1 - p0) + 2 * s * t * (p2 - p1) + t * t * (p3 - p2));
  }
};

/// Collects the edges of an outline.
class ShapeBuilder {
 public:
  explicit ShapeBuilder(int pieces) : pieces_(pieces) {}

  std::vector<ProfileLoop> take() {
    finish_loop();
    return std::move(loops_);
  }

  void move_to(const Vec2& to) {
    finish_loop();
    at_ = to;
  }

  void line_to(const Vec2& to) {
    if (to == at_) return;
    ProfileEdge edge;
    edge.end = to;
    add(edge);
  }

  void conic_to(const Vec2& control, const Vec2& to) {
    if (pieces_ == 0) {
      bezier_to(control, to);
      return;
    }
    const Vec2 from = at_;
    for (int i = 1; i < pieces_; ++i) {
      const double t = share(i);
      line_to((1 - t) * (1 - t) * from + 2 * t * (1 - t) * control + t * t * to);
    }
    line_to(to);
  }

  void cubic_to(const Vec2& control1, const Vec2& control2, const Vec2& to) {
    const Cubic cubic{at_, control1, control2, to};
    if (pieces_ == 0) {
      quadratics_to(cubic);
      return;
    }
    for (int i = 1; i < pieces_; ++i) line_to(cubic.at(share(i)));
    line_to(to);
  }

 private:
  double share(int i) const { return static_cast<double>(i) / pieces_; }

  void bezier_to(const Vec2& control, const Vec2& to) {
    if (to == at_ && control == at_) return;
    ProfileEdge edge;
    edge.kind = ProfileEdge::Kind::kBezier;
    edge.control = control;
    edge.end = to;
    add(edge);
  }

  /// A quadratic curve whose control point is (3(p1 + p2) − p0 − p3)/4 has the cubic's ends, and
  /// differs from it by (p3 − 3p2 + 3p1 − p0)·t(t − 1/2)(t − 1), whose polynomial is at most √3/36.
  /// The third difference of one of n pieces is 1/n³ of the whole curve's.
  void quadratics_to(const Cubic& cubic) {
    const double off_by =
        std::sqrt(3.0) / 36 * glm::length(cubic.p3 - 3.0 * cubic.p2 + 3.0 * cubic.p1 - cubic.p0);
    const int count = std::max(1, static_cast<int>(std::ceil(std::cbrt(off_by / kCubicTolerance))));
    const double step = 1.0 / count;
    for (int i = 0; i < count; ++i) {
      const Vec2 from = at_;
      const double t_end = (i + 1) * step;
      const Vec2 to = i + 1 == count ? cubic.p3 : cubic.at(t_end);
      // By the piece's own control points from + slope/3 and to − slope/3.
      const Vec2 control =
          0.5 * (from + to) + step / 4 * (cubic.slope(i * step) - cubic.slope(t_end));
      bezier_to(control, to);
    }
  }

  void add(const ProfileEdge& edge) {
    loop_.push_back(edge);
    at_ = edge.end;
  }

  /// FreeType ends each contour where it begins.
  void finish_loop() {
    if (!loop_.empty()) loops_.push_back(std::move(loop_));
    loop_.clear();
  }

  int pieces_;
  Vec2 at_{0.0};
  ProfileLoop loop_;
  std::vector<ProfileLoop> loops_;
};

ShapeBuilder& builder_of(void* user) { return *static_cast<ShapeBuilder*>(user); }

int move_to(const FT_Vector* to, void* user) {
  builder_of(user).move_to(point_of(*to));
  return 0;
}

int line_to(const FT_Vector* to, void* user) {
  builder_of(user).line_to(point_of(*to));
  return 0;
}

int conic_to(const FT_Vector* control, const FT_Vector* to, void* user) {
  builder_of(user).conic_to(point_of(*control), point_of(*to));
  return 0;
}

int cubic_to(const FT_Vector* control1, const FT_Vector* control2, const FT_Vector* to,
             void* user) {
  builder_of(user).cubic_to(point_of(*control1), point_of(*control2), point_of(*to));
  return 0;
}

constexpr FT_Outline_Funcs kVisitors = {move_to, line_to, conic_to, cubic_to, 0, 0};

}  // namespace

GlyphShape shape_of(const FontLibraries& libraries, FT_Outline& outline, int pieces) {
  ShapeBuilder builder(pieces);
  if (libraries.freetype.outline_decompose(&outline, &kVisitors, &builder) != 0) return {};
  Outline result{builder.take(), csgcore::FillRule::kNonZero};
  GlyphShape shape;
  if (result.loops.empty()) return shape;
  shape.profile = std::make_shared<csgcore::Profile>(result.loops, result.fill_rule);
  if (!shape.profile->has_area()) return {};
  shape.figure = std::make_shared<const Figure>(std::move(result));
  return shape;
}

}  // namespace frontend
