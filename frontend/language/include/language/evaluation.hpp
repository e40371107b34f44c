// OpenSCAD's language: from the text of a design to its tree of nodes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "language/evaluation_cache.hpp"
#include "language/language_version.hpp"
#include "language/message_group.hpp"
#include "language/node_tree.hpp"
#include "language/parameter_value.hpp"
#include "language/source_files.hpp"
#include "language/text_meter.hpp"
#include "language/text_overlay.hpp"

namespace language {

/// What the camera is chosen by, which decides what is said of a design's own.
enum class CameraChoice : uint8_t {
  kDesign,   // openscad -o without --camera: it is said that $vpt, $vpr, $vpd and $vpf count
  kWindow,   // openscad's window: that is not said
  kCommand,  // --camera: nor is that a value is no camera's
};

/// The camera that a design of 2026 finds in $vpt, $vpr and $vpd.
struct ViewCamera {
  std::array<double, 3> translation{0, 0, 0};
  std::array<double, 3> rotation_deg{55, 0, 25};
  double distance = 140;
};

/// How errors tell the calls around them, in 2026.
struct TraceOptions {
  uint32_t most_lines = 12;    // --trace-depth
  bool has_parameters = true;  // --trace-usermodule-parameters: of modules
};

struct EvaluationOptions {
  LanguageVersion language = LanguageVersion::k2021;
  std::vector<std::string> definitions;       // -D, in order, as typed
  std::string parameter_file, parameter_set;  // -p, -P; empty: none
  std::optional<ParameterSet> parameters;     // in place of that set
  bool hard_warnings = false;                 // --hardwarnings
  bool check_parameters = true;               // --check-parameters
  bool check_ranges = false;                  // --check-parameter-ranges
  bool lazy_union = false;                    // --enable=lazy-union, of 2026
  bool is_preview = true;                     // $preview
  double time = 0;                            // $t
  CameraChoice camera = CameraChoice::kDesign;
  ViewCamera view;
  TraceOptions traces;
  std::stop_token stop;
  EvaluationCache* cache = nullptr;       // null: nothing is kept
  std::shared_ptr<TextMeter> text_meter;  // null: textmetrics() and fontmetrics() find no font
  const TextOverlay* overlay = nullptr;   // texts of included and used files; null: they are read
  bool wants_values = false;              // Evaluation::values
  bool has_all_digits = true;             // NodeTree's: the text is no .csg
};

enum class Outcome : uint8_t {
  kDone,
  kAborted,     // by an assertion, endless recursion or a hard warning: the tree is empty, or has
                // in 2026's dialect the nodes of the top level's statements that had ended
  kRefused,     // by a hard warning in 2026's dialect, where the program then fails; as kAborted
  kNotParsed,   // a syntax error in the main file, or in what it includes
  kUnreadable,  // the main file cannot be read
};

/// The camera that a design's own top level sets; absent: it does not assign that variable.
struct DesignCamera {
  std::optional<std::array<double, 3>> translation;   // $vpt
  std::optional<std::array<double, 3>> rotation_deg;  // $vpr
  std::optional<double> distance;                     // $vpd
  std::optional<double> field_of_view_deg;            // $vpf
};

struct Evaluation {
  Outcome outcome = Outcome::kDone;
  std::shared_ptr<const NodeTree> tree;      // never null
  std::shared_ptr<const SourceFiles> files;  // what the nodes' places refer to
  /// Absolute paths of all files that were read, the main one first: sources, parameter sets,
  /// fonts, and what import(), surface(), dxf_dim() and others name. None is listed twice.
  std::vector<std::string> files_read;
  std::vector<std::string> lookups;  // absolute paths that were tried and did not exist, once each
  DesignCamera camera;
  bool has_unparsed_files = false;  // a used file has a syntax error, which ends nothing
  /// The values of the variables of the main file's top level, as echo() shows them, or in words
  /// where they are large: "vector of 1000 elements".
  std::map<std::string, std::string, std::less<>> values;
};

/// A line that OpenSCAD would print, without the line feed.
struct SaidLine {
  std::string_view text;
  Place place{};             // of its cause, which the text need not name; kNoFile: none is known
  const SourceFiles& files;  // what the place refers to
  MessageGroup group = MessageGroup::kPlain;
  std::string_view what{};  // the text without its group and place
  operator std::string_view() const { return text; }
};

/// Takes the lines, in order.
using MessageSink = std::function<void(const SaidLine& line)>;

/// Evaluates the design in the file `path`, or `text` in its place: that of the standard input,
/// where the path is "-", or of any file that is not to be read here. All messages go to `sink`,
/// with OpenSCAD's texts, order and suppression (LANGUAGE.md, "Messages"). Throws nothing but
/// Stopped (language/stopped.hpp), within 50 ms of a request of options.stop.
Evaluation evaluate(const std::string& path, const EvaluationOptions& options,
                    const MessageSink& sink, std::optional<std::string_view> text = {});

}  // namespace language
