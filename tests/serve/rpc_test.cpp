#include "rpc.hpp"

#include <gmock/gmock.h>

#include <thread>

namespace serve {
namespace {

using testing::HasSubstr;

/// Gives a text in pieces of some bytes.
FrameReader reader_of(std::string text, std::size_t piece) {
  auto rest = std::make_shared<std::string>(std::move(text));
  return FrameReader([rest, piece](char* bytes, std::size_t room) {
    const std::size_t count = std::min({room, piece, rest->size()});
    std::copy_n(rest->begin(), count, bytes);
    rest->erase(0, count);
    return count;
  });
}

TEST(Frames, AreReadInPiecesOfAnySize) {
  for (const std::size_t piece : {1, 2, 7, 1000}) {
    FrameReader reader = reader_of(
        "Content-Length: 2\r\nContent-Type: x\r\n\r\n{}"
        "content-length:3 \n\n[1]"
        "Content-Length: 0\r\n\r\n",
        piece);
    EXPECT_EQ(reader.next(), "{}");
    EXPECT_EQ(reader.next(), "[1]");
    EXPECT_EQ(reader.next(), "");
    EXPECT_EQ(reader.next(), std::nullopt);
  }
}

TEST(Frames, AWrongHeaderIsAnErrorAndTheNextMessageIsRead) {
  for (const char* header :
       {"Content-Length: -1", "Content-Length: ten", "Content-Length:", "Content-Type: x",
        "Content-Length: 99999999999999999999", "Content-Length: 9000000000000"}) {
    FrameReader reader =
        reader_of(std::string(header) + "\r\n\r\n{\"a\": 1}\r\nContent-Length: 2\r\n\r\n{}", 5);
    EXPECT_THROW(static_cast<void>(reader.next()), RequestError) << header;
    EXPECT_EQ(reader.next(), "{}") << header;
  }
}

TEST(Frames, ALineWithoutEndIsSkipped) {
  FrameReader reader = reader_of(std::string(300'000, 'x') + "\nContent-Length: 1\n\n7", 4096);
  EXPECT_EQ(reader.next(), "7");
}

TEST(Frames, AStreamThatEndsWithinAMessageHasNone) {
  EXPECT_EQ(reader_of("Content-Length: 5\r\n\r\n{}", 3).next(), std::nullopt);
  EXPECT_EQ(reader_of("Content-Length: 5\r\n", 3).next(), std::nullopt);
}

TEST(Frames, TheLengthCountsBytes) {
  EXPECT_EQ(framed({{"a", "ä"}}), "Content-Length: 10\r\n\r\n{\"a\":\"ä\"}");
}

TEST(Messages, WhatIsNoneIsAnInvalidRequest) {
  const auto problem = [](const char* text) {
    const auto found = problem_of(Json::parse(text));
    return found ? static_cast<int>(found->code) : 0;
  };
  EXPECT_EQ(problem(R"({"jsonrpc": "2.0", "id": 1, "method": "x"})"), 0);
  EXPECT_EQ(problem(R"({"jsonrpc": "2.0", "method": "x", "params": {}})"), 0);
  EXPECT_EQ(problem(R"({"jsonrpc": "2.0", "id": 1, "result": null})"), 0);
  for (const char* wrong :
       {"[]", "7", "{}", R"({"jsonrpc": "1.0", "method": "x"})", R"({"jsonrpc": "2.0"})",
        R"({"jsonrpc": "2.0", "id": 1})", R"({"jsonrpc": "2.0", "id": {}, "method": "x"})",
        R"({"jsonrpc": "2.0", "id": 1.5, "method": "x"})",
        R"({"jsonrpc": "2.0", "id": 1, "method": 7})"}) {
    EXPECT_EQ(problem(wrong), -32600) << wrong;
  }
  EXPECT_EQ(problem(R"({"jsonrpc": "2.0", "id": 1, "method": "x", "params": 7})"), -32602);
}

Inbox::Item item_of(const char* text) {
  Inbox::Item item;
  item.message = Json::parse(text);
  return item;
}

TEST(Inbox, ACancelReachesTheRequestThatWaits) {
  Inbox inbox;
  inbox.put(item_of(R"({"id": 1, "method": "a"})"));
  inbox.put(item_of(R"({"id": 2, "method": "b"})"));
  inbox.put(item_of(R"({"method": "$/cancelRequest", "params": {"id": 2}})"));
  EXPECT_FALSE(inbox.take().is_cancelled);
  EXPECT_TRUE(inbox.take().is_cancelled);
}

TEST(Inbox, AClientThatSendsTooMuchWaits) {
  Inbox inbox;
  constexpr int kMessages = 3000;
  std::thread client([&] {
    for (int i = 0; i < kMessages; ++i) inbox.put(item_of("{}"));
  });
  for (int i = 0; i < kMessages; ++i) EXPECT_TRUE(inbox.take().message);
  client.join();
}

TEST(Inbox, ReadsUntilExit) {
  FrameReader reader = reader_of(framed({{"method", "a"}}) + "Content-Length: 1\r\n\r\n{" +
                                     framed({{"method", "exit"}}) + framed({{"method", "b"}}),
                                 100);
  Inbox inbox;
  read_messages(reader, inbox);
  EXPECT_EQ((*inbox.take().message)["method"], "a");
  const Inbox::Item wrong = inbox.take();
  ASSERT_TRUE(wrong.error);
  EXPECT_EQ(wrong.error->code, ErrorCode::kParseError);
  EXPECT_THAT(wrong.error->message, HasSubstr("parse error"));
  EXPECT_EQ((*inbox.take().message)["method"], "exit");
}

TEST(Messages, ThatAreNoJsonAreErrors) {
  EXPECT_EQ(message_of("{\"a\": 1}").message, Json({{"a", 1}}));
  for (const char* text : {"", "{", "2e589", "[-1e999]", "\"\xff\""}) {
    const Inbox::Item item = message_of(text);
    EXPECT_FALSE(item.message) << text;
    ASSERT_TRUE(item.error) << text;
    EXPECT_EQ(item.error->code, ErrorCode::kParseError);
  }
}

TEST(Base64, IsThatOfItsStandard) {
  const auto encoded = [](std::string_view text) {
    return base64(std::as_bytes(std::span(text.data(), text.size())));
  };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace serve
