#include "command/texts.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "command/handover.hpp"
#include "command/outputs.hpp"
#include "follow/evaluated_design.hpp"
#include "frontend/files.hpp"
#include "language/csg_writer.hpp"
#include "language/customizer.hpp"
#include "language/evaluation.hpp"

namespace frontend {
namespace {

/// The evaluations for one output, and where their messages go.
class TextRun {
 public:
  TextRun(const Options& options, const TextOutput& output, const std::optional<FileText>& text,
          MessageWriter& messages)
      : options_(options), output_(output), text_(text), messages_(messages) {}

  ExitCode run() {
    std::optional<language::EvaluationOptions> known =
        evaluation_options(options_.openscad_arguments, options_.input);
    const bool wants_openscad = options_.evaluator == Evaluator::kOpenScad;
    if (!known || (wants_openscad && kind_of(options_.input) != DesignKind::kImported)) {
      std::vector<std::string> arguments = options_.openscad_arguments;
      if (options_.quiet) arguments.push_back("--quiet");
      if (options_.import.picture == PictureKind::kRendered) arguments.push_back("--render");
      const HandedOutput output{output_.path, word_of(output_.kind)};
      return write_by_openscad(options_, {&output, 1}, arguments, text_, writes_rule());
    }
    known->language = options_.import.language;
    known->camera = camera_choice(options_);
    known->view = view_of(options_);
    known->is_preview = options_.import.picture != PictureKind::kRendered;
    bool is_read = true;
    for (uint32_t frame = options_.first_frame; is_read && frame < options_.end_frame; ++frame) {
      is_read = evaluate(*known, frame);
    }
    if (output_.kind == TextKind::kEcho) outputs_.push_back({output_.path, bytes_of(echo_)});
    if (is_read && writes_rule()) {
      outputs_.push_back({options_.rule_path, bytes_of(rule_of(options_, files_))});
    }
    if (is_read || output_.kind == TextKind::kEcho) write_outputs(outputs_);
    return is_read ? ExitCode::kDone : ExitCode::kFailure;
  }

 private:
  /// Models and pictures, where there are any, write it.
  bool writes_rule() const {
    return !options_.rule_path.empty() && options_.models.empty() && options_.outputs.empty();
  }

  /// The messages of a tree go to stderr.
  void add(const std::string& line, const SourcePlace& place) {
    if (options_.quiet && !line.starts_with("ERROR")) return;
    if (output_.kind == TextKind::kEcho) {
      echo_ += line + '\n';
    } else if (!line.empty() || !messages_.is_json()) {
      messages_.say(DesignMessage{line, place});
    }
  }

  std::string parameters_of(const language::Evaluation& evaluation) const {
    const language::SourceFiles& files = *evaluation.files;
    const auto parameters = language::customizer_parameters(files[files.order().front()].text,
                                                            options_.import.language);
    return language::parameters_text(
        parameters.value_or(std::vector<language::CustomizerParameter>{}),
        std::filesystem::path(options_.input).stem().string());
  }

  /// Returns whether the design could be read.
  bool evaluate(language::EvaluationOptions options, uint32_t frame) {
    options.time = frame_time(options_, frame).value_or(0);
    if (const std::string line = exporting_line(word_of(output_.kind), options_); !line.empty()) {
      add(line.substr(0, line.size() - 1), {});
    }
    PlacesOfLines places;
    const language::Evaluation evaluation = language::evaluate(
        options_.input, options,
        [&](const language::SaidLine& line) { add(std::string(line.text), places.of(line)); },
        view_of(text_));
    const std::string advice =
        advice_of_language(options_.input, options, evaluation.outcome, view_of(text_));
    if (!advice.empty() && !options_.quiet) messages_.say("", advice);
    if (evaluation.outcome != language::Outcome::kDone &&
        evaluation.outcome != language::Outcome::kAborted) {
      return false;
    }
    if (output_.kind == TextKind::kParam) {
      outputs_.push_back({path_of(output_, options_, frame), bytes_of(parameters_of(evaluation))});
    }
    if (output_.kind == TextKind::kCsg) {
      outputs_.push_back(
          {path_of(output_, options_, frame), bytes_of(language::csg_text(*evaluation.tree))});
    }
    for (std::string& file : files_of(evaluation, options_.input)) {
      if (std::find(files_.begin(), files_.end(), file) == files_.end()) {
        files_.push_back(std::move(file));
      }
    }
    return true;
  }

  const Options& options_;
  const TextOutput& output_;
  const std::optional<FileText>& text_;
  MessageWriter& messages_;
  std::string echo_;                // the messages, if they are the output
  std::vector<std::string> files_;  // that the design was read from, for all frames
  std::vector<PendingOutput> outputs_;
};

}  // namespace

ExitCode write_texts(const Options& options, const std::optional<FileText>& text,
                     MessageWriter& messages) {
  if (options.texts.empty()) return ExitCode::kDone;
  check_all_outputs(options);
  for (const TextOutput& output : options.texts) {
    const ExitCode code = TextRun(options, output, text, messages).run();
    if (code != ExitCode::kDone) return code;
  }
  return ExitCode::kDone;
}

}  // namespace frontend
