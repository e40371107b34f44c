// The previews of a client, in the words of their protocol (PREVIEW.md).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "preview.hpp"
#include "preview_messages.hpp"
#include "rpc.hpp"
#include "workspace.hpp"

namespace serve {

/// Answers one request, at any time.
struct Reply {
  std::function<void(Json result)> give;
  std::function<void(const RequestError& error)> fail;
};

/// What previews need of the server that they belong to.
struct PreviewClient {
  std::function<void(const Json& notification)> send;
  std::function<void(const Json& notification, const frontend::Bytes& png)> send_frame;
  std::function<void(std::function<void()> work)> post;  // by any thread, to the server's
  std::function<std::string(const std::string& key, const std::string& path)> uri_of;
  std::function<PositionEncoding()> encoding;
};

/// It belongs to the server's thread.
class Previews {
 public:
  /// `only_design` is the path of the one design that may be shown, and beside which files may be
  /// written; empty: there is no such limit.
  Previews(Workspace& workspace, PreviewClient client, std::string only_design);
  ~Previews();

  static bool has_request(const std::string& method);
  static bool has_notification(const std::string& method);
  /// Answers at once or later. Throws RequestError.
  void request(const std::string& method, const Json& params, const Reply& reply);
  void notify(const std::string& method, const Json& params);

  /// Something about a document has changed.
  void notice_document(const std::string& key);

 private:
  struct Open {
    std::string key, uri;
    std::unique_ptr<Preview> preview;
    std::map<uint64_t, std::pair<Reply, std::string>> waiting;  // requests, with their paths
  };
  using Request = void (Previews::*)(uint64_t number, Open& open, const Json& params,
                                     const Reply& reply);
  using Notification = void (Previews::*)(Open& open, const Json& params);

  static const std::map<std::string, Request, std::less<>>& requests();
  static const std::map<std::string, Notification, std::less<>>& notifications();

  void open(const Json& params, const Reply& reply);
  void close(uint64_t number, Open& open, const Json& params, const Reply& reply);
  void view_all(uint64_t number, Open& open, const Json& params, const Reply& reply);
  void pick(uint64_t number, Open& open, const Json& params, const Reply& reply);
  void save_picture(uint64_t number, Open& open, const Json& params, const Reply& reply);
  void export_model(uint64_t number, Open& open, const Json& params, const Reply& reply);
  void tell_source(uint64_t number, Open& open, const Json& params, const Reply& reply);
  void use_set(uint64_t number, Open& open, const Json& params, const Reply& reply);

  void look(Open& open, const Json& params);
  void cursor(Open& open, const Json& params);
  void parameters(Open& open, const Json& params);
  void shown(Open& open, const Json& params);
  void stop(Open& open, const Json& params);

  uint64_t wait(Open& open, const Reply& reply, std::string path);
  std::string output_path(const Open& open, const Json& params) const;
  std::pair<const uint64_t, Open>& find(const Json& params);
  PlaceForms places(const Open& open) const;
  Json design_of(const Open& open, const DesignReading& reading) const;
  void tell_news(uint64_t number);
  void send(const char* method, Json params) const;

  Workspace& workspace_;
  const PreviewClient client_;
  const std::string only_design_;
  uint64_t last_number_ = 0;   // of a preview
  uint64_t last_request_ = 0;  // of one that waits
  std::map<uint64_t, Open> open_;
};

}  // namespace serve
