#include "fonts/font_libraries.hpp"

#include <dlfcn.h>

#include <optional>

namespace frontend {
namespace {

/// Looks functions up in one library, and remembers whether all were found.
class Library {
 public:
  explicit Library(const char* name) : handle_(dlopen(name, RTLD_NOW | RTLD_LOCAL)) {}

  template <typename Function>
  void find(const char* name, Function& function) {
    function = handle_ == nullptr ? nullptr : reinterpret_cast<Function>(dlsym(handle_, name));
    is_complete_ = is_complete_ && function != nullptr;
  }
  bool is_complete() const { return is_complete_; }

 private:
  void* handle_;  // never closed: functions of it are in use to the end
  bool is_complete_ = true;
};

bool load(FontLibraries::FreeType& freetype) {
  Library library("libfreetype.so.6");
  library.find("FT_Init_FreeType", freetype.init);
  library.find("FT_Done_FreeType", freetype.done);
  library.find("FT_New_Memory_Face", freetype.new_memory_face);
  library.find("FT_Done_Face", freetype.done_face);
  library.find("FT_Select_Charmap", freetype.select_charmap);
  library.find("FT_Set_Char_Size", freetype.set_char_size);
  library.find("FT_Load_Glyph", freetype.load_glyph);
  library.find("FT_Outline_Decompose", freetype.outline_decompose);
  library.find("FT_Outline_Get_CBox", freetype.outline_get_cbox);
  return library.is_complete();
}

bool load(FontLibraries::HarfBuzz& harfbuzz) {
  Library library("libharfbuzz.so.0");
  library.find("hb_ft_font_create", harfbuzz.ft_font_create);
  library.find("hb_font_destroy", harfbuzz.font_destroy);
  library.find("hb_buffer_create", harfbuzz.buffer_create);
  library.find("hb_buffer_destroy", harfbuzz.buffer_destroy);
  library.find("hb_buffer_add_utf32", harfbuzz.buffer_add_utf32);
  library.find("hb_buffer_set_direction", harfbuzz.buffer_set_direction);
  library.find("hb_buffer_set_script", harfbuzz.buffer_set_script);
  library.find("hb_buffer_set_language", harfbuzz.buffer_set_language);
  library.find("hb_buffer_get_glyph_infos", harfbuzz.buffer_get_glyph_infos);
  library.find("hb_buffer_get_glyph_positions", harfbuzz.buffer_get_glyph_positions);
  library.find("hb_shape", harfbuzz.shape);
  library.find("hb_unicode_funcs_get_default", harfbuzz.unicode_funcs_get_default);
  library.find("hb_unicode_script", harfbuzz.unicode_script);
  library.find("hb_script_from_string", harfbuzz.script_from_string);
  library.find("hb_script_get_horizontal_direction", harfbuzz.script_get_horizontal_direction);
  library.find("hb_direction_from_string", harfbuzz.direction_from_string);
  library.find("hb_language_from_string", harfbuzz.language_from_string);
  library.find("hb_feature_from_string", harfbuzz.feature_from_string);
  return library.is_complete();
}

bool load(FontLibraries::Fontconfig& fontconfig) {
  Library library("libfontconfig.so.1");
  library.find("FcInitLoadConfigAndFonts", fontconfig.init_load_config_and_fonts);
  library.find("FcConfigCreate", fontconfig.config_create);
  library.find("FcConfigGetFilename", fontconfig.config_get_filename);
  library.find("FcConfigParseAndLoad", fontconfig.config_parse_and_load);
  library.find("FcConfigGetCacheDirs", fontconfig.config_get_cache_dirs);
  library.find("FcConfigBuildFonts", fontconfig.config_build_fonts);
  library.find("FcStrListNext", fontconfig.str_list_next);
  library.find("FcStrListDone", fontconfig.str_list_done);
  library.find("FcStrFree", fontconfig.str_free);
  library.find("FcConfigDestroy", fontconfig.config_destroy);
  library.find("FcConfigUptoDate", fontconfig.config_up_to_date);
  library.find("FcConfigAppFontAddFile", fontconfig.config_app_font_add_file);
  library.find("FcConfigAppFontAddDir", fontconfig.config_app_font_add_dir);
  library.find("FcConfigSubstitute", fontconfig.config_substitute);
  library.find("FcDefaultSubstitute", fontconfig.default_substitute);
  library.find("FcFontMatch", fontconfig.font_match);
  library.find("FcNameParse", fontconfig.name_parse);
  library.find("FcPatternAddBool", fontconfig.pattern_add_bool);
  library.find("FcPatternGetString", fontconfig.pattern_get_string);
  library.find("FcPatternGetInteger", fontconfig.pattern_get_integer);
  library.find("FcPatternDestroy", fontconfig.pattern_destroy);
  library.find("FcPatternAddCharSet", fontconfig.pattern_add_charset);
  library.find("FcPatternGetCharSet", fontconfig.pattern_get_charset);
  library.find("FcCharSetCreate", fontconfig.charset_create);
  library.find("FcCharSetAddChar", fontconfig.charset_add_char);
  library.find("FcCharSetHasChar", fontconfig.charset_has_char);
  library.find("FcCharSetDestroy", fontconfig.charset_destroy);
  return library.is_complete();
}

std::optional<FontLibraries> loaded() {
  FontLibraries libraries{};
  const bool is_complete =
      load(libraries.freetype) && load(libraries.harfbuzz) && load(libraries.fontconfig);
  return is_complete ? std::optional(libraries) : std::nullopt;
}

}  // namespace

FcConfig* FontLibraries::Fontconfig::load_fonts() const {
  // FcInitLoadConfigAndFonts() reads all settings that the system offers as well, used or not, for
  // their descriptions: 1.7 ms of 4.5. It stays where there are none, and where they name no cache.
  FcConfig* const config = config_create();
  FcChar8* const file = config != nullptr ? config_get_filename(config, nullptr) : nullptr;
  bool has_cache = false;
  if (file != nullptr && config_parse_and_load(config, file, FcFalse) == FcTrue) {
    FcStrList* const caches = config_get_cache_dirs(config);
    has_cache = caches != nullptr && str_list_next(caches) != nullptr;
    if (caches != nullptr) str_list_done(caches);
  }
  if (file != nullptr) str_free(file);
  if (has_cache && config_build_fonts(config) == FcTrue) return config;
  if (config != nullptr) config_destroy(config);
  return init_load_config_and_fonts();
}

const FontLibraries* font_libraries() {
  static const std::optional<FontLibraries> libraries = loaded();
  return libraries ? &*libraries : nullptr;
}

}  // namespace frontend
