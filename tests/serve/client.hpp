// An editor of a test, which speaks with a server in its own process.
#pragma once

#include <gmock/gmock.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "protocol.hpp"
#include "server.hpp"
#include "temporary_folder.hpp"

namespace serve {

using frontend::TemporaryFolder;

/// A text whose `|` is the cursor.
struct Marked {
  explicit Marked(const std::string& marked) : text(marked) {
    const std::size_t at = text.find('|');
    if (at == text.npos) return;
    text.erase(at, 1);
    position = Text(text).position_of(at, PositionEncoding::kUtf16);
  }
  std::string text;
  Position position;
};

inline Json json_of_position(Position at) {
  return {{"line", at.line}, {"character", at.character}};
}

class Client {
 public:
  explicit Client(language::LanguageVersion version = language::LanguageVersion::k2021,
                  Json capabilities = Json::object(), const std::string& folder = "")
      : server_(
            version, [this](const Json& message) { take(message); },
            [this](Json message, const frontend::Bytes& image) {
              frames.push_back({std::move(message["params"]), image});
            },
            [this](std::function<void()> work) {
              const std::lock_guard lock(mutex_);
              posted_.push_back(std::move(work));
              has_posted_.notify_all();
            }) {
    Json params = {{"capabilities", std::move(capabilities)}};
    if (!folder.empty()) params["rootUri"] = uri_of_path(folder);
    initialized = request("initialize", params);
    notify("initialized", Json::object());
  }

  /// Returns the result; of a request that fails, its error. Some are answered later.
  Json request(const std::string& method, const Json& params) {
    server_.handle({{"jsonrpc", "2.0"}, {"id", ++id_}, {"method", method}, {"params", params}});
    run_until([this] { return answer_["id"] == id_; });
    EXPECT_EQ(answer_["id"], id_) << method;
    return answer_.contains("error") ? answer_["error"] : answer_["result"];
  }
  /// Does what is posted until something holds. Returns whether it does.
  bool run_until(const std::function<bool()>& is_done) {
    while (!is_done()) {
      std::unique_lock lock(mutex_);
      constexpr std::chrono::seconds kLong{60};
      if (!has_posted_.wait_for(lock, kLong, [this] { return !posted_.empty(); })) return false;
      const std::function<void()> work = std::move(posted_.front());
      posted_.pop_front();
      lock.unlock();
      work();
    }
    return true;
  }
  void notify(const std::string& method, const Json& params) {
    server_.handle({{"jsonrpc", "2.0"}, {"method", method}, {"params", params}});
  }

  void open(const std::string& path, const std::string& text) {
    notify(
        "textDocument/didOpen",
        {{"textDocument",
          {{"uri", uri_of_path(path)}, {"languageId", "scad"}, {"version", 1}, {"text", text}}}});
  }
  /// Opens a text as the file, or replaces it, and returns what a request says at its cursor.
  Json ask(const std::string& method, const std::string& path, const std::string& marked,
           Json params = Json::object()) {
    const Marked text(marked);
    open(path, text.text);
    params["textDocument"] = {{"uri", uri_of_path(path)}};
    params["position"] = json_of_position(text.position);
    return request("textDocument/" + method, params);
  }
  void change(const std::string& path, int version, const Json& changes) {
    notify("textDocument/didChange",
           {{"textDocument", {{"uri", uri_of_path(path)}, {"version", version}}},
            {"contentChanges", changes}});
  }
  void close(const std::string& path) {
    notify("textDocument/didClose", {{"textDocument", {{"uri", uri_of_path(path)}}}});
  }

  /// Waits until all is evaluated. Then `diagnostics` are those that an editor would show.
  void settle() {
    server_.wait_until_evaluated();
    for (;;) {
      std::function<void()> work;
      {
        const std::lock_guard lock(mutex_);
        if (posted_.empty()) return;
        work = std::move(posted_.front());
        posted_.pop_front();
      }
      work();
    }
  }
  /// Returns the diagnostics of a file: "line:column-line:column message", counted from 0.
  std::vector<std::string> said(const std::string& path) {
    settle();
    std::vector<std::string> lines;
    for (const Json& diagnostic : diagnostics[uri_of_path(path)])
      lines.push_back(place(diagnostic["range"]) + " " + diagnostic["message"].get<std::string>());
    return lines;
  }
  static std::string place(const Json& range) {
    const auto position = [](const Json& at) {
      return std::to_string(at["line"].get<int>()) + ":" +
             std::to_string(at["character"].get<int>());
    };
    return position(range["start"]) + "-" + position(range["end"]);
  }

  Server& server() { return server_; }

  Json initialized;
  std::map<std::string, Json> diagnostics;  // by URI
  std::vector<Json> sent;                   // all else that was no answer
  struct Frame {
    Json params;
    frontend::Bytes image;
  };
  std::vector<Frame> frames;

 private:
  void take(const Json& message) {
    if (message.contains("method") && message["method"] == "textDocument/publishDiagnostics")
      diagnostics[message["params"]["uri"]] = message["params"]["diagnostics"];
    else if (message.contains("method"))
      sent.push_back(message);
    else
      answer_ = message;
  }

  std::mutex mutex_;
  std::condition_variable has_posted_;
  std::deque<std::function<void()>> posted_;
  int id_ = 0;
  Json answer_;
  Server server_;
};

}  // namespace serve
