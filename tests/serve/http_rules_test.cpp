// What a server for browsers answers to whom.
#include "http_rules.hpp"

#include <gmock/gmock.h>

#include "frontend/error.hpp"
#include "temporary_folder.hpp"

namespace serve {
namespace {

using frontend::TemporaryFolder;
using testing::HasSubstr;

TEST(Tokens, AreRandomAndLong) {
  EXPECT_THAT(random_token(), testing::MatchesRegex("[0-9a-f]+"));
  EXPECT_EQ(random_token().size(), 32u);
  EXPECT_NE(random_token(), random_token());
  EXPECT_TRUE(are_same_secrets("abc", "abc"));
  EXPECT_FALSE(are_same_secrets("abc", "abd"));
  EXPECT_FALSE(are_same_secrets("abc", "abcd"));
  EXPECT_FALSE(are_same_secrets("", "a"));
}

TEST(Origins, AreTheAddressesOfTheServer) {
  const HttpOrigin loopback("127.0.0.1", 8080, true, "");
  EXPECT_EQ(loopback.address(), "http://127.0.0.1:8080");
  EXPECT_EQ(loopback.socket_address(), "ws://127.0.0.1:8080");
  EXPECT_TRUE(loopback.accepts("127.0.0.1:8080", std::nullopt));
  EXPECT_TRUE(loopback.accepts("LOCALHOST:8080", "http://localhost:8080"));
  EXPECT_FALSE(loopback.accepts("127.0.0.1:8081", std::nullopt));
  EXPECT_FALSE(loopback.accepts("127.0.0.1", std::nullopt));
  EXPECT_FALSE(loopback.accepts("evil.example:8080", std::nullopt));
  EXPECT_FALSE(loopback.accepts("127.0.0.1:8080", "http://evil.example"));
  EXPECT_FALSE(loopback.accepts("127.0.0.1:8080", "https://127.0.0.1:8080"));
  EXPECT_FALSE(loopback.accepts("127.0.0.1:8080", "http://localhost:8080"));
  EXPECT_FALSE(loopback.accepts("127.0.0.1:8080", "null"));
  const HttpOrigin open("192.168.1.2", 80, false, "");
  EXPECT_FALSE(open.accepts("localhost:80", std::nullopt));
  const HttpOrigin behind("127.0.0.1", 8080, true, "https://Cad.example/");
  EXPECT_EQ(behind.address(), "https://cad.example");
  EXPECT_EQ(behind.socket_address(), "wss://cad.example");
  EXPECT_TRUE(behind.accepts("cad.example", "https://cad.example"));
  EXPECT_FALSE(behind.accepts("127.0.0.1:8080", std::nullopt));
  EXPECT_EQ(HttpOrigin("::1", 80, true, "").address(), "http://[::1]:80");
  for (const char* wrong : {"cad.example", "ftp://a", "https://", "https://a/b", "https://a@b"})
    EXPECT_THROW(HttpOrigin("127.0.0.1", 80, true, wrong), frontend::Error) << wrong;
}

TEST(Targets, AreCutAndNotDecoded) {
  EXPECT_EQ(http_target("/socket?token=ab").path, "/socket");
  EXPECT_EQ(http_target("/socket?token=ab").token, "ab");
  EXPECT_EQ(http_target("/?a=1&token=ab&b").token, "ab");
  EXPECT_EQ(http_target("/?xtoken=ab").token, "");
  EXPECT_EQ(http_target("/%2e%2e").path, "/%2e%2e");
  EXPECT_EQ(http_target("?").path, "");
  EXPECT_EQ(http_target("").token, "");
}

TEST(PanelFiles, AreThoseOfTheFolder) {
  const TemporaryFolder folder;
  EXPECT_THROW(PanelFiles(folder.path()), frontend::Error);
  EXPECT_THROW(PanelFiles(folder / "none"), frontend::Error);
  folder.write("index.html", "<html><head></head><body></body></html>");
  folder.write("notes.txt", "no");
  std::filesystem::create_directory(folder / "src");
  folder.write("src/a.js", "1;");
  const PanelFiles panel(folder.path());
  EXPECT_EQ(panel.page("file:///a%22\"<&"),
            "<html><head><meta name=\"scadray-design\" content=\"file:///a%22&quot;&lt;&amp;\">"
            "</head><body></body></html>");
  ASSERT_NE(panel.find("src/a.js"), nullptr);
  EXPECT_EQ(panel.find("src/a.js")->bytes, "1;");
  EXPECT_THAT(panel.find("src/a.js")->type, HasSubstr("text/javascript"));
  for (const char* path :
       {"notes.txt", "", "src", "../index.html", "src/../index.html", "/etc/passwd"})
    EXPECT_EQ(panel.find(path), nullptr) << path;
}

}  // namespace
}  // namespace serve
