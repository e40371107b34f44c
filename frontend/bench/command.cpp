#include <unistd.h>

#include <cstdio>
#include <thread>
#include <utility>

#include "frontend/design_file.hpp"
#include "frontend/error.hpp"
#include "frontend/interrupt.hpp"
#include "frontend/run_program.hpp"
#include "frontend/terminal.hpp"
#include "measurement.hpp"
#include "options.hpp"

namespace bench {
namespace {

using frontend::Error;
using frontend::ExitCode;

struct Design {
  std::string name;
  ScenePointer scene;
  frontend::Camera camera;
};

/// Returns views from the camera turned once around the vertical axis.
std::vector<csgcore::View> turning_views(frontend::Camera camera,
                                         const frontend::CameraOptions& options) {
  constexpr int kSteps = 36;
  std::vector<csgcore::View> views;
  for (int i = 0; i < kSteps; ++i) {
    views.push_back(frontend::make_view(camera, options));
    camera.rotation_deg.z += 360.0 / kSteps;
  }
  return views;
}

class Run {
 public:
  explicit Run(const Options& options)
      : options_(options), progress_(!options.quiet && isatty(STDERR_FILENO) == 1) {}

  ExitCode execute() {
    // All files are read before the first is measured, so that one that cannot be read is reported
    // at once.
    std::vector<Design> designs;
    for (const std::string& input : options_.inputs) designs.push_back(import(input));
    Json files = Json::array();
    bool is_right = true;
    for (const Design& design : designs) {
      Json result = measure(design);
      for (const std::string wrong : result["wrong"]) {
        say(design.name + ": error: " + wrong + ": not measured" +
            (wrong.starts_with("gl") ? " (OpenGL computes in float; give --renderer=cpu)" : ""));
        is_right = false;
      }
      if (options_.json) {
        Json file = {{"file", design.name}};
        file.update(result);
        files.push_back(std::move(file));
      } else {
        frontend::print_text(stdout, table_of(design.name, result));
        std::fflush(stdout);
      }
    }
    if (options_.json) print(files);
    return is_right ? ExitCode::kDone : ExitCode::kFailure;
  }

 private:
  void say(const std::string& text) {
    progress_.clear();
    frontend::print_text(stderr, text + "\n");
  }

  /// Imports the model alone: `%` parts do not belong to it, and `#` parts overlay it.
  Design import(const std::string& input) {
    frontend::DesignFileOptions reading{options_};
    reading.message = [this](const std::string& line) {
      if (!options_.quiet || line.starts_with("ERROR")) say(line);
    };
    reading.progress = [this](const char* stage) { progress_.update(stage, -1); };
    frontend::DesignFile file = frontend::read_design(input, reading);
    frontend::ImportedDesign design = frontend::import_design(file);
    for (const frontend::Warning& warning : design.warnings) {
      if (!options_.quiet) say(warning.text);
    }
    design.scene.layers.clear();
    const frontend::Camera camera = frontend::choose_camera(options_.camera, design.view_box);
    if (frontend::sees_nothing(camera, options_.camera.projection)) {
      throw frontend::Error("", {}, "from the camera's distance nothing is seen",
                            "give --camera a positive distance, or --viewall");
    }
    return {file.name, std::make_shared<const csgcore::Scene>(std::move(design.scene)), camera};
  }

  Json measure(const Design& design) {
    const std::vector<csgcore::View> views = turning_views(design.camera, options_.camera);
    Json result =
        bench::measure(design.scene, views, options_.settings, [&](const std::string& stage) {
          progress_.update((design.name + ": " + stage).c_str(), -1);
        });
    progress_.clear();
    return result;
  }

  void print(const Json& files) const {
    const unsigned threads = options_.settings.threads;
    const Json all = {{"version", SCADRAY_VERSION},
                      {"width_px", options_.camera.width_px},
                      {"height_px", options_.camera.height_px},
                      {"threads", threads > 0 ? threads : std::thread::hardware_concurrency()},
                      {"files", files}};
    // The name of a file need not be UTF-8.
    const std::string text = all.dump(1, ' ', false, Json::error_handler_t::replace);
    frontend::print_text(stdout, text + "\n");
  }

  const Options& options_;
  frontend::ProgressLine progress_;
};

ExitCode run(const std::vector<std::string>& arguments) {
  const Options options = parse_options(arguments);
  if (frontend::print_requested(options.request, help_text(),
                                "scadray-bench version " SCADRAY_VERSION)) {
    return ExitCode::kDone;
  }
  return Run(options).execute();
}

}  // namespace

}  // namespace bench

int main(int argc, char** argv) {
  frontend::handle_interrupts();
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  return static_cast<int>(frontend::run_program([&] { return bench::run(arguments); },
                                                "a smaller --imgsize or design"));
}
