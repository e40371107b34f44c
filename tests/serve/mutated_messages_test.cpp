// Messages with random mistakes: no crash, and an answer to each request.
#include <random>

#include "client.hpp"
#include "rpc.hpp"
#include "support/full_run.hpp"

namespace serve {
namespace {

std::vector<Json> right_messages(const std::string& path) {
  const std::string text =
      "include <b.scad>\nmodule m(a, b = 2) { cube([a, b]); }\r\nx = \"😀\"; m(b = x, 1);\n"
      "color(\"red\") m(";
  const Json document = {{"uri", uri_of_path(path)}, {"version", 1}, {"text", text}};
  const Json place = {{"textDocument", {{"uri", uri_of_path(path)}}},
                      {"position", {{"line", 2}, {"character", 12}}},
                      {"newName", "fresh"},
                      {"context", {{"includeDeclaration", true}}},
                      {"color", {{"red", 1}, {"green", 0}, {"blue", 0}, {"alpha", 1}}},
                      {"range", json_of({{0, 0}, {0, 4}})}};
  std::vector<Json> messages = {
      {{"method", "textDocument/didOpen"}, {"params", {{"textDocument", document}}}},
      {{"method", "textDocument/didChange"},
       {"params",
        {{"textDocument", document},
         {"contentChanges", {{{"range", json_of({{1, 3}, {1, 9}})}, {"text", "x\n😀"}}}}}}},
      {{"method", "textDocument/didSave"}, {"params", place}},
      {{"method", "textDocument/didClose"}, {"params", place}},
      {{"method", "workspace/didChangeWatchedFiles"},
       {"params", {{"changes", {{{"uri", uri_of_path(path)}, {"type", 1}}}}}}},
      {{"method", "workspace/didChangeWorkspaceFolders"},
       {"params", {{"event", {{"added", Json::array()}, {"removed", Json::array()}}}}}}};
  int id = 0;
  for (const char* method :
       {"completion", "signatureHelp", "hover", "definition", "references", "documentSymbol",
        "foldingRange", "documentColor", "colorPresentation", "prepareRename", "rename"}) {
    messages.push_back(
        {{"id", ++id}, {"method", std::string("textDocument/") + method}, {"params", place}});
  }
  for (Json& message : messages) message["jsonrpc"] = "2.0";
  return messages;
}

class Mutator {
 public:
  explicit Mutator(uint32_t seed) : random_(seed) {}
  std::size_t pick(std::size_t count) { return random_() % count; }

  /// Replaces, removes or copies a part of a message.
  void mutate(Json& json) {
    Json* at = &json;
    while (at->is_structured() && !at->empty() && pick(4) > 0) {
      auto child = at->begin();
      std::advance(child, static_cast<std::ptrdiff_t>(pick(at->size())));
      at = &*child;
    }
    switch (pick(4)) {
      case 0:
        *at = value();
        break;
      case 1:
        if (at->is_object() && !at->empty()) at->erase(at->begin());
        break;
      case 2:
        if (at->is_array()) at->push_back(value());
        break;
      default:
        if (at->is_number_integer()) *at = at->get<int64_t>() + static_cast<int64_t>(pick(3)) - 1;
        if (at->is_string()) *at = at->get<std::string>().erase(0, pick(3));
    }
  }
  /// Changes some bytes.
  void mutate(std::string& text) {
    for (std::size_t i = 0; i <= pick(3); ++i) {
      const std::size_t at = pick(text.size());
      if (pick(2) == 0)
        text[at] = static_cast<char>(pick(256));
      else
        text.erase(at, pick(9));
      if (text.empty()) text = " ";
    }
  }

 private:
  Json value() {
    const Json values[] = {nullptr,
                           true,
                           -1,
                           0,
                           1.5,
                           1e300,
                           int64_t{1} << 60,
                           "",
                           "x",
                           "file:///",
                           "file://%00",
                           Json::array(),
                           Json::object(),
                           Json{{"line", 1}},
                           99999,
                           "\\"};
    return values[pick(std::size(values))];
  }

  std::mt19937 random_;
};

TEST(MutatedMessages, AreAnsweredOrLogged) {
  const TemporaryFolder folder;
  const auto messages = right_messages(folder / "a.scad");
  std::vector<Json> sent;
  std::mutex mutex;
  std::deque<std::function<void()>> posted;
  Server server(
      language::LanguageVersion::k2021, [&](const Json& message) { sent.push_back(message); },
      [](const Json&, const frontend::Bytes&) {},
      [&](std::function<void()> work) {
        const std::lock_guard lock(mutex);
        posted.push_back(std::move(work));
      });
  server.handle({{"jsonrpc", "2.0"}, {"id", 0}, {"method", "initialize"}});
  Mutator mutator(1);
  const int count = test_support::full_run() ? 1'000'000 : 3000;
  for (int i = 0; i < count; ++i) {
    if (i % 50 == 0) server.handle(messages[0]);
    Json message = messages[mutator.pick(messages.size())];
    for (std::size_t changes = mutator.pick(4); changes > 0; --changes) mutator.mutate(message);
    if (message.is_object() && message.value("method", Json()) == "shutdown") continue;
    sent.clear();
    server.handle(message);
    const bool is_request = message.is_object() && message.contains("id") &&
                            message.contains("method") && !message["id"].is_structured();
    int answers = 0;
    for (const Json& one : sent) {
      if (!one.contains("id")) continue;
      ++answers;
      const bool has_code = one.contains("error") && one["error"]["code"].is_number_integer() &&
                            one["error"]["message"].is_string();
      EXPECT_TRUE(one.contains("result") || has_code) << one;
      EXPECT_NE(one.value("/error/code"_json_pointer, 0), -32603) << message << one;
      static_cast<void>(framed(one));
    }
    if (is_request) {
      EXPECT_EQ(answers, 1) << message;
    }
    const std::lock_guard lock(mutex);
    while (!posted.empty()) {
      posted.front()();
      posted.pop_front();
    }
  }
  sent.clear();
  server.handle({{"jsonrpc", "2.0"}, {"id", 1}, {"method", "shutdown"}});
  EXPECT_TRUE(sent.back().contains("result"));
}

TEST(MutatedMessages, BytesOfAnyKindAreReadToTheirEnd) {
  const auto messages = right_messages("/tmp/a.scad");
  Mutator mutator(2);
  const int count = test_support::full_run() ? 20'000 : 500;
  for (int i = 0; i < count; ++i) {
    std::string stream;
    for (int k = 0; k < 4; ++k) stream += framed(messages[mutator.pick(messages.size())]);
    mutator.mutate(stream);
    std::size_t at = 0;
    FrameReader reader([&](char* bytes, std::size_t room) {
      const std::size_t taken = std::min({room, stream.size() - at, std::size_t{100}});
      std::copy_n(stream.begin() + static_cast<std::ptrdiff_t>(at), taken, bytes);
      at += taken;
      return taken;
    });
    Inbox inbox;
    read_messages(reader, inbox);
    for (;;) {
      const Inbox::Item item = inbox.take();
      if (!item.message && !item.error) break;
      EXPECT_TRUE(!item.error || !item.error->message.empty());
    }
    EXPECT_EQ(at, stream.size());
  }
}

}  // namespace
}  // namespace serve
