// FreeType, HarfBuzz and fontconfig, loaded when a design first has text.
//
// They are opened by name, so that a run without text does not load them, and a computer that lacks
// them draws everything else.
#pragma once

#include <fontconfig/fontconfig.h>
#include <ft2build.h>
#include <hb-ft.h>
#include <hb.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

namespace frontend {

/// The functions that are used, each under its library's name without the prefix.
struct FontLibraries {
  struct FreeType {
    decltype(&FT_Init_FreeType) init;
    decltype(&FT_Done_FreeType) done;
    decltype(&FT_New_Memory_Face) new_memory_face;
    decltype(&FT_Done_Face) done_face;
    decltype(&FT_Select_Charmap) select_charmap;
    decltype(&FT_Set_Char_Size) set_char_size;
    decltype(&FT_Load_Glyph) load_glyph;
    decltype(&FT_Outline_Decompose) outline_decompose;
    decltype(&FT_Outline_Get_CBox) outline_get_cbox;
  } freetype;
  struct HarfBuzz {
    decltype(&hb_ft_font_create) ft_font_create;
    decltype(&hb_font_destroy) font_destroy;
    decltype(&hb_buffer_create) buffer_create;
    decltype(&hb_buffer_destroy) buffer_destroy;
    decltype(&hb_buffer_add_utf32) buffer_add_utf32;
    decltype(&hb_buffer_set_direction) buffer_set_direction;
    decltype(&hb_buffer_set_script) buffer_set_script;
    decltype(&hb_buffer_set_language) buffer_set_language;
    decltype(&hb_buffer_get_glyph_infos) buffer_get_glyph_infos;
    decltype(&hb_buffer_get_glyph_positions) buffer_get_glyph_positions;
    decltype(&hb_shape) shape;
    decltype(&hb_unicode_funcs_get_default) unicode_funcs_get_default;
    decltype(&hb_unicode_script) unicode_script;
    decltype(&hb_script_from_string) script_from_string;
    decltype(&hb_script_get_horizontal_direction) script_get_horizontal_direction;
    decltype(&hb_direction_from_string) direction_from_string;
    decltype(&hb_language_from_string) language_from_string;
    decltype(&hb_feature_from_string) feature_from_string;
  } harfbuzz;
  struct Fontconfig {
    decltype(&FcInitLoadConfigAndFonts) init_load_config_and_fonts;
    decltype(&FcConfigCreate) config_create;
    decltype(&FcConfigGetFilename) config_get_filename;
    decltype(&FcConfigParseAndLoad) config_parse_and_load;
    decltype(&FcConfigGetCacheDirs) config_get_cache_dirs;
    decltype(&FcConfigBuildFonts) config_build_fonts;
    decltype(&FcStrListNext) str_list_next;
    decltype(&FcStrListDone) str_list_done;
    decltype(&FcStrFree) str_free;
    decltype(&FcConfigDestroy) config_destroy;
    decltype(&FcConfigUptoDate) config_up_to_date;
    decltype(&FcConfigAppFontAddFile) config_app_font_add_file;
    decltype(&FcConfigAppFontAddDir) config_app_font_add_dir;
    decltype(&FcConfigSubstitute) config_substitute;
    decltype(&FcDefaultSubstitute) default_substitute;
    decltype(&FcFontMatch) font_match;
    decltype(&FcNameParse) name_parse;
    decltype(&FcPatternAddBool) pattern_add_bool;
    decltype(&FcPatternGetString) pattern_get_string;
    decltype(&FcPatternGetInteger) pattern_get_integer;
    decltype(&FcPatternDestroy) pattern_destroy;
    decltype(&FcPatternAddCharSet) pattern_add_charset;
    decltype(&FcPatternGetCharSet) pattern_get_charset;
    decltype(&FcCharSetCreate) charset_create;
    decltype(&FcCharSetAddChar) charset_add_char;
    decltype(&FcCharSetHasChar) charset_has_char;
    decltype(&FcCharSetDestroy) charset_destroy;

    /// Returns the user's settings with the fonts that they name, which the caller destroys; null
    /// if there are none.
    FcConfig* load_fonts() const;
  } fontconfig;
};

/// Returns the libraries, which stay loaded; null if one of them is not installed.
const FontLibraries* font_libraries();

}  // namespace frontend
