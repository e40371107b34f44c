// Tells which files are evaluated, and has frontend/language evaluate a .scad.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/camera.hpp"
#include "frontend/design_file_options.hpp"
#include "frontend/source_place.hpp"
#include "language/evaluation.hpp"

namespace frontend {

/// What a design's file is, by its name.
enum class DesignKind : uint8_t {
  kCsg,
  kScad,      // which has to be evaluated
  kImported,  // a mesh or a drawing, which is shown as import() shows it
  kEither,    // its text tells whether it is a .csg or a .scad: standard input, and the temporary
              // files without a suffix that editors' plugins pass
};

DesignKind kind_of(const std::string& path);

/// Returns the .scad that shows a mesh or a drawing of that name.
std::string import_of(const std::string& name);
/// Finds the places of lines. There may be many lines, and looking for the path of their file takes
/// longer than all else.
class PlacesOfLines {
 public:
  SourcePlace of(const language::SaidLine& line);

 private:
  std::unordered_map<language::FileId, std::string> paths_;
};

/// Returns OpenSCAD's command-line arguments as options of the own evaluator; nothing if one of
/// them is for openscad alone: -m, unless the file is a mesh or a drawing, which misses no files.
std::optional<language::EvaluationOptions> evaluation_options(
    const std::vector<std::string>& openscad_arguments, const std::string& path);

/// Evaluates a design, in the file or, where there is one, in `text`; its messages go to
/// `options.message`. Returns null if the arguments are none of the own evaluator's. Throws Error
/// where openscad would report an error, and Stopped (stop.hpp) once `stop` is requested.
std::shared_ptr<const language::Evaluation> evaluate_design(const std::string& path,
                                                            const std::optional<FileText>& text,
                                                            const DesignFileOptions& options,
                                                            const std::stop_token& stop);

/// Returns what is to be said of a design whose evaluation has ended so: where it is whole in the
/// language of 2021.01, and not in that of 2026, that. Empty: nothing. Throws language::Stopped.
std::string advice_of_language(const std::string& path, language::EvaluationOptions options,
                               language::Outcome outcome,
                               const std::optional<std::string_view>& text);

/// Returns the view of a text, if there is one.
std::optional<std::string_view> view_of(const std::optional<FileText>& text);

/// Returns the files that a design was read from, itself last, under the name that it was given.
std::vector<std::string> files_of(const language::Evaluation& evaluation, const std::string& path);

/// Returns those of the files that are fonts, by their suffixes, as OpenSCAD tells them.
std::vector<std::string> fonts_of(const std::vector<std::string>& files);

/// Returns the camera that the design sets.
DesignCamera camera_of(const language::Evaluation& evaluation);

}  // namespace frontend
