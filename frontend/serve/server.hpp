// The language server: the protocol's requests, answered by the features.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>

#include "features.hpp"
#include "previews.hpp"
#include "rpc.hpp"
#include "sources.hpp"
#include "workspace.hpp"

namespace serve {

/// Speaks the Language Server Protocol 3.17. It belongs to one thread, but for what it has posted.
class Server {
 public:
  using Send = std::function<void(const Json& message)>;
  /// Sends a message whose parameters lack `data`: the image.
  using SendFrame = std::function<void(const Json& message, const frontend::Bytes& image)>;
  using Post = std::function<void(std::function<void()> work)>;

  /// `send` gets the messages to the client. `post`, which another thread may call, has work done
  /// by the server's thread, in order. With the path of a design it is initialized, and shows that
  /// alone, as it is in its file.
  Server(language::LanguageVersion version, Send send, SendFrame send_frame, Post post,
         const std::string& only_design = "");

  /// Handles a message, and answers it if it is a request. Throws nothing.
  void handle(const Json& message, bool is_cancelled = false);
  /// Answers a message that could not be read.
  void refuse(const RequestError& error);

  bool has_ended() const { return has_ended_; }
  /// Returns whether the client has asked for the end in the protocol's order.
  bool has_shut_down() const { return state_ == State::kShutDown; }
  /// For tests: waits until all that is open has been evaluated.
  void wait_until_evaluated() const { workspace_.wait_until_evaluated(); }

 private:
  enum class State : uint8_t { kNew, kInitialized, kShutDown };
  using Handler = Json (Server::*)(const Json& params);

  static const std::map<std::string, Handler, std::less<>>& requests();
  static const std::map<std::string, void (Server::*)(const Json&), std::less<>>& notifications();

  void check_order(const std::string& method) const;
  bool is_offered(const std::string& method) const;
  Json answer(const std::string& method, const Json& params);
  void take_notice(const std::string& method, const Json& params);

  Json initialize(const Json& params);
  Json shut_down(const Json&);
  void initialized(const Json&);
  void open(const Json& params);
  void change(const Json& params);
  void save(const Json& params);
  void close(const Json& params);
  void notice_files(const Json& params);
  void change_folders(const Json& params);

  Json complete(const Json& params);
  Json help_with_signature(const Json& params);
  Json hover_over(const Json& params);
  Json define(const Json& params);
  Json refer(const Json& params);
  Json list_symbols(const Json& params);
  Json list_folds(const Json& params);
  Json list_colors(const Json& params);
  Json spell_color(const Json& params);
  Json prepare_rename(const Json& params);
  Json rename(const Json& params);

  Query query_of(const Json& params);
  Query query_of_document(const Json& params);
  Range range(const Query& query, Span span) const {
    return query.source->outline.text->range_of(span, encoding_);
  }
  Json locations_of(const std::vector<PlaceInSource>& places) const;
  std::string uri_of(const std::string& key, const std::string& path) const;
  void notice_document(const std::string& key);
  void publish();
  void add_diagnostics(const Document& document, std::map<std::string, Json>& all) const;
  std::set<std::string> included_documents();

  const language::LanguageVersion version_;
  const Send send_;
  const Post post_;
  const bool shows_one_design_;
  State state_;
  bool has_ended_ = false;
  PositionEncoding encoding_ = PositionEncoding::kUtf16;
  bool watches_files_ = false;               // the client can be asked to tell of them
  std::set<std::string> folders_;            // open ones, by path
  std::map<std::string, std::string> uris_;  // of the open documents, by key
  std::map<std::string, Json> published_;    // by URI: what the client shows
  std::map<std::string, int64_t> told_;      // by URI: of which version
  std::mutex mutex_;
  std::set<std::string> changed_;  // documents, by key, of which work has been posted; with mutex_
  Workspace workspace_;
  Sources sources_;
  Previews previews_;
};

}  // namespace serve
