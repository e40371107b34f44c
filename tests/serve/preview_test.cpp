// The preview's protocol, with a server in this process.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>
#include <set>
#include <thread>

#include "client.hpp"
#include "resident_bytes.hpp"
#include "support/full_run.hpp"

namespace serve {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// A client with one preview, whose pictures have no light that takes long.
class PreviewClient {
 public:
  explicit PreviewClient(const std::string& text, Json look = Json::object())
      : path(folder / "a.scad") {
    client.open(path, text);
    begin(std::move(look));
  }
  /// Does not open the document, which is in that file.
  PreviewClient() : path(folder / "a.scad") {}

  /// Writes a file and lets it age: one that is as new as its first reading is read twice.
  void write(const std::string& name, const std::string& text) const {
    folder.write(name, text);
    constexpr std::chrono::milliseconds kOld{20};
    std::this_thread::sleep_for(kOld);
  }
  /// Replaces a file, as most editors do: the server reads no half of it.
  void save(const std::string& name, const std::string& text) const {
    std::filesystem::rename(folder.write(name + '~', text), folder / name);
  }
  void begin(Json look = Json::object()) {
    if (!look.contains("width")) look["width"] = 160;
    if (!look.contains("height")) look["height"] = 120;
    if (!look.contains("shading")) look["shading"] = "flat";
    const Json result = client.request(
        "scadray/openPreview", {{"textDocument", {{"uri", uri_of_path(path)}}}, {"look", look}});
    preview = result.value("preview", Json());
    opened = result;
  }

  void change(const std::string& text) {
    client.change(path, ++version, Json::array({Json{{"text", text}}}));
  }
  Json request(const std::string& method, Json params = Json::object()) {
    params["preview"] = preview;
    return client.request("scadray/" + method, params);
  }
  void notify(const std::string& method, Json params = Json::object()) {
    params["preview"] = preview;
    client.notify("scadray/" + method, params);
  }
  void look(const Json& look) { notify("look", {{"look", look}}); }
  void acknowledge() { notify("shown", {{"number", client.frames.back().params["number"]}}); }

  /// Waits for the final picture of what was asked for so far, and returns it.
  Client::Frame final_frame() {
    for (;;) {
      if (!client.run_until([&] { return client.frames.size() > taken; })) break;
      taken = client.frames.size();
      acknowledge();
      if (client.frames.back().params["final"] == true) return client.frames.back();
    }
    ADD_FAILURE() << "no final picture came";
    return {};
  }
  /// Waits for the next version of the design.
  Json design() {
    const auto find = [this] {
      return std::find_if(client.sent.begin(), client.sent.end(),
                          [](const Json& sent) { return sent["method"] == "scadray/design"; });
    };
    if (!client.run_until([&] { return find() != client.sent.end(); })) return {};
    Json result = (*find())["params"]["design"];
    client.sent.erase(find());
    return result;
  }
  /// Returns what the next message that is logged says.
  std::string logged() {
    for (const Json& sent : client.sent)
      if (sent["method"] == "window/logMessage") return sent["params"]["message"];
    return "";
  }
  Json progress() {
    const auto find = [this] {
      return std::find_if(client.sent.begin(), client.sent.end(),
                          [](const Json& sent) { return sent["method"] == "scadray/progress"; });
    };
    if (!client.run_until([&] { return find() != client.sent.end(); })) return {{"stage", ""}};
    Json result = (*find())["params"];
    client.sent.erase(find());
    return result;
  }

  TemporaryFolder folder;
  Client client;
  std::string path;
  Json preview, opened;
  int version = 1;
  std::size_t taken = 0;  // frames that final_frame() has seen
};

const Json kTop = {
    {"rotation", {0, 0, 0}}, {"translation", {5, 5, 0}}, {"distance", 60}, {"projection", "ortho"}};

/// Takes hours to evaluate, and no memory.
constexpr const char* kEndless =
    "x = [for (i = [0 : 9999]) for (j = [0 : 9999]) for (k = [0 : 9999]) if (i + j < 0) k];\n";

/// Returns the final picture of a text as a new server draws it.
frontend::Bytes fresh_picture(const std::string& text, const Json& look = {{"camera", kTop}}) {
  PreviewClient fresh(text, look);
  return fresh.final_frame().image;
}

TEST(Preview, ShowsADocument) {
  PreviewClient client("cube(10);\necho(\"hi\");\nfoo();", {{"camera", kTop}});
  EXPECT_EQ(client.opened["preview"], 1);
  const Json design = client.design();
  EXPECT_EQ(design["version"], 1);
  EXPECT_EQ(design["ok"], true);
  EXPECT_EQ(design["plane"], false);
  EXPECT_EQ(design["animated"], false);
  EXPECT_NEAR(design["bounds"]["max"][2], 10, 1e-9);
  ASSERT_EQ(design["messages"].size(), 2u);
  EXPECT_EQ(design["messages"][0]["severity"], 3);
  EXPECT_EQ(design["messages"][0]["text"], "\"hi\"");
  EXPECT_EQ(design["messages"][1]["group"], "WARNING");
  EXPECT_EQ(Client::place(design["messages"][1]["range"]), "2:0-2:3");
  EXPECT_EQ(design["messages"][1]["uri"], uri_of_path(client.path));
  const Client::Frame frame = client.final_frame();
  EXPECT_EQ(frame.params["preview"], 1);
  EXPECT_EQ(frame.params["version"], 1);
  EXPECT_EQ(frame.params["width"], 160);
  EXPECT_EQ(frame.params["height"], 120);
  EXPECT_EQ(frame.params["type"], "image/png");
  EXPECT_EQ(frame.params["camera"]["fov"], 22.5);
  EXPECT_EQ(frame.params["camera"]["projection"], "ortho");
  EXPECT_EQ(frame.params["camera"]["distance"], 60);
  ASSERT_GT(frame.image.size(), 8u);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(frame.image.data()) + 1, 3), "PNG");
}

TEST(Preview, WaitsForAnEvaluationOfItsOwn) {
  PreviewClient client;
  client.client.open(client.path, "cube(10);");
  client.client.said(client.path);  // it has been evaluated, for its diagnostics alone
  client.begin();
  EXPECT_EQ(client.design()["ok"], true);
}

TEST(Preview, EchoesAreNoDiagnostics) {
  PreviewClient client("echo(1);");
  EXPECT_THAT(client.client.said(client.path), IsEmpty());
}

TEST(Preview, StudioPicturesGetBetter) {
  PreviewClient client("cube(10);", {{"camera", kTop}, {"shading", "studio"}});
  client.final_frame();
  ASSERT_GE(client.client.frames.size(), 2u);
  EXPECT_EQ(client.client.frames.front().params["final"], false);
  EXPECT_EQ(client.client.frames.front().params["width"], 160);
}

TEST(Preview, ShowsWhatIsNotSaved) {
  PreviewClient client("cube(10);", {{"camera", kTop}});
  const frontend::Bytes before = client.final_frame().image;
  client.change("sphere(10);");
  const Client::Frame after = client.final_frame();
  EXPECT_EQ(after.params["version"], 2);
  EXPECT_NE(after.image, before);
  EXPECT_EQ(after.image, fresh_picture("sphere(10);"));
}

TEST(Preview, ShowsAnIncludedTextThatIsNotSaved) {
  PreviewClient client("include <b.scad>\ncube(size);", {{"camera", kTop}});
  client.final_frame();
  client.client.open(client.folder / "b.scad", "size = 7;");
  EXPECT_EQ(client.final_frame().image, fresh_picture("cube(7);"));
}

TEST(Preview, OfRandomEditsIsThatOfAFreshServer) {
  constexpr const char* kParts[] = {"cube(%d);\n",
                                    "translate([%d, 2, 1]) sphere(4);\n",
                                    "difference() { cube(12); cylinder(r = %d, h = 30); }\n",
                                    "color(\"red\") cylinder(r = 2, h = %d);\n",
                                    "%%cube([%d, 2, 20]);\n",
                                    "if ((%d\n",
                                    "text(\"%d\");\n"};
  std::mt19937 random(7);
  std::vector<std::string> lines{"cube(3);\n"};
  const auto joined = [&] {
    std::string text;
    for (const std::string& line : lines) text += line;
    return text;
  };
  PreviewClient client(joined(), {{"camera", kTop}});
  client.final_frame();
  std::string good = joined();
  const int edits = test_support::full_run() ? 10'000 : 12;
  for (int i = 0; i < edits; ++i) {
    char line[100];
    std::snprintf(line, sizeof line, kParts[random() % std::size(kParts)],
                  static_cast<int>(random() % 9 + 1));
    const std::size_t at = random() % (lines.size() + 1);
    if (lines.size() > 9 || (lines.size() > 3 && random() % 3 == 0))
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at % lines.size()));
    else
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), line);
    client.change(joined());
    Json design = client.design();
    while (design["version"] != client.version) design = client.design();
    if (design["ok"] != true) continue;  // the picture stays
    good = joined();
    client.client.run_until([&] {
      if (client.client.frames.empty()) return false;
      client.acknowledge();
      const Json& shown = client.client.frames.back().params;
      return shown["version"] == client.version && shown["final"] == true;
    });
    EXPECT_EQ(client.client.frames.back().image, fresh_picture(good)) << good;
  }
}

TEST(Preview, ABrokenTextLeavesTheLastPicture) {
  PreviewClient client("cube(10);");
  client.design();
  const frontend::Bytes before = client.final_frame().image;
  client.change("cube(10;");
  const Json design = client.design();
  EXPECT_EQ(design["version"], 2);
  EXPECT_EQ(design["ok"], false);
  EXPECT_EQ(design["messages"][0]["severity"], 1);
  EXPECT_EQ(design["messages"][0]["group"], "ERROR");
  EXPECT_NEAR(design["bounds"]["max"][2], 10, 1e-9);
  client.look({{"width", 160}});
  client.change("cube(10);");
  EXPECT_EQ(client.design()["ok"], true);
  EXPECT_EQ(client.final_frame().image, before);
}

TEST(Preview, FollowsAFileThatIsNotOpen) {
  PreviewClient client;
  client.begin();
  EXPECT_EQ(client.opened["code"], -32803);
  client.write("a.scad", "include <b.scad>\ncube(size);");
  client.write("b.scad", "size = 4;");
  client.begin({{"camera", kTop}});
  EXPECT_EQ(client.final_frame().image, fresh_picture("cube(4);"));
  client.save("b.scad", "size = 6;");
  EXPECT_EQ(client.final_frame().image, fresh_picture("cube(6);"));
  client.save("a.scad", "sphere(5);");
  EXPECT_EQ(client.final_frame().image, fresh_picture("sphere(5);"));
  // The text of an editor goes before, until it is closed.
  client.client.open(client.path, "cylinder(r = 3, h = 1);");
  EXPECT_EQ(client.final_frame().image, fresh_picture("cylinder(r = 3, h = 1);"));
  client.client.close(client.path);
  EXPECT_EQ(client.final_frame().image, fresh_picture("sphere(5);"));
  EXPECT_THAT(client.client.said(client.path), IsEmpty());
}

TEST(Preview, ShowsACsgWithItsRoundedNumbersMended) {
  // Six digits of a turn leave it no rotation.
  const std::string csg =
      "multmatrix([[-0.980785, -0.19509, 0, 5], [0.19509, -0.980785, 0, 5], [0, 0, 1, 0],"
      " [0, 0, 0, 1]]) { multmatrix([[1, 0, 0, 0], [0, 0.5, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])"
      " { sphere($fn = 0, $fa = 12, $fs = 2, r = 8); } }\n"
      "group() { cube(size = [2, 2, 9], center = false); }\n";
  const Json place = {{"camera", kTop}, {"x", 84}, {"y", 58}};
  PreviewClient typed("translate([5, 5, 0]) rotate(168.75) scale([1, 0.5, 1]) sphere(8);");
  typed.final_frame();
  const double normal = typed.request("pick", place)["normal"][0];
  PreviewClient client;
  client.path = client.folder / "a.csg";
  client.write("a.csg", csg);
  client.begin({{"camera", kTop}});
  EXPECT_EQ(client.design()["ok"], true);
  const frontend::Bytes seen = client.final_frame().image;
  EXPECT_NEAR(client.request("pick", place)["normal"][0], normal, 1e-9);
  client.notify("cursor", {{"position", {{"line", 1}, {"character", 0}}}});
  EXPECT_NE(client.final_frame().image, seen);
  client.save("a.csg", csg + "cube(;");
  EXPECT_EQ(client.design()["ok"], false);
}

TEST(Preview, ShowsAMesh) {
  const std::string tetrahedron =
      "OFF\n4 4 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  PreviewClient client;
  client.path = client.folder / "a.off";
  client.write("a.off", tetrahedron);
  client.write("b.off", tetrahedron);
  client.begin({{"camera", kTop}});
  const frontend::Bytes seen = client.final_frame().image;
  EXPECT_EQ(seen, fresh_picture("polyhedron([[0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]],"
                                " [[1, 2, 0], [3, 1, 0], [3, 2, 1], [3, 0, 2]]);"));
  EXPECT_EQ(client.request("exportModel", {{"path", "a.off"}})["code"], -32803);
  EXPECT_EQ(client.folder.read("a.off"), tetrahedron);
  EXPECT_TRUE(client.request("exportModel", {{"path", "a.stl"}}).contains("path"));
  std::string wider = tetrahedron;
  wider.replace(wider.find("9 0 0"), 1, "8");
  client.save("a.off", wider);
  EXPECT_NE(client.final_frame().image, seen);
}

TEST(Preview, SaysWhenItsFileIsGone) {
  PreviewClient client;
  client.write("a.scad", "cube(4);");
  client.begin();
  EXPECT_EQ(client.design()["ok"], true);
  std::filesystem::remove(client.path);
  const Json design = client.design();
  EXPECT_EQ(design["ok"], false);
  EXPECT_THAT(design["messages"][0]["text"].get<std::string>(), HasSubstr("a.scad"));
}

TEST(Preview, ShowsTheDesignAsItsLookSays) {
  PreviewClient client("difference() { cube(10); translate([5, 5, 5]) sphere(4); }",
                       {{"camera", kTop}});
  std::vector<frontend::Bytes> pictures{client.final_frame().image};
  const Json looks[] = {
      {{"section", {{"normal", {0, 0, 1}}, {"position", 5}, {"flipped", false}}}},
      {{"section", {{"normal", {1, 0, 0}}, {"position", 4}, {"flipped", true}}}},
      {{"section", {{"normal", {0.6, 0, 0.8}}, {"position", 7}, {"flipped", false}}}},
      {{"section", nullptr}, {"colorscheme", "Metallic"}},
      {{"colorscheme", "Cornfield"}, {"axes", true}},
      {{"axes", false}, {"edges", true}},
      {{"edges", false}, {"shading", "studio"}},
      {{"shading", "flat"}, {"width", 100}}};
  for (const Json& look : looks) {
    client.look(look);
    const Client::Frame frame = client.final_frame();
    EXPECT_THAT(pictures, testing::Not(Contains(frame.image))) << look;
    pictures.push_back(frame.image);
  }
  EXPECT_EQ(client.client.frames.back().params["width"], 100);
  client.look({{"width", 160}});
  EXPECT_EQ(client.final_frame().image, pictures[0]);  // what is missing stays
}

TEST(Preview, ViewAllKeepsTheDirectionAndTheInsets) {
  PreviewClient client("translate([100, 0, 0]) cube(10);");
  client.final_frame();
  const Json all = client.request("viewAll", {{"camera", kTop}})["camera"];
  EXPECT_EQ(all["rotation"], Json({0.0, 0.0, 0.0}));
  EXPECT_NEAR(all["translation"][0], 105, 1e-6);
  const Json right = client.request(
      "viewAll", {{"camera", kTop},
                  {"insets", {{"left", 80}, {"top", 0}, {"right", 0}, {"bottom", 0}}}})["camera"];
  EXPECT_LT(right["translation"][0], 105);
  EXPECT_GT(right["distance"], all["distance"]);
}

TEST(Preview, ChoosesACameraIfTheClientHasNone) {
  PreviewClient client("translate([100, 0, 0]) cube(10);");
  EXPECT_GT(client.final_frame().params["camera"]["translation"][0], 90);
  PreviewClient other("$vpt = [1, 2, 3]; $vpd = 50; cube(10);");
  const Json design = other.design();
  EXPECT_EQ(design["camera"]["distance"], 50);
  EXPECT_EQ(other.final_frame().params["camera"]["translation"], Json({1.0, 2.0, 3.0}));
}

TEST(Preview, FindsWhatIsSeenAtAPlace) {
  PreviewClient client(
      "module post() {\n  translate([0, 0, 1]) cylinder(r = 3, h = 4);\n}\n"
      "translate([12, 0, 0]) color(\"red\") cube(10);\ntranslate([5, 5, 0]) post();\n",
      {{"camera", kTop}});
  client.final_frame();
  const Json post = client.request("pick", {{"camera", kTop}, {"x", 80}, {"y", 60}});
  EXPECT_NEAR(post["position"][2], 5, 1e-9);
  EXPECT_EQ(post["normal"], Json({0.0, 0.0, 1.0}));
  EXPECT_EQ(post["flat"], true);
  EXPECT_THAT(post["leaf"].get<std::string>(), HasSubstr("cylinder"));
  ASSERT_EQ(post["places"].size(), 2u);
  EXPECT_EQ(Client::place(post["places"][0]["range"]), "1:23-1:46");
  EXPECT_EQ(post["places"][0]["uri"], uri_of_path(client.path));
  EXPECT_EQ(Client::place(post["places"][1]["range"]), "4:21-4:28");
  EXPECT_EQ(post["places"][1]["label"], "post()");
  const double px_per_unit = 120 / (2 * 60 * std::tan(11.25 * 3.14159265358979 / 180));
  const auto x_of = [&](double x) { return 80 + (x - 5) * px_per_unit; };
  const Json cube = client.request("pick", {{"camera", kTop}, {"x", x_of(14)}, {"y", 60}});
  EXPECT_EQ(cube["color"], Json({1.0, 0.0, 0.0, 1.0}));
  EXPECT_EQ(client.request("pick", {{"camera", kTop}, {"x", 1}, {"y", 1}}), nullptr);
}

TEST(Preview, SnapsToFeatures) {
  PreviewClient client("cube(10);\ntranslate([-10, 5, 0]) cylinder(r = 4, h = 10, $fn = 0);",
                       {{"camera", kTop}});
  client.final_frame();
  const double px_per_unit = 120 / (2 * 60 * std::tan(11.25 * 3.14159265358979 / 180));
  const auto pick = [&](double x, double y) {
    return client.request("pick", {{"camera", kTop},
                                   {"x", 80 + (x - 5) * px_per_unit},
                                   {"y", 60 - (y - 5) * px_per_unit},
                                   {"snap", 6}});
  };
  const Json vertex = pick(9.6, 9.6);
  EXPECT_EQ(vertex["feature"]["kind"], "vertex");
  EXPECT_NEAR(vertex["feature"]["points"][0][0], 10, 1e-6);
  const Json edge = pick(9.6, 5);
  EXPECT_EQ(edge["feature"]["kind"], "edge");
  ASSERT_EQ(edge["feature"]["points"].size(), 2u);
  EXPECT_NEAR(edge["length"], 10, 1e-6);
  const double ends[] = {edge["feature"]["points"][0][1], edge["feature"]["points"][1][1]};
  EXPECT_NEAR(std::min(ends[0], ends[1]), 0, 1e-6);
  EXPECT_NEAR(std::max(ends[0], ends[1]), 10, 1e-6);
  const Json center = pick(-10, 5);
  EXPECT_EQ(center["feature"]["kind"], "center");
  EXPECT_EQ(center["flat"], false);
  EXPECT_NEAR(center["feature"]["points"][0][0], -10, 1e-6);
  EXPECT_NEAR(center["radius"], 4, 1e-9);
}

/// Returns a text in which a colour stands as the preview dims the scheme's first one.
std::string dimmed(const std::string& part) {
  const auto mix = [](double from, double to) { return from + 0.8 * (to - from); };
  char color[200];
  std::snprintf(color, sizeof color, "color([%.9g, %.9g, %.9g]) ", mix(0xf9 / 255., 1),
                mix(0xd7 / 255., 1), mix(0x2c / 255., 0xe5 / 255.));
  return color + part;
}

TEST(Preview, LightsWhatTheCursorsStatementMakes) {
  const std::string cube = "cube(5);", post = "translate([8, 0, 0]) post();";
  const std::string body = "module post() { sphere(3); }\n";
  PreviewClient client(body + cube + "\n" + post + "\n", {{"camera", kTop}});
  const frontend::Bytes whole = client.final_frame().image;
  const auto put = [&](int line, int character) {
    client.notify("cursor", {{"position", {{"line", line}, {"character", character}}}});
    return client.final_frame().image;
  };
  const frontend::Bytes cube_lit = fresh_picture(body + cube + dimmed(post));
  const frontend::Bytes post_lit = fresh_picture(body + dimmed(cube) + post);
  EXPECT_EQ(put(1, 2), cube_lit);
  EXPECT_EQ(put(2, 22), post_lit);
  EXPECT_EQ(put(1, 2), cube_lit);
  EXPECT_EQ(put(0, 20), post_lit);  // the call in the module
  client.notify("cursor");
  EXPECT_EQ(client.final_frame().image, whole);
  EXPECT_EQ(put(1, 2), cube_lit);
  // It stays lit as the text changes.
  client.change(body + "cube(5, center = true);\n" + post + "\n\n");
  EXPECT_EQ(client.final_frame().image,
            fresh_picture(body + "cube(5, center = true);" + dimmed(post)));
  EXPECT_EQ(put(3, 0), fresh_picture(body + "cube(5, center = true);" + post));  // nothing there
}

TEST(Preview, LightsWhatAnotherFileMakes) {
  PreviewClient client;
  client.folder.write("b.scad", "module post() {\n  sphere(3);\n}\n");
  client.client.open(client.path, "use <b.scad>\ncube(5);\ntranslate([8, 0, 0]) post();");
  client.begin({{"camera", kTop}});
  client.final_frame();
  client.notify("cursor", {{"uri", uri_of_path(client.folder / "b.scad")},
                           {"position", {{"line", 1}, {"character", 4}}}});
  EXPECT_EQ(client.final_frame().image,
            fresh_picture(dimmed("cube(5);") + "translate([8, 0, 0]) sphere(3);"));
}

TEST(Preview, TellsTheTextsThatItsDesignReads) {
  PreviewClient client;
  const std::string other = client.folder.write("b.scad", "size = 5;\n");
  const std::string secret = client.folder.write("c.scad", "secret = 5;\n");
  client.client.open(client.path, "include <b.scad>\ncube(size + 1);");
  client.begin();
  client.final_frame();
  const auto source = [&](const std::string& path) {
    return client.request("source", {{"uri", uri_of_path(path)}});
  };
  EXPECT_EQ(source(client.path)["text"], "include <b.scad>\ncube(size + 1);");
  EXPECT_EQ(source(other)["text"], "size = 5;\n");
  EXPECT_EQ(source(secret), nullptr);
  EXPECT_EQ(source("/etc/passwd"), nullptr);
  EXPECT_EQ(client.request("source")["code"], -32602);
}

TEST(Preview, LightsAHullByItsParts) {
  const std::string hull = "hull() { sphere(2); cube(4); }";
  PreviewClient client("translate([9, 9, 0]) cube(2);\n" + hull, {{"camera", kTop}});
  client.final_frame();
  client.notify("cursor", {{"position", {{"line", 1}, {"character", 12}}}});
  EXPECT_EQ(client.final_frame().image,
            fresh_picture(dimmed("translate([9, 9, 0]) cube(2);") + hull));
}

TEST(Preview, GivesParametersValues) {
  const std::string text =
      "// Of the box\nsize = 4; // [1:0.5:10]\nname = \"a\"; // [a:first, b:second]\n"
      "on = true;\nat = [0, 0, 0];\n/* [More] */\nlabel = \"x\"; // 3\n"
      "translate(at) cube(size);\nif (!on) sphere(6);\n";
  PreviewClient client(text, {{"camera", kTop}});
  const Json parameters = client.design()["parameters"];
  ASSERT_EQ(parameters.size(), 5u);
  EXPECT_EQ(parameters[0], Json({{"name", "size"},
                                 {"group", ""},
                                 {"description", "Of the box"},
                                 {"value", 4.0},
                                 {"default", 4.0},
                                 {"kind", "number"},
                                 {"min", 1.0},
                                 {"max", 10.0},
                                 {"step", 0.5}}));
  EXPECT_EQ(parameters[1]["choices"][1], Json({{"value", "b"}, {"label", "second"}}));
  EXPECT_EQ(parameters[2]["kind"], "boolean");
  EXPECT_EQ(parameters[3]["kind"], "vector");
  EXPECT_EQ(parameters[4]["length"], 3);
  EXPECT_EQ(parameters[4]["group"], "More");
  client.final_frame();
  client.notify("parameters", {{"values", {{"size", 8}, {"at", {1, 1, 0}}}}});
  EXPECT_EQ(client.final_frame().image, fresh_picture("translate([1, 1, 0]) cube(8);"));
  EXPECT_EQ(client.design()["parameters"][0]["value"], 8.0);
  client.notify("parameters", {{"values", {{"size", nullptr}}}});
  EXPECT_EQ(client.final_frame().image, fresh_picture("translate([1, 1, 0]) cube(4);"));
  client.notify("parameters", {{"values", {{"at", nullptr}}}});
  EXPECT_EQ(client.final_frame().image, fresh_picture("cube(4);"));
  for (const Json& wrong :
       {Json{{"size", "8"}}, Json{{"size", 11}}, Json{{"size", true}}, Json{{"name", "c"}},
        Json{{"on", 1}}, Json{{"at", {1, 2}}}, Json{{"at", {1, 2, "3"}}}, Json{{"none", 1}},
        Json{{"label", "much too long"}}, Json(7)}) {
    client.client.sent.clear();
    client.notify("parameters", {{"values", wrong}});
    EXPECT_NE(client.logged(), "") << wrong;
  }
}

TEST(Preview, KeepsSetsOfParameters) {
  PreviewClient client("size = 4; // [1:10]\ncube(size);", {{"camera", kTop}});
  client.design();
  client.final_frame();
  const auto use = [&](const char* action, const char* name) {
    return client.request("parameterSet", {{"action", action}, {"name", name}});
  };
  client.notify("parameters", {{"values", {{"size", 7}}}});
  client.final_frame();
  EXPECT_EQ(use("save", "seven")["problem"], "");
  EXPECT_THAT(client.folder.read("a.json"), HasSubstr("\"size\": \"7\""));
  EXPECT_EQ(use("choose", "")["problem"], "");
  EXPECT_EQ(client.final_frame().image, fresh_picture("cube(4);"));
  EXPECT_EQ(use("choose", "seven")["problem"], "");
  EXPECT_EQ(client.final_frame().image, fresh_picture("cube(7);"));
  EXPECT_NE(use("choose", "eight")["problem"], "");
  client.client.sent.clear();
  EXPECT_EQ(use("erase", "seven")["problem"], "");
  const Json design = client.design();
  EXPECT_EQ(design["sets"], Json::array());
  EXPECT_EQ(design["set"], "");
  EXPECT_EQ(use("burn", "seven")["code"], -32602);
  EXPECT_EQ(use("save", "")["code"], -32602);
}

TEST(Preview, ShowsATime) {
  PreviewClient client("translate([10 * $t, 0, 0]) cube(5);", {{"camera", kTop}});
  EXPECT_EQ(client.design()["animated"], true);
  client.final_frame();
  client.look({{"time", 0.5}});
  EXPECT_EQ(client.final_frame().image, fresh_picture("translate([5, 0, 0]) cube(5);"));
  client.look({{"time", 0}});
  EXPECT_EQ(client.final_frame().image, fresh_picture("cube(5);"));
}

TEST(Preview, TellsOfLongWorkAndStopsIt) {
  PreviewClient client("cube(5);", {{"camera", kTop}});
  const frontend::Bytes before = client.final_frame().image;
  client.change(kEndless + std::string("cube(6);"));
  const Json progress = client.progress();
  EXPECT_EQ(progress["stage"], "evaluating");
  EXPECT_GE(progress["ms"], 1000);
  client.notify("stop");
  while (client.progress()["stage"] != "") {
  }
  client.look({{"axes", true}});
  client.final_frame();
  client.look({{"axes", false}});
  EXPECT_EQ(client.final_frame().image, before);
  client.change("cube(7);");
  EXPECT_EQ(client.final_frame().image, fresh_picture("cube(7);"));
}

TEST(Preview, SavesThePictureThatIsShown) {
  PreviewClient client("cube(5);", {{"camera", kTop}});
  const frontend::Bytes shown = client.final_frame().image;
  const auto save = [&](const std::string& path) {
    return client.request("savePicture", {{"path", path}});
  };
  EXPECT_EQ(save("a.png")["path"], client.folder / "a.png");
  const std::string saved = client.folder.read("a.png");
  EXPECT_TRUE(std::equal(saved.begin(), saved.end(), shown.begin(), shown.end(),
                         [](char a, std::byte b) { return static_cast<std::byte>(a) == b; }));
  EXPECT_EQ(save(client.folder / "b.exr")["path"], client.folder / "b.exr");
  EXPECT_TRUE(client.folder.has("b.exr"));
  client.folder.write("surface.png", "no picture");
  client.change("cube(5); surface(\"surface.png\");");
  while (client.design()["version"] != 2) {
  }
  EXPECT_EQ(save("surface.png")["code"], -32803);  // the design reads it
  EXPECT_EQ(client.folder.read("surface.png"), "no picture");
  EXPECT_EQ(save("a.jpg")["code"], -32602);
  EXPECT_EQ(save("")["code"], -32602);
  EXPECT_EQ(save(client.folder / "none/a.png")["code"], -32803);
}

TEST(Preview, ExportsTheTextThatIsShown) {
  PreviewClient client("include <b.scad>\ncube(size);");
  client.client.open(client.folder / "b.scad", "size = 5;");
  client.final_frame();
  const auto save = [&](const std::string& path) {
    return client.request("exportModel", {{"path", path}});
  };
  EXPECT_EQ(save("a.off")["path"], client.folder / "a.off");
  EXPECT_THAT(client.folder.read("a.off"), HasSubstr("5 5 5"));
  EXPECT_EQ(save("a.scad")["code"], -32602);
  EXPECT_EQ(save("a.svg")["code"], -32803);  // a solid is no plane figure
}

TEST(Preview, AClientThatAcknowledgesNothingGetsOneFrame) {
  PreviewClient client("cube(5);", {{"camera", kTop}});
  client.client.run_until([&] { return !client.client.frames.empty(); });
  for (int i = 0; i < 20; ++i) {
    client.look({{"section", {{"normal", {0, 0, 1}}, {"position", 0.2 * i}, {"flipped", true}}}});
    client.request("pick", {{"camera", kTop}, {"x", 1}, {"y", 1}});  // behind the picture
  }
  EXPECT_EQ(client.client.frames.size(), 1u);
  client.notify("shown", {{"number", 7}});  // which was never sent
  client.request("pick", {{"camera", kTop}, {"x", 1}, {"y", 1}});
  EXPECT_EQ(client.client.frames.size(), 1u);
  client.acknowledge();
  client.client.run_until([&] { return client.client.frames.size() > 1; });
  EXPECT_EQ(client.client.frames.back().params["number"], 2);  // the newest alone
  EXPECT_EQ(client.client.frames.back().image,
            fresh_picture("translate([0, 0, 3.8]) cube([5, 5, 1.2]);"));
}

std::set<std::string> thread_folders() {
  std::set<std::string> folders;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task"))
    folders.insert(task.path());
  return folders;
}

TEST(Preview, GivesItsThreadsBackWhenItIsClosed) {
  PreviewClient client("cube(5);");
  client.final_frame();
  const std::size_t before = thread_folders().size();
  for (int i = 0; i < 10; ++i) {
    client.begin();
    client.final_frame();
    EXPECT_EQ(client.request("closePreview"), nullptr);
  }
  EXPECT_LE(thread_folders().size(), before + 1);
  EXPECT_EQ(client.request("closePreview")["code"], -32602);
}

/// Returns how often threads have waited for something.
long waits(const std::set<std::string>& folders) {
  long count = 0;
  for (const std::string& folder : folders) {
    std::ifstream file(folder + "/status");
    for (std::string line; std::getline(file, line);) {
      constexpr std::string_view kName = "voluntary_ctxt_switches:";
      if (line.starts_with(kName)) count += std::stol(line.substr(kName.size()));
    }
  }
  return count;
}

TEST(Preview, DoesNothingAtRest) {
  const std::set<std::string> others = thread_folders();  // a sanitizer's may wake by itself
  PreviewClient client;
  client.write("a.scad", "include <b.scad>\ncube(size);");
  client.write("b.scad", "size = 5;");
  client.begin();
  client.final_frame();
  std::set<std::string> threads;
  std::ranges::set_difference(thread_folders(), others, std::inserter(threads, threads.end()));
  EXPECT_FALSE(threads.empty());
  long before = 0, after = -1;
  for (int i = 0; i < 60 && after != before; ++i) {  // all threads come to rest
    before = waits(threads);
    std::this_thread::sleep_for(std::chrono::seconds(1));
    after = waits(threads);
  }
  EXPECT_EQ(after, before);
}

TEST(Preview, GivesItsMemoryBackWhenItIsClosed) {
  const std::string many = "for (i = [0 : 199], j = [0 : 199]) translate([i, j, 0]) sphere(0.4);";
  PreviewClient client("cube(5);");
  client.final_frame();
  client.request("closePreview");
  client.change(many);
  client.client.settle();
  const std::size_t before = resident_bytes();
  client.begin();
  client.final_frame();
  const std::size_t open = resident_bytes();
  client.request("closePreview");
  EXPECT_GT(open, before + (std::size_t{20} << 20));
#ifndef SCADRAY_SANITIZED  // which keeps what is freed for a while
  EXPECT_LT(resident_bytes(), before + (open - before) / 4);
#endif
}

TEST(Preview, CloseEndsWhatWaits) {
  PreviewClient client(kEndless + std::string("cube(6);"));
  EXPECT_EQ(client.request("savePicture", {{"path", "a.png"}})["code"], -32803);
  EXPECT_EQ(client.request("pick", {{"camera", kTop}, {"x", 1}, {"y", 1}}), nullptr);
  EXPECT_EQ(client.request("closePreview"), nullptr);
}

TEST(Preview, ManyAreRefused) {
  PreviewClient client("cube(5);");
  for (int i = 1; i < 16; ++i) client.begin();
  EXPECT_FALSE(client.opened.contains("code"));
  client.begin();
  EXPECT_EQ(client.opened["code"], -32803);
}

TEST(Preview, WrongParametersAreErrors) {
  PreviewClient client("cube(5);");
  client.final_frame();
  const auto with = [](const char* name, const Json& value) {
    Json camera = kTop;
    camera[name] = value;
    return Json{{"camera", camera}, {"x", 1}, {"y", 1}};
  };
  for (const Json& wrong :
       {with("distance", "1"), with("distance", 1e300), with("rotation", {1, 2}),
        with("projection", "fisheye"), with("fov", "x"), with("translation", {1, 2, nullptr}),
        Json{{"camera", kTop}, {"x", -1}, {"y", 1}}, Json{{"camera", kTop}, {"x", 1}, {"y", 999}},
        Json{{"camera", kTop}, {"x", 1}, {"y", 1}, {"snap", -1}}, Json{{"x", 1}, {"y", 1}}}) {
    EXPECT_EQ(client.request("pick", wrong)["code"], -32602) << wrong;
  }
  const Json insets = {{"left", 100}, {"top", 0}, {"right", 100}, {"bottom", 0}};
  EXPECT_EQ(client.request("viewAll", {{"camera", kTop}, {"insets", insets}})["code"], -32602);
  const Json looks[] = {{{"width", 0}},
                        {{"width", 4097}},
                        {{"height", "9"}},
                        {{"moving", 1}},
                        {{"section", 1}},
                        {{"section", {{"normal", {0, 0, 0}}, {"position", 1}, {"flipped", true}}}},
                        {{"section", {{"normal", {0, 1}}, {"position", 1}, {"flipped", true}}}},
                        {{"shading", "dark"}},
                        {{"colorscheme", "none"}},
                        {{"axes", 1}},
                        {{"edges", nullptr}},
                        {{"time", "now"}}};
  for (const Json& look : looks) {
    client.client.sent.clear();
    client.look(look);
    EXPECT_NE(client.logged(), "") << look;
    const Json params = {{"textDocument", {{"uri", uri_of_path(client.path)}}}, {"look", look}};
    EXPECT_EQ(client.client.request("scadray/openPreview", params)["code"], -32602) << look;
  }
  for (const Json& preview : {Json(2), Json(-1), Json("1"), Json(nullptr), Json(1e300)}) {
    EXPECT_EQ(client.client.request("scadray/closePreview", {{"preview", preview}})["code"],
              -32602);
  }
  const Json untitled = {{"textDocument", {{"uri", "untitled:1"}}}, {"look", Json::object()}};
  EXPECT_EQ(client.client.request("scadray/openPreview", untitled)["code"], -32602);
}

TEST(Preview, OfADocumentWithoutAFile) {
  Client client;
  client.notify(
      "textDocument/didOpen",
      {{"textDocument",
        {{"uri", "untitled:1"}, {"languageId", "scad"}, {"version", 1}, {"text", "cube(5);"}}}});
  const Json result = client.request(
      "scadray/openPreview",
      {{"textDocument", {{"uri", "untitled:1"}}}, {"look", {{"width", 50}, {"height", 50}}}});
  ASSERT_EQ(result["preview"], 1);
  ASSERT_TRUE(client.run_until([&] { return !client.frames.empty(); }));
  const Json pick = client.request(
      "scadray/pick",
      {{"preview", 1}, {"camera", client.frames[0].params["camera"]}, {"x", 25}, {"y", 25}});
  EXPECT_EQ(pick["places"][0]["uri"], "untitled:1");
  EXPECT_EQ(client.request("scadray/savePicture", {{"preview", 1}, {"path", "a.png"}})["code"],
            -32602);
  EXPECT_EQ(client.request("scadray/parameterSet",
                           {{"preview", 1}, {"action", "save"}, {"name", "x"}})["code"],
            -32803);
}

}  // namespace
}  // namespace serve
