// Random edits of random designs: the diagnostics of a server that has seen all edits are those of
// a new one.
#include <random>

#include "client.hpp"
#include "support/full_run.hpp"

namespace serve {
namespace {

constexpr const char* kPieces[] = {"cube(x);\r\n",
                                   "x = 1;\n",
                                   "y = \"😀ä\";\r\n",
                                   "module m(a = 2) { cube(a); }\n",
                                   "m(y);\n",
                                   "/* 😀\r\n */",
                                   "// €\n",
                                   "function f(x) = x + y;\n",
                                   "z = f(1);\r\n",
                                   "include <b.scad>\n",
                                   "use <b.scad>\r\n",
                                   "assert(x > 0);\n",
                                   "m() { child(); }",
                                   "{",
                                   "}",
                                   "(",
                                   ")",
                                   "\"",
                                   ";",
                                   "\r",
                                   "\n",
                                   "😀",
                                   "é",
                                   "x",
                                   "[1, 2]",
                                   "echo(y);\n",
                                   "if (x) ",
                                   " else "};

class Editor {
 public:
  explicit Editor(uint32_t seed) : random_(seed) {
    for (std::string* text : {&main_, &other_})
      for (int i = 0; i < 8; ++i) *text += kPieces[pick(std::size(kPieces) - 14)];
  }
  std::size_t pick(std::size_t count) { return random_() % count; }

  /// Changes one of the documents in some places at once.
  void edit(Client& client) {
    const bool is_main = pick(3) > 0;
    std::string& text = is_main ? main_ : other_;
    Json changes = Json::array();
    for (std::size_t i = 0; i <= pick(3); ++i) changes.push_back(change(text));
    client.change(path(is_main), ++version_, changes);
  }
  /// Returns what an editor that opens the documents now is told.
  void open(Client& client) {
    client.open(path(true), main_);
    client.open(path(false), other_);
  }
  std::string path(bool is_main) const { return folder_ / (is_main ? "a.scad" : "b.scad"); }
  const std::string& text(bool is_main) const { return is_main ? main_ : other_; }

 private:
  Json change(std::string& text) {
    const Text before(text);
    Position places[2];
    for (Position& place : places) {
      const auto line = static_cast<uint32_t>(pick(before.lines() + 1));
      place = {line, static_cast<uint32_t>(pick(30))};
    }
    if (places[1] < places[0]) std::swap(places[0], places[1]);
    if (pick(2) == 0) places[1] = places[0];
    const std::string piece = pick(4) > 0 ? kPieces[pick(std::size(kPieces))] : "";
    const Json json = {{"range", json_of({places[0], places[1]})}, {"text", piece}};
    // The server's own arithmetic is tested by itself; here both have the same text.
    text = changed_text(std::make_shared<const Text>(text), Json::array({json}),
                        PositionEncoding::kUtf16)
               ->bytes();
    return json;
  }

  std::mt19937 random_;
  TemporaryFolder folder_;
  std::string main_, other_;
  int version_ = 1;
};

TEST(RandomEdits, HaveTheDiagnosticsOfAFreshServer) {
  const uint32_t designs = test_support::full_run() ? 1000 : 100;
  constexpr int kEdits = 10;
  for (uint32_t seed = 0; seed < designs; ++seed) {
    Editor editor(seed);
    Client client;
    editor.open(client);
    for (int i = 0; i < kEdits; ++i) {
      editor.edit(client);
      if (editor.pick(3) > 0) continue;  // the next edit comes before the evaluation has ended
      client.settle();
      Client fresh;
      editor.open(fresh);
      fresh.settle();
      for (const bool is_main : {true, false}) {
        const std::string uri = uri_of_path(editor.path(is_main));
        ASSERT_EQ(client.diagnostics[uri], fresh.diagnostics[uri])
            << "seed " << seed << ", edit " << i << "\n--- a.scad\n"
            << editor.text(true) << "\n--- b.scad\n"
            << editor.text(false);
      }
    }
  }
}

}  // namespace
}  // namespace serve
