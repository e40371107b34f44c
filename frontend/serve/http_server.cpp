#include "http_server.hpp"

#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <condition_variable>
#include <csignal>
#include <cstring>
#include <deque>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "protocol.hpp"
#include "rpc.hpp"
#include "server.hpp"

namespace serve {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;

constexpr uint32_t kMostHeaderBytes = 8192;
constexpr std::size_t kMostMessage = std::size_t{1} << 20;  // from a browser
/// What waits for a client that reads slowly; its server then waits, too.
constexpr std::size_t kMostWaiting = std::size_t{8} << 20;
/// Connections at a time, those of clients included. Others are closed at once.
constexpr std::size_t kMostConnections = 256;

using Response = http::response<http::string_body>;

/// A message to a client.
struct Outgoing {
  std::string bytes;
  bool is_binary = false;
};

std::string text_of_json(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Returns a frame as PREVIEW.md has it: the length of the JSON, the JSON, the image.
std::string frame_message(const Json& json, const frontend::Bytes& image) {
  const std::string text = text_of_json(json);
  std::string message;
  message.reserve(sizeof(uint32_t) + text.size() + image.size());
  for (std::size_t shift = 0; shift < 32; shift += 8)
    message += static_cast<char>(text.size() >> shift & 0xFF);
  message += text;
  message.append(reinterpret_cast<const char*>(image.data()), image.size());
  return message;
}

/// A browser's WebSocket, and the server that it speaks with, which has a thread of its own. One
/// message is handled at a time: the next is read after it.
class SocketClient : public std::enable_shared_from_this<SocketClient> {
 public:
  using Socket = websocket::stream<beast::tcp_stream>;
  using OnEnd = std::function<void(const std::shared_ptr<SocketClient>&)>;

  SocketClient(beast::tcp_stream stream, const HttpOptions& options, OnEnd on_end)
      : socket_(std::move(stream)),
        work_(asio::make_work_guard(socket_.get_executor())),
        options_(options),
        on_end_(std::move(on_end)) {}

  /// Answers the request for a WebSocket.
  void start(const http::request<http::empty_body>& request) {
    beast::tcp_stream& stream = beast::get_lowest_layer(socket_);
    stream.expires_never();  // the WebSocket has times of its own
    beast::error_code ignored;
    stream.socket().set_option(tcp::no_delay(true), ignored);
    socket_.auto_fragment(false);
    socket_.set_option(websocket::stream_base::timeout{options_.patience, options_.idle, true});
    socket_.read_message_max(kMostMessage);
    thread_ = std::thread([self = shared_from_this()] { self->serve_client(); });
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return self->close();
      self->is_open_ = true;
      self->read();
      self->write();
    });
  }

  /// Ends it, from the network's thread.
  void close() {
    beast::get_lowest_layer(socket_).close();
    {
      const std::lock_guard lock(mutex_);
      if (std::exchange(is_closed_, true)) return;
    }
    has_room_.notify_all();
    inbox_.put({});
  }

  void join() { thread_.join(); }

 private:
  // The network's thread.

  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->close();
      self->take_message();
    });
  }

  void take_message() {
    Inbox::Item item = message_of(beast::buffers_to_string(buffer_.data()));
    buffer_.consume(buffer_.size());
    inbox_.put(std::move(item));
  }

  void write() {
    {
      const std::lock_guard lock(mutex_);
      if (!is_open_ || is_writing_ || waiting_.empty() || is_closed_) return;
      is_writing_ = true;
      writing_ = std::move(waiting_.front());
      waiting_.pop_front();
    }
    socket_.binary(writing_.is_binary);
    socket_.async_write(asio::buffer(writing_.bytes),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          self->note_written();
                          if (error) return self->close();
                          self->write();
                        });
  }

  void note_written() {
    {
      const std::lock_guard lock(mutex_);
      is_writing_ = false;
      waiting_bytes_ -= writing_.bytes.size();
    }
    has_room_.notify_all();
  }

  // The server's thread.

  /// Waits while too much waits for the client.
  void send(Outgoing message) {
    {
      std::unique_lock lock(mutex_);
      has_room_.wait(lock, [this] { return is_closed_ || waiting_bytes_ < kMostWaiting; });
      if (is_closed_) return;
      waiting_bytes_ += message.bytes.size();
      waiting_.push_back(std::move(message));
    }
    asio::post(socket_.get_executor(), [self = shared_from_this()] { self->write(); });
  }

  void serve_client() {
    {
      Server server(
          options_.language,
          [this](const Json& message) {
            send({text_of_json(message), false});
          },
          [this](const Json& message, const frontend::Bytes& image) {
            send({frame_message(message, image), true});
          },
          [this](std::function<void()> work) {
            Inbox::Item item;
            item.work = std::move(work);
            inbox_.put(std::move(item));
          },
          options_.design);
      while (!server.has_ended()) {
        const Inbox::Item item = inbox_.take();
        if (item.work) {
          item.work();
          continue;
        }
        if (item.error)
          server.refuse(*item.error);
        else if (item.message)
          server.handle(*item.message, false);
        else
          break;
        asio::post(socket_.get_executor(), [self = shared_from_this()] { self->read(); });
      }
    }
    asio::post(socket_.get_executor(), [self = shared_from_this()] {
      self->close();
      self->on_end_(self);
      self->work_.reset();
    });
  }

  Socket socket_;
  asio::executor_work_guard<Socket::executor_type> work_;
  const HttpOptions& options_;
  const OnEnd on_end_;
  beast::flat_buffer buffer_;
  Outgoing writing_;
  bool is_open_ = false;
  Inbox inbox_;
  std::thread thread_;

  std::mutex mutex_;  // of the following
  std::condition_variable has_room_;
  std::deque<Outgoing> waiting_;
  std::size_t waiting_bytes_ = 0;  // with what is being written
  bool is_writing_ = false;
  bool is_closed_ = false;
};

}  // namespace

class HttpServer::Impl {
 public:
  Impl(HttpOptions options, PanelFiles panel)
      : options_(std::move(options)),
        panel_(std::move(panel)),
        token_(random_token()),
        acceptor_(context_),
        signals_(context_) {
    frontend::check_input(options_.design);
    options_.design = std::filesystem::absolute(options_.design).lexically_normal().string();
    listen();
  }

  ~Impl() {
    stop();
    run(false);
  }

  std::string address() const { return origin_->address() + "/?token=" + token_; }
  bool is_loopback() const { return is_loopback_; }

  void run(bool ends_at_signals) {
    if (ends_at_signals) {
      signals_.add(SIGINT);
      signals_.add(SIGTERM);
      signals_.async_wait([this](beast::error_code error, int) {
        if (!error) end();
      });
    }
    context_.restart();
    context_.run();
  }

  void stop() {
    asio::post(context_, [this] { end(); });
  }

 private:
  /// A connection, until it becomes a client's.
  class Connection : public std::enable_shared_from_this<Connection> {
   public:
    Connection(Impl& server, tcp::socket socket) : server_(server), stream_(std::move(socket)) {
      server_.connections_.insert(this);
    }
    ~Connection() { server_.connections_.erase(this); }

    void read() {
      parser_.emplace();
      parser_->header_limit(kMostHeaderBytes);
      parser_->body_limit(0);
      stream_.expires_after(server_.options_.patience);
      http::async_read(
          stream_, buffer_, *parser_,
          [self = shared_from_this()](beast::error_code error, std::size_t) { self->take(error); });
    }

    void close() { stream_.close(); }

   private:
    void take(beast::error_code error) {
      if (error == http::error::end_of_stream || error == beast::error::timeout) return close();
      if (error == http::error::header_limit)
        return answer(server_.plain(http::status::request_header_fields_too_large, false));
      if (error) return answer(server_.plain(http::status::bad_request, false));
      const auto& request = parser_->get();
      const HttpTarget target = http_target({request.target().data(), request.target().size()});
      if (const auto refusal = server_.refusal(request, target))
        return answer(server_.plain(*refusal, request.keep_alive()));
      if (target.path == "/socket") {
        server_.start_client(std::move(stream_), request);
        return;
      }
      answer(server_.response(request, target));
    }

    void answer(Response response) {
      response_ = std::move(response);
      response_.prepare_payload();
      stream_.expires_after(server_.options_.patience);
      http::async_write(stream_, response_,
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          if (error || self->response_.need_eof()) return self->end();
                          self->read();
                        });
    }

    void end() {
      beast::error_code ignored;
      stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
      stream_.close();
    }

    Impl& server_;
    beast::tcp_stream stream_;
    beast::flat_buffer buffer_{std::size_t{4} * kMostHeaderBytes};
    std::optional<http::request_parser<http::empty_body>> parser_;
    Response response_;
  };

  void listen() {
    beast::error_code failed;
    const asio::ip::address address = asio::ip::make_address(options_.bind, failed);
    if (failed)
      throw frontend::Error("", {}, "--bind=" + options_.bind + " is no numeric address",
                            "give one like 127.0.0.1");
    try {
      const tcp::endpoint endpoint(address, options_.port);
      acceptor_.open(endpoint.protocol());
      acceptor_.set_option(asio::socket_base::reuse_address(true));
      acceptor_.bind(endpoint);
      acceptor_.listen();
    } catch (const boost::system::system_error& error) {
      throw frontend::Error("", {},
                            "cannot listen at port " + std::to_string(options_.port) + " of " +
                                options_.bind + ": " + error.code().message(),
                            "give another port");
    }
    is_loopback_ = address.is_loopback();
    origin_.emplace(address.to_string(), acceptor_.local_endpoint().port(), is_loopback_,
                    options_.origin);
    accept();
  }

  void accept() {
    acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
      if (!acceptor_.is_open()) return;
      // Without a descriptor for one more connection, the others have to end first.
      if (error) return wait_to_accept();
      if (connections_.size() + clients_.size() < kMostConnections)
        std::make_shared<Connection>(*this, std::move(socket))->read();
      accept();
    });
  }

  void wait_to_accept() {
    pause_.expires_after(std::chrono::milliseconds(100));
    pause_.async_wait([this](beast::error_code) {
      if (acceptor_.is_open()) accept();
    });
  }

  /// Returns why a request is not answered; nothing: it is.
  std::optional<http::status> refusal(const http::request<http::empty_body>& request,
                                      const HttpTarget& target) const {
    if (request.count(http::field::host) != 1 || request.count(http::field::origin) > 1)
      return http::status::forbidden;
    const auto view = [](beast::string_view text) {
      return std::string_view(text.data(), text.size());
    };
    std::optional<std::string_view> origin;
    if (request.count(http::field::origin) == 1) origin = view(request[http::field::origin]);
    if (!origin_->accepts(view(request[http::field::host]), origin)) return http::status::forbidden;
    const bool is_public = target.path.starts_with(kPanel);
    if (!is_public && !are_same_secrets(target.token, token_)) return http::status::forbidden;
    if (request.method() != http::verb::get) return http::status::method_not_allowed;
    if (target.path != "/socket") return std::nullopt;
    if (!websocket::is_upgrade(request)) return http::status::upgrade_required;
    if (clients_.size() >= kMostClients) return http::status::service_unavailable;
    return std::nullopt;
  }

  Response plain(http::status status, bool keeps_alive) const {
    Response response{status, 11};
    set_policy(response);
    response.set(http::field::content_type, "text/plain; charset=utf-8");
    response.body() = std::string(http::obsolete_reason(status)) + "\n";
    response.keep_alive(keeps_alive);
    return response;
  }

  Response response(const http::request<http::empty_body>& request,
                    const HttpTarget& target) const {
    PanelFiles::File page;
    const PanelFiles::File* file = nullptr;
    if (target.path == "/") {
      page = {"text/html; charset=utf-8", panel_.page(uri_of_path(options_.design))};
      file = &page;
    } else if (target.path.starts_with(kPanel)) {
      file = panel_.find(target.path.substr(kPanel.size()));
    }
    if (!file) return plain(http::status::not_found, request.keep_alive());
    Response response = plain(http::status::ok, request.keep_alive());
    response.set(http::field::content_type, file->type);
    response.body() = file->bytes;
    return response;
  }

  /// Lets the page load its own files alone, and shows it in no other.
  void set_policy(Response& response) const {
    response.set("Content-Security-Policy",
                 "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: "
                 "data:; connect-src 'self' " +
                     origin_->socket_address() +
                     "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.set(http::field::cache_control, "no-store");
  }

  void start_client(beast::tcp_stream stream, const http::request<http::empty_body>& request) {
    const auto client = std::make_shared<SocketClient>(
        std::move(stream), options_, [this](const std::shared_ptr<SocketClient>& ended) {
          ended->join();
          clients_.erase(ended);
        });
    clients_.insert(client);
    client->start(request);
  }

  /// Ends all, in the network's thread.
  void end() {
    beast::error_code ignored;
    acceptor_.close(ignored);
    signals_.cancel(ignored);
    pause_.cancel();
    for (Connection* const connection : std::set<Connection*>(connections_)) connection->close();
    for (const auto& client : std::set<std::shared_ptr<SocketClient>>(clients_)) client->close();
  }

  static constexpr std::string_view kPanel = "/panel/";

  HttpOptions options_;
  const PanelFiles panel_;
  const std::string token_;
  asio::io_context context_{1};  // one thread has the network
  tcp::acceptor acceptor_;
  asio::signal_set signals_;
  asio::steady_timer pause_{context_};
  std::optional<HttpOrigin> origin_;
  bool is_loopback_ = true;
  std::set<Connection*> connections_;
  std::set<std::shared_ptr<SocketClient>> clients_;
};

HttpServer::HttpServer(HttpOptions options, PanelFiles panel)
    : impl_(std::make_unique<Impl>(std::move(options), std::move(panel))) {}
HttpServer::~HttpServer() = default;

std::string HttpServer::address() const { return impl_->address(); }
bool HttpServer::is_loopback() const { return impl_->is_loopback(); }
void HttpServer::run(bool ends_at_signals) { impl_->run(ends_at_signals); }
void HttpServer::stop() { impl_->stop(); }

}  // namespace serve
