// The fonts of this computer and of designs, found by fontconfig and opened once.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fonts/font_face.hpp"
#include "fonts/font_libraries.hpp"
#include "language/file_signature.hpp"

namespace frontend {

/// The font that was found for a name.
struct FoundFont {
  std::shared_ptr<FontFace> face;  // null: there is none, or it cannot be opened
  std::string family;
  std::string missing_family;            // the family that was asked for, if the font is of another
  std::vector<hb_feature_t> features{};  // OpenType's, which the name asks for
};

/// All but lock() and instance() are to be called while the lock is held.
class FontStock {
 public:
  FontStock(const FontStock&) = delete;
  FontStock& operator=(const FontStock&) = delete;

  /// The only one of the process, whose fonts stay open for the next import; null if the libraries
  /// are not installed.
  static FontStock* instance();

  std::unique_lock<std::mutex> lock() { return std::unique_lock(mutex_); }
  const FontLibraries& libraries() const { return libraries_; }

  /// Looks fonts up among these files, too, in place of those of the last call. Notices fonts that
  /// have been installed or changed since then.
  void use_files(const std::vector<std::string>& files);
  /// Returns the files of the last call.
  const std::vector<std::string>& files() const { return sources_.files; }

  /// Returns fontconfig's best match for a pattern ("Family:style=Bold") among the fonts that have
  /// outlines; for an empty one, that for OpenSCAD's default. It lives until use_files().
  const FoundFont& find(std::string_view pattern);

  /// Returns the letters without their script and language if too many others were met before:
  /// HarfBuzz keeps what it prepares for each in lists, which it searches, and never frees it.
  TextLetters within_limits(TextLetters letters);

 private:
  /// What the list of fonts was made from.
  struct Sources {
    std::vector<std::string> folders;
    std::vector<std::string> files;
    std::vector<language::FileSignature> signatures;  // of the files
    bool operator==(const Sources& other) const = default;
  };
  struct OpenFace {
    language::FileSignature signature;
    std::shared_ptr<FontFace> face;
  };

  explicit FontStock(const FontLibraries& libraries);
  ~FontStock();

  void load_list();
  FoundFont match(const std::string& pattern);
  std::vector<hb_feature_t> features_of(const char* text) const;
  std::shared_ptr<FontFace> open(const std::string& path, int index);

  const FontLibraries& libraries_;
  std::mutex mutex_;
  FT_Library freetype_ = nullptr;
  FcConfig* config_ = nullptr;
  Sources sources_;
  std::set<std::string> scripts_and_languages_;
  std::map<std::string, FoundFont, std::less<>> found_;    // by pattern
  std::map<std::pair<std::string, int>, OpenFace> faces_;  // by file and the index in it
};

}  // namespace frontend
