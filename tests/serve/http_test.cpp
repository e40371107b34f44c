// The server for browsers: what it shows, what it refuses, and that nothing makes it fail.
#include <gmock/gmock.h>

#include <charconv>
#include <random>
#include <thread>

#include "browser.hpp"
#include "frontend/error.hpp"
#include "http_server.hpp"
#include "protocol.hpp"
#include "resident_bytes.hpp"
#include "support/full_run.hpp"
#include "temporary_folder.hpp"

namespace serve {
namespace {

using frontend::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class HttpTest : public testing::Test {
 protected:
  explicit HttpTest(HttpOptions options = {}, std::size_t script_bytes = 2) {
    folder_.write("a.scad", "include <b.scad>\ncube(size);");
    folder_.write("b.scad", "size = 5;\n");
    folder_.write("secret.scad", "secret = 1;\n");
    panel_.write("index.html", "<html><head></head></html>");
    panel_.write("panel.js", std::string(script_bytes, ';'));
    options.design = folder_ / "a.scad";
    server_.emplace(std::move(options), PanelFiles(panel_.path()));
    const std::string address = server_->address();
    const std::size_t colon = address.rfind(':');
    std::from_chars(address.data() + colon + 1, address.data() + address.size(), port_);
    token_ = address.substr(address.find("token=") + 6);
    host_ = "127.0.0.1:" + std::to_string(port_);
    thread_ = std::thread([this] { server_->run(false); });
  }
  ~HttpTest() override {
    server_->stop();
    thread_.join();
  }

  /// Returns the whole answer to a request, after which the connection ends.
  std::string answer(const std::string& text) const {
    Connection connection(port_);
    connection.send(text);
    return connection.rest();
  }
  std::string get(const std::string& target, Headers headers, const char* method = "GET") const {
    headers.others += "Connection: close\r\n";
    return answer(request_text(target, headers, method));
  }
  std::string get(const std::string& target) const { return get(target, {host_}); }
  BrowserSocket socket() const {
    return {port_, "/socket?token=" + token_, {host_, "http://" + host_}};
  }
  Json open(BrowserSocket& socket, const std::string& path) const {
    return socket.ask("scadray/openPreview",
                      {{"textDocument", {{"uri", uri_of_path(path)}}},
                       {"look", {{"width", 80}, {"height", 60}, {"shading", "flat"}}}});
  }
  Json open(BrowserSocket& socket) const { return open(socket, folder_ / "a.scad"); }
  /// A client that comes now is served.
  void expect_service() const {
    BrowserSocket client = socket();
    ASSERT_TRUE(client.is_open()) << client.answer();
    EXPECT_EQ(open(client)["preview"], 1);
    EXPECT_TRUE(client.final_frame());
  }

  TemporaryFolder folder_, panel_;
  std::optional<HttpServer> server_;
  uint16_t port_ = 0;
  std::string token_, host_;
  std::thread thread_;
};

TEST_F(HttpTest, ShowsThePage) {
  EXPECT_THAT(server_->address(), StartsWith("http://127.0.0.1:"));
  EXPECT_TRUE(server_->is_loopback());
  const std::string page = get("/?token=" + token_);
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200 OK\r\n"));
  EXPECT_THAT(page, HasSubstr("content=\"" + uri_of_path(folder_ / "a.scad") + "\""));
  EXPECT_THAT(page, HasSubstr("Content-Type: text/html; charset=utf-8"));
  EXPECT_THAT(page, HasSubstr("Content-Security-Policy: default-src 'none'; script-src 'self'; "));
  EXPECT_THAT(page, HasSubstr("connect-src 'self' ws://" + host_ + ";"));
  EXPECT_THAT(page, HasSubstr("Referrer-Policy: no-referrer"));
  EXPECT_THAT(get("/panel/panel.js"), HasSubstr("text/javascript"));
  EXPECT_THAT(get("/panel/none.js"), StartsWith("HTTP/1.1 404"));
}

TEST_F(HttpTest, RefusesWithoutTheToken) {
  const std::string wrong(token_.size(), '0');
  for (const std::string& target : std::vector<std::string>{
           "/", "/?token=", "/?token=" + wrong, "/?token=" + token_ + "0", "/none", "/socket"}) {
    EXPECT_THAT(get(target), StartsWith("HTTP/1.1 403")) << target;
    EXPECT_FALSE(BrowserSocket(port_, target, {host_}).is_open()) << target;
  }
}

TEST_F(HttpTest, RefusesOtherHostsAndOrigins) {
  const std::string target = "/?token=" + token_, socket = "/socket?token=" + token_;
  const Headers wrong[] = {{"evil.example"},
                           {"evil.example:" + std::to_string(port_)},
                           {""},
                           {"127.0.0.1"},
                           {host_, "http://evil.example"},
                           {host_, "null"},
                           {host_, "https://" + host_},
                           {host_, "", "Host: evil.example\r\n"},
                           {host_, "http://" + host_, "Origin: http://evil.example\r\n"}};
  for (const Headers& headers : wrong) {
    const std::string about = headers.host + " " + headers.origin + " " + headers.others;
    EXPECT_THAT(get(target, headers), StartsWith("HTTP/1.1 403")) << about;
    EXPECT_THAT(get("/panel/panel.js", headers), StartsWith("HTTP/1.1 403")) << about;
    EXPECT_THAT(BrowserSocket(port_, socket, headers).answer(), StartsWith("HTTP/1.1 403"))
        << about;
  }
  EXPECT_THAT(get(target, {"localhost:" + std::to_string(port_)}), StartsWith("HTTP/1.1 200"));
}

TEST_F(HttpTest, ReadsNoOtherFiles) {
  for (const char* path : {"/panel/../../etc/passwd", "/panel/%2e%2e/%2e%2e/etc/passwd",
                           "/panel//etc/passwd", "/panel/..%2f..%2fetc/passwd", "/panel/.",
                           "/panel/", "/panel/panel.js/", "/panel/\\..\\a"}) {
    EXPECT_THAT(get(path), StartsWith("HTTP/1.1 404")) << path;
  }
  const std::string token = "?token=" + token_;
  EXPECT_THAT(get("/a.scad" + token), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(get("/etc/passwd" + token), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(get("http://" + host_ + "/" + token), Not(HasSubstr("200 OK")));
}

TEST_F(HttpTest, RefusesWhatIsTooLongOrNoRequest) {
  EXPECT_THAT(get("/" + std::string(20000, 'a')), StartsWith("HTTP/1.1 431"));
  EXPECT_THAT(get("/", {host_, "", "X: " + std::string(20000, 'a') + "\r\n"}),
              StartsWith("HTTP/1.1 431"));
  EXPECT_THAT(get("/", {host_, "", "Content-Length: 9\r\n"}), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(answer("GET / HTTP/9.9\r\n\r\n"), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(answer("\x16\x03\x01 hello\r\n\r\n"), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(get("/?token=" + token_, {host_}, "POST"), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(get("/socket?token=" + token_), StartsWith("HTTP/1.1 426"));
  expect_service();
}

TEST_F(HttpTest, ShowsTheDesignAndFollowsIt) {
  BrowserSocket client = socket();
  ASSERT_TRUE(client.is_open()) << client.answer();
  EXPECT_EQ(open(client)["preview"], 1);
  const auto first = client.final_frame();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->json["params"]["width"], 80);
  EXPECT_THAT(first->image, StartsWith("\x89PNG"));
  EXPECT_FALSE(first->json["params"].contains("data"));
  folder_.write("b.scad", "size = 3;\n");
  const auto second = client.final_frame();
  ASSERT_TRUE(second);
  EXPECT_NE(first->image, second->image);
}

TEST_F(HttpTest, ShowsItsDesignAlone) {
  BrowserSocket client = socket();
  for (const std::string& path :
       {folder_ / "secret.scad", folder_ / "b.scad", std::string("/etc/passwd")})
    EXPECT_EQ(open(client, path)["code"], -32602) << path;
  EXPECT_EQ(
      open(client, folder_ / "../" + std::filesystem::path(folder_.path()).filename().string() +
                       "/a.scad")["preview"],
      1);
  ASSERT_TRUE(client.final_frame());
  const Json document = {{"uri", uri_of_path(folder_ / "a.scad")},
                         {"version", 9},
                         {"text", "include <secret.scad>\necho(secret);"}};
  client.send({{"method", "textDocument/didOpen"}, {"params", {{"textDocument", document}}}});
  EXPECT_EQ(client.ask("textDocument/completion",
                       {{"textDocument", document},
                        {"position", json_of({{0, 0}, {0, 0}})["start"]}})["code"],
            -32601);
  EXPECT_EQ(client.ask("initialize", Json::object())["code"], -32601);
  const auto source = [&](const std::string& path) {
    return client.ask("scadray/source", {{"preview", 1}, {"uri", uri_of_path(path)}});
  };
  EXPECT_THAT(source(folder_ / "a.scad")["text"].get<std::string>(), StartsWith("include <b"));
  EXPECT_EQ(source(folder_ / "b.scad")["text"], "size = 5;\n");
  EXPECT_EQ(source(folder_ / "secret.scad"), nullptr);
}

TEST_F(HttpTest, WritesBesideTheDesignAlone) {
  const TemporaryFolder other;
  std::filesystem::create_directory_symlink(other.path(), folder_ / "link");
  std::filesystem::create_symlink(other / "c.png", folder_ / "c.png");
  BrowserSocket client = socket();
  open(client);
  ASSERT_TRUE(client.final_frame());
  const auto save = [&](const std::string& path) {
    return client.ask("scadray/savePicture", {{"preview", 1}, {"path", path}});
  };
  for (const std::string& path :
       {other / "a.png", std::string("../a.png"), std::string("link/a.png"), std::string("c.png"),
        std::string("a.png\0.png", 10)}) {
    EXPECT_EQ(save(path)["code"], -32602) << path;
  }
  EXPECT_EQ(client.ask("scadray/exportModel", {{"preview", 1}, {"path", "../a.stl"}})["code"],
            -32602);
  EXPECT_TRUE(other.names().empty());
  EXPECT_EQ(client.ask("scadray/exportModel", {{"preview", 1}, {"path", "a.stl"}})["path"],
            std::filesystem::weakly_canonical(folder_ / "a.stl").string());
  EXPECT_TRUE(folder_.has("a.stl"));
}

int descriptors() {
  const std::filesystem::directory_iterator all("/proc/self/fd");
  return static_cast<int>(std::distance(begin(all), end(all)));
}

/// A server that is soon impatient.
class ImpatientHttpTest : public HttpTest {
 protected:
  static constexpr std::size_t kScriptBytes = std::size_t{30} << 20;  // no buffer holds that

  ImpatientHttpTest()
      : HttpTest(
            {.patience = std::chrono::milliseconds(200), .idle = std::chrono::milliseconds(400)},
            kScriptBytes),
        descriptors_(descriptors()) {}

  /// The server closes all connections; those of the test's own side are still open.
  void expect_closed(int own) const {
    int open = 0;
    for (int i = 0; i < 600; ++i) {
      open = descriptors() - descriptors_;
      if (open <= own) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    EXPECT_EQ(open, own);
  }

 private:
  const int descriptors_;  // before any client
};

TEST_F(ImpatientHttpTest, ClosesWhatSaysNothing) {
  Connection silent(port_), half(port_), kept(port_);
  half.send("GET / HTTP/1.1\r\nHost: ");
  kept.send(request_text("/?token=" + token_, {host_}));
  EXPECT_THAT(kept.take_until("</html>"), StartsWith("HTTP/1.1 200"));
  expect_closed(3);
  EXPECT_EQ(silent.rest(), "");
  expect_service();
}

TEST_F(ImpatientHttpTest, ClosesARequestThatComesByteByByte) {
  Connection slow(port_);
  const std::string text = request_text("/panel/" + std::string(8000, 'a'), {host_});
  std::size_t sent = 0;
  for (; sent < text.size() && slow.send(text.substr(sent, 1)); ++sent)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_LT(sent, text.size());
  expect_closed(1);
}

TEST_F(ImpatientHttpTest, ClosesWhatDoesNotReadItsAnswer) {
  Connection deaf(port_);
  constexpr int kRoom = 65536;
  setsockopt(deaf.descriptor(), SOL_SOCKET, SO_RCVBUF, &kRoom, sizeof kRoom);
  deaf.send(request_text("/panel/panel.js", {host_}));
  expect_closed(1);
  EXPECT_LT(deaf.rest().size(), kScriptBytes);
  expect_service();
}

TEST_F(ImpatientHttpTest, ClosesClientsThatAreGone) {
  folder_.write("a.scad", "for (i = [0 : 999]) echo(\"" + std::string(3000, 'x') +
                              "\", i);\ncube(5);");  // a design of 3 MB
  BrowserSocket silent = socket(), deaf = socket();
  ASSERT_TRUE(silent.is_open() && deaf.is_open());
  EXPECT_EQ(open(deaf)["preview"], 1);
  for (int i = 0; i < 9; ++i) {
    deaf.send({{"id", i},
               {"method", "scadray/parameterSet"},
               {"params", {{"preview", 1}, {"action", "choose"}, {"name", ""}}}});
  }
  expect_closed(2);
  expect_service();
}

TEST_F(HttpTest, ManyClientsAreRefused) {
  std::vector<BrowserSocket> clients;
  std::size_t refused = 0;
  for (int i = 0; i < 1000; ++i) {
    BrowserSocket client = socket();
    if (client.is_open())
      clients.push_back(std::move(client));
    else
      refused += client.answer().starts_with("HTTP/1.1 503") ? 1 : 0;
  }
  EXPECT_EQ(clients.size(), kMostClients);
  EXPECT_EQ(refused, 1000 - kMostClients);
  EXPECT_THAT(get("/?token=" + token_), StartsWith("HTTP/1.1 200"));
  EXPECT_EQ(open(clients[7])["preview"], 1);
  clients.clear();
  for (int i = 0; i < 100 && !socket().is_open(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  expect_service();
}

TEST_F(HttpTest, ConnectionsThatSayNothingAreBounded) {
  std::vector<Connection> silent;
  for (int i = 0; i < 1000; ++i) silent.emplace_back(port_);
  silent.clear();
  for (int i = 0; i < 100 && !socket().is_open(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  expect_service();
}

TEST_F(HttpTest, MutatedMessagesEndNoServer) {
  std::mt19937 random(3);
  const auto pick = [&](std::size_t count) { return random() % count; };
  const Json camera = {{"rotation", {0, 0, 0}},
                       {"translation", {0, 0, 0}},
                       {"distance", 60},
                       {"projection", "ortho"}};
  const Json params = {
      {"preview", 1},
      {"camera", camera},
      {"x", 5},
      {"y", 5},
      {"number", 1},
      {"look",
       {{"width", 40}, {"section", {{"normal", {0, 1, 0}}, {"position", 1}, {"flipped", true}}}}},
      {"textDocument", {{"uri", uri_of_path(folder_ / "a.scad")}}},
      {"position", {{"line", 1}, {"character", 1}}},
      {"values", {{"size", 2}}},
      {"uri", uri_of_path(folder_ / "a.scad")},
      {"path", "a.png"},
      {"action", "choose"},
      {"name", ""}};
  constexpr const char* kMethods[] = {"openPreview", "viewAll",     "pick",         "look",
                                      "cursor",      "parameters",  "shown",        "stop",
                                      "source",      "savePicture", "parameterSet", "closePreview"};
  const int count = test_support::full_run() ? 1'000'000 : 2000;
  std::optional<BrowserSocket> client;
  for (int i = 0; i < count; ++i) {
    if (client && i % 50 == 0 && client->ask("scadray/none", nullptr) == "closed") client.reset();
    if (!client) client.emplace(socket());
    std::string text = Json{
        {"jsonrpc", "2.0"},
        {"id", i},
        {"method", std::string("scadray/") + kMethods[pick(std::size(kMethods))]},
        {"params", params}}.dump();
    for (std::size_t k = pick(3); k > 0; --k) {
      const std::size_t at = pick(text.size() - 12);
      if (pick(2) == 0)
        text[at] = static_cast<char>(pick(100) == 0 ? pick(256) : ' ' + pick(95));
      else
        text.erase(at, pick(9));
    }
    std::string frame = client_frame(text);
    if (pick(100) == 0)
      frame[pick(std::min<std::size_t>(frame.size(), 8))] = static_cast<char>(pick(256));
    if (!client->connection().send(frame)) client.reset();
  }
  client.reset();
  for (int i = 0; i < 100 && !socket().is_open(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  expect_service();
}

TEST_F(HttpTest, RefusesLongMessages) {
  BrowserSocket client = socket();
  client.connection().send(client_frame(std::string((1 << 20) + 1, ' ')));
  EXPECT_FALSE(client.receive());
  expect_service();
}

TEST_F(HttpTest, AClientThatReadsNothingCostsLittle) {
  folder_.write("a.scad",
                "for (i = [0 : 999]) echo(\"" + std::string(3000, 'x') + "\", i);\ncube(5);");
  BrowserSocket client = socket();
  EXPECT_EQ(open(client)["preview"], 1);
  client.final_frame();
  const std::size_t before = resident_bytes();
  // Each of these is answered by the whole design, of 3 MB.
  const timeval patience{1, 0};
  setsockopt(client.connection().descriptor(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  for (int i = 0; i < 400; ++i) {
    if (!client.send({{"id", i},
                      {"method", "scadray/parameterSet"},
                      {"params", {{"preview", 1}, {"action", "choose"}, {"name", ""}}}}))
      break;
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
#ifndef SCADRAY_SANITIZED
  EXPECT_LT(resident_bytes(), before + (std::size_t{100} << 20));
#else
  static_cast<void>(before);
#endif
  BrowserSocket other = socket();
  EXPECT_EQ(open(other)["preview"], 1);
}

TEST(HttpServerErrors, AreToldBeforeItListens) {
  const TemporaryFolder folder;
  folder.write("index.html", "");
  folder.write("a.scad", "cube(1);");
  const auto make = [&](const HttpOptions& options) {
    HttpServer(options, PanelFiles(folder.path()));
  };
  EXPECT_THROW(make({.design = folder / "none.scad"}), frontend::Error);
  EXPECT_THROW(make({.design = folder / "a.scad", .bind = "localhost"}), frontend::Error);
  EXPECT_THROW(make({.design = folder / "a.scad", .bind = "203.0.113.1"}), frontend::Error);
  HttpServer all({.design = folder / "a.scad", .bind = "0.0.0.0"}, PanelFiles(folder.path()));
  EXPECT_FALSE(all.is_loopback());
}

}  // namespace
}  // namespace serve
