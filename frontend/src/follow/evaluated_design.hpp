// Has frontend/language evaluate a .scad.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "frontend/camera.hpp"
#include "language/evaluation.hpp"

namespace frontend {

/// Returns OpenSCAD's command-line arguments as options of the own evaluator; nothing if one of
/// them is for openscad alone (-m).
std::optional<language::EvaluationOptions> evaluation_options(
    const std::vector<std::string>& openscad_arguments);

/// Evaluates a design; its messages go to `message`. Returns null, and says so there, if openscad
/// has to do it. `cache` holds what is kept for the design's next evaluation. Throws Error where
/// openscad would report an error, and Stopped (stop.hpp) once `stop` is requested.
std::shared_ptr<const language::Evaluation> evaluate_design(
    const std::string& path, const std::vector<std::string>& openscad_arguments, bool is_preview,
    const std::function<void(const std::string& line)>& message, const std::stop_token& stop,
    language::EvaluationCache* cache = nullptr);

/// Returns the files that a design was read from, itself last, under the name that it was given.
std::vector<std::string> files_of(const language::Evaluation& evaluation, const std::string& path);

/// Returns the fonts among them.
std::vector<std::string> fonts_of(const language::Evaluation& evaluation);

/// Returns the camera that the design sets.
DesignCamera camera_of(const language::Evaluation& evaluation);

}  // namespace frontend
