#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <utility>

#include "csgcore/workers.hpp"
#include "extrusion_judge.hpp"
#include "frontend/design_file.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/interrupt.hpp"
#include "frontend/parser.hpp"
#include "frontend/run_program.hpp"
#include "frontend/terminal.hpp"
#include "language/evaluation.hpp"
#include "options.hpp"
#include "render/scene_scale.hpp"
#include "validation.hpp"

namespace validation {
namespace {

using frontend::Error;
using frontend::ExitCode;

/// One run that compares.
class Run {
 public:
  explicit Run(const Options& options)
      : options_(options), progress_(!options.quiet && isatty(STDERR_FILENO) == 1) {}

  ExitCode execute() {
    if (!options_.report.empty()) check_report();
    const csgcore::Scene design = import();
    // The scene is scaled as for a picture: floats, and products of three, cannot hold every size.
    const int exponent = frontend::scale_exponent(design);
    const csgcore::Scene scene = exponent == 0 ? design : frontend::scaled(design, exponent);
    Result result = validate(scene, options_.settings, show_progress_);
    judge_extrusions_alone(result);
    progress_.clear();
    if (exponent != 0) {
      result.notes.push_back("the design was scaled by 2^" + std::to_string(exponent) +
                             ": its volume and all coordinates are so, too");
    }
    result.notes.insert(result.notes.end(), not_judged_.begin(), not_judged_.end());
    if (!options_.report.empty()) write_report(result, exponent);
    if (!options_.quiet && options_.report != "-") frontend::print_text(stdout, table_of(result));
    return result.agrees() ? ExitCode::kDone : ExitCode::kDisagreement;
  }

 private:
  void say(const std::string& text) {
    progress_.clear();
    frontend::print_text(stderr, text + "\n");
  }

  /// Imports the model alone: `%` parts do not belong to it, and `#` parts overlay it.
  csgcore::Scene import() {
    frontend::DesignFileOptions reading{options_};
    reading.message = [this](const std::string& line) {
      if (!options_.quiet || line.starts_with("ERROR")) say(line);
    };
    reading.progress = [this](const char* stage) { progress_.update(stage, -1); };
    reading.wants_text = true;
    frontend::DesignFile file = frontend::read_design(options_.input, reading);
    name_ = file.name;
    frontend::ImportedDesign design = frontend::import_design(file);
    text_ = std::move(file.text);
    tree_ = std::move(file.tree);
    for (const frontend::Warning& warning : design.warnings) {
      if (!options_.quiet) say(warning.text);
    }
    note_what_is_not_judged(design);
    design.scene.layers.clear();
    return std::move(design.scene);
  }

  /// Compares the extrusions that turn, each for itself.
  void judge_extrusions_alone(Result& result) {
    const auto time =
        std::chrono::duration<double>(kExtrusionShare * options_.settings.time_limit_s);
    Result extrusions = judge_extrusions(
        tree_, frontend::beside(options_.input, text_, options_.import), options_.settings,
        Clock::now() + std::chrono::duration_cast<Clock::duration>(time), show_progress_);
    std::ranges::move(extrusions.checks, std::back_inserter(result.checks));
    std::ranges::move(extrusions.notes, std::back_inserter(result.notes));
  }

  void note_what_is_not_judged(const frontend::ImportedDesign& design) {
    const auto note = [this](uint32_t count, const std::string& of_one,
                             const std::string& of_many) {
      if (count == 1) not_judged_.push_back("1 " + of_one);
      if (count > 1) not_judged_.push_back(std::to_string(count) + ' ' + of_many);
    };
    note(design.left_out, "node is left out, and was not judged",
         "nodes are left out, and were not judged");
  }

  void check_report() const {
    frontend::check_output(options_.report);
    const frontend::NamedPath report{"--report", options_.report};
    frontend::check_outputs_differ(
        {&report, 1}, frontend::design_inputs(options_.input, options_.openscad_arguments));
  }

  void write_report(const Result& result, int exponent) {
    const std::string json = report_of(result, name_, options_.settings, exponent);
    const frontend::PendingOutput output{options_.report, frontend::bytes_of(json)};
    frontend::write_outputs({&output, 1});
  }

  /// The extrusions get so much of the time limit besides.
  static constexpr double kExtrusionShare = 0.25;

  const Options& options_;
  std::string name_;
  frontend::DesignText text_;
  frontend::DesignTree tree_;
  std::vector<std::string> not_judged_;
  frontend::ProgressLine progress_;
  const Progress show_progress_ = [this](const std::string& stage, double fraction) {
    progress_.update(stage.c_str(), fraction);
  };
};

ExitCode run(const std::vector<std::string>& arguments) {
  const Options options = parse_options(arguments);
  if (frontend::print_requested(options.request, help_text(),
                                "scadray-validate version " SCADRAY_VERSION)) {
    return ExitCode::kDone;
  }
  const csgcore::ThreadLimit limit(options.threads);
  return Run(options).execute();
}

}  // namespace

}  // namespace validation

int main(int argc, char** argv) {
  frontend::handle_interrupts();
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  return static_cast<int>(frontend::run_program([&] { return validation::run(arguments); },
                                                "a smaller design or --fn"));
}
