// Tests the panels' layout without a display, at several densities and widths: nothing is cut off
// at the right, none leaves the window, and no two overlap where there is room for them.
#include "panels/panels.hpp"

#include <gmock/gmock.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <set>

#include "frontend/parser.hpp"
#include "language/customizer.hpp"
#include "state_texts.hpp"

namespace window {
namespace {

struct Screen {
  float scale;
  float width, height;
};

void PrintTo(const Screen& screen, std::ostream* out) {
  *out << screen.width << " × " << screen.height << " at " << screen.scale;
}

constexpr const char* kParameters =
    "/* [A group whose name is long enough to be cut in a narrow window] */\n"
    "// A description that is wrapped wherever it is shown\n"
    "a_parameter_with_a_long_name = 1; // [9]\nb = [1, 2, 3, 4];\nc = true;\n";

constexpr const char* kWarning = "WARNING: Ignoring unknown variable 'x' in file a.scad, line ";

/// ImGui, with the font and the style that the window has at a scale.
class Panels : public testing::TestWithParam<Screen> {
 protected:
  Panels() : state_(frontend::Options{}) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {GetParam().width, GetParam().height};
    ImFontConfig font;
    font.SizePixels = std::round(13 * GetParam().scale);
    io.Fonts->AddFontDefault(&font);
    io.Fonts->Build();
    ImGui::GetStyle().ScaleAllSizes(GetParam().scale);
    state_.design = std::make_shared<frontend::ImportedDesign>(
        frontend::import_design(frontend::parse("cube(size = [10, 20, 40]);", "")));
    state_.customizer.take(std::make_shared<const frontend::DesignParameters>(
        frontend::DesignParameters{kParameters, *language::customizer_parameters(kParameters)}));
  }
  ~Panels() override { ImGui::DestroyContext(); }

  /// Draws frames until the windows have found their sizes.
  void draw() {
    csgcore::View view;
    view.width_px = static_cast<uint32_t>(GetParam().width);
    view.height_px = static_cast<uint32_t>(GetParam().height);
    for (int frame = 0; frame < 4; ++frame) {
      ImGui::GetIO().DeltaTime = 0.02f;
      ImGui::NewFrame();
      draw_panels(state_, view, 1,
                  {[](Command) {}, [](const std::string&) {}, [](const auto&) {},
                   [](const std::string&) {}});
      ImGui::EndFrame();
    }
  }

  static std::vector<ImGuiWindow*> shown() {
    std::vector<ImGuiWindow*> windows;
    for (ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
      const bool is_panel = window->Active && !window->Hidden && window->ParentWindow == nullptr;
      if (is_panel && !(window->Flags & ImGuiWindowFlags_NoInputs)) windows.push_back(window);
      if (is_panel && std::string(window->Name) == "##status") windows.push_back(window);
    }
    return windows;
  }

  static void expect_whole() {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    for (const ImGuiWindow* window : shown()) {
      if (std::string(window->Name).starts_with("Debug")) continue;
      SCOPED_TRACE(window->Name);
      EXPECT_GE(window->Pos.x, 0);
      EXPECT_GE(window->Pos.y, 0);
      EXPECT_LE(window->Pos.x + window->Size.x, display.x);
      EXPECT_LE(window->Pos.y + window->Size.y, display.y);
      const float right = window->DC.CursorMaxPos.x;
      EXPECT_LE(right, window->Pos.x + window->Size.x + 0.5f) << "cut off";
    }
  }

  static void expect_disjoint() {
    const std::vector<ImGuiWindow*> windows = shown();
    for (const ImGuiWindow* a : windows) {
      for (const ImGuiWindow* b : windows) {
        if (a >= b) continue;
        EXPECT_FALSE(a->Rect().Overlaps(b->Rect())) << a->Name << ", " << b->Name;
      }
    }
  }

  void measure() {
    MeasuredPoint point;
    const frontend::SourcePlace place{"/a/design.scad", "design.scad", 16, 136};
    point.place.trail = {{"cube(size = [27, 27, 12])", place},
                         {"a_module_with_a_long_name(and_its_argument = 1)", place}};
    point.surface = {Surface::Kind::kPlane, csgcore::Vec3(0), csgcore::Vec3(0, 0, 1), 0};
    state_.measure(point);
  }
  void say() {
    std::vector<std::string> lines;
    for (int i = 0; i < 5; ++i) lines.push_back(kWarning + std::to_string(i));
    lines.push_back("ECHO: \"a\"");
    state_.messages = messages_of(lines);
  }

  State state_;
};

TEST_P(Panels, AreWhole) {
  draw();
  expect_whole();
  const auto alone = [&](const char* what, const auto& open, const auto& close) {
    SCOPED_TRACE(what);
    open();
    draw();
    expect_whole();
    expect_disjoint();
    close();
  };
  const auto with = [&](const char* what, bool& shows) {
    alone(
        what, [&] { shows = true; }, [&] { shows = false; });
  };
  with("help", state_.shows_help);
  with("parameters", state_.shows_parameters);
  with("animation", state_.shows_animation);
  alone(
      "section",
      [&] {
        state_.set_section_normal({1, 0, 0});
      },
      [&] { state_.section.is_on = false; });
  alone(
      "place", [&] { measure(); }, [&] { state_.points.clear(); });
  alone(
      "messages", [&] { say(); }, [&] { state_.messages.clear(); });
  state_.picture_dialogue.is_asked_for = true;
  draw();
  expect_whole();
}

TEST_P(Panels, TheDialogueForExportsIsWhole) {
  state_.apply(Command::kExport);
  draw();
  expect_whole();
}

TEST_P(Panels, TheDialogueForDesignsIsWhole) {
  state_.asks_for_design = true;
  draw();
  expect_whole();
}

TEST_P(Panels, TheHelpIsShownWithoutScrolling) {
  if (GetParam().width / GetParam().scale < 1000) GTEST_SKIP() << "too small";
  state_.shows_help = true;
  draw();
  const ImGuiWindow* const help = ImGui::FindWindowByName("Mouse and keys");
  ASSERT_NE(help, nullptr);
  EXPECT_EQ(help->ScrollMax.y, 0);
}

TEST_P(Panels, DoNotOverlap) {
  if (GetParam().height / GetParam().scale < 400) GTEST_SKIP() << "too low for all of them";
  state_.set_section_normal({1, 0, 0});
  state_.shows_parameters = state_.shows_animation = true;
  say();
  draw();
  expect_whole();
  expect_disjoint();
}

TEST_P(Panels, AChangedParameterCanBeReset) {
  state_.shows_parameters = true;
  state_.customizer.set(0, 2.0);
  draw();
  expect_whole();
}

/// A right click on a message copies that one, a right click on the place all that is measured.
TEST_P(Panels, ARightClickCopiesWhatItIsOn) {
  say();
  measure();
  draw();
  const auto copied_within = [this](const std::string& name) {
    std::set<std::string> copied;
    const ImGuiWindow* const window = ImGui::FindWindowByName(name.c_str());
    for (float y = window->Pos.y; y < window->Pos.y + window->Size.y; y += 5) {
      ImGui::GetIO().MousePos = {window->Pos.x + 20, y};  // over the first tab, not the next
      for (const bool is_down : {true, false}) {
        ImGui::GetIO().MouseDown[ImGuiMouseButton_Right] = is_down;
        draw();
      }
      if (const char* text = ImGui::GetClipboardText()) copied.insert(text);
    }
    return copied;
  };
  EXPECT_THAT(copied_within("##messages"), testing::Contains(kWarning + std::string("0")));
  ImGui::SetClipboardText("");
  EXPECT_THAT(copied_within("##place"), testing::ElementsAre(text_to_copy(state_)));
  EXPECT_THAT(state_.notice, testing::StartsWith("copied: [0, 0, 0]"));
}

INSTANTIATE_TEST_SUITE_P(, Panels,
                         testing::Values(Screen{1, 480, 400}, Screen{1, 640, 480},
                                         Screen{1, 1024, 768}, Screen{1, 1280, 800},
                                         Screen{1.5, 480, 400}, Screen{1.5, 640, 600},
                                         Screen{2, 480, 480}, Screen{2, 480, 900},
                                         Screen{2, 640, 480}, Screen{2, 640, 900},
                                         Screen{2, 1280, 800}));

}  // namespace
}  // namespace window
