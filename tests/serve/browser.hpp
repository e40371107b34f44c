// A browser of a test: requests and WebSockets over plain sockets, so that they can be wrong.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "rpc.hpp"

namespace serve {

/// A connection to a port of this machine. What is received waits at most a minute.
class Connection {
 public:
  explicit Connection(uint16_t port) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    timeval patience{60, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    is_open_ = connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  Connection(Connection&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)),
        is_open_(other.is_open_),
        buffer_(std::move(other.buffer_)) {}
  ~Connection() {
    if (socket_ >= 0) ::close(socket_);
  }

  int descriptor() const { return socket_; }
  bool send(const std::string& bytes) const {
    for (std::size_t at = 0; at < bytes.size();) {
      const ssize_t count = ::send(socket_, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
      if (count <= 0) return false;
      at += static_cast<std::size_t>(count);
    }
    return is_open_;
  }
  /// Returns so many bytes; fewer at the end.
  std::string take(std::size_t count) {
    while (buffer_.size() < count && fill()) {
    }
    return cut(std::min(count, buffer_.size()));
  }
  /// Returns what comes up to a text; all at the end.
  std::string take_until(const std::string& text) {
    while (buffer_.find(text) == buffer_.npos && fill()) {
    }
    const std::size_t at = buffer_.find(text);
    return cut(at == buffer_.npos ? buffer_.size() : at + text.size());
  }
  std::string rest() { return take_until("\x01never\x02"); }

 private:
  bool fill() {
    char bytes[65536];
    const ssize_t count = recv(socket_, bytes, sizeof bytes, 0);
    if (count > 0) buffer_.append(bytes, static_cast<std::size_t>(count));
    return count > 0;
  }
  std::string cut(std::size_t count) {
    std::string result = buffer_.substr(0, count);
    buffer_.erase(0, count);
    return result;
  }

  int socket_;
  bool is_open_ = false;
  std::string buffer_;
};

/// What a browser adds to its requests; a header that is empty is left out.
struct Headers {
  std::string host, origin{}, others{};
};

inline std::string request_text(const std::string& target, const Headers& headers,
                                const std::string& method = "GET") {
  std::string text = method + " " + target + " HTTP/1.1\r\n";
  if (!headers.host.empty()) text += "Host: " + headers.host + "\r\n";
  if (!headers.origin.empty()) text += "Origin: " + headers.origin + "\r\n";
  return text + headers.others + "\r\n";
}

constexpr const char* kUpgrade =
    "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";

/// Returns a frame of a client, masked with zeros. `kind` is its first byte.
inline std::string client_frame(const std::string& payload, char kind = '\x81') {
  std::string frame{kind};
  constexpr std::size_t kShort = 126, kMedium = 65536;
  const std::size_t size = payload.size();
  const auto add_size = [&](std::size_t bytes) {
    for (std::size_t i = bytes; i-- > 0;) frame += static_cast<char>(size >> (8 * i) & 0xFF);
  };
  if (size < kShort) {
    frame += static_cast<char>(0x80 | size);
  } else if (size < kMedium) {
    frame += static_cast<char>(0x80 | 126);
    add_size(2);
  } else {
    frame += static_cast<char>(0x80 | 127);
    add_size(8);
  }
  return frame + std::string(4, '\0') + payload;
}

/// A message of the server.
struct SocketMessage {
  Json json;
  std::string image;  // of a binary one
};

/// A WebSocket, once its request was answered.
class BrowserSocket {
 public:
  BrowserSocket(uint16_t port, const std::string& target, Headers headers) : connection_(port) {
    headers.others += kUpgrade;
    connection_.send(request_text(target, headers));
    answer_ = connection_.take_until("\r\n\r\n");
  }
  bool is_open() const { return answer_.starts_with("HTTP/1.1 101"); }
  const std::string& answer() const { return answer_; }
  Connection& connection() { return connection_; }

  bool send(Json message) {
    message["jsonrpc"] = "2.0";
    return connection_.send(client_frame(message.dump()));
  }
  /// Returns the next message; nothing at the end.
  std::optional<SocketMessage> receive() {
    for (;;) {
      const std::string head = connection_.take(2);
      if (head.size() < 2) return std::nullopt;
      const auto number = [](const std::string& bytes) {
        std::size_t size = 0;
        for (const char c : bytes) size = size << 8 | static_cast<unsigned char>(c);
        return size;
      };
      std::size_t size = static_cast<unsigned char>(head[1]);
      if (size == 126) size = number(connection_.take(2));
      if (size == 127) size = number(connection_.take(8));
      const std::string payload = connection_.take(size);
      if (payload.size() < size) return std::nullopt;
      if (head[0] == '\x81') return SocketMessage{Json::parse(payload), {}};
      if (head[0] == '\x82') return frame_of(payload);
      if ((head[0] & 0xF) == 8) return std::nullopt;
      if ((head[0] & 0xF) == 9) connection_.send(client_frame(payload, '\x8A'));  // as browsers do
    }
  }
  /// Returns the answer to a request, and drops what comes before.
  Json ask(const std::string& method, const Json& params) {
    send({{"id", ++id_}, {"method", method}, {"params", params}});
    while (auto message = receive()) {
      if (message->json["id"] != id_) continue;
      return message->json.contains("error") ? message->json["error"] : message->json["result"];
    }
    return "closed";
  }
  /// Acknowledges frames up to a final one, and returns that.
  std::optional<SocketMessage> final_frame() {
    while (auto message = receive()) {
      if (message->json["method"] != "scadray/frame") continue;
      const Json& params = message->json["params"];
      send({{"method", "scadray/shown"},
            {"params", {{"preview", params["preview"]}, {"number", params["number"]}}}});
      if (params["final"] == true) return message;
    }
    return std::nullopt;
  }

 private:
  static SocketMessage frame_of(const std::string& payload) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i)
      length |= static_cast<std::size_t>(static_cast<unsigned char>(payload[i])) << (8 * i);
    return {Json::parse(payload.substr(4, length)), payload.substr(4 + length)};
  }

  Connection connection_;
  std::string answer_;
  int id_ = 1 << 20;  // others are the test's own
};

}  // namespace serve
