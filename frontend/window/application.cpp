#include "application.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <thread>
#include <utility>

#include "frontend/design_file.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/picture_file.hpp"
#include "frontend/terminal.hpp"
#include "memory.hpp"
#include "panels/panels.hpp"
#include "state_texts.hpp"

namespace window {
namespace {

/// The share of the display's time for a frame that drawing a picture may take; the rest is the
/// window's.
constexpr double kDrawingShare = 0.6;

/// ImGui answers an event in the next frame, and lays out a new panel in the one after that.
constexpr int kFramesAfterEvent = 3;

/// The longest wait for a picture that was ordered; then the window is drawn without it.
constexpr std::chrono::milliseconds kShortPainting{50};

/// Work that takes longer is shown, and can be stopped.
constexpr std::chrono::seconds kLongWork{1};
/// How often that display is brought up to date.
constexpr std::chrono::milliseconds kProgressInterval{250};

constexpr const char* kNoFile = "no file has that place";

/// A reading that takes less is not shown, and work that takes less is not worth stopping.
constexpr std::chrono::milliseconds kShortReading{150};

std::string file_name(const std::string& path) {
  return path == "-" ? "standard input" : std::filesystem::path(path).filename().string();
}

/// Returns the arguments without the values of variables, which are meant for one design.
std::vector<std::string> without_values(const std::vector<std::string>& arguments) {
  std::vector<std::string> rest;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    if (word == "-D" || word == "-p" || word == "-P") {
      ++i;
    } else {
      rest.push_back(word);
      if (word == "-m" && i + 1 < arguments.size()) rest.push_back(arguments[++i]);
    }
  }
  return rest;
}

std::string default_picture(const std::string& input) {
  if (input == "-") return "picture.png";
  return std::filesystem::path(input).replace_extension(".png").string();
}

frontend::FollowOptions follow_options(const frontend::Options& options) {
  frontend::FollowOptions result{options};
  result.import.keeps_places = true;
  result.import.keeps_meshes = true;  // edges may be switched on at any time
  return result;
}

std::optional<Size> given_size(const frontend::Options& options) {
  if (!options.has_image_size) return std::nullopt;
  return Size{options.camera.width_px, options.camera.height_px};
}

void print_echoes(const frontend::DesignVersion& version) {
  for (const std::string& line : version.messages) {
    if (frontend::is_echo(line)) frontend::print_text(stdout, line + "\n");
  }
  std::fflush(stdout);
}

}  // namespace

Application::Application(const frontend::Options& options)
    : options_(options),
      memory_(memory_path(), options.resets_window),
      state_(options),
      window_(file_name(options.input) + " - scadray",
              remembered_placement(memory_, given_size(options)), *this),
      actions_{.run = [this](Command command) { run_command(command); },
               .save = [this](const std::string& path) { save_picture(path); },
               .open = [this](const MessagePlace& place) { open_place(place); },
               .open_design = [this](const std::string& path) { opening_ = path; },
               .export_model = [this](const std::string& path) { export_model(path); }},
      report_(options.stats_path),
      frame_s_(1 / window_.frames_per_second()),
      editor_(options.editor, GlfwWindow::wake),
      painter_(kDrawingShare * 1000 * frame_s_, GlfwWindow::wake),
      exporter_(GlfwWindow::wake),
      follower_(options.input, follow_options(options), GlfwWindow::wake),
      has_camera_(!frontend::sees_all(options.camera)) {
  restore_habits(memory_, options_.given, state_);
  options_.camera.projection = state_.navigation.projection();
  memory_.note(habits_of(state_), Clock::now());
  memory_.note(values_of(window_.placement(), memory_.is_only_window()), Clock::now());
  begin_design();
}

/// Shows nothing yet of the design of the options.
void Application::begin_design() {
  state_.picture_dialogue.path = default_picture(options_.input);
  const frontend::Rgb background = state_.look.scheme.background;
  screen_.load({1, 1, {{background.r, background.g, background.b}}, {}, {}, {}, {}, {}});
  std::error_code failed;
  const std::filesystem::path path = std::filesystem::absolute(options_.input, failed);
  if (!failed && std::filesystem::is_regular_file(path, failed)) {
    memory_.note_design(path.lexically_normal().string(), Clock::now());
  }
  state_.recent_designs = memory_.recent();
}

/// Shows another design, as if the window were opened with it.
void Application::open_design(const std::string& path) {
  try {
    frontend::check_input(path);
  } catch (const frontend::Error& error) {
    state_.notice = error.what();
    return;
  }
  options_.input = path;
  options_.openscad_arguments = without_values(options_.openscad_arguments);
  follower_ = frontend::DesignFollower(path, follow_options(options_), GlfwWindow::wake);
  painter_.stop();
  end_hover();
  state_.begin(options_);
  options_.camera.projection = state_.navigation.projection();
  tree_ = {};
  inputs_ = {};
  asked_camera_ = {};
  has_camera_ = !frontend::sees_all(options_.camera);
  ordered_.design.reset();
  oldest_order_ = ordered_.number + 1;
  reported_version_ = 0;
  is_picture_stopped_ = is_reading_ = false;
  save_path_.clear();
  saving_ = 0;
  begin_design();
  show_title();
}

void Application::run() {
  frames_due_ = kFramesAfterEvent;
  while (!window_.is_closing()) {
    wait_for_news();
    probe_hover();
    if (!opening_.empty()) open_design(std::exchange(opening_, {}));
    if (take_news() || window_.take_activity()) frames_due_ = kFramesAfterEvent;
    watch_work();
    frames_due_ = std::max(frames_due_, watch_long_work());
    order_picture();
    remember();
    if (window_.size().width_px == 0) frames_due_ = 0;
    if (frames_due_ == 0 || Clock::now() < awaited_until_) continue;
    wait_for_display();
    draw_frame();
    --frames_due_;
  }
  write_memory();
}

void Application::wait_for_news() {
  const std::chrono::duration<double> rest = awaited_until_ - Clock::now();
  if (rest.count() > 0) {
    window_.wait(rest.count());
  } else if (frames_due_ > 0) {
    window_.poll();
  } else if (const auto seconds = seconds_to_next_look()) {
    window_.wait(*seconds);
  } else {
    window_.wait();
  }
}

/// Returns the time until something may have to change though nothing happens: what is shown of
/// unfinished work, or of what is under the resting mouse. Nothing: the window may sleep.
std::optional<double> Application::seconds_to_next_look() const {
  std::optional<Clock::time_point> next;
  const auto look_at = [&next](Clock::time_point when) {
    next = std::min(next.value_or(when), when);
  };
  if (is_reading_ && !state_.is_reading) look_at(reading_since_ + kShortReading);
  if (const auto due = hover_.due()) look_at(*due);
  if (const auto due = memory_.due()) look_at(*due);
  for (const auto& activity : activities()) {
    if (activity && window_.size().width_px > 0)
      look_at(std::max(activity->since + kLongWork, last_frame_ + kProgressInterval));
  }
  if (state_.animation.is_playing() && (shows_inputs() || state_.is_stopped))
    look_at(state_.animation.due());
  if (!next) return std::nullopt;
  return std::max(std::chrono::duration<double>(*next - Clock::now()).count(), 1e-3);
}

/// Returns whether the display of the reading has to change.
bool Application::watch_reading() {
  using Reading = frontend::DesignFollower::State;
  const Reading now = follower_.state();
  const bool was_reading = std::exchange(is_reading_, now == Reading::kReading);
  if (is_reading_ && !was_reading) reading_since_ = Clock::now();
  state_.is_stopped = now == Reading::kStopped || is_picture_stopped_;
  const bool is_long = is_reading_ && Clock::now() - reading_since_ >= kShortReading;
  return std::exchange(state_.is_reading, is_long) != is_long;
}

/// Returns how many frames the display of long work needs now.
int Application::watch_long_work() {
  const bool was_shown = state_.long_activity.has_value();
  state_.long_activity.reset();
  for (const auto& activity : activities()) {
    if (activity && Clock::now() - activity->since >= kLongWork && !state_.long_activity) {
      state_.long_activity = activity;
    }
  }
  if (state_.long_activity.has_value() != was_shown) return kFramesAfterEvent;
  const bool is_due = was_shown && Clock::now() >= last_frame_ + kProgressInterval;
  return is_due ? 1 : 0;
}

/// Returns what each thread does, the one that the user is most likely to wait for first.
std::array<std::optional<frontend::Activity>, 3> Application::activities() const {
  return {follower_.activity(), painter_.activity(), exporter_.activity()};
}

/// Returns whether the picture that was ordered last is still to come.
bool Application::is_drawing() const {
  const bool is_there = state_.painting && state_.painting->order.number == ordered_.number &&
                        (state_.painting->is_final || !state_.painting->error.empty());
  return ordered_.design && !is_there && !is_picture_stopped_;
}

/// Returns since when something has been under way, without a pause.
std::optional<Application::Clock::time_point> Application::watch_work() {
  if (!is_reading_ && !follower_.activity() && !is_drawing() && !exporter_.activity()) {
    working_since_.reset();
  } else if (!working_since_) {
    working_since_ = Clock::now();
  }
  return working_since_;
}

/// Returns whether Esc is to stop something: what takes a moment only is not worth it, unless there
/// is nothing else to do.
bool Application::is_worth_stopping() {
  const auto since = watch_work();
  return since && (Clock::now() - *since >= kShortReading || !state_.has_anything_to_forget());
}

/// Ends reading, rendering, drawing and exporting; what they have made last stays.
void Application::stop_work() {
  if (!watch_work()) return;
  if (exporter_.stop()) {
    state_.notice = "stopped; nothing was exported to " + std::exchange(state_.exporting, {});
  }
  if (is_reading_ || follower_.activity()) follower_.stop();
  if (is_drawing()) {
    painter_.stop();
    is_picture_stopped_ = true;
    save_path_.clear();
    saving_ = 0;
  }
  is_reading_ = state_.is_reading = false;
  state_.long_activity.reset();
  state_.is_stopped = true;
  working_since_.reset();
  state_.animation.pause();
}

/// Waits for the display if the driver does not, as a software renderer does not.
void Application::wait_for_display() {
  const auto frame =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(frame_s_));
  std::this_thread::sleep_until(last_frame_ + frame);
  last_frame_ = Clock::now();
}

/// Draws the panels as they are to be in the next frame, without showing them: they find their
/// sizes in several frames.
void Application::lay_out_panels() {
  for (int frame = 0; frame < kFramesAfterEvent; ++frame) {
    begin_frame();
    draw_panels();
    window_.drop_frame();
  }
}

void Application::begin_frame() {
  visit_texts(state_, [this](std::string_view text) { window_.need_letters(text); });
  window_.begin_frame();
}

void Application::draw_panels() {
  const Size size = window_.size();
  const double scale = window_.pixels_per_unit();
  csgcore::View view = state_.navigation.view(size);
  view.width_px = static_cast<uint32_t>(std::lround(size.width_px / scale));
  view.height_px = static_cast<uint32_t>(std::lround(size.height_px / scale));
  window::draw_panels(state_, view, static_cast<float>(scale), actions_);
}

void Application::draw_frame() {
  screen_.draw(window_.size());
  begin_frame();
  draw_panels();
  window_.end_frame();
  update_inputs();
  if (std::exchange(shows_version_, false)) note_shown();
  if (std::exchange(has_new_picture_, false)) report_picture();
}

bool Application::take_news() {
  bool any = watch_reading();
  any |= play();
  if (auto version = follower_.take()) {
    take_version(std::move(*version));
    any = true;
  }
  if (auto painting = painter_.take_painting()) {
    awaited_until_ = {};
    take_painting(std::move(*painting));
    any = true;
  }
  if (auto problem = editor_.take_problem()) {
    state_.notice = std::move(*problem);
    any = true;
  }
  if (const auto outcome = exporter_.take_outcome()) {
    take_outcome(*outcome);
    any = true;
  }
  while (const auto finding = painter_.take_finding()) {
    take_finding(*finding);
    any = true;
  }
  return any;
}

void Application::take_version(frontend::DesignVersion version) {
  const bool is_shown = version.design != nullptr;
  if (is_shown) tree_ = version.source.tree;
  if (options_.prints_echoes) print_echoes(version);
  if (is_picture_stopped_) ordered_.design.reset();
  end_hover();
  is_moving_ |= state_.version && state_.version->inputs != version.inputs;
  reading_since_ = Clock::now();
  const frontend::DesignCamera camera = version.camera;
  state_.take(std::move(version));
  if (!has_camera_ && !state_.bounds().empty()) {
    const frontend::CameraOptions options = frontend::with_camera_of(camera, options_.camera);
    state_.navigation = Navigation(frontend::choose_camera(options, state_.bounds()),
                                   state_.navigation.projection());
    if (frontend::sees_all(options) && (options.auto_center || !options.camera)) {
      lay_out_panels();
      state_.view_all();
    }
    has_camera_ = true;
    asked_camera_ = camera;
  } else if (state_.version->error.empty()) {
    take_camera(camera);
  }
  update_inputs();  // the new version may lack parameters
  show_title();
  // The picture stays, and the next frame shows what there is to say of the version.
  if (!is_shown) has_new_picture_ = true;
}

/// Follows the camera that the design asks for when it asks for another one, as one does that turns
/// itself with $t.
void Application::take_camera(const frontend::DesignCamera& asked) {
  if (std::exchange(asked_camera_, asked) == asked || options_.camera.camera) return;
  frontend::Camera camera = state_.navigation.camera();
  camera.target = asked.target.value_or(camera.target);
  camera.rotation_deg = asked.rotation_deg.value_or(camera.rotation_deg);
  camera.distance = asked.distance.value_or(camera.distance);
  state_.navigation = Navigation(camera, state_.navigation.projection());
}

/// Returns whether the newest version was read with the newest parameters and time, and openscad
/// renders no more of it.
bool Application::shows_inputs() const {
  return state_.version && state_.version->inputs == inputs_ && !follower_.activity();
}

/// Goes on with the animation, once its last frame was read or given up. Returns whether it did.
bool Application::play() {
  if (!(shows_inputs() || state_.is_stopped) || !state_.animation.advance(Clock::now()))
    return false;
  update_inputs();
  return true;
}

void Application::update_inputs() {
  if (!state_.shows_animation) state_.animation.stop();
  frontend::DesignInputs wanted{state_.customizer.inputs(), std::nullopt, std::nullopt};
  if (state_.language != options_.import.language) wanted.language = state_.language;
  if (state_.animation.frame() > 0) wanted.time = state_.animation.time();
  if (wanted == inputs_) return;
  inputs_ = std::move(wanted);
  follower_.set_inputs(inputs_);
}

void Application::show_title() {
  const bool is_broken = has_error(state_.messages);
  window_.set_title(file_name(options_.input) + (is_broken ? " - error" : "") + " - scadray");
}

void Application::take_painting(Painting painting) {
  if (painting.order.number < oldest_order_) return;  // of a design that is gone
  if (!painting.error.empty()) {
    state_.painting = std::move(painting);
    has_new_picture_ = true;
    return;
  }
  if (painting.order.is_moving) {
    motion_.count(Clock::now());
    state_.frames_per_second = motion_.frames_per_second();
  }
  screen_.load(painting.image);
  if (painting.is_final && saving_ != 0 && painting.order.number == saving_) {
    write_picture(painting);
  }
  painting.image = {};
  shows_version_ = state_.version && painting.order.design == state_.version->design;
  has_new_picture_ |= painting.is_final;
  if (painting.is_final && painting.order.number == ordered_.number) is_picture_stopped_ = false;
  state_.painting = std::move(painting);
}

/// Takes the time from the save to the first picture of its version, which refined ones may follow.
void Application::note_shown() {
  if (!state_.version || state_.version->number == reported_version_) return;
  reported_version_ = state_.version->number;
  save_to_screen_ms_ =
      std::chrono::duration<double, std::milli>(Clock::now() - state_.version->noticed).count();
}

/// Reports the picture that is on the screen.
void Application::report_picture() {
  note_shown();
  report_.write(state_, std::exchange(save_to_screen_ms_, -1));
}

PaintOrder Application::wanted_picture() const {
  PaintOrder order;
  order.design = state_.design;
  order.section = state_.section.is_on ? state_.section : SectionPlane{};
  order.navigation = state_.navigation;
  order.size = window_.size();
  order.settings = state_.look;
  order.overlays = state_.overlays;
  order.overlays.has_gnomon = !state_.shows_orientation;
  order.is_moving = is_moving_;
  return order;
}

void Application::order_picture() {
  PaintOrder order = wanted_picture();
  is_moving_ = false;
  if (!order.design || order.size.width_px == 0) return;
  order.settings.measured_channels = save_path_.ends_with(".exr");
  const bool is_to_be_saved = !save_path_.empty() && saving_ == 0;
  if (show_the_same(order, ordered_) && !is_to_be_saved) return;
  order.number = ordered_.number + 1;
  if (!save_path_.empty()) saving_ = order.number;
  ordered_ = order;
  painter_.order(std::move(order));
  is_picture_stopped_ = false;
  awaited_until_ = Clock::now() + kShortPainting;
}

void Application::save_picture(const std::string& path) {
  save_path_ = path;
  saving_ = 0;
}

/// Exports the design as its file and its parameters are now.
void Application::export_model(const std::string& path) {
  state_.exporting = path;
  exporter_.start(
      {path, options_, inputs_, state_.version ? state_.version->stream : std::nullopt});
}

void Application::take_outcome(const ModelOutcome& outcome) {
  state_.exporting.clear();
  state_.notice = outcome.error.empty() ? "exported " + outcome.path : outcome.error;
  // Most warnings are the design's, which the messages show in any case.
  std::vector<std::string> others;
  for (const std::string& warning : outcome.warnings) {
    const bool is_shown =
        std::any_of(state_.messages.begin(), state_.messages.end(),
                    [&](const Message& message) { return message.text == warning; });
    if (!is_shown) others.push_back(warning);
  }
  if (!others.empty()) state_.notice += '\n' + others.front();
  if (others.size() > 1) state_.notice += " (and " + std::to_string(others.size() - 1) + " more)";
}

void Application::write_picture(const Painting& painting) {
  const std::string path = std::exchange(save_path_, {});
  saving_ = 0;
  try {
    const frontend::NamedPath picture{"a picture", path};
    frontend::check_outputs_differ({&picture, 1}, inputs());
    const frontend::PendingOutput output{
        path, frontend::encode_picture(painting.image, frontend::picture_format(path))};
    frontend::write_outputs({&output, 1});
    state_.notice = "saved " + path;
  } catch (const frontend::Error& error) {
    state_.notice = error.what();
  }
}

/// Returns all files that are known to be read.
std::vector<frontend::NamedPath> Application::inputs() const {
  std::vector<frontend::NamedPath> inputs =
      frontend::design_inputs(options_.input, options_.openscad_arguments);
  if (!state_.version) return inputs;
  for (const std::string& file : state_.version->files) {
    inputs.push_back({"a file of the design", file});
  }
  return inputs;
}

/// Returns the path of the file that a message names, from the folder that it is most likely to
/// begin in; empty: there is no such file.
std::string Application::path_of(const MessagePlace& place) const {
  std::array<std::filesystem::path, 2> paths{
      std::filesystem::path(options_.input).parent_path() / place.file, place.file};
  if (place.is_from_here) std::swap(paths[0], paths[1]);
  for (const std::filesystem::path& path : paths) {
    std::error_code failed;
    if (std::filesystem::is_regular_file(path, failed)) {
      return std::filesystem::absolute(path, failed).string();
    }
  }
  return {};
}

void Application::open_place(const MessagePlace& place) {
  const std::string path = path_of(place);
  state_.notice =
      path.empty() ? kNoFile : editor_.open({path, place.line, std::max(place.column, 1u)});
}

void Application::open_chosen_place() {
  const frontend::SourcePlace* const place = state_.place_to_open();
  if (place == nullptr) {
    state_.notice = "click on the design first: the editor opens the place that is found there";
  } else if (place->path.empty()) {
    state_.notice = kNoFile;
  } else {
    state_.notice = editor_.open({place->path, place->line, place->column});
  }
}

void Application::run_command(Command command) {
  state_.notice.clear();
  if (command == Command::kForgetPoints && is_worth_stopping()) command = Command::kStop;
  if (state_.apply(command)) return;
  if (command == Command::kStop) stop_work();
  if (command == Command::kReload) follower_.reload();
  if (command == Command::kOpenEditor) open_chosen_place();
  if (command == Command::kCopy) copy_measured_or_said(state_);
  if (command == Command::kQuit) window_.close();
}

}  // namespace window
