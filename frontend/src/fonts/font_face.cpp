#include "fonts/font_face.hpp"

#include <algorithm>
#include <cmath>

namespace frontend {
namespace {

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
  hb.shape(font_, buffer.get(), nullptr, 0);
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
