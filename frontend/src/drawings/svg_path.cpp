#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "base/angles.hpp"
#include "drawings/svg.hpp"

namespace frontend {
namespace {

bool is_command(char c) {
  return std::string_view("MmLlHhVvZzCcSsQqTtAa").find(c) != std::string_view::npos;
}

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// How many numbers a command takes at a time.
size_t count_of(char command) {
  switch (lower(command)) {
    case 'h':
    case 'v':
      return 1;
    case 'c':
      return 6;
    case 's':
    case 'q':
      return 4;
    case 'a':
      return 7;
    default:
      return 2;
  }
}

/// The words of a path: commands of one letter, and what stands for numbers.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// Empty at the end.
  std::string_view next() {
    while (!text_.empty() && is_svg_separator(text_.front())) text_.remove_prefix(1);
    size_t length = text_.empty() ? 0 : 1;
    if (length == 1 && !is_command(text_.front())) length = length_of_number();
    const std::string_view word = text_.substr(0, length);
    text_.remove_prefix(length);
    return word;
  }

 private:
  /// A minus begins a new number, but for that of an exponent, and so does a second point.
  size_t length_of_number() const {
    bool has_point = text_.front() == '.';
    bool has_exponent = false;
    size_t i = 1;
    for (; i < text_.size(); ++i) {
      const char c = text_[i];
      const bool follows_exponent = lower(text_[i - 1]) == 'e';
      if (is_svg_separator(c) || is_command(c)) break;
      if (c == '-' && !follows_exponent) break;
      if (c == '.' && (has_point || has_exponent)) break;
      has_point = has_point || c == '.';
      has_exponent = has_exponent || lower(c) == 'e';
    }
    return i;
  }

  std::string_view text_;
};

class PathReader {
 public:
  explicit PathReader(const SvgChords& chords) : chords_(chords) {}

  SvgPath read(std::string_view data) {
    Words words(data);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      if (is_command(word.front())) {
        begin(word.front());
      } else if (command_ != 'z' && command_ != '\0') {
        numbers_[count_++] = svg_number(word);
        if (count_ < count_of(command_)) continue;
        count_ = 0;
        apply();
      }
    }
    // Once a part was closed, the last one counts as closed, too.
    finish_part(has_closed_);
    return std::move(path_);
  }

 private:
  /// Ends of a part that are as near to each other are joined.
  static constexpr double kOpenGap = 0.1;

  void begin(char command) {
    count_ = 0;
    is_relative_ = command >= 'a';
    command_ = lower(command);
    if (command_ != 'z') return;
    finish_part(true);
    has_closed_ = true;
    at_ = start_;
    last_control_.reset();
  }

  void finish_part(bool is_closed) {
    if (!has_part_) return;
    has_part_ = false;
    const bool has_gap = glm::length(part_.last() - part_.first()) > kOpenGap;
    (is_closed || !has_gap ? path_.filled : path_.open).push_back(std::move(part_));
  }

  Vec2 point(size_t i) const {
    const Vec2 given(numbers_[i], numbers_[i + 1]);
    return is_relative_ ? at_ + given : given;
  }

  /// The part that is drawn on. After `z`, OpenSCAD begins one with the first end of a line.
  CurvePath& part(const Vec2& first) {
    if (!has_part_) begin_part(first);
    return part_;
  }

  void begin_part(const Vec2& first) {
    part_ = CurvePath(first);
    has_part_ = true;
  }

  void line_to(const Vec2& end) {
    if (has_part_) {
      part_.line_to(end);
    } else {
      begin_part(end);
    }
    at_ = end;
    last_control_.reset();
  }

  void move_to(const Vec2& to) {
    finish_part(false);
    begin_part(to);
    at_ = start_ = to;
    last_control_.reset();
    command_ = 'l';  // for the numbers that follow
  }

  void cubic_to(const Vec2& control, const Vec2& second_control, const Vec2& end) {
    part(at_).cubic_to(control, second_control, end);
    at_ = end;
    last_control_ = second_control;
    last_is_cubic_ = true;
  }

  void quadratic_to(const Vec2& control, const Vec2& end) {
    part(at_).quadratic_to(control, end);
    at_ = end;
    last_control_ = control;
    last_is_cubic_ = false;
  }

  /// What goes on smoothly from a curve of the same kind.
  Vec2 reflected(bool is_cubic) const {
    return last_control_ && last_is_cubic_ == is_cubic ? 2.0 * at_ - *last_control_ : at_;
  }

  void arc_to(const Vec2& end) {
    const Vec2 radii(std::abs(numbers_[0]), std::abs(numbers_[1]));
    if (radii.x == 0 || radii.y == 0 || end == at_) return;
    const EllipseArc arc =
        svg_arc(at_, end, radii, numbers_[2], numbers_[3] != 0, numbers_[4] != 0);
    if (std::isfinite(arc.sweep)) {
      const Vec2 reach(glm::length(arc.u), glm::length(arc.v));
      part(at_).arc_to(arc, chords_.arc(arc.sweep, reach), end);
    } else {  // on the way to its angles some number is beyond double's
      part(at_).line_to(end);
    }
    at_ = end;
    last_control_.reset();
  }

  void apply() {
    switch (command_) {
      case 'm':
        return move_to(point(0));
      case 'l':
        return line_to(point(0));
      case 'h':
        return line_to({is_relative_ ? at_.x + numbers_[0] : numbers_[0], at_.y});
      case 'v':
        return line_to({at_.x, is_relative_ ? at_.y + numbers_[0] : numbers_[0]});
      case 'c':
        return cubic_to(point(0), point(2), point(4));
      case 's':
        return cubic_to(reflected(true), point(0), point(2));
      case 'q':
        return quadratic_to(point(0), point(2));
      case 't':
        return quadratic_to(reflected(false), point(0));
      default:
        return arc_to(point(5));
    }
  }

  const SvgChords& chords_;
  SvgPath path_;
  CurvePath part_{Vec2(0.0)};  // where has_part_ is true
  bool has_part_ = false;
  Vec2 at_{0.0};
  Vec2 start_{0.0};
  std::optional<Vec2> last_control_;
  bool last_is_cubic_ = false;
  bool has_closed_ = false;
  bool is_relative_ = false;
  char command_ = '\0';
  std::array<double, 7> numbers_{};
  size_t count_ = 0;
};

}  // namespace

SvgPath read_svg_path(std::string_view data, const SvgChords& chords) {
  return PathReader(chords).read(data);
}

EllipseArc svg_arc(const Vec2& from, const Vec2& to, Vec2 radii, double rotation_deg, bool is_large,
                   bool is_clockwise_on_paper) {
  // As the SVG specification computes the centre, where the ellipse is the unit circle.
  const double c = std::cos(rotation_deg * kDegree);
  const double s = std::sin(rotation_deg * kDegree);
  const Vec2 half = (from - to) / 2.0;
  Vec2 unit((c * half.x + s * half.y) / radii.x, (c * half.y - s * half.x) / radii.y);
  const double reach = glm::length(unit);
  if (reach > 1) {
    radii *= reach;
    unit /= reach;
  }
  const double distance = std::sqrt(std::max(0.0, 1 - std::min(reach * reach, 1.0)));
  const double side = is_large == is_clockwise_on_paper ? -1 : 1;
  const Vec2 across =
      reach > 0 ? side * distance * Vec2(unit.y, -unit.x) / glm::length(unit) : Vec2(0.0);
  EllipseArc arc;
  arc.u = radii.x * Vec2(c, s);
  arc.v = radii.y * Vec2(-s, c);
  arc.center = (from + to) / 2.0 + across.x * arc.u + across.y * arc.v;
  const Vec2 first = unit - across;
  const Vec2 last = -unit - across;
  arc.start = std::atan2(first.y, first.x);
  arc.sweep = std::atan2(cross(first, last), glm::dot(first, last));
  if (is_clockwise_on_paper && arc.sweep < 0) arc.sweep += kTurn;
  if (!is_clockwise_on_paper && arc.sweep > 0) arc.sweep -= kTurn;
  return arc;
}

double SvgChords::fragments(const Vec2& radii) const {
  if (!facets_) return 0;
  return csgcore::fragment_count(std::max(std::abs(radii.x), std::abs(radii.y)), *facets_);
}

int SvgChords::circle(const Vec2& radii) const {
  return static_cast<int>(std::max(40.0, fragments(radii)));
}

double SvgChords::circle_start() const { return facets_ ? kTurn / 4 : 0; }

int SvgChords::arc(double sweep, const Vec2& radii) const {
  constexpr double kPiece = 18 * kDegree;
  constexpr int kMore = 4;
  // Half a turn may be a little less by rounding.
  constexpr double kRounding = 1e-9;
  const double turns = std::abs(sweep) / kTurn;
  const double least = std::floor(turns * (kTurn / kPiece) + kRounding) + kMore;
  return static_cast<int>(std::max(least, std::ceil(fragments(radii) * turns - kRounding)));
}

int SvgChords::bezier() const {
  constexpr double kLeast = 20, kMost = 1 << 30;
  const double wanted = facets_ && std::isfinite(facets_->fn) ? facets_->fn : 0;
  return static_cast<int>(std::clamp(wanted, kLeast, kMost));
}

}  // namespace frontend
