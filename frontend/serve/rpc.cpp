#include "rpc.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>

namespace serve {
namespace {

/// A longer line is no header.
constexpr std::size_t kLongestLine = std::size_t{1} << 16;

/// Returns the number behind "Content-Length:"; nothing if the line says no such thing, and -1 if
/// it says no number.
std::optional<long long> content_length(std::string_view line) {
  constexpr std::string_view kName = "content-length:";
  if (line.size() < kName.size()) return std::nullopt;
  const auto is_same = [](char known, char c) {
    return known == std::tolower(static_cast<unsigned char>(c));
  };
  if (!std::equal(kName.begin(), kName.end(), line.begin(), is_same)) return std::nullopt;
  line.remove_prefix(kName.size());
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  while (line.ends_with(' ') || line.ends_with('\t')) line.remove_suffix(1);
  long long number = -1;
  const auto [end, failed] = std::from_chars(line.data(), line.data() + line.size(), number);
  return failed == std::errc() && end == line.data() + line.size() ? number : -1;
}

const Json* member(const Json& object, const char* name) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(name);
  return found == object.end() ? nullptr : &*found;
}

bool is_method(const Json& message, const char* method) {
  const Json* const said = member(message, "method");
  return said && *said == method;
}

}  // namespace

bool FrameReader::fill() {
  constexpr std::size_t kRoom = std::size_t{1} << 16;
  buffer_.erase(0, std::exchange(at_, 0));
  const std::size_t size = buffer_.size();
  buffer_.resize(size + kRoom);
  const std::size_t count = source_(buffer_.data() + size, kRoom);
  buffer_.resize(size + count);
  return count > 0;
}

/// Returns the next line without its end; the start of one that is too long, and nothing at the end
/// of the stream.
std::optional<std::string> FrameReader::line() {
  for (;;) {
    const std::size_t end = buffer_.find('\n', at_);
    if (end != buffer_.npos || buffer_.size() - at_ > kLongestLine) {
      const std::size_t stop = std::min(end, buffer_.size());
      std::string result = buffer_.substr(at_, stop - at_);
      at_ = std::min(stop + 1, buffer_.size());
      if (result.ends_with('\r')) result.pop_back();
      return result;
    }
    if (!fill()) return std::nullopt;
  }
}

std::optional<std::string> FrameReader::next() {
  std::optional<long long> length;
  bool has_header = false;
  for (;;) {
    const auto header = line();
    if (!header) return std::nullopt;
    if (const auto found = content_length(*header)) length = found;
    has_header = has_header || header->find(':') != header->npos;
    if (header->empty() && has_header) break;
  }
  if (!length || *length < 0)
    throw RequestError{ErrorCode::kParseError, "a header lacks a Content-Length that is a number"};
  if (static_cast<unsigned long long>(*length) > kMostMessageBytes)
    throw RequestError{ErrorCode::kParseError, "a message is larger than 512 MiB"};
  const auto size = static_cast<std::size_t>(*length);
  while (buffer_.size() - at_ < size)
    if (!fill()) return std::nullopt;
  std::string result = buffer_.substr(at_, size);
  at_ += size;
  return result;
}

std::string framed(const Json& message) {
  const std::string text = message.dump(-1, ' ', false, Json::error_handler_t::replace);
  return "Content-Length: " + std::to_string(text.size()) + "\r\n\r\n" + text;
}

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  const auto byte = [&](std::size_t i) {
    return i < bytes.size() ? std::to_integer<uint32_t>(bytes[i]) : 0;
  };
  std::size_t to = 0;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const uint32_t bits = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    const std::size_t digits = std::min<std::size_t>(bytes.size() - i, 3) + 1;
    for (std::size_t digit = 0; digit < digits; ++digit)
      text[to + digit] = kDigits[bits >> (18 - 6 * digit) & 63];
    to += 4;
  }
  return text;
}

Json response_of(const Json& id, Json result) {
  return {{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}};
}

Json error_of(const Json& id, const RequestError& error) {
  return {{"jsonrpc", "2.0"},
          {"id", id},
          {"error", {{"code", static_cast<int>(error.code)}, {"message", error.message}}}};
}

std::optional<RequestError> problem_of(const Json& message) {
  const auto invalid = [](const char* what) {
    return RequestError{ErrorCode::kInvalidRequest, what};
  };
  if (!message.is_object()) return invalid("a message is an object");
  const Json* const version = member(message, "jsonrpc");
  if (!version || *version != "2.0") return invalid("\"jsonrpc\" is not \"2.0\"");
  const Json* const id = member(message, "id");
  if (id && !id->is_number_integer() && !id->is_string() && !id->is_null())
    return invalid("\"id\" is neither a whole number nor a string");
  const Json* const method = member(message, "method");
  if (!method) {
    const bool is_response = id && (member(message, "result") || member(message, "error"));
    return is_response ? std::nullopt : std::optional(invalid("\"method\" is missing"));
  }
  if (!method->is_string()) return invalid("\"method\" is no string");
  const Json* const params = member(message, "params");
  if (params && !params->is_structured() && !params->is_null())
    return RequestError{ErrorCode::kInvalidParams, "\"params\" is neither an object nor an array"};
  return std::nullopt;
}

void Inbox::put(Item item) {
  constexpr std::size_t kMostItems = 1000;
  std::unique_lock lock(mutex_);
  if (!item.work) {  // what the server itself puts never waits
    has_room_.wait(lock,
                   [this] { return items_.size() < kMostItems && bytes_ < kMostMessageBytes; });
  }
  if (item.message && is_method(*item.message, "$/cancelRequest")) {
    const Json* const params = member(*item.message, "params");
    const Json* const id = params ? member(*params, "id") : nullptr;
    for (Item& waiting : items_) {
      const Json* const own = waiting.message ? member(*waiting.message, "id") : nullptr;
      if (id && own && *own == *id) waiting.is_cancelled = true;
    }
  }
  bytes_ += item.bytes;
  items_.push_back(std::move(item));
  has_items_.notify_one();
}

Inbox::Item Inbox::take() {
  std::unique_lock lock(mutex_);
  has_items_.wait(lock, [this] { return !items_.empty(); });
  Item item = std::move(items_.front());
  items_.pop_front();
  bytes_ -= item.bytes;
  has_room_.notify_one();
  return item;
}

Inbox::Item message_of(std::string_view text) {
  Inbox::Item item;
  item.bytes = text.size();
  try {
    item.message = Json::parse(text);
  } catch (const Json::exception& error) {  // also of numbers that are too large
    item.error = RequestError{ErrorCode::kParseError, error.what()};
  }
  return item;
}

void read_messages(FrameReader& reader, Inbox& inbox) {
  for (;;) {
    Inbox::Item item;
    try {
      const auto text = reader.next();
      if (!text) break;
      item = message_of(*text);
    } catch (const RequestError& error) {
      item.error = error;
    }
    const bool is_exit = item.message && is_method(*item.message, "exit");
    inbox.put(std::move(item));
    if (is_exit) return;
  }
  inbox.put({});
}

}  // namespace serve
