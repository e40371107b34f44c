// An open preview of a document: the design read from what its evaluations make, drawn as it
// changes, picked, measured, saved and exported.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "customizer.hpp"
#include "follow/input_turn.hpp"
#include "framing.hpp"
#include "frontend/picture_file.hpp"
#include "model_exporter.hpp"
#include "painter.hpp"
#include "workspace.hpp"

namespace serve {

/// What a preview shows.
struct Look {
  window::Size size{800, 600};
  /// Nothing: that of the design, or one that shows all of it.
  std::optional<window::Navigation> navigation;
  bool is_moving = false;  // others follow at the display's rate
  window::SectionPlane section;
  frontend::Shading shading = frontend::Shading::kStudio;
  frontend::ColorScheme scheme = frontend::color_schemes().front();
  frontend::Overlays overlays;
  double time = 0;  // $t
};

/// A place in a document, which may be another one than the preview's.
struct Cursor {
  std::string key;
  Position position;
  PositionEncoding encoding = PositionEncoding::kUtf16;
  bool operator==(const Cursor&) const = default;
};

/// The newest version of the design that was read.
struct DesignReading {
  int64_t version = 0;  // of the document
  bool is_ok = false;   // the design below is of this version; else it is the last good one
  std::shared_ptr<const frontend::ImportedDesign> design;  // null: there was none yet
  frontend::DesignTree tree;                               // of it
  bool lacks_files = false;                                // a used file of it has a syntax error
  csgcore::Box bounds;                                     // of what is left of it
  frontend::DesignCamera camera;                           // that this version asks for
  bool is_animated = false;                                // it uses $t
  std::vector<Said> said;
  std::vector<std::string> files;  // that this version has read
  std::shared_ptr<const frontend::DesignParameters> parameters;
  frontend::DesignInputs inputs;  // that it was read with
};

/// A picture that the client is to show.
struct PreviewFrame {
  uint64_t number = 0;
  int64_t version = 0;  // of the document
  window::Size size;    // of the picture
  bool is_final = false;
  window::Navigation navigation{{}, csgcore::Projection::kPerspective};
  double ms = 0;  // that drawing took
  frontend::Bytes png;
};

struct Progress {
  std::string stage;  // empty: nothing takes long any more
  double ms = 0;
};

/// How a picture was saved or a model exported.
struct FileOutcome {
  uint64_t number = 0;  // of what was asked for
  std::string error;    // empty: the file is there
};

/// What there is to tell of a preview, each at most once.
struct PreviewNews {
  std::shared_ptr<const DesignReading> design;
  std::optional<PreviewFrame> frame;
  std::optional<Progress> progress;
  std::vector<window::Finding> findings;
  std::vector<FileOutcome> outcomes;
};

/// It belongs to one thread, and works in others. At most one frame is under way to the client, and
/// one waits: what is newer replaces it.
class Preview {
 public:
  /// `on_news` is called by other threads when there may be news; it must not block.
  Preview(Workspace& workspace, DocumentPointer document, Look look, std::function<void()> on_news);
  ~Preview();
  Preview(const Preview&) = delete;
  Preview& operator=(const Preview&) = delete;

  /// The document has been evaluated, or work for it has begun.
  void notice_document();
  void set_look(Look look);
  const Look& look() const { return look_; }
  void set_cursor(std::optional<Cursor> cursor);
  window::Customizer& customizer() { return customizer_; }
  /// To be called after changes of the customizer.
  void notice_parameters();
  /// The client shows a frame, and can take the next.
  void note_shown(uint64_t number);
  /// Ends what takes long. The last picture stays.
  void stop();

  /// Returns the camera that shows all in a part of the picture, from the direction of another one.
  window::Navigation view_all(const window::Navigation& from, const window::PicturePart& part);
  /// Looks for what is seen at a place; a finding of that number follows. False: there is no
  /// design yet.
  bool probe(uint64_t number, const window::Navigation& navigation,
             const window::PicturePoint& place, double snap_px);
  /// Writes the picture as it is shown, once it is final; an outcome of that number follows.
  void save_picture(uint64_t number, std::string path);
  /// Exports the design; an outcome of that number follows, unless it is stopped. False: another
  /// export is under way.
  bool export_model(uint64_t number, const std::string& path);

  /// Does what the news of other threads ask for, and returns what is to be told. It waits for
  /// nothing.
  PreviewNews take_news();
  /// Of the newest version; null: there is none yet.
  const std::shared_ptr<const DesignReading>& reading() const { return reading_; }
  window::Navigation navigation() const;
  /// Returns the text of a document that the design reads, by its key; nothing of any other.
  std::optional<std::string> source(const std::string& key) const;

 private:
  struct Job {
    DocumentPointer document;
    std::shared_ptr<const language::TextOverlay> overlay;
    frontend::DesignInputs inputs;
  };
  struct Saving {
    uint64_t number;
    std::string path;
    std::vector<frontend::NamedPath> inputs;  // which are not to be overwritten
    uint64_t order = 0;                       // whose final picture is written; 0: none yet
  };

  void read_designs(const std::stop_token& stop);
  std::shared_ptr<const DesignReading> read(const Job& job, const DesignReading* before,
                                            const std::stop_token& stop);
  void import_into(DesignReading& reading,
                   const std::shared_ptr<const language::Evaluation>& evaluation,
                   const std::stop_token& stop) const;
  void send_frames(const std::stop_token& stop);
  void save(const window::Painting& painting);
  PreviewFrame frame_of(const window::Painting& painting) const;
  std::optional<frontend::Activity> activity() const;
  void wake();
  void read_later(Job job, bool has_new_inputs);

  frontend::DesignInputs wanted_inputs() const;
  void update_inputs();
  DocumentPointer evaluated_document() const;
  Job job_of(const DocumentPointer& document) const;
  void take_reading(std::shared_ptr<const DesignReading> reading);
  void choose_camera();
  void light_cursor();
  void order_picture();

  Workspace& workspace_;
  const std::string key_;
  const std::string path_;  // of the design
  const std::function<void()> on_news_;

  // Used by the owner's thread alone.
  Look look_;
  std::optional<window::Navigation> own_navigation_;  // where the look has none
  std::optional<Cursor> cursor_;
  window::Customizer customizer_;
  frontend::DesignInputs inputs_;               // that were asked for last
  std::shared_ptr<const Evaluated> evaluated_;  // that was taken last
  std::shared_ptr<const DesignReading> reading_;
  std::shared_ptr<const csgcore::Scene> recolored_;  // for the cursor; null: it lights nothing
  window::PaintOrder ordered_;
  bool has_new_inputs_ = false;  // the next picture is of other inputs: more may follow
  uint64_t export_ = 0;          // number of the export that is under way; 0: none

  mutable std::mutex mutex_;  // of the following
  std::condition_variable_any wake_;
  std::optional<Job> job_;
  std::stop_source reading_stop_;
  frontend::InputTurn turn_;
  std::optional<std::chrono::steady_clock::time_point> reading_since_;  // while it reads
  std::shared_ptr<const DesignReading> read_;                           // that was not taken
  bool is_woken_ = false;              // the sending thread is to look around
  std::string problem_;                // why there is no picture; that was not taken
  std::optional<PreviewFrame> frame_;  // that was not taken
  uint64_t frames_ = 0;                // the number of the last
  bool is_frame_under_way_ = false;
  std::vector<std::pair<uint64_t, int64_t>> versions_;  // of orders from a number on, ascending
  std::vector<Saving> savings_;
  std::vector<FileOutcome> outcomes_;
  std::optional<Progress> progress_;  // that was not taken

  frontend::ActivityMeter reading_activity_;
  language::EvaluationCache cache_;       // of evaluations with other inputs
  const frontend::ImportOptions import_;  // without what depends on the design
  window::ModelExporter exporter_;
  window::Painter painter_;
  std::jthread reading_thread_, sending_thread_;  // they use all others
};

}  // namespace serve
