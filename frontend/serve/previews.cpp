#include "previews.hpp"

#include <malloc.h>

#include <atomic>
#include <filesystem>
#include <system_error>
#include <utility>

#include "frontend/error.hpp"
#include "frontend/options.hpp"

namespace serve {
namespace {

namespace fs = std::filesystem;
using language::TextOverlay;

constexpr const char* kOpen = "scadray/openPreview";
/// Each preview has threads and solids of its own.
constexpr std::size_t kMostPreviews = 16;
constexpr std::size_t kMostWaiting = 100;  // requests of a preview
constexpr double kMostSnap_px = 100;
constexpr double kMostNumber = 9007199254740991;  // of JSON's

RequestError failed(const std::string& what) { return {ErrorCode::kRequestFailed, what}; }

uint64_t whole_number(const Json& params, const char* name) {
  return static_cast<uint64_t>(number_of(params, name, 0, kMostNumber));
}

}  // namespace

Previews::Previews(Workspace& workspace, PreviewClient client, std::string only_design)
    : workspace_(workspace),
      client_(std::move(client)),
      only_design_(only_design.empty() ? "" : TextOverlay::key_of(only_design)) {}

Previews::~Previews() = default;

const std::map<std::string, Previews::Request, std::less<>>& Previews::requests() {
  static const std::map<std::string, Request, std::less<>> kRequests = {
      {"scadray/closePreview", &Previews::close},
      {"scadray/viewAll", &Previews::view_all},
      {"scadray/pick", &Previews::pick},
      {"scadray/savePicture", &Previews::save_picture},
      {"scadray/exportModel", &Previews::export_model},
      {"scadray/parameterSet", &Previews::use_set},
      {"scadray/source", &Previews::tell_source},
  };
  return kRequests;
}

const std::map<std::string, Previews::Notification, std::less<>>& Previews::notifications() {
  static const std::map<std::string, Notification, std::less<>> kNotifications = {
      {"scadray/look", &Previews::look},   {"scadray/cursor", &Previews::cursor},
      {"scadray/stop", &Previews::stop},   {"scadray/parameters", &Previews::parameters},
      {"scadray/shown", &Previews::shown},
  };
  return kNotifications;
}

bool Previews::has_request(const std::string& method) {
  return method == kOpen || requests().contains(method);
}

bool Previews::has_notification(const std::string& method) {
  return notifications().contains(method);
}

std::pair<const uint64_t, Previews::Open>& Previews::find(const Json& params) {
  const auto found = open_.find(whole_number(params, "preview"));
  if (found == open_.end()) throw invalid("there is no such preview");
  return *found;
}

void Previews::request(const std::string& method, const Json& params, const Reply& reply) {
  if (method == kOpen) return open(params, reply);
  auto& [number, preview] = find(params);
  (this->*requests().at(method))(number, preview, params, reply);
}

void Previews::notify(const std::string& method, const Json& params) {
  (this->*notifications().at(method))(find(params).second, params);
}

void Previews::notice_document(const std::string& key) {
  for (auto& [number, open] : open_)
    if (open.key == key) open.preview->notice_document();
}

// Requests.

void Previews::open(const Json& params, const Reply& reply) {
  const std::string uri = text_of(member_of(params, "textDocument"), "uri"), key = key_of_uri(uri);
  Look look;
  change_look(member_of(params, "look"), look);
  if (!only_design_.empty() && key != only_design_)
    throw invalid("this server shows its design alone");
  if (open_.size() == kMostPreviews) throw failed("there are 16 previews; close one");
  if (path_of_uri(uri) == "-" && !workspace_.find(key)) throw invalid("the document is not open");
  try {
    workspace_.follow(key, path_of_uri(uri));
  } catch (const std::runtime_error& error) {
    throw failed(error.what());
  }
  const uint64_t number = ++last_number_;
  const auto is_posted = std::make_shared<std::atomic<bool>>(false);
  const auto on_news = [this, number, is_posted] {
    if (is_posted->exchange(true)) return;
    client_.post([this, number, is_posted] {
      *is_posted = false;
      tell_news(number);
    });
  };
  try {
    auto preview =
        std::make_unique<Preview>(workspace_, workspace_.find(key), std::move(look), on_news);
    open_[number] = {key, uri, std::move(preview), {}};
  } catch (const std::system_error& error) {  // there are no more threads
    workspace_.unfollow(key);
    throw failed(error.what());
  }
  reply.give({{"preview", number}});
}

void Previews::close(uint64_t number, Open& open, const Json&, const Reply& reply) {
  for (const auto& [request, waiting] : open.waiting)
    waiting.first.fail({ErrorCode::kRequestCancelled, "the preview was closed"});
  const std::string key = open.key;
  open_.erase(number);
  workspace_.unfollow(key);
  malloc_trim(0);  // what its pictures have taken goes back to the system
  reply.give(nullptr);
}

void Previews::view_all(uint64_t, Open& open, const Json& params, const Reply& reply) {
  const window::Navigation from = navigation_of(member_of(params, "camera"));
  const auto part = part_of(find_member(params, {"insets"}), open.preview->look().size);
  reply.give({{"camera", json_of(open.preview->view_all(from, part))}});
}

/// Remembers a request that is answered later. Returns the number of that.
uint64_t Previews::wait(Open& open, const Reply& reply, std::string path) {
  if (open.waiting.size() == kMostWaiting) throw failed("too many requests wait");
  open.waiting[++last_request_] = {reply, std::move(path)};
  return last_request_;
}

void Previews::pick(uint64_t, Open& open, const Json& params, const Reply& reply) {
  const window::Navigation navigation = navigation_of(member_of(params, "camera"));
  const window::Size size = open.preview->look().size;
  const window::PicturePoint place{number_of(params, "x", 0, size.width_px),
                                   number_of(params, "y", 0, size.height_px)};
  const double snap_px = params.contains("snap") ? number_of(params, "snap", 0, kMostSnap_px) : 0;
  const uint64_t request = wait(open, reply, {});
  if (open.preview->probe(request, navigation, place, snap_px)) return;
  open.waiting.erase(request);
  reply.give(nullptr);  // there is nothing to be seen yet
}

/// Returns the absolute path of a file that is to be written.
std::string Previews::output_path(const Open& open, const Json& params) const {
  const std::string design = path_of_uri(open.uri);
  fs::path path = text_of(params, "path");
  if (path.empty() || path.native().find('\0') != std::string::npos)
    throw invalid("\"path\" names no file");
  if (path.is_relative()) {
    if (design == "-") throw invalid("\"path\" is not absolute, and the document has no file");
    path = fs::path(design).parent_path() / path;
  }
  if (only_design_.empty()) return path;
  std::error_code failure;
  const fs::path whole = fs::weakly_canonical(path, failure);
  if (failure || whole.parent_path() != fs::path(only_design_).parent_path() ||
      fs::is_symlink(whole, failure))
    throw invalid("files are written beside the design only");
  return whole;
}

void Previews::save_picture(uint64_t, Open& open, const Json& params, const Reply& reply) {
  const std::string path = output_path(open, params);
  try {
    frontend::picture_format(path);
  } catch (const frontend::Error& error) {
    throw invalid(error.what());
  }
  if (!open.preview->reading() || !open.preview->reading()->design)
    throw failed("there is no picture yet");
  open.preview->save_picture(wait(open, reply, path), path);
}

void Previews::export_model(uint64_t, Open& open, const Json& params, const Reply& reply) {
  const std::string path = output_path(open, params);
  try {
    frontend::model_format(path);
  } catch (const frontend::Error& error) {
    throw invalid(error.what());
  }
  const uint64_t request = wait(open, reply, path);
  if (open.preview->export_model(request, path)) return;
  open.waiting.erase(request);
  throw failed("another export is under way");
}

void Previews::tell_source(uint64_t, Open& open, const Json& params, const Reply& reply) {
  const auto text = open.preview->source(key_of_uri(text_of(params, "uri")));
  reply.give(text ? Json{{"text", *text}} : Json());
}

void Previews::use_set(uint64_t number, Open& open, const Json& params, const Reply& reply) {
  const std::string action = text_of(params, "action"), name = text_of(params, "name");
  window::Customizer& customizer = open.preview->customizer();
  if (path_of_uri(open.uri) == "-") throw failed("the document has no file, and so no sets");
  std::string problem;
  if (action == "choose") {
    problem = customizer.choose(name);
  } else if (name.empty()) {
    throw invalid("\"name\" is empty");
  } else if (action == "save") {
    problem = customizer.save(name);
  } else if (action == "erase") {
    problem = customizer.erase(name);
  } else {
    throw invalid("\"action\" is none of \"choose\", \"save\" and \"erase\"");
  }
  open.preview->notice_parameters();
  reply.give({{"problem", problem}});
  if (const auto& reading = open.preview->reading())
    send("scadray/design", {{"preview", number}, {"design", design_of(open, *reading)}});
}

// Notifications.

void Previews::look(Open& open, const Json& params) {
  Look look = open.preview->look();
  change_look(member_of(params, "look"), look);
  open.preview->set_look(std::move(look));
}

void Previews::cursor(Open& open, const Json& params) {
  const Json& position = find_member(params, {"position"});
  if (position.is_null()) return open.preview->set_cursor(std::nullopt);
  const std::string uri = params.contains("uri") ? text_of(params, "uri") : open.uri;
  open.preview->set_cursor(Cursor{key_of_uri(uri), position_of(position), client_.encoding()});
}

void Previews::parameters(Open& open, const Json& params) {
  change_parameters(member_of(params, "values"), open.preview->customizer());
  open.preview->notice_parameters();
}

void Previews::shown(Open& open, const Json& params) {
  open.preview->note_shown(whole_number(params, "number"));
}

void Previews::stop(Open& open, const Json&) { open.preview->stop(); }

// News.

PlaceForms Previews::places(const Open& open) const {
  return {client_.encoding(), [this, &open](const std::string& path) {
            const std::string key = path.empty() ? open.key : TextOverlay::key_of(path);
            return key == open.key ? open.uri : client_.uri_of(key, path);
          }};
}

Json Previews::design_of(const Open& open, const DesignReading& reading) const {
  return json_of(reading, open.preview->customizer(), open.preview->navigation(), places(open));
}

void Previews::send(const char* method, Json params) const {
  client_.send({{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}});
}

void Previews::tell_news(uint64_t number) {
  const auto found = open_.find(number);
  if (found == open_.end()) return;
  Open& open = found->second;
  PreviewNews news = open.preview->take_news();
  if (news.design)
    send("scadray/design", {{"preview", number}, {"design", design_of(open, *news.design)}});
  if (news.progress) {
    send("scadray/progress",
         {{"preview", number}, {"stage", news.progress->stage}, {"ms", news.progress->ms}});
  }
  for (const window::Finding& finding : news.findings) {
    const auto waiting = open.waiting.extract(finding.probe.number);
    if (waiting) waiting.mapped().first.give(json_of(finding, places(open)));
  }
  for (const FileOutcome& outcome : news.outcomes) {
    const auto waiting = open.waiting.extract(outcome.number);
    if (!waiting) continue;
    const auto& [reply, path] = waiting.mapped();
    if (outcome.error.empty())
      reply.give({{"path", path}});
    else
      reply.fail(failed(outcome.error));
  }
  if (news.frame) {
    client_.send_frame(
        {{"jsonrpc", "2.0"}, {"method", "scadray/frame"}, {"params", json_of(*news.frame, number)}},
        news.frame->png);
  }
}

}  // namespace serve
