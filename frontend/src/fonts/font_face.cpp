#include "fonts/font_face.hpp"

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
struct GlyphCubic {
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
    const GlyphCubic cubic{at_, control1, control2, to};
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
  void quadratics_to(const GlyphCubic& cubic) {
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

/// At 100 dots per inch, so that the em has 138,889 units (text_layout.hpp).
constexpr FT_UInt kResolution_dpi = 100;
/// FreeType has 64 units in a pixel.
constexpr double kUnitsOfPixel = 64;

struct BufferDeleter {
  decltype(&hb_buffer_destroy) destroy;
  void operator()(hb_buffer_t* buffer) const { destroy(buffer); }
};

/// A longer text is shaped in parts: the time that HarfBuzz takes for accents upon one letter grows
/// with the square of their number.
constexpr size_t kMostLettersOfPart = 2048;

/// Returns where the parts of a text end, at spaces where there are any.
std::vector<size_t> part_ends(const std::vector<uint32_t>& letters) {
  std::vector<size_t> ends;
  size_t begin = 0;
  while (letters.size() - begin > kMostLettersOfPart) {
    size_t end = begin + kMostLettersOfPart;
    while (end > begin && letters[end - 1] != ' ') --end;
    if (end == begin) end = begin + kMostLettersOfPart;
    ends.push_back(end);
    begin = end;
  }
  if (begin < letters.size()) ends.push_back(letters.size());
  return ends;
}

Rectangle rounded_outwards(const FT_BBox& box) {
  const auto down = [](FT_Pos x) {
    return kUnitsOfPixel * std::floor(static_cast<double>(x) / kUnitsOfPixel);
  };
  const auto up = [](FT_Pos x) {
    return kUnitsOfPixel * std::ceil(static_cast<double>(x) / kUnitsOfPixel);
  };
  return {{down(box.xMin), down(box.yMin)}, {up(box.xMax), up(box.yMax)}};
}

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

std::shared_ptr<FontFace> FontFace::open(const FontLibraries& libraries, FT_Library freetype,
                                         FileText file, int index) {
  std::shared_ptr<FontFace> result(new FontFace(libraries, std::move(file)));
  const std::string_view bytes = result->file_.view();
  const FontLibraries::FreeType& ft = libraries.freetype;
  if (ft.new_memory_face(freetype, reinterpret_cast<const FT_Byte*>(bytes.data()),
                         static_cast<FT_Long>(bytes.size()), index, &result->face_) != 0) {
    return nullptr;
  }
  if (!FT_IS_SCALABLE(result->face_) ||
      ft.set_char_size(result->face_, 0, static_cast<FT_F26Dot6>(kOutlineUnits), kResolution_dpi,
                       kResolution_dpi) != 0) {
    return nullptr;
  }
  // Without a table of Unicode FreeType chooses none. HarfBuzz knows where symbols have their
  // letters.
  if (result->face_->charmap == nullptr) {
    ft.select_charmap(result->face_, FT_ENCODING_MS_SYMBOL);
  }
  result->font_ = libraries.harfbuzz.ft_font_create(result->face_, nullptr);
  return result;
}

FontFace::~FontFace() {
  if (font_ != nullptr) libraries_.harfbuzz.font_destroy(font_);
  if (face_ != nullptr) libraries_.freetype.done_face(face_);
}

std::vector<ShapedGlyph> FontFace::shape(const TextRun& run) const {
  const std::vector<size_t> ends = part_ends(run.letters);
  const size_t count = ends.size();
  std::vector<ShapedGlyph> glyphs;
  glyphs.reserve(run.letters.size());
  for (size_t i = 0; i < count; ++i) {
    // What runs backwards has its last part first.
    const size_t part = HB_DIRECTION_IS_BACKWARD(run.direction) ? count - 1 - i : i;
    shape_part(run, part == 0 ? 0 : ends[part - 1], ends[part], glyphs);
  }
  return glyphs;
}

void FontFace::shape_part(const TextRun& run, size_t begin, size_t end,
                          std::vector<ShapedGlyph>& glyphs) const {
  const FontLibraries::HarfBuzz& hb = libraries_.harfbuzz;
  const std::unique_ptr<hb_buffer_t, BufferDeleter> buffer(hb.buffer_create(),
                                                           BufferDeleter{hb.buffer_destroy});
  hb.buffer_add_utf32(buffer.get(), run.letters.data(), static_cast<int>(run.letters.size()),
                      static_cast<unsigned>(begin), static_cast<int>(end - begin));
  hb.buffer_set_direction(buffer.get(), run.direction);
  hb.buffer_set_script(buffer.get(), run.script);
  hb.buffer_set_language(buffer.get(), run.language);
  hb.shape(font_, buffer.get(), run.features.data(), static_cast<unsigned>(run.features.size()));
  unsigned count = 0;
  const hb_glyph_info_t* infos = hb.buffer_get_glyph_infos(buffer.get(), &count);
  const hb_glyph_position_t* positions = hb.buffer_get_glyph_positions(buffer.get(), &count);
  for (unsigned i = 0; i < count; ++i) {
    glyphs.push_back({infos[i].codepoint, Vec2(positions[i].x_offset, positions[i].y_offset),
                      Vec2(positions[i].x_advance, positions[i].y_advance)});
  }
}

const Rectangle& FontFace::pixel_box(uint32_t glyph) {
  const auto [entry, is_new] = boxes_.try_emplace(glyph);
  if (!is_new) return entry->second;
  if (FT_Outline* outline = load(glyph); outline != nullptr && outline->n_points > 0) {
    FT_BBox box;
    libraries_.freetype.outline_get_cbox(outline, &box);
    entry->second = rounded_outwards(box);
  }
  return entry->second;
}

FontFace::Extent FontFace::extent() const {
  // As FreeType scales: to whole units.
  constexpr double kFixedOne = 65536;
  const auto scaled = [&](FT_Pos length) {
    return std::round(static_cast<double>(length) *
                      static_cast<double>(face_->size->metrics.y_scale) / kFixedOne);
  };
  const auto text = [](const FT_String* name) { return std::string(name == nullptr ? "" : name); };
  return {scaled(face_->ascender),  scaled(face_->descender), scaled(face_->bbox.yMax),
          scaled(face_->bbox.yMin), scaled(face_->height),    text(face_->family_name),
          text(face_->style_name)};
}

const GlyphShape& FontFace::shape_of_glyph(uint32_t glyph, int pieces) {
  const auto [entry, is_new] = shapes_.try_emplace({glyph, pieces});
  if (!is_new) return entry->second;
  if (FT_Outline* outline = load(glyph)) entry->second = shape_of(libraries_, *outline, pieces);
  return entry->second;
}

FT_Outline* FontFace::load(uint32_t glyph) {
  if (libraries_.freetype.load_glyph(face_, glyph, FT_LOAD_DEFAULT | FT_LOAD_NO_BITMAP) != 0) {
    return nullptr;
  }
  return face_->glyph->format == FT_GLYPH_FORMAT_OUTLINE ? &face_->glyph->outline : nullptr;
}

}  // namespace frontend
