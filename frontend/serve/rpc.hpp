// JSON-RPC 2.0 as the Language Server Protocol has it: messages behind headers with their length.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace serve {

using Json = nlohmann::json;

/// The protocol's codes of errors.
enum class ErrorCode : int {
  kParseError = -32700,
  kInvalidRequest = -32600,
  kMethodNotFound = -32601,
  kInvalidParams = -32602,
  kInternalError = -32603,
  kServerNotInitialized = -32002,
  kRequestFailed = -32803,
  kRequestCancelled = -32800,
};

/// Ends a request with an error.
struct RequestError {
  ErrorCode code;
  std::string message;
};

/// A longer message is refused. A text of 64 MiB, the largest design, takes up to six times as
/// much.
constexpr std::size_t kMostMessageBytes = std::size_t{512} << 20;

/// Reads messages from a stream that may hold anything.
class FrameReader {
 public:
  /// Reads some bytes, waiting for the first; 0: the stream has ended.
  using Source = std::function<std::size_t(char* bytes, std::size_t room)>;
  explicit FrameReader(Source source) : source_(std::move(source)) {}

  /// Returns the next message's text; nothing at the end of the stream. Lines that are no header
  /// are skipped. Throws RequestError for a header without a length, or with one that is too large,
  /// and can then be called again.
  std::optional<std::string> next();

 private:
  bool fill();
  std::optional<std::string> line();

  Source source_;
  std::string buffer_;
  std::size_t at_ = 0;  // in it
};

/// Returns a message with its header.
std::string framed(const Json& message);

/// Returns bytes in base64 (RFC 4648).
std::string base64(std::span<const std::byte> bytes);

Json response_of(const Json& id, Json result);
Json error_of(const Json& id, const RequestError& error);

/// Returns what is wrong with a message, as far as its form tells.
std::optional<RequestError> problem_of(const Json& message);

/// What waits to be handled, in order. One thread puts, another takes.
class Inbox {
 public:
  struct Item {
    std::optional<Json> message;        // nothing: the stream has ended
    std::optional<RequestError> error;  // in place of a message that could not be read
    std::function<void()> work;         // in place of a message
    bool is_cancelled = false;          // before it was taken
    std::size_t bytes = 0;              // of the message's text
  };

  /// Waits while too much waits. A `$/cancelRequest` cancels the request that it names, if that
  /// waits.
  void put(Item item);
  /// Waits for an item.
  Item take();

 private:
  std::mutex mutex_;
  std::condition_variable has_room_, has_items_;
  std::deque<Item> items_;
  std::size_t bytes_ = 0;
};

/// Returns a message's text as a message, or what is wrong with it.
Inbox::Item message_of(std::string_view text);

/// Reads messages into an inbox until the stream ends, or an `exit` has come.
void read_messages(FrameReader& reader, Inbox& inbox);

}  // namespace serve
