#include "preview.hpp"

#include <algorithm>
#include <filesystem>
#include <new>
#include <utility>

#include "base/elapsed.hpp"
#include "follow/evaluated_design.hpp"
#include "frontend/design_file.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/options.hpp"
#include "frontend/stop.hpp"
#include "language/customizer.hpp"
#include "language/stopped.hpp"
#include "preview_light.hpp"
#include "solids/solid_pool.hpp"
#include "tokens.hpp"

namespace serve {
namespace {

using frontend::Clock;
using language::TextOverlay;

/// What a picture may take while the view moves. To encode, send and show it takes some more.
constexpr double kMovingFrame_ms = 14;
/// Work that takes longer is told of.
constexpr std::chrono::seconds kLongWork{1};
/// How often the work is looked at.
constexpr std::chrono::milliseconds kLookInterval{250};

frontend::ImportOptions import_options(language::LanguageVersion version) {
  frontend::ImportOptions options;
  options.language = version;
  options.keeps_places = true;
  options.keeps_meshes = true;  // edges may be switched on at any time
  options.solids = std::make_shared<frontend::SolidPool>(frontend::SolidPool::Keeps::kAll);
  return options;
}

/// Returns whether they are those that a document is evaluated with.
bool are_defaults(const frontend::DesignInputs& inputs) {
  return (!inputs.parameters || inputs.parameters->empty()) && !inputs.time;
}

/// Returns whether a text uses $t.
bool uses_time(const std::string& text) {
  constexpr std::string_view kTime = "$t";
  if (text.find(kTime) == text.npos) return false;
  return std::ranges::any_of(tokens_of(text), [&](const Token& token) {
    return token.kind == TokenKind::kWord &&
           text.compare(token.span.begin, token.span.end - token.span.begin, kTime) == 0;
  });
}

bool uses_time(const language::SourceFiles& files) {
  return std::ranges::any_of(files.order(), [&](language::FileId file) {
    return files.has(file) && uses_time(std::string(files[file].text));
  });
}

/// Returns a warning of the importer as what an evaluation says.
Said said_of(const frontend::Warning& warning, const Evaluated& evaluated,
             const std::string& path) {
  const frontend::Problem& problem = warning.problem;
  Said said{language::MessageGroup::kWarning, problem.what.empty() ? warning.text : problem.what};
  if (!problem.todo.empty()) said.what += " (" + problem.todo + ")";
  if (problem.location.line == 0) return said;
  said.path = problem.path.empty() ? path : problem.path;
  if (said.path != path) return said;
  said.text = evaluated.text;
  const uint32_t line = std::min(problem.location.line, said.text->lines()) - 1;
  const uint32_t offset = said.text->line_start(line) + problem.location.column - 1;
  said.span = {std::min(offset, said.text->size()), std::min(offset, said.text->size())};
  return said;
}

/// Returns the number of a design's file of that key.
std::optional<language::FileId> file_of(const language::SourceFiles& files,
                                        const std::string& key) {
  const auto found = std::ranges::find_if(
      files.order(), [&](language::FileId file) { return has_key(files[file].path, key); });
  return found == files.order().end() ? std::nullopt : std::optional(*found);
}

}  // namespace

Preview::Preview(Workspace& workspace, DocumentPointer document, Look look,
                 std::function<void()> on_news)
    : workspace_(workspace),
      key_(document->key),
      path_(document->path),
      on_news_(std::move(on_news)),
      look_(std::move(look)),
      customizer_(path_, {}),
      import_(import_options(workspace.language_version())),
      exporter_(on_news_),
      painter_(kMovingFrame_ms,
               [this] {
                 wake();
                 on_news_();
               }),
      reading_thread_([this](const std::stop_token& stop) { read_designs(stop); }),
      sending_thread_([this](const std::stop_token& stop) { send_frames(stop); }) {
  update_inputs();
  notice_document();
}

Preview::~Preview() {
  reading_thread_.request_stop();
  sending_thread_.request_stop();
  const std::lock_guard lock(mutex_);
  reading_stop_.request_stop();
}

void Preview::wake() {
  {
    const std::lock_guard lock(mutex_);
    is_woken_ = true;
  }
  wake_.notify_all();
}

// What the owner asks for.

Preview::Job Preview::job_of(const DocumentPointer& document) const {
  Document evaluated = *document;
  evaluated.text = document->evaluated->text;
  evaluated.version = document->evaluated->version;
  return {std::make_shared<const Document>(std::move(evaluated)), workspace_.overlay(), inputs_};
}

/// Returns the document once it has been evaluated for those who follow it, or else null.
DocumentPointer Preview::evaluated_document() const {
  const DocumentPointer document = workspace_.find(key_);
  return document && document->evaluated && document->evaluated->was_followed ? document : nullptr;
}

void Preview::read_later(Job job, bool has_new_inputs) {
  {
    const std::lock_guard lock(mutex_);
    job_ = std::move(job);
    if (has_new_inputs)
      turn_.notice(Clock::now());
    else
      reading_stop_.request_stop();
  }
  wake();
}

void Preview::notice_document() {
  wake();
  const DocumentPointer document = evaluated_document();
  if (!document || document->evaluated == evaluated_) return;
  evaluated_ = document->evaluated;
  read_later(job_of(document), false);
}

frontend::DesignInputs Preview::wanted_inputs() const {
  frontend::DesignInputs inputs{customizer_.inputs(), std::nullopt};
  if (look_.time != 0) inputs.time = look_.time;
  return inputs;
}

void Preview::update_inputs() {
  frontend::DesignInputs wanted = wanted_inputs();
  if (wanted == inputs_) return;
  inputs_ = std::move(wanted);
  const DocumentPointer document = evaluated_document();
  if (!document) return;
  evaluated_ = document->evaluated;
  has_new_inputs_ = true;
  read_later(job_of(document), true);
}

void Preview::notice_parameters() { update_inputs(); }

void Preview::set_look(Look look) {
  const bool has_new_scheme = look.scheme.name != look_.scheme.name;
  look_ = std::move(look);
  update_inputs();
  if (has_new_scheme) light_cursor();
  order_picture();
}

void Preview::set_cursor(std::optional<Cursor> cursor) {
  if (cursor == cursor_) return;
  cursor_ = std::move(cursor);
  light_cursor();
  order_picture();
}

void Preview::note_shown(uint64_t number) {
  {
    const std::lock_guard lock(mutex_);
    if (frame_ || number != frames_) return;
    is_frame_under_way_ = false;
  }
  wake();
}

void Preview::stop() {
  workspace_.stop(key_);
  {
    const std::lock_guard lock(mutex_);
    job_.reset();
    turn_.give_up();
    reading_stop_.request_stop();
  }
  painter_.stop();
  if (exporter_.stop()) {
    const std::lock_guard lock(mutex_);
    outcomes_.push_back({std::exchange(export_, 0), "stopped"});
  }
  wake();
  on_news_();
}

// The picture.

window::Navigation Preview::navigation() const {
  if (look_.navigation) return *look_.navigation;
  return own_navigation_.value_or(window::Navigation({}, csgcore::Projection::kPerspective));
}

/// Chooses the camera for the first design that is no empty one, as the window does.
void Preview::choose_camera() {
  if (own_navigation_ || look_.navigation || reading_->bounds.empty()) return;
  const frontend::CameraOptions options = frontend::with_camera_of(reading_->camera, {});
  window::Navigation chosen(frontend::choose_camera(options, reading_->bounds), options.projection);
  if (!options.camera) {
    window::PicturePart whole;
    whole.aspect = static_cast<double>(look_.size.width_px) / look_.size.height_px;
    chosen = view_all(chosen, whole);
  }
  own_navigation_ = chosen;
}

window::Navigation Preview::view_all(const window::Navigation& from,
                                     const window::PicturePart& part) {
  if (!reading_ || !reading_->design) return from;
  return window::view_all(from, *reading_->design, reading_->bounds, look_.section, part);
}

std::optional<std::string> Preview::source(const std::string& key) const {
  if (key == key_) {
    const DocumentPointer document = workspace_.find(key);
    return document ? std::optional(document->text->bytes()) : std::nullopt;
  }
  if (!reading_ || !reading_->tree.files) return std::nullopt;
  const language::SourceFiles& files = *reading_->tree.files;
  const auto file = file_of(files, key);
  return file ? std::optional(own_text(files[*file].text)) : std::nullopt;
}

void Preview::light_cursor() {
  recolored_.reset();
  if (!cursor_ || !reading_ || !reading_->design) return;
  const language::SourceFiles& files = *reading_->tree.files;
  const auto file =
      cursor_->key == key_ ? std::optional(files.order().front()) : file_of(files, cursor_->key);
  if (!file) return;
  const Text text(own_text(files[*file].text));
  recolored_ = lit_scene(*reading_->design, reading_->tree, *file,
                         text.offset_of(cursor_->position, cursor_->encoding), look_.scheme);
}

void Preview::order_picture() {
  if (!reading_ || !reading_->design) return;
  window::PaintOrder order;
  order.design = reading_->design;
  order.recolored = recolored_;
  if (look_.section.is_on) order.section = look_.section;
  order.navigation = navigation();
  order.size = look_.size;
  order.settings.scheme = look_.scheme;
  order.settings.shading = look_.shading;
  order.settings.renderer = frontend::RendererKind::kCpu;
  order.overlays = look_.overlays;
  order.is_moving = std::exchange(has_new_inputs_, false) || look_.is_moving;
  {
    const std::lock_guard lock(mutex_);
    const bool is_to_be_saved =
        std::ranges::any_of(savings_, [](const Saving& saving) { return saving.order == 0; });
    order.settings.measured_channels = std::ranges::any_of(savings_, [](const Saving& saving) {
      return frontend::picture_format(saving.path) == frontend::PictureFormat::kExr;
    });
    if (window::show_the_same(order, ordered_) && !is_to_be_saved) return;
    order.number = ordered_.number + 1;
    for (Saving& saving : savings_) saving.order = order.number;
    if (versions_.empty() || versions_.back().second != reading_->version)
      versions_.emplace_back(order.number, reading_->version);
  }
  ordered_ = order;
  painter_.order(std::move(order));
  wake();
}

bool Preview::probe(uint64_t number, const window::Navigation& navigation,
                    const window::PicturePoint& place, double snap_px) {
  if (!ordered_.design) return false;
  window::Probe probe;
  probe.number = number;
  probe.order = ordered_;
  probe.order.navigation = navigation;
  probe.place = place;
  probe.snap_px = snap_px;
  probe.tree = reading_->tree;
  painter_.probe(std::move(probe));
  return true;
}

void Preview::save_picture(uint64_t number, std::string path) {
  std::vector<frontend::NamedPath> inputs{{"the design", path_}};
  if (reading_)
    for (const std::string& file : reading_->files)
      inputs.push_back({"a file of the design", file});
  {
    const std::lock_guard lock(mutex_);
    savings_.push_back({number, std::move(path), std::move(inputs)});
  }
  order_picture();
}

bool Preview::export_model(uint64_t number, const std::string& path) {
  const DocumentPointer document = workspace_.find(key_);
  if (export_ != 0 || !document) return false;
  export_ = number;
  window::ModelOrder order;
  order.path = path;
  order.options.input = path_;
  order.inputs = inputs_;
  order.options.import.language = workspace_.language_version();
  order.stream = frontend::FileText(document->text->bytes());
  order.overlay = workspace_.overlay();
  exporter_.start(std::move(order));
  wake();
  return true;
}

// News.

void Preview::take_reading(std::shared_ptr<const DesignReading> reading) {
  reading_ = std::move(reading);
  customizer_.take(reading_->parameters);
  update_inputs();  // the new version may lack parameters
  if (!reading_->design) return;
  choose_camera();
  light_cursor();
  order_picture();
}

PreviewNews Preview::take_news() {
  PreviewNews news;
  std::string problem;
  {
    const std::lock_guard lock(mutex_);
    news.design = std::exchange(read_, nullptr);
    news.frame = std::exchange(frame_, std::nullopt);
    news.progress = std::exchange(progress_, std::nullopt);
    news.outcomes = std::exchange(outcomes_, {});
    problem = std::exchange(problem_, {});
  }
  if (news.design) take_reading(news.design);
  if (!problem.empty() && reading_) {
    DesignReading told = *reading_;
    told.is_ok = false;
    told.said.push_back({language::MessageGroup::kError, problem});
    news.design = std::make_shared<const DesignReading>(std::move(told));
  }
  while (auto finding = painter_.take_finding()) news.findings.push_back(std::move(*finding));
  if (auto outcome = exporter_.take_outcome())
    news.outcomes.push_back({std::exchange(export_, 0), outcome->error});
  return news;
}

// The reading thread.

void Preview::read_designs(const std::stop_token& stop) {
  std::shared_ptr<const DesignReading> before;
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [this] { return job_.has_value(); })) {
    const Job job = *std::exchange(job_, std::nullopt);
    turn_.start(reading_stop_.stop_requested());
    reading_stop_ = {};
    const std::stop_token reading_stop = reading_stop_.get_token();
    if (stop.stop_requested()) return;
    reading_since_ = Clock::now();
    reading_activity_.begin("reading");
    lock.unlock();
    std::shared_ptr<const DesignReading> reading;
    try {
      const csgcore::StopScope scope(&reading_stop);
      reading = read(job, before.get(), reading_stop);
    } catch (const csgcore::Stopped&) {
    } catch (const language::Stopped&) {
    }
    reading_activity_.end();
    lock.lock();
    reading_since_.reset();
    if (!reading) continue;
    turn_.finish();
    before = read_ = std::move(reading);
    lock.unlock();
    on_news_();
    lock.lock();
  }
}

void Preview::import_into(DesignReading& reading,
                          const std::shared_ptr<const language::Evaluation>& evaluation,
                          const std::stop_token& stop) const {
  frontend::DesignText text;
  text.name = frontend::input_name(path_);
  text.is_exported = true;
  text.evaluation = evaluation;
  reading.tree = frontend::tree_of(text, stop);
  reading.design = std::make_shared<const frontend::ImportedDesign>(
      frontend::import_design(reading.tree, frontend::beside(path_, text, import_), stop));
  reading.bounds = window::seen_box(reading.design->scene);
}

/// `before` is the reading before; null: there is none.
std::shared_ptr<const DesignReading> Preview::read(const Job& job, const DesignReading* before,
                                                   const std::stop_token& stop) {
  std::shared_ptr<const Evaluated> evaluated = job.document->evaluated;
  if (!are_defaults(job.inputs)) {
    reading_activity_.update("evaluating");
    evaluated = std::make_shared<const Evaluated>(evaluate(
        *job.document, *job.overlay, workspace_.language_version(), job.inputs, cache_, stop));
  }
  auto reading = std::make_shared<DesignReading>();
  reading->version = evaluated->version;
  reading->inputs = job.inputs;
  reading->said = evaluated->said;
  reading->files = evaluated->files_read;
  reading->parameters = before ? before->parameters : nullptr;
  const std::string& text = evaluated->text->bytes();
  if (!reading->parameters || reading->parameters->text != text) {
    if (auto list = language::customizer_parameters(text, workspace_.language_version()))
      reading->parameters = std::make_shared<const frontend::DesignParameters>(
          frontend::DesignParameters{text, std::move(*list)});
  }
  if (const auto& evaluation = evaluated->evaluation) {
    reading->camera = frontend::camera_of(*evaluation);
    reading->is_animated = uses_time(*evaluation->files);
    // A picture without what a used file has is shown only where there is none with it.
    const bool needs_files = before && before->design && !before->lacks_files;
    reading->is_ok = evaluation->outcome == language::Outcome::kDone &&
                     !(needs_files && evaluation->has_unparsed_files);
  }
  if (reading->is_ok) {
    reading_activity_.update("importing");
    reading->lacks_files = evaluated->evaluation->has_unparsed_files;
    try {
      import_into(*reading, evaluated->evaluation, stop);
      for (const frontend::Warning& warning : reading->design->warnings)
        reading->said.push_back(said_of(warning, *evaluated, path_));
    } catch (const std::bad_alloc&) {
      reading->is_ok = false;
      reading->said.push_back({language::MessageGroup::kError, "out of memory"});
    } catch (const frontend::Error& error) {
      reading->is_ok = false;
      reading->said.push_back({language::MessageGroup::kError, error.what()});
    }
  }
  if (!reading->is_ok) {
    const DesignReading none;
    const DesignReading& good = before ? *before : none;
    reading->design = good.design;
    reading->tree = good.tree;
    reading->lacks_files = good.lacks_files;
    reading->bounds = good.bounds;
  }
  return reading;
}

// The sending thread.

/// Returns what is being done, the longest work first.
std::optional<frontend::Activity> Preview::activity() const {
  std::optional<frontend::Activity> longest;
  for (auto& known : {workspace_.activity(key_), reading_activity_.current(), painter_.activity(),
                      exporter_.activity()}) {
    if (known && (!longest || known->since < longest->since)) longest = known;
  }
  return longest;
}

PreviewFrame Preview::frame_of(const window::Painting& painting) const {
  PreviewFrame frame;
  frame.size = {painting.image.width_px, painting.image.height_px};
  frame.is_final = painting.is_final;
  frame.navigation = painting.order.navigation;
  frame.ms = painting.draw_ms;
  frame.png = frontend::encode_png(painting.image);
  return frame;
}

/// Writes the picture to all files that are to have it.
void Preview::save(const window::Painting& painting) {
  std::vector<Saving> due;
  {
    const std::lock_guard lock(mutex_);
    const auto is_due = [&](const Saving& saving) {
      return painting.is_final && saving.order == painting.order.number;
    };
    std::ranges::copy_if(savings_, std::back_inserter(due), is_due);
    std::erase_if(savings_, is_due);
  }
  for (const Saving& saving : due) {
    FileOutcome outcome{saving.number, {}};
    try {
      const frontend::NamedPath picture{"a picture", saving.path};
      frontend::check_outputs_differ({&picture, 1}, saving.inputs);
      const frontend::PendingOutput output{
          saving.path,
          frontend::encode_picture(painting.image, frontend::picture_format(saving.path))};
      frontend::write_outputs({&output, 1});
    } catch (const std::exception& error) {
      outcome.error = error.what();
    }
    const std::lock_guard lock(mutex_);
    outcomes_.push_back(std::move(outcome));
  }
  if (!due.empty()) on_news_();
}

void Preview::send_frames(const std::stop_token& stop) {
  std::optional<window::Painting> waiting;  // for the client
  bool is_told = false;                     // of long work
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    is_woken_ = false;
    lock.unlock();
    if (auto painting = painter_.take_painting()) {
      if (painting->error.empty()) {
        save(*painting);
        waiting = std::move(painting);
      } else {
        const std::lock_guard again(mutex_);
        problem_ = painting->error;
      }
    }
    const auto work = activity();
    lock.lock();
    const Clock::time_point now = Clock::now();
    const bool is_long = work && now - work->since >= kLongWork;
    const bool was_told = std::exchange(is_told, is_long);
    if (is_long)
      progress_ = Progress{work->stage, frontend::ms_since(work->since)};
    else if (was_told)
      progress_ = Progress{};
    const auto due = turn_.due(reading_since_);
    if (reading_since_ && due && now >= *due) reading_stop_.request_stop();
    bool has_news = is_long || was_told || !problem_.empty();
    if (waiting && !is_frame_under_way_) {
      is_frame_under_way_ = true;
      lock.unlock();
      PreviewFrame frame = frame_of(*waiting);
      lock.lock();
      frame.number = ++frames_;
      while (versions_.size() > 1 && versions_[1].first <= waiting->order.number)
        versions_.erase(versions_.begin());
      frame.version = versions_.front().second;
      frame_ = std::move(frame);
      waiting.reset();
      has_news = true;
    }
    if (has_news) {
      lock.unlock();
      on_news_();
      lock.lock();
    }
    const auto is_awake = [this] { return is_woken_; };
    if (work)
      wake_.wait_for(lock, stop, kLookInterval, is_awake);
    else
      wake_.wait(lock, stop, is_awake);
  }
}

}  // namespace serve
