// Shows a design's preview to browsers: the panel's page and files, and WebSockets, each of which
// is a client of a server of its own.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "http_rules.hpp"
#include "language/language_version.hpp"

namespace serve {

struct HttpOptions {
  std::string design{};  // its path
  language::LanguageVersion language{};
  std::string bind = "127.0.0.1";  // a numeric address
  uint16_t port = 0;               // 0: any that is free
  std::string origin{};            // HttpOrigin's `seen`
  /// A request that does not come in this time, or an answer that is not taken, is given up.
  std::chrono::milliseconds patience = std::chrono::seconds(10);
  /// So is a WebSocket's client that has sent nothing for so long, no pong either.
  std::chrono::milliseconds idle = std::chrono::seconds(60);
};

/// Clients at a time; more are answered 503.
constexpr std::size_t kMostClients = 32;

class HttpServer {
 public:
  /// Listens from now on. Throws frontend::Error.
  HttpServer(HttpOptions options, PanelFiles panel);
  ~HttpServer();

  /// The address to open, with the token.
  std::string address() const;
  bool is_loopback() const;
  /// Answers until stop() was called or, if `ends_at_signals`, the process was asked to end.
  void run(bool ends_at_signals);
  /// May be called by any thread.
  void stop();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace serve
