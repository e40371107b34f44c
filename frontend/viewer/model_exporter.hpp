// Exports the design in a thread of its own, so that the window never waits for it.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "frontend/activity.hpp"
#include "frontend/design_file_options.hpp"
#include "frontend/options.hpp"

namespace window {

struct ModelOrder {
  std::string path;           // of the file that is written; its suffix tells the format
  frontend::Options options;  // whose input is the design
  frontend::DesignInputs inputs;
  std::optional<frontend::FileText> stream;  // DesignVersion::stream, or a text that is not saved
  std::shared_ptr<const language::TextOverlay> overlay{};  // DesignFileOptions::overlay
};

struct ModelOutcome {
  std::string path;
  std::string error;  // why there is no file; empty: there is one
  std::vector<std::string> warnings;
};

/// Its end stops what is under way, and waits for a file that is being written.
class ModelExporter {
 public:
  /// `on_news` is called from the exporter's thread when take_outcome() has something; it must not
  /// block.
  explicit ModelExporter(std::function<void()> on_news);
  ModelExporter(const ModelExporter&) = delete;
  ModelExporter& operator=(const ModelExporter&) = delete;

  // None of these functions waits.

  /// Evaluates the design for itself, as `scadray -o` does, and writes the file whole or not at
  /// all. Nothing else may be under way.
  void start(ModelOrder order);
  /// Returns what is being done; nothing if nothing is.
  std::optional<frontend::Activity> activity() const { return activity_.current(); }
  /// Returns, once, how the last export has ended, unless it was stopped.
  std::optional<ModelOutcome> take_outcome();
  /// Ends what is under way: no file will be there. Returns false if there is nothing, or if it has
  /// come to writing the file, which then is to be awaited.
  bool stop();

 private:
  void run(const ModelOrder& order, const std::stop_token& stop);
  void make(const ModelOrder& order, const std::stop_token& stop, ModelOutcome& outcome);
  bool begin_writing(const std::stop_token& stop);

  const std::function<void()> on_news_;
  frontend::ActivityMeter activity_;
  std::mutex mutex_;  // of the following
  bool is_writing_ = false;
  std::optional<ModelOutcome> outcome_;
  std::jthread thread_;  // used by the window's thread alone
};

}  // namespace window
