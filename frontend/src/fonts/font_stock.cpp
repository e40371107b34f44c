#include "fonts/font_stock.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>

#include "frontend/error.hpp"
#include "frontend/files.hpp"

namespace frontend {
namespace {

constexpr std::string_view kDefaultFont = "Liberation Sans:style=Regular";

const FcChar8* fc_string(const std::string& text) {
  return reinterpret_cast<const FcChar8*>(text.c_str());
}

std::string trimmed_name(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n\v\f";
  const size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(kSpace) + 1 - first));
}

/// Names that fontconfig takes for any font of a kind.
constexpr std::array<std::string_view, 8> kGenericFamilies = {
    "sans", "sans-serif", "serif", "mono", "monospace", "cursive", "fantasy", "system-ui"};

bool same_name(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

bool is_generic(std::string_view family) {
  return std::ranges::any_of(kGenericFamilies,
                             [&](std::string_view name) { return same_name(name, family); });
}

/// Returns the folders whose fonts count besides those of fontconfig's settings.
std::vector<std::string> font_folders() {
  std::vector<std::string> folders;
  if (const char* home = std::getenv("HOME")) {
    folders.push_back((std::filesystem::path(home) / ".fonts").string());
  }
  if (const char* set = std::getenv("OPENSCAD_FONT_PATH")) {
    for (std::string_view rest = set; !rest.empty();) {
      const std::string_view folder = rest.substr(0, rest.find(':'));
      if (!folder.empty()) folders.emplace_back(folder);
      rest.remove_prefix(std::min(folder.size() + 1, rest.size()));
    }
  }
  return folders;
}

/// A fontconfig pattern, which is destroyed with this.
class Pattern {
 public:
  Pattern(const FontLibraries::Fontconfig& fontconfig, FcPattern* pattern)
      : fontconfig_(fontconfig), pattern_(pattern) {}
  Pattern(const Pattern&) = delete;
  Pattern& operator=(const Pattern&) = delete;
  ~Pattern() {
    if (pattern_ != nullptr) fontconfig_.pattern_destroy(pattern_);
  }

  FcPattern* get() const { return pattern_; }

  /// Returns the i-th value of a property; null if there is none.
  const char* string(const char* property, int i = 0) const {
    FcChar8* text = nullptr;
    const bool has = fontconfig_.pattern_get_string(pattern_, property, i, &text) == FcResultMatch;
    return has ? reinterpret_cast<const char*>(text) : nullptr;
  }
  int integer(const char* property) const {
    int value = 0;
    fontconfig_.pattern_get_integer(pattern_, property, 0, &value);
    return value;
  }
  std::vector<std::string> families() const {
    std::vector<std::string> names;
    for (int i = 0; const char* name = string(FC_FAMILY, i); ++i) names.emplace_back(name);
    return names;
  }

 private:
  const FontLibraries::Fontconfig& fontconfig_;
  FcPattern* pattern_;
};

/// Returns whether families were asked for, and the font is of none of them.
bool are_missing(const std::vector<std::string>& asked, const std::vector<std::string>& found) {
  return !asked.empty() && std::ranges::none_of(asked, [&](const std::string& family) {
    return is_generic(family) || std::ranges::any_of(found, [&](const std::string& name) {
             return same_name(name, family);
           });
  });
}

}  // namespace

FontStock* FontStock::instance() {
  const FontLibraries* const libraries = font_libraries();
  if (libraries == nullptr) return nullptr;
  static FontStock stock(*libraries);
  return &stock;
}

FontStock::FontStock(const FontLibraries& libraries) : libraries_(libraries) {
  if (libraries.freetype.init(&freetype_) != 0) freetype_ = nullptr;
}

FontStock::~FontStock() {
  found_.clear();
  faces_.clear();
  if (config_ != nullptr) libraries_.fontconfig.config_destroy(config_);
  if (freetype_ != nullptr) libraries_.freetype.done(freetype_);
}

void FontStock::use_files(const std::vector<std::string>& files) {
  Sources sources{font_folders(), files, {}};
  for (const std::string& file : files) sources.signatures.emplace_back(file);
  const bool is_current = config_ != nullptr && sources == sources_ &&
                          libraries_.fontconfig.config_up_to_date(config_) == FcTrue;
  if (is_current) return;
  sources_ = std::move(sources);
  found_.clear();
  std::erase_if(faces_, [](const auto& entry) {
    return !(entry.second.signature == language::FileSignature(entry.first.first));
  });
  load_list();
}

void FontStock::load_list() {
  const FontLibraries::Fontconfig& fc = libraries_.fontconfig;
  if (config_ != nullptr) fc.config_destroy(config_);
  config_ = fc.load_fonts();
  if (config_ == nullptr) return;
  for (const std::string& folder : sources_.folders) {
    fc.config_app_font_add_dir(config_, fc_string(folder));
  }
  for (size_t i = 0; i < sources_.files.size(); ++i) {
    // Fontconfig would wait for a named pipe's writer.
    if (!sources_.signatures[i].is_regular()) continue;
    fc.config_app_font_add_file(config_, fc_string(sources_.files[i]));
  }
}

const FoundFont& FontStock::find(std::string_view pattern) {
  auto found = found_.find(pattern);
  if (found == found_.end()) {
    found = found_.emplace(std::string(pattern), match(trimmed_name(pattern))).first;
  }
  return found->second;
}

TextLetters FontStock::within_limits(TextLetters letters) {
  constexpr size_t kMost = 1000;  // far more than there are in any design
  const std::string key = letters.script + '\n' + letters.language;
  if (scripts_and_languages_.size() < kMost) scripts_and_languages_.insert(key);
  if (!scripts_and_languages_.contains(key)) letters.script = letters.language = "";
  return letters;
}

std::vector<hb_feature_t> FontStock::features_of(const char* text) const {
  std::vector<hb_feature_t> features;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view word = rest.substr(0, rest.find_first_of(",;"));
    rest.remove_prefix(std::min(word.size() + 1, rest.size()));
    hb_feature_t feature;
    if (libraries_.harfbuzz.feature_from_string(word.data(), static_cast<int>(word.size()),
                                                &feature) != 0) {
      features.push_back(feature);
    }
  }
  return features;
}

FoundFont FontStock::match(const std::string& pattern) {
  const FontLibraries::Fontconfig& fc = libraries_.fontconfig;
  FoundFont result;
  if (config_ == nullptr) return result;
  const std::string wanted = pattern.empty() ? std::string(kDefaultFont) : pattern;
  const Pattern asked(fc, fc.name_parse(fc_string(wanted)));
  if (asked.get() == nullptr) return result;
  const std::vector<std::string> families =
      pattern.empty() ? std::vector<std::string>{} : asked.families();
  for (int i = 0; const char* text = asked.string(FC_FONT_FEATURES, i); ++i) {
    const std::vector<hb_feature_t> more = features_of(text);
    result.features.insert(result.features.end(), more.begin(), more.end());
  }
  fc.pattern_add_bool(asked.get(), FC_OUTLINE, FcTrue);
  fc.pattern_add_bool(asked.get(), FC_SCALABLE, FcTrue);
  fc.config_substitute(config_, asked.get(), FcMatchPattern);
  fc.default_substitute(asked.get());
  FcResult outcome = FcResultNoMatch;
  const Pattern best(fc, fc.font_match(config_, asked.get(), &outcome));
  if (best.get() == nullptr) return result;
  const char* const path = best.string(FC_FILE);
  if (path == nullptr) return result;
  if (const char* name = best.string(FC_FAMILY)) result.family = name;
  if (are_missing(families, best.families())) result.missing_family = families.front();
  result.face = open(path, best.integer(FC_INDEX));
  return result;
}

std::shared_ptr<FontFace> FontStock::open(const std::string& path, int index) {
  if (freetype_ == nullptr) return nullptr;
  const auto [entry, is_new] = faces_.try_emplace({path, index});
  if (!is_new) return entry->second.face;
  entry->second.signature = language::FileSignature(path);
  try {
    entry->second.face = FontFace::open(libraries_, freetype_, read_regular_file(path), index);
  } catch (const Error&) {  // the file vanished: there is no face
  }
  return entry->second.face;
}

}  // namespace frontend
