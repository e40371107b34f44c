#include "language/dxf.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/number_text.hpp"

namespace language {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kRadians = std::numbers::pi / 180;
/// More chords cannot be told from a circle.
constexpr int kMostChords = 3600;

std::string_view without_blanks(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  const size_t begin = line.find_first_not_of(kBlanks);
  if (begin == line.npos) return {};
  return line.substr(begin, line.find_last_not_of(kBlanks) + 1 - begin);
}

/// Takes the next line, without blanks around it. `is_at_end` becomes true where no line feed ends
/// it.
std::string_view take_line(std::string_view& text, bool& is_at_end) {
  const size_t end = text.find('\n');
  is_at_end = end == text.npos;
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(is_at_end ? text.size() : end + 1);
  return without_blanks(line);
}

std::optional<int> whole_number(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// Returns a decimal number, inf or nan; nothing for one that no double can hold.
std::optional<double> number_of(std::string_view word) {
  const bool is_negative = word.starts_with('-');
  if (is_negative || word.starts_with('+')) word.remove_prefix(1);
  if (word.starts_with('-')) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::invalid_argument || end != word.data() + word.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    const std::optional<double> found = decimal_number(word);
    if (!found) return std::nullopt;
    value = *found;
  }
  return is_negative ? -value : value;
}

/// The affine map by which a block is inserted: its columns, and where its origin goes.
struct Insertion {
  DxfPoint x_axis, y_axis, translation;

  DxfPoint vector(DxfPoint v) const {
    return {x_axis.x * v.x + y_axis.x * v.y, x_axis.y * v.x + y_axis.y * v.y};
  }
  DxfPoint point(DxfPoint p) const {
    const DxfPoint turned = vector(p);
    return {turned.x + translation.x, turned.y + translation.y};
  }
  DxfStroke stroke(const DxfStroke& old) const {
    const DxfArc& arc = old.arc;
    return {point(old.start),
            point(old.end),
            old.is_arc,
            {point(arc.center), vector(arc.u), vector(arc.v), arc.start, arc.sweep},
            old.chords};
  }
};

/// The values of the entity that is being read.
struct Entity {
  std::string name;                  // what stood at code 0
  std::string layer;                 // 8
  std::string label;                 // 1
  std::string title;                 // 2
  std::vector<double> x, y;          // 10 and 11, 20 and 21
  std::array<DxfPoint, 7> points{};  // 10 to 16, 20 to 26: the last of each code
  double radius = 0;                 // 40, an ellipse's ratio, too
  double start = 0;                  // 50, degrees; of a block the rotation
  double end = 0;                    // 51
  /// 41 and 42: an ellipse's first and last parameter, or a block's factors.
  std::optional<double> first, second;
  int flags = 0;  // 70

  bool has_points(size_t count) const { return x.size() >= count && y.size() >= count; }
  DxfPoint point(size_t i) const { return {x[i], y[i]}; }
};

/// Turns that go on beyond two whole ones cancel by the even-odd rule.
double sweep_of(double start, double end, double turn) {
  double sweep = end - start;
  if (!std::isfinite(sweep)) return 0;
  if (sweep < 0) sweep += turn * std::ceil(-sweep / turn);
  return sweep > 2 * turn ? std::fmod(sweep, 2 * turn) : sweep;
}

class Reader {
 public:
  explicit Reader(const DxfSettings& settings) : settings_(settings) {}

  DxfContents read(std::string_view text) {
    for (bool is_at_end = false; !is_at_end;) {
      const std::string_view code_word = take_line(text, is_at_end);
      const std::string_view value = take_line(text, is_at_end);
      const std::optional<int> code = whole_number(code_word);
      if (!code) {
        if (!is_at_end) tell(DxfProblem::Kind::kIllegalCode, code_word);
        break;
      }
      *code == 0 ? begin_entity(value) : take_value(*code, value);
    }
    for (const auto& [name, count] : unsupported_)
      settings_.tell({DxfProblem::Kind::kUnsupported, name, count});
    return std::move(contents_);
  }

 private:
  using Kind = DxfProblem::Kind;
  /// Before its first section a file may be anything: a message shows none of its words, which are
  /// no business of the design's author.
  void tell(Kind kind, std::string_view word) {
    settings_.tell({kind, has_section_ ? word : std::string_view()});
  }

  /// The entity before the new one is complete. If it lacks points, OpenSCAD gives it those of the
  /// new one, whose name it does not see.
  void begin_entity(std::string_view name) {
    if (!finish_entity()) return tell(Kind::kMissingPoints, name);
    entity_ = Entity();
    entity_.name = name;
    has_section_ = has_section_ || name == "SECTION";
  }

  void take_value(int code, std::string_view value) {
    if (code >= 10 && code <= 16) return take_coordinate(value, code - 10, true);
    if (code >= 20 && code <= 26) return take_coordinate(value, code - 20, false);
    switch (code) {
      case 1:
        entity_.label = value;
        break;
      case 2:
        entity_.title = value;
        break;
      case 8:
        entity_.layer = value;
        break;
      case 40:  // OpenSCAD scales an ellipse's ratio, too
        take_number(value, [&](double number) { entity_.radius = placed(number, 0); });
        break;
      case 41:
        take_number(value, [&](double number) { entity_.first = number; });
        break;
      case 42:
        take_number(value, [&](double number) { entity_.second = number; });
        break;
      case 50:
        take_number(value, [&](double number) { entity_.start = number; });
        break;
      case 51:
        take_number(value, [&](double number) { entity_.end = number; });
        break;
      case 70:
        if (const std::optional<int> flags = whole_number(value))
          entity_.flags = *flags;
        else
          tell(Kind::kIllegalValue, value);
        break;
      default:
        break;
    }
  }

  void take_coordinate(std::string_view word, int point, bool is_x) {
    take_number(word, [&](double number) {
      const double value = placed(number, is_x ? settings_.origin.x : settings_.origin.y);
      DxfPoint& last = entity_.points[static_cast<size_t>(point)];
      (is_x ? last.x : last.y) = value;
      if (point < 2) (is_x ? entity_.x : entity_.y).push_back(value);
    });
  }

  template <typename Take>
  void take_number(std::string_view word, const Take& take) {
    const std::optional<double> number = number_of(word);
    if (number) return take(*number);
    tell(Kind::kIllegalValue, word);
  }

  /// Blocks are placed and scaled where they are inserted.
  double placed(double number, double origin) const {
    return section_ == Section::kBlocks ? number : (number - origin) * settings_.scale;
  }

  bool is_in_layer() const { return settings_.layer.empty() || settings_.layer == entity_.layer; }
  bool is_wanted() const {
    return section_ == Section::kBlocks || (section_ == Section::kEntities && is_in_layer());
  }

  /// False: it lacks points, wanted or not.
  bool finish_entity() {
    const std::string& name = entity_.name;
    if (finish_structure(name)) return true;
    if (name == "LINE") return add_line();
    if (name == "LWPOLYLINE") return add_polyline();
    if (name == "CIRCLE") return add_circle();
    if (name == "ARC") return add_arc();
    if (name == "ELLIPSE") return add_ellipse();
    if (name == "INSERT") return insert_block();
    if (is_wanted()) ++unsupported_[name];
    return true;
  }

  /// False: it is no dimension of the layer, and nothing that is above layers.
  bool finish_structure(const std::string& name) {
    if (name == "SECTION") {
      section_ = entity_.title == "ENTITIES" ? Section::kEntities
                 : entity_.title == "BLOCKS" ? Section::kBlocks
                                             : Section::kOther;
    } else if (name == "BLOCK") {
      block_ = entity_.title;
    } else if (name == "ENDBLK") {
      block_.clear();
    } else if (name == "DIMENSION" && is_in_layer()) {
      contents_.dimensions.push_back(
          {entity_.label, entity_.layer, entity_.flags, entity_.start, entity_.points});
    } else {
      return name == "ENDSEC";
    }
    return true;
  }

  bool add_line() {
    if (!entity_.has_points(2)) return false;
    add({entity_.point(0), entity_.point(1)});
    return true;
  }

  bool add_polyline() {
    const size_t count = std::max(entity_.x.size(), entity_.y.size());
    for (size_t i = 1; i < count; ++i) {
      if (!entity_.has_points(i + 1)) return false;
      add({entity_.point(i - 1), entity_.point(i)});
    }
    if ((entity_.flags & 1) == 0) return true;
    if (count == 0 || !entity_.has_points(count)) return false;
    add({entity_.point(count - 1), entity_.point(0)});
    return true;
  }

  bool add_circle() {
    if (!entity_.has_points(1)) return false;
    add_curve(circle_arc(0, kTurn), fragments(entity_.radius));
    return true;
  }

  bool add_arc() {
    if (!entity_.has_points(1)) return false;
    const double sweep = sweep_of(entity_.start, entity_.end, 360);
    const double chords = std::ceil(fragments(entity_.radius) * sweep / 360);
    add_curve(circle_arc(entity_.start * kRadians, sweep * kRadians), static_cast<int>(chords));
    return true;
  }

  bool add_ellipse() {
    if (!entity_.has_points(2)) return false;
    const DxfPoint u = entity_.point(1);
    const double ratio = entity_.radius;
    const double start = entity_.first.value_or(0);
    const double sweep = sweep_of(start, entity_.second.value_or(0), kTurn);
    const double chords = std::ceil(fragments(std::hypot(u.x, u.y)) * sweep / kTurn);
    add_curve({entity_.point(0), u, {ratio * -u.y, ratio * u.x}, start, sweep},
              static_cast<int>(chords));
    return true;
  }

  DxfArc circle_arc(double start, double sweep) const {
    const double radius = entity_.radius;
    return {entity_.point(0), {radius, 0}, {0, radius}, start, sweep};
  }

  int fragments(double radius) const { return std::min(kMostChords, settings_.fragments(radius)); }

  void add_curve(const DxfArc& arc, int chords) {
    if (arc.sweep > 0)
      add({arc.point(arc.start), arc.point(arc.start + arc.sweep), true, arc, std::max(chords, 1)});
  }

  bool insert_block() {
    const auto found = blocks_.find(entity_.title);
    if (found == blocks_.end()) return true;
    if (!entity_.has_points(1)) return false;
    const double scale = section_ == Section::kBlocks ? 1 : settings_.scale;
    const double c = scale * std::cos(entity_.start * kRadians);
    const double s = scale * std::sin(entity_.start * kRadians);
    const double x = entity_.first.value_or(1), y = entity_.second.value_or(1);
    const Insertion insertion = {{c * x, s * x}, {-s * y, c * y}, entity_.point(0)};
    // The block may be inserted into itself.
    const std::vector<DxfStroke>& block = found->second;
    for (size_t i = 0, count = block.size(); i < count && strokes_ < kMostDxfStrokes; ++i) {
      add(insertion.stroke(block[i]));
    }
    if (strokes_ >= kMostDxfStrokes) tell(Kind::kTooManyStrokes, {});
    return true;
  }

  void add(const DxfStroke& stroke) {
    if (!is_wanted()) return;
    ++strokes_;
    (section_ == Section::kBlocks ? blocks_[block_] : contents_.strokes).push_back(stroke);
  }

  enum class Section : uint8_t { kOther, kEntities, kBlocks };

  const DxfSettings& settings_;
  DxfContents contents_;
  Section section_ = Section::kOther;
  bool has_section_ = false;
  Entity entity_;
  std::string block_;
  std::map<std::string, std::vector<DxfStroke>, std::less<>> blocks_;
  size_t strokes_ = 0;
  /// OpenSCAD tells of them in the order of such a container.
  std::unordered_map<std::string, uint64_t> unsupported_;
};

}  // namespace

DxfPoint DxfArc::point(double t) const {
  const double c = std::cos(t), s = std::sin(t);
  return {center.x + c * u.x + s * v.x, center.y + c * u.y + s * v.y};
}

DxfContents read_dxf(std::string_view text, const DxfSettings& settings) {
  return Reader(settings).read(text);
}

}  // namespace language
