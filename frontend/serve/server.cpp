#include "server.hpp"

#include <algorithm>
#include <utility>

#include "protocol.hpp"

namespace serve {
namespace {

using language::TextOverlay;

Json capabilities(PositionEncoding encoding) {
  return {
      {"positionEncoding", encoding == PositionEncoding::kUtf8 ? "utf-8" : "utf-16"},
      {"textDocumentSync", {{"openClose", true}, {"change", 2}, {"save", true}}},
      {"completionProvider", {{"triggerCharacters", {"$", "<", "/", "."}}}},
      {"signatureHelpProvider", {{"triggerCharacters", {"(", ","}}}},
      {"hoverProvider", true},
      {"definitionProvider", true},
      {"referencesProvider", true},
      {"documentSymbolProvider", true},
      {"colorProvider", true},
      {"renameProvider", {{"prepareProvider", true}}},
      {"foldingRangeProvider", true},
      {"workspace", {{"workspaceFolders", {{"supported", true}, {"changeNotifications", true}}}}},
  };
}

const Json& document_of(const Json& params) { return member_of(params, "textDocument"); }

std::string key_of(const Json& params) { return key_of_uri(text_of(document_of(params), "uri")); }

}  // namespace

Server::Server(language::LanguageVersion version, Send send, SendFrame send_frame, Post post,
               const std::string& only_design)
    : version_(version),
      send_(std::move(send)),
      post_(std::move(post)),
      shows_one_design_(!only_design.empty()),
      state_(shows_one_design_ ? State::kInitialized : State::kNew),
      workspace_(version, [this](const std::string& key) { notice_document(key); }),
      sources_(workspace_),
      previews_(
          workspace_,
          {send_, std::move(send_frame), post_,
           [this](const std::string& key, const std::string& path) { return uri_of(key, path); },
           [this] { return encoding_; }},
          only_design) {}

const std::map<std::string, Server::Handler, std::less<>>& Server::requests() {
  static const std::map<std::string, Handler, std::less<>> kRequests = {
      {"initialize", &Server::initialize},
      {"shutdown", &Server::shut_down},
      {"textDocument/completion", &Server::complete},
      {"textDocument/signatureHelp", &Server::help_with_signature},
      {"textDocument/hover", &Server::hover_over},
      {"textDocument/definition", &Server::define},
      {"textDocument/references", &Server::refer},
      {"textDocument/documentSymbol", &Server::list_symbols},
      {"textDocument/foldingRange", &Server::list_folds},
      {"textDocument/documentColor", &Server::list_colors},
      {"textDocument/colorPresentation", &Server::spell_color},
      {"textDocument/prepareRename", &Server::prepare_rename},
      {"textDocument/rename", &Server::rename},
  };
  return kRequests;
}

const std::map<std::string, void (Server::*)(const Json&), std::less<>>& Server::notifications() {
  static const std::map<std::string, void (Server::*)(const Json&), std::less<>> kNotifications = {
      {"initialized", &Server::initialized},
      {"textDocument/didOpen", &Server::open},
      {"textDocument/didChange", &Server::change},
      {"textDocument/didSave", &Server::save},
      {"textDocument/didClose", &Server::close},
      {"workspace/didChangeWatchedFiles", &Server::notice_files},
      {"workspace/didChangeWorkspaceFolders", &Server::change_folders},
  };
  return kNotifications;
}

void Server::refuse(const RequestError& error) { send_(error_of(nullptr, error)); }

void Server::handle(const Json& message, bool is_cancelled) {
  const bool has_id = message.is_object() && message.contains("id");
  if (const auto problem = problem_of(message)) {
    const bool is_id = has_id && (message["id"].is_string() || message["id"].is_number_integer());
    return send_(error_of(is_id ? message["id"] : Json(), *problem));
  }
  if (!message.contains("method")) return;  // an answer to what the server has asked
  const std::string method = message["method"];
  const Json& params = find_member(message, {"params"});
  if (!has_id) return take_notice(method, params);
  const Json& id = message["id"];
  try {
    if (is_cancelled) throw RequestError{ErrorCode::kRequestCancelled, "cancelled"};
    check_order(method);
    if (Previews::has_request(method)) {
      const Reply reply{[this, id](Json result) { send_(response_of(id, std::move(result))); },
                        [this, id](const RequestError& error) { send_(error_of(id, error)); }};
      return previews_.request(method, params, reply);
    }
    send_(response_of(id, answer(method, params)));
  } catch (const RequestError& error) {
    send_(error_of(id, error));
  } catch (const std::exception& error) {
    send_(error_of(id, {ErrorCode::kInternalError, error.what()}));
  }
}

bool Server::is_offered(const std::string& method) const {
  if (Previews::has_request(method) || Previews::has_notification(method)) return true;
  if (shows_one_design_) return method == "shutdown";
  return requests().contains(method) || notifications().contains(method);
}

void Server::check_order(const std::string& method) const {
  if (!is_offered(method))
    throw RequestError{ErrorCode::kMethodNotFound, "there is no request " + method};
  const bool is_first = method == "initialize";
  if (state_ == State::kNew && !is_first)
    throw RequestError{ErrorCode::kServerNotInitialized, "the first request is initialize"};
  if (state_ == State::kShutDown || (is_first && state_ != State::kNew))
    throw RequestError{ErrorCode::kInvalidRequest, method + " is out of order"};
}

Json Server::answer(const std::string& method, const Json& params) {
  const auto handler = requests().find(method);
  if (handler == requests().end())
    throw RequestError{ErrorCode::kMethodNotFound, "there is no request " + method};
  return (this->*handler->second)(params);
}

/// A notification has no answer; a wrong one is told of in the client's log.
void Server::take_notice(const std::string& method, const Json& params) {
  if (method == "exit") has_ended_ = true;
  if (state_ != State::kInitialized || !is_offered(method)) return;
  const auto handler = notifications().find(method);
  std::string problem;
  try {
    if (Previews::has_notification(method)) return previews_.notify(method, params);
    if (handler != notifications().end()) (this->*handler->second)(params);
    return;
  } catch (const RequestError& error) {
    problem = error.message;
  } catch (const std::exception& error) {
    problem = error.what();
  }
  constexpr int kError = 1;
  send_({{"jsonrpc", "2.0"},
         {"method", "window/logMessage"},
         {"params", {{"type", kError}, {"message", method + ": " + problem}}}});
}

Json Server::initialize(const Json& params) {
  const Json& encodings = find_member(params, {"capabilities", "general", "positionEncodings"});
  const bool has_utf8 = std::ranges::find(encodings, Json("utf-8")) != encodings.end();
  encoding_ = has_utf8 ? PositionEncoding::kUtf8 : PositionEncoding::kUtf16;
  watches_files_ = find_member(params, {"capabilities", "workspace", "didChangeWatchedFiles",
                                        "dynamicRegistration"}) == true;
  const auto add = [&](const Json& uri) {
    const std::string path = uri.is_string() ? path_of_uri(uri.get<std::string>()) : "-";
    if (path != "-") folders_.insert(path);
  };
  const Json& folders = find_member(params, {"workspaceFolders"});
  if (folders.is_array() && !folders.empty()) {
    for (const Json& folder : folders) add(find_member(folder, {"uri"}));
  } else {
    add(find_member(params, {"rootUri"}));
  }
  sources_.set_folders({folders_.begin(), folders_.end()});
  state_ = State::kInitialized;
  return {{"capabilities", capabilities(encoding_)},
          {"serverInfo", {{"name", "scadray"}, {"version", SCADRAY_VERSION}}}};
}

void Server::initialized(const Json&) {
  if (!watches_files_) return;
  const Json watcher = {{"globPattern", "**/*.scad"}};
  const Json registration = {{"id", "files"},
                             {"method", "workspace/didChangeWatchedFiles"},
                             {"registerOptions", {{"watchers", {watcher}}}}};
  send_({{"jsonrpc", "2.0"},
         {"id", "files"},
         {"method", "client/registerCapability"},
         {"params", {{"registrations", {registration}}}}});
}

Json Server::shut_down(const Json&) {
  state_ = State::kShutDown;
  return nullptr;
}

// Documents.

void Server::open(const Json& params) {
  const Json& document = document_of(params);
  const std::string uri = text_of(document, "uri"), key = key_of_uri(uri);
  auto text = std::make_shared<const Text>(text_of(document, "text"));
  const uint32_t version = number_of(member_of(document, "version"));
  uris_[key] = uri;
  workspace_.open(key, path_of_uri(uri), version, std::move(text));
  sources_.invalidate(true);
}

void Server::change(const Json& params) {
  const std::string key = key_of(params);
  const DocumentPointer document = workspace_.find(key);
  if (!document || !document->is_open) throw invalid("the document is not open");
  const uint32_t version = number_of(member_of(document_of(params), "version"));
  workspace_.change(key, version,
                    changed_text(document->text, member_of(params, "contentChanges"), encoding_));
  sources_.invalidate(false);
  previews_.notice_document(key);
}

void Server::save(const Json& params) {
  sources_.invalidate(true);
  workspace_.notice_change(key_of(params));
}

void Server::close(const Json& params) {
  const std::string key = key_of(params);
  workspace_.close(key);
  told_.erase(uris_[key]);
  uris_.erase(key);
  sources_.invalidate(true);
  publish();
}

void Server::notice_files(const Json& params) {
  sources_.invalidate(true);
  for (const Json& change : member_of(params, "changes"))
    workspace_.notice_change(key_of_uri(text_of(change, "uri")));
}

void Server::change_folders(const Json& params) {
  const Json& event = member_of(params, "event");
  for (const Json& folder : member_of(event, "removed"))
    folders_.erase(path_of_uri(text_of(folder, "uri")));
  for (const Json& folder : member_of(event, "added"))
    folders_.insert(path_of_uri(text_of(folder, "uri")));
  folders_.erase("-");
  sources_.set_folders({folders_.begin(), folders_.end()});
}

// Diagnostics.

std::string Server::uri_of(const std::string& key, const std::string& path) const {
  const auto open = uris_.find(key);
  return open != uris_.end() ? open->second : uri_of_path(path);
}

/// Returns the keys of the documents that others include: as files of their own they would lack
/// what is defined around them.
std::set<std::string> Server::included_documents() {
  std::set<std::string> keys;
  if (uris_.size() < 2) return keys;
  const auto includes = [&](const std::string& from, const std::string& to) {
    const SourcePointer source = sources_.of_document(from);
    return source && std::ranges::any_of(sources_.included(source), [&](const SourcePointer& part) {
             return part->key == to;
           });
  };
  for (const auto& [key, uri] : uris_)
    for (const auto& [other, other_uri] : uris_)
      if (key != other && includes(other, key) && !includes(key, other)) keys.insert(key);
  return keys;
}

/// Adds what a document's evaluation has said, by URI.
void Server::add_diagnostics(const Document& document, std::map<std::string, Json>& all) const {
  std::map<std::string, std::string> uris;  // by path
  const auto uri_of_said = [&](const Said& said) -> const std::string& {
    const auto [known, is_new] = uris.try_emplace(said.path);
    const bool is_own = said.path.empty() || said.path == document.path;
    if (is_new) {
      known->second = is_own ? uri_of(document.key, document.path)
                             : uri_of(TextOverlay::key_of(said.path), said.path);
    }
    return known->second;
  };
  std::vector<std::pair<std::string, Json>> diagnostics;
  for (const Said& said : document.evaluated->said) {
    if (said.group == language::MessageGroup::kEcho || said.group == language::MessageGroup::kPlain)
      continue;
    Json json = json_of(said, encoding_);
    const std::string& uri = uri_of_said(said);
    if (said.group != language::MessageGroup::kTrace) {
      diagnostics.emplace_back(uri, std::move(json));
    } else if (!diagnostics.empty() && said.text) {
      diagnostics.back().second["relatedInformation"].push_back(
          {{"location", {{"uri", uri}, {"range", json["range"]}}}, {"message", said.what}});
    }
  }
  for (auto& [uri, json] : diagnostics) {
    Json& list = all[uri];
    if (std::ranges::find(list, json) == list.end()) list.push_back(std::move(json));
  }
}

/// Has the server's thread tell what there is of a document; called by the workspace.
void Server::notice_document(const std::string& key) {
  {
    const std::lock_guard lock(mutex_);
    changed_.insert(key);
    if (changed_.size() > 1) return;  // that is posted already
  }
  post_([this] {
    std::set<std::string> keys;
    {
      const std::lock_guard lock(mutex_);
      keys = std::exchange(changed_, {});
    }
    for (const std::string& changed : keys) previews_.notice_document(changed);
    publish();
  });
}

/// Sends the diagnostics that have changed.
void Server::publish() {
  std::map<std::string, Json> all;
  for (const auto& [key, uri] : uris_) all[uri] = Json::array();
  const std::set<std::string> included = included_documents();
  for (const DocumentPointer& document : workspace_.documents()) {
    const bool is_shown = document->is_open && document->evaluated;
    if (is_shown && !included.contains(document->key)) add_diagnostics(*document, all);
  }
  for (const auto& [uri, list] : published_)
    if (!list.empty()) all.try_emplace(uri, Json::array());
  for (const auto& [uri, list] : all) {
    const std::string& name = uri;
    const auto open =
        std::ranges::find_if(uris_, [&](const auto& known) { return known.second == name; });
    Json params = {{"uri", uri}, {"diagnostics", list}};
    bool is_new = !published_.contains(uri) || published_[uri] != list;
    if (open != uris_.end()) {
      const DocumentPointer document = workspace_.find(open->first);
      if (!document->evaluated) continue;  // it comes
      params["version"] = document->version;
      // An editor may have dropped what it was told of another version.
      const bool is_current = document->evaluated->text == document->text;
      if (!is_current) continue;
      is_new = is_new || told_[uri] != document->version;
      told_[uri] = document->version;
    }
    if (!is_new) continue;
    published_[uri] = list;
    send_({{"jsonrpc", "2.0"},
           {"method", "textDocument/publishDiagnostics"},
           {"params", std::move(params)}});
  }
  std::erase_if(published_, [&](const auto& known) {
    const bool is_open =
        std::ranges::any_of(uris_, [&](const auto& open) { return open.second == known.first; });
    return known.second.empty() && !is_open;
  });
}

// Features.

Query Server::query_of_document(const Json& params) {
  const SourcePointer source = sources_.of_document(key_of(params));
  if (!source) throw invalid("the document is not open");
  return {sources_, source, 0, version_};
}

Query Server::query_of(const Json& params) {
  Query query = query_of_document(params);
  const Position position = position_of(member_of(params, "position"));
  query.offset = query.source->outline.text->offset_of(position, encoding_);
  return query;
}

Json Server::complete(const Json& params) {
  const Query query = query_of(params);
  const Completions found = completions(query);
  const Json replaced = json_of(range(query, found.replaced));
  Json items = Json::array();
  for (const Completion& completion : found.list) {
    Json item = {{"label", completion.label},
                 {"kind", completion_kind(completion.kind)},
                 {"textEdit", {{"range", replaced}, {"newText", completion.text}}}};
    if (!completion.detail.empty()) item["detail"] = completion.detail;
    if (!completion.about.empty()) item["documentation"] = markup("", completion.about);
    if (completion.is_deprecated) item["tags"] = {1};
    items.push_back(std::move(item));
  }
  return {{"isIncomplete", false}, {"items", std::move(items)}};
}

Json Server::help_with_signature(const Json& params) {
  const auto help = signature_help(query_of(params));
  if (!help) return nullptr;
  Json signatures = Json::array();
  for (const Signature& signature : help->signatures) {
    Json parameters = Json::array();
    for (const Span span : signature.parameters)
      parameters.push_back({{"label", signature.label.substr(span.begin, span.end - span.begin)}});
    Json json = {{"label", signature.label}, {"parameters", std::move(parameters)}};
    if (!signature.about.empty()) json["documentation"] = markup("", signature.about);
    signatures.push_back(std::move(json));
  }
  Json result = {{"signatures", std::move(signatures)}, {"activeSignature", help->active}};
  // Without a number the first would be shown.
  const std::size_t none = help->signatures[help->active].parameters.size();
  result["activeParameter"] = help->active_parameter ? *help->active_parameter : none;
  return result;
}

Json Server::hover_over(const Json& params) {
  const Query query = query_of(params);
  const DocumentPointer document = workspace_.find(query.source->key);
  static const std::map<std::string, std::string, std::less<>> kNoValues;
  const auto found =
      hover(query, document && document->evaluated ? document->evaluated->values : kNoValues);
  if (!found) return nullptr;
  return {{"contents", markup(found->code, found->about)},
          {"range", json_of(range(query, found->span))}};
}

Json Server::locations_of(const std::vector<PlaceInSource>& places) const {
  Json list = Json::array();
  for (const auto& [source, span] : places)
    list.push_back({{"uri", uri_of(source->key, source->path)},
                    {"range", json_of(source->outline.text->range_of(span, encoding_))}});
  return list;
}

Json Server::define(const Json& params) { return locations_of(definitions(query_of(params))); }

Json Server::refer(const Json& params) {
  const bool has_definitions = find_member(params, {"context", "includeDeclaration"}) == true;
  return locations_of(references(query_of(params), has_definitions));
}

Json Server::list_symbols(const Json& params) {
  const Query query = query_of_document(params);
  Json list = Json::array();
  for (const Symbol& symbol : symbols(*query.source))
    list.push_back(json_of(symbol, *query.source->outline.text, encoding_));
  return list;
}

Json Server::list_folds(const Json& params) {
  const Query query = query_of_document(params);
  Json list = Json::array();
  for (const Fold& fold : folds(*query.source)) {
    Json json = {{"startLine", fold.first_line}, {"endLine", fold.last_line}};
    if (fold.kind == Fold::Kind::kComment) json["kind"] = "comment";
    if (fold.kind == Fold::Kind::kImports) json["kind"] = "imports";
    list.push_back(std::move(json));
  }
  return list;
}

Json Server::list_colors(const Json& params) {
  const Query query = query_of_document(params);
  Json list = Json::array();
  for (const ColorPlace& place : colors(*query.source)) {
    const auto& [r, g, b, a] = place.color;
    list.push_back({{"range", json_of(range(query, place.span))},
                    {"color", {{"red", r}, {"green", g}, {"blue", b}, {"alpha", a}}}});
  }
  return list;
}

Json Server::spell_color(const Json& params) {
  const Query query = query_of_document(params);
  const Json& color = member_of(params, "color");
  std::array<double, 4> channels{};
  std::size_t channel = 0;
  for (const char* name : {"red", "green", "blue", "alpha"}) {
    const Json& value = member_of(color, name);
    if (!value.is_number()) throw invalid("a channel is no number");
    channels[channel++] = value;
  }
  const Text& text = *query.source->outline.text;
  const Range place = range_of(member_of(params, "range"));
  const uint32_t begin = text.offset_of(place.start, encoding_);
  const Span span{begin, std::max(begin, text.offset_of(place.end, encoding_))};
  Json list = Json::array();
  for (const std::string& spelled : color_texts(channels, text.at(span)))
    list.push_back(
        {{"label", spelled}, {"textEdit", {{"range", json_of(place)}, {"newText", spelled}}}});
  return list;
}

Json Server::prepare_rename(const Json& params) {
  const Query query = query_of(params);
  const auto found = renaming(query);
  if (const auto* why = std::get_if<std::string>(&found))
    throw RequestError{ErrorCode::kRequestFailed, *why};
  const Span span = std::get<Renaming>(found).span;
  return {{"range", json_of(range(query, span))},
          {"placeholder", query.source->outline.text->at(span)}};
}

Json Server::rename(const Json& params) {
  const Query query = query_of(params);
  const std::string name = text_of(params, "newName");
  const auto found = renaming(query);
  if (const auto* why = std::get_if<std::string>(&found))
    throw RequestError{ErrorCode::kRequestFailed, *why};
  const Renaming& replaced = std::get<Renaming>(found);
  const std::string problem = problem_of_name(query, replaced, name);
  if (!problem.empty()) throw RequestError{ErrorCode::kRequestFailed, problem};
  Json changes = Json::object();
  for (const auto& [source, span] : replaced.places)
    changes[uri_of(source->key, source->path)].push_back(
        {{"range", json_of(source->outline.text->range_of(span, encoding_))}, {"newText", name}});
  return {{"changes", std::move(changes)}};
}

}  // namespace serve
