// The order of a session, and the form of its messages.
#include "client.hpp"

namespace serve {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(Uris, ArePathsWithEscapes) {
  EXPECT_EQ(path_of_uri("file:///a%20b/%C3%A4.scad"), "/a b/ä.scad");
  EXPECT_EQ(path_of_uri("file://host/a.scad"), "/a.scad");
  EXPECT_EQ(path_of_uri("untitled:Untitled-1"), "-");
  EXPECT_EQ(path_of_uri("file:///a%00b"), "-");
  EXPECT_EQ(path_of_uri("file:///100%"), "/100%");
  EXPECT_EQ(uri_of_path("/a b/ä%.scad"), "file:///a%20b/%C3%A4%25.scad");
}

TEST(Session, BeginsWithInitialize) {
  std::vector<Json> sent;
  Server server(
      language::LanguageVersion::k2021, [&](const Json& message) { sent.push_back(message); },
      [](const Json&, const frontend::Bytes&) {}, [](const std::function<void()>&) {});
  const auto ask = [&](int id, const char* method) {
    server.handle({{"jsonrpc", "2.0"}, {"id", id}, {"method", method}});
    return sent.back();
  };
  EXPECT_EQ(ask(1, "textDocument/hover")["error"]["code"], -32002);
  server.handle({{"jsonrpc", "2.0"}, {"method", "textDocument/didOpen"}, {"params", {}}});
  EXPECT_EQ(sent.size(), 1u);  // notifications before are dropped
  EXPECT_EQ(ask(2, "initialize")["result"]["serverInfo"]["name"], "scadray");
  EXPECT_EQ(ask(3, "initialize")["error"]["code"], -32600);
  EXPECT_EQ(ask(4, "textDocument/none")["error"]["code"], -32601);
  EXPECT_EQ(ask(5, "textDocument/hover")["error"]["code"], -32602);
  EXPECT_EQ(ask(6, "shutdown")["result"], nullptr);
  EXPECT_EQ(ask(7, "textDocument/hover")["error"]["code"], -32600);
  EXPECT_FALSE(server.has_ended());
  server.handle({{"jsonrpc", "2.0"}, {"method", "exit"}});
  EXPECT_TRUE(server.has_ended());
  EXPECT_TRUE(server.has_shut_down());
}

TEST(Session, ACancelledRequestIsNotAnswered) {
  Client client;
  std::vector<Json> sent;
  Server server(
      language::LanguageVersion::k2021, [&](const Json& message) { sent.push_back(message); },
      [](const Json&, const frontend::Bytes&) {}, [](const std::function<void()>&) {});
  server.handle({{"jsonrpc", "2.0"}, {"id", 1}, {"method", "initialize"}}, true);
  EXPECT_EQ(sent.back()["error"]["code"], -32800);
}

TEST(Session, AnIdMayBeAString) {
  std::vector<Json> sent;
  Server server(
      language::LanguageVersion::k2021, [&](const Json& message) { sent.push_back(message); },
      [](const Json&, const frontend::Bytes&) {}, [](const std::function<void()>&) {});
  server.handle({{"jsonrpc", "2.0"}, {"id", "ä"}, {"method", "initialize"}});
  EXPECT_EQ(sent.back()["id"], "ä");
  server.handle({{"jsonrpc", "2.0"}, {"id", "b"}, {"method", 7}});
  EXPECT_EQ(sent.back()["id"], "b");
  EXPECT_EQ(sent.back()["error"]["code"], -32600);
}

TEST(Session, AWrongNotificationIsLogged) {
  Client client;
  client.notify("textDocument/didOpen", {{"textDocument", {{"uri", "file:///a.scad"}}}});
  ASSERT_FALSE(client.sent.empty());
  EXPECT_EQ(client.sent.back()["method"], "window/logMessage");
  EXPECT_THAT(client.sent.back()["params"]["message"].get<std::string>(),
              HasSubstr("\"text\" is missing"));
  client.notify("$/unknown", {});
  client.notify("textDocument/willSave", {});
  EXPECT_EQ(client.sent.size(), 1u);
}

TEST(Session, ADocumentThatCouldNotBeOpenedIsNotOpen) {
  const TemporaryFolder folder;
  Client client;
  const Json broken = {{"uri", uri_of_path(folder / "a.scad")}, {"version", "1"}, {"text", ""}};
  client.notify("textDocument/didOpen", {{"textDocument", broken}});
  client.open(folder / "b.scad", "cube(;");
  EXPECT_EQ(client.said(folder / "b.scad").size(), 1u);
}

TEST(Session, ChoosesUtf8IfItIsOffered) {
  const TemporaryFolder folder;
  Client client(language::LanguageVersion::k2021,
                {{"general", {{"positionEncodings", {"utf-16", "utf-8"}}}}});
  EXPECT_EQ(client.initialized["capabilities"]["positionEncoding"], "utf-8");
  client.open(folder / "a.scad", "x = \"😀\" + y;");
  EXPECT_THAT(client.said(folder / "a.scad"),
              testing::Contains("0:13-0:14 Ignoring unknown variable 'y'"));
}

TEST(Session, AsksToBeToldOfFiles) {
  Client client(language::LanguageVersion::k2021,
                {{"workspace", {{"didChangeWatchedFiles", {{"dynamicRegistration", true}}}}}});
  ASSERT_EQ(client.sent.size(), 1u);
  EXPECT_EQ(client.sent[0]["method"], "client/registerCapability");
  client.server().handle({{"jsonrpc", "2.0"}, {"id", "files"}, {"result", nullptr}});
}

TEST(Changes, AreAppliedInOrder) {
  const auto text = std::make_shared<const Text>("a😀b\r\nc");
  const auto edit = [](int line, int begin, int end, const char* put) {
    return Json{{"range",
                 {{"start", {{"line", line}, {"character", begin}}},
                  {"end", {{"line", line}, {"character", end}}}}},
                {"text", put}};
  };
  const auto changed = [&](const std::vector<Json>& changes) {
    return changed_text(text, changes, PositionEncoding::kUtf16)->bytes();
  };
  EXPECT_EQ(changed({edit(0, 1, 3, "")}), "ab\r\nc");
  EXPECT_EQ(changed({edit(0, 3, 3, "x"), edit(0, 4, 5, "yy")}), "a😀xyy\r\nc");
  EXPECT_EQ(changed({edit(1, 0, 1, "\n"), edit(2, 0, 0, "z")}), "a😀b\r\n\nz");
  EXPECT_EQ(changed({Json{{"text", "new"}}}), "new");
  EXPECT_EQ(changed({edit(9, 9, 9, "!")}), "a😀b\r\nc!");
  for (const Json& wrong : {Json(7), Json{{"range", 7}, {"text", ""}}, edit(0, 3, 1, ""),
                            edit(0, -1, 1, ""), Json{{"range", edit(0, 0, 0, "")["range"]}}}) {
    EXPECT_THROW(changed({wrong}), RequestError) << wrong;
  }
  EXPECT_THROW(changed_text(text, 7, PositionEncoding::kUtf16), RequestError);
}

}  // namespace
}  // namespace serve
