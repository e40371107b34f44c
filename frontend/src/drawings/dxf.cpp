// DXF: pairs of lines, a group code and its value. Each entity begins with code 0.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "drawings/curve_path.hpp"
#include "drawings/disjoint_figures.hpp"
#include "drawings/drawing.hpp"
#include "drawings/dxf_chains.hpp"
#include "meshes/number_text.hpp"
#include "plane/outlines.hpp"

namespace frontend {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kRadians = std::numbers::pi / 180;
/// More chords cannot be told from a circle.
constexpr int kMostChords = 3600;
/// Blocks that insert blocks may make any number of lines: the file's length does not bound them.
constexpr size_t kMostParts = 1 << 21;

/// A line, or a curve whose ends are those of its arc.
struct DxfPart {
  Vec2 start{0.0};
  Vec2 end{0.0};
  bool is_arc = false;
  EllipseArc arc{};
  int chords = 1;  // OpenSCAD's
};

DxfPart mapped(const PlaneMap& map, const DxfPart& part) {
  return {map.point(part.start), map.point(part.end), part.is_arc, mapped(map, part.arc),
          part.chords};
}

/// The values of the entity that is being read.
struct DxfEntity {
  std::string name;   // what stood at code 0
  std::string layer;  // 8
  std::string title;  // 2
  std::vector<double> x, y;
  double radius = 0;  // 40, an ellipse's ratio, too
  double start = 0;   // 50, degrees; of a block the rotation
  double end = 0;     // 51
  /// 41 and 42: an ellipse's first and last parameter, or a block's factors.
  std::optional<double> first, second;
  int flags = 0;  // 70

  bool has_points(size_t count) const { return x.size() >= count && y.size() >= count; }
  Vec2 point(size_t i) const { return {x[i], y[i]}; }
};

class DxfReader {
 public:
  DxfReader(const std::string& name, const DxfSettings& settings)
      : name_(name), settings_(settings) {
    if (!(settings_.scale > 0)) settings_.scale = 1;
  }

  Drawing read(std::string_view text) {
    while (!trimmed(text).empty()) {
      const std::string_view code_word = trimmed(take_line(text));
      const std::string_view value = trimmed(take_line(text));
      const std::optional<int> code = whole_number(code_word);
      if (!code) {
        tell("Illegal ID '" + shortened(code_word) + "' in '" + name_ + "'",
             "what follows is not read; export the drawing again, as text");
        break;
      }
      *code == 0 ? begin_entity(value) : take_value(*code, value);
    }
    tell_unsupported();
    return finish();
  }

 private:
  static std::optional<int> whole_number(std::string_view word) {
    int value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
  }

  /// A message need not hold all of a long line.
  static std::string shortened(std::string_view word) {
    constexpr size_t kMost = 60;
    return std::string(word.substr(0, kMost)) + (word.size() > kMost ? "..." : "");
  }

  /// Tells the first problem of each kind.
  void tell(const std::string& what, const std::string& todo) {
    const std::string_view kind = std::string_view(what).substr(0, what.find(' '));
    for (const DrawingProblem& problem : drawing_.problems) {
      if (problem.what.starts_with(kind)) return;
    }
    drawing_.problems.push_back({what, todo});
  }

  /// The entity before the new one is complete. If it lacks points, OpenSCAD gives it those of the
  /// new one, whose name it does not see.
  void begin_entity(std::string_view name) {
    if (!finish_entity()) {
      tell("Not enough input values for " + shortened(name) + ". in '" + name_ + "'",
           "the entity before it is damaged: export the drawing again");
      return;
    }
    entity_ = DxfEntity();
    entity_.name = name;
  }

  void take_value(int code, std::string_view value) {
    if (code == 8) entity_.layer = value;
    if (code == 2) entity_.title = value;
    if (code >= 10 && code <= 16)
      return take_number(
          value, [&](double number) { entity_.x.push_back(placed(number, settings_.origin.x)); });
    if (code >= 20 && code <= 26)
      return take_number(
          value, [&](double number) { entity_.y.push_back(placed(number, settings_.origin.y)); });
    switch (code) {
      case 40:  // OpenSCAD scales an ellipse's ratio, too
        return take_number(value, [&](double number) { entity_.radius = placed(number, 0); });
      case 41:
        return take_number(value, [&](double number) { entity_.first = number; });
      case 42:
        return take_number(value, [&](double number) { entity_.second = number; });
      case 50:
        return take_number(value, [&](double number) { entity_.start = number; });
      case 51:
        return take_number(value, [&](double number) { entity_.end = number; });
      case 70:
        return take_number(value, [&](double number) {
          entity_.flags =
              std::abs(number) < std::numeric_limits<int>::max() ? static_cast<int>(number) : 0;
        });
      default:
        break;
    }
  }

  template <typename Take>
  void take_number(std::string_view word, const Take& take) {
    const std::optional<double> number = number_of(word);
    if (number) return take(*number);
    tell("Illegal value '" + shortened(word) + "' in '" + name_ + "'",
         "it is left out; write numbers with a decimal point");
  }

  /// Blocks are placed and scaled where they are inserted.
  double placed(double number, double origin) const {
    return section_ == Section::kBlocks ? number : (number - origin) * settings_.scale;
  }

  bool is_wanted() const {
    if (section_ == Section::kBlocks) return true;
    return section_ == Section::kEntities &&
           (settings_.layer.empty() || settings_.layer == entity_.layer);
  }

  /// False: it lacks points.
  bool finish_entity() {
    const std::string& name = entity_.name;
    if (name == "SECTION") {
      section_ = entity_.title == "ENTITIES" ? Section::kEntities
                 : entity_.title == "BLOCKS" ? Section::kBlocks
                                             : Section::kOther;
    } else if (name == "BLOCK") {
      block_ = entity_.title;
    } else if (name == "ENDBLK") {
      block_.clear();
    } else if (name == "ENDSEC" || name == "DIMENSION" || !is_wanted()) {
      return true;
    } else if (name == "LINE") {
      return add_line();
    } else if (name == "LWPOLYLINE") {
      return add_polyline();
    } else if (name == "CIRCLE") {
      return add_circle();
    } else if (name == "ARC") {
      return add_arc();
    } else if (name == "ELLIPSE") {
      return add_ellipse();
    } else if (name == "INSERT") {
      return insert_block();
    } else if (section_ == Section::kEntities && unsupported_.size() < kMostUnsupported) {
      ++unsupported_[shortened(name)];
    }
    return true;
  }

  bool add_line() {
    if (!entity_.has_points(2)) return false;
    add({entity_.point(0), entity_.point(1)});
    return true;
  }

  bool add_polyline() {
    const size_t count = entity_.x.size();
    for (size_t i = 1; i < std::min(count, entity_.y.size()); ++i) {
      add({entity_.point(i - 1), entity_.point(i)});
    }
    if (entity_.y.size() < count) return false;
    if ((entity_.flags & 1) != 0 && count > 1) add({entity_.point(count - 1), entity_.point(0)});
    return true;
  }

  bool add_circle() {
    if (!entity_.has_points(1)) return false;
    const int chords = fragments(entity_.radius);
    add_curve(circle_arc(0, kTurn), chords);
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
    const Vec2 u = entity_.point(1);
    const double ratio = entity_.radius;
    const double start = entity_.first.value_or(0);
    const double sweep = sweep_of(start, entity_.second.value_or(0), kTurn);
    const double chords = std::ceil(fragments(std::hypot(u.x, u.y)) * sweep / kTurn);
    add_curve({entity_.point(0), u, ratio * Vec2(-u.y, u.x), start, sweep},
              static_cast<int>(chords));
    return true;
  }

  EllipseArc circle_arc(double start, double sweep) const {
    const double radius = entity_.radius;
    return {entity_.point(0), Vec2(radius, 0), Vec2(0, radius), start, sweep};
  }

  /// Turns that go on beyond two whole ones cancel by the even-odd rule.
  static double sweep_of(double start, double end, double turn) {
    double sweep = end - start;
    if (!std::isfinite(sweep)) return 0;
    if (sweep < 0) sweep += turn * std::ceil(-sweep / turn);
    return sweep > 2 * turn ? std::fmod(sweep, 2 * turn) : sweep;
  }

  int fragments(double radius) const {
    return std::min(kMostChords, csgcore::fragment_count(radius, settings_.facets));
  }

  void add_curve(const EllipseArc& arc, int chords) {
    if (arc.sweep > 0) add({arc.first(), arc.last(), true, arc, std::max(chords, 1)});
  }

  bool insert_block() {
    if (!entity_.has_points(1)) return false;
    const auto found = blocks_.find(entity_.title);
    if (found == blocks_.end()) return true;
    const double scale = section_ == Section::kBlocks ? 1 : settings_.scale;
    const double c = scale * std::cos(entity_.start * kRadians);
    const double s = scale * std::sin(entity_.start * kRadians);
    PlaneMap map;
    map.linear = glm::dmat2(c, s, -s, c) *
                 glm::dmat2(entity_.first.value_or(1), 0, 0, entity_.second.value_or(1));
    map.translation = entity_.point(0);
    // The block may be inserted into itself.
    const std::vector<DxfPart>& block = found->second;
    for (size_t i = 0, count = block.size(); i < count && parts_ < kMostParts; ++i) {
      add(mapped(map, block[i]));
    }
    if (parts_ >= kMostParts) {
      tell("Blocks of '" + name_ + "' are left out: they would make more than " +
               std::to_string(kMostParts) + " lines",
           "explode fewer blocks within blocks");
    }
    return true;
  }

  void add(const DxfPart& part) {
    ++parts_;
    (section_ == Section::kBlocks ? blocks_[block_] : drawn_).push_back(part);
  }

  void tell_unsupported() {
    if (unsupported_.empty()) return;
    std::string list;
    for (const auto& [name, count] : unsupported_) {
      list += (list.empty() ? "'" : ", '") + name + "' (" + std::to_string(count) + ")";
    }
    const std::string place = settings_.layer.empty()
                                  ? "in '" + name_ + "'"
                                  : "in layer '" + settings_.layer + "' of '" + name_ + "'";
    tell("Unsupported DXF Entity " + list + " " + place,
         "it is left out; explode it to lines, arcs and polylines");
  }

  Drawing finish() {
    const auto is_near = [](const Vec2& p) {
      return std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest;
    };
    const bool is_in_range = std::all_of(drawn_.begin(), drawn_.end(), [&](const DxfPart& part) {
      return is_near(part.start) && is_near(part.end) && is_near(part.arc.center) &&
             is_near(part.arc.u) && is_near(part.arc.v);
    });
    if (!is_in_range) {
      tell("Range check failed for '" + name_ + "'",
           "it has coordinates that are too large, or not finite");
      return std::move(drawing_);
    }
    Outline outline = settings_.is_faceted ? chords() : curves();
    std::erase_if(outline.loops, is_line_and_back);
    if (outline.loops.empty()) return std::move(drawing_);
    drawing_.figures = disjoint_figures({std::move(outline)});
    leave_out_tangles(name_, drawing_);
    return std::move(drawing_);
  }

  static bool is_line_and_back(const csgcore::ProfileLoop& loop) {
    return loop.size() <= 2 && std::all_of(loop.begin(), loop.end(), [](const auto& edge) {
             return edge.kind == csgcore::ProfileEdge::Kind::kLine;
           });
  }

  Outline chords() {
    DxfChains chains;
    for (const DxfPart& part : drawn_) {
      Vec2 from = part.start;
      for (int i = 1; i < part.chords; ++i) {
        const Vec2 to = part.arc.point(part.arc.start + part.arc.sweep * i / part.chords);
        chains.add({from, to});
        from = to;
      }
      chains.add({from, part.end});
    }
    Polygons polygons;
    for (const CurvePath& path : chains.join()) polygons.push_back(path.openscad_points());
    return outline_of(std::move(polygons));
  }

  Outline curves() {
    DxfChains chains;
    std::vector<CurvePath> paths;
    for (const DxfPart& part : drawn_) {
      if (part.is_arc && part.arc.sweep >= kTurn * (1 - kRoundingOfTurn)) {
        paths.push_back(whole_turn(part.arc));
      } else if (part.is_arc) {
        add_arc(part, chains);
      } else {
        chains.add({part.start, part.end});
      }
    }
    for (CurvePath& path : chains.join()) paths.push_back(std::move(path));
    Outline outline;
    Rectangle box;
    size_t count = 1;
    for (const CurvePath& path : paths) {
      box.merge(path.bounds());
      count += path.curves();
    }
    const CurveFineness fineness = fineness_of(box, count);
    for (const CurvePath& path : paths) outline.loops.push_back(path.loop(fineness));
    return outline;
  }

  /// Files give 2π with as few as six digits.
  static constexpr double kRoundingOfTurn = 1e-5;

  /// In two halves: the ends of an arc may lie so near to each other that they are one point.
  static void add_arc(const DxfPart& part, DxfChains& chains) {
    EllipseArc half = part.arc;
    half.sweep /= 2;
    const Vec2 middle = half.last();
    chains.add({part.start, middle, half});
    half.start += half.sweep;
    chains.add({middle, part.end, half});
  }

  static CurvePath whole_turn(const EllipseArc& arc) {
    CurvePath path(arc.first());
    path.arc_to({arc.center, arc.u, arc.v, arc.start, kTurn}, 1, arc.first());
    return path;
  }

  enum class Section : uint8_t { kOther, kEntities, kBlocks };
  static constexpr size_t kMostUnsupported = 20;  // names in a message

  const std::string& name_;
  DxfSettings settings_;
  Drawing drawing_;
  Section section_ = Section::kOther;
  DxfEntity entity_;
  std::string block_;
  std::map<std::string, std::vector<DxfPart>, std::less<>> blocks_;
  std::vector<DxfPart> drawn_;
  size_t parts_ = 0;
  std::map<std::string, uint64_t> unsupported_;
};

}  // namespace

Drawing read_dxf(std::string_view bytes, const std::string& name, const DxfSettings& settings) {
  return DxfReader(name, settings).read(bytes);
}

}  // namespace frontend
