#include "glfw_window.hpp"

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE  // epoxy provides OpenGL
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "frontend/error.hpp"
#include "frontend/terminal.hpp"
#include "letters.hpp"
#include "panels/keyboard.hpp"

namespace window {
namespace {

/// A press and a release at most this far apart are a click, in units of the screen.
constexpr double kClickReach = 3;
/// Two clicks within this time are a double click.
constexpr double kDoubleClick_s = 0.4;
constexpr double kUnknownRate = 60;  // frames/s, if the display does not tell
constexpr Size kLeastSize{160, 120};

std::string last_error;  // GLFW's

/// Returns whether what a key does is done again and again while it is held.
bool repeats(int key, uint8_t modifiers) {
  if (const PictureKey* picture_key = find_picture_key(key, modifiers)) {
    return picture_key->action != PictureKey::Action::kMeasure;
  }
  const CommandRow* const row = find_command(key, modifiers);
  return row && (row->command == Command::kZoomIn || row->command == Command::kZoomOut);
}

bool is_alt(int key) { return key == GLFW_KEY_LEFT_ALT || key == GLFW_KEY_RIGHT_ALT; }

/// Returns whether all that a key does is to type a character.
bool types_text(int key, int glfw_modifiers) {
  return key > GLFW_KEY_SPACE && key < GLFW_KEY_ESCAPE && (glfw_modifiers & GLFW_MOD_CONTROL) == 0;
}

/// Returns whether ImGui's items are walked along, chosen or scrolled by a key.
bool walks_panels(int key) {
  constexpr int kKeys[] = {GLFW_KEY_LEFT,    GLFW_KEY_RIGHT,     GLFW_KEY_UP,   GLFW_KEY_DOWN,
                           GLFW_KEY_PAGE_UP, GLFW_KEY_PAGE_DOWN, GLFW_KEY_HOME, GLFW_KEY_END,
                           GLFW_KEY_ENTER,   GLFW_KEY_KP_ENTER,  GLFW_KEY_SPACE};
  return std::find(std::begin(kKeys), std::end(kKeys), key) != std::end(kKeys);
}

/// By GLFW's numbers.
constexpr WindowEvents::Button kButtons[] = {
    WindowEvents::Button::kLeft, WindowEvents::Button::kRight, WindowEvents::Button::kMiddle};

uint8_t modifiers_of(int glfw_modifiers) {
  return static_cast<uint8_t>(((glfw_modifiers & GLFW_MOD_CONTROL) ? kControl : 0) |
                              ((glfw_modifiers & GLFW_MOD_SHIFT) ? kShift : 0) |
                              ((glfw_modifiers & GLFW_MOD_ALT) ? kAlt : 0));
}

[[noreturn]] void fail(const std::string& what, const std::string& todo) {
  throw frontend::Error("", {}, what + (last_error.empty() ? "" : ": " + last_error), todo);
}

/// Makes a size that is to fit smaller than the largest screen, and forgets a position whose title
/// bar would be on none.
void fit_to_screens(Placement& placement) {
  constexpr int kTitle = 40;  // at least as high as a window's title bar
  int count = 0, most_width = 0, most_height = 0;
  GLFWmonitor** const monitors = glfwGetMonitors(&count);
  bool is_on_screen = false;
  for (int i = 0; i < count; ++i) {
    int x = 0, y = 0, width = 0, height = 0;
    glfwGetMonitorWorkarea(monitors[i], &x, &y, &width, &height);
    most_width = std::max(most_width, width);
    most_height = std::max(most_height, height);
    if (!placement.position) continue;
    const auto [left, top] = *placement.position;
    is_on_screen |=
        left + kTitle >= x && left + kTitle <= x + width && top >= y && top + kTitle <= y + height;
  }
  if (!is_on_screen) placement.position.reset();
  if (!placement.fits_screen || count == 0) return;
  placement.size.width_px = std::min(placement.size.width_px, static_cast<uint32_t>(most_width));
  placement.size.height_px = std::min(placement.size.height_px, static_cast<uint32_t>(most_height));
}

/// Holds GLFW itself, as long as there is a window.
class Library {
 public:
  Library() {
    glfwSetErrorCallback([](int, const char* text) { last_error = text; });
    if (!glfwInit()) {
      fail("no window can be opened", "set DISPLAY; or draw without a window: scadray -o FILE.png");
    }
  }
  ~Library() { glfwTerminate(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

}  // namespace

struct GlfwWindow::Impl {
  Impl(const std::string& title, const Placement& placement, WindowEvents& window_events);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void open(const std::string& title, Placement placement);
  void set_up_imgui();
  void on_button(int button, int action, int glfw_modifiers);
  void on_cursor(double x, double y);
  /// An event of the keyboard, by GLFW's numbers; or a character of Unicode.
  struct KeyEvent {
    int key = 0, scancode = 0, action = 0, modifiers = 0;
    unsigned character = 0;  // 0: it is a key
  };
  void take_key(const KeyEvent& event);
  void take_waiting_keys();
  void on_key(const KeyEvent& event);
  void on_character(unsigned character);
  bool give_to_picture(const KeyEvent& event);
  void on_alt(int action);
  void toggle_menus();
  void note_placement();
  void place_cursor();
  double pixels_per_unit() const;
  bool is_over_panel() const;

  static Impl& of(GLFWwindow* window) {
    return *static_cast<Impl*>(glfwGetWindowUserPointer(window));
  }

  WindowEvents& events;
  Library library;
  GLFWwindow* window = nullptr;
  std::optional<Letters> letters;
  bool is_active = true;
  bool has_new_placement = false;
  bool has_key_for_frame = false;      // ImGui will act upon a key in the next frame
  std::vector<KeyEvent> waiting_keys;  // those that came after it
  bool is_alt_alone = false;           // Alt is down, and nothing else has happened since

  // The state of the mouse, in units of the screen.
  int pressed = -1;  // the button that is held; -1: none
  uint8_t modifiers = 0;
  bool has_cursor = false;  // its place is known
  double cursor_x = 0, cursor_y = 0;
  double press_x = 0, press_y = 0;
  double last_x = 0, last_y = 0;  // up to where it was dragged
  bool has_moved = false;
  double last_click_s = -1e9;
  std::optional<ImVec2> panel_press;  // where a panel was pressed that has not seen it yet
};

GlfwWindow::Impl::Impl(const std::string& title, const Placement& placement,
                       WindowEvents& window_events)
    : events(window_events) {
  open(title, placement);
  set_up_imgui();
}

void GlfwWindow::Impl::open(const std::string& title, Placement placement) {
  fit_to_screens(placement);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "scadray");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "scadray");
  glfwWindowHint(GLFW_MAXIMIZED, placement.is_maximized ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);  // until it has its position
  window = glfwCreateWindow(static_cast<int>(placement.size.width_px),
                            static_cast<int>(placement.size.height_px),
                            frontend::visible(title).c_str(), nullptr, nullptr);
  if (!window) {
    fail("no window with OpenGL 3.3 can be opened",
         "install a driver, with: apt-get install libgl1-mesa-dri; or draw without a window: "
         "scadray -o FILE.png");
  }
  if (placement.position) {
    glfwSetWindowPos(window, placement.position->first, placement.position->second);
  }
  glfwShowWindow(window);
  glfwMakeContextCurrent(window);
  glfwSwapInterval(1);
  glfwSetWindowSizeLimits(window, kLeastSize.width_px, kLeastSize.height_px, GLFW_DONT_CARE,
                          GLFW_DONT_CARE);
  glfwSetWindowUserPointer(window, this);
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
    of(w).is_alt_alone = false;
    of(w).on_button(button, action, mods);
  });
  glfwSetCursorPosCallback(window,
                           [](GLFWwindow* w, double x, double y) { of(w).on_cursor(x, y); });
  glfwSetWindowPosCallback(window, [](GLFWwindow* w, int, int) { of(w).note_placement(); });
  glfwSetWindowSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).note_placement(); });
  glfwSetWindowMaximizeCallback(window, [](GLFWwindow* w, int) { of(w).note_placement(); });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    of(w).is_active = true;
    of(w).events.drop({paths, paths + count});
  });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int) { of(w).is_alt_alone = false; });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double notches) {
    Impl& impl = of(w);
    impl.is_active = true;
    if (impl.is_over_panel()) return;
    const double scale = impl.pixels_per_unit();
    impl.events.wheel(notches, impl.cursor_x * scale, impl.cursor_y * scale);
  });
  const auto activity = [](GLFWwindow* w) { of(w).is_active = true; };
  glfwSetWindowRefreshCallback(window, activity);
  glfwSetWindowCloseCallback(window, activity);
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).is_active = true; });
  glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { of(w).is_active = true; });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int is_inside) {
    of(w).is_active = true;
    if (!is_inside) of(w).events.leave();
  });
}

void GlfwWindow::Impl::set_up_imgui() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // nothing is stored between runs
  io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange | ImGuiConfigFlags_NavEnableKeyboard;
  float scale = 1, scale_y = 1;
  glfwGetWindowContentScale(window, &scale, &scale_y);
  letters.emplace(scale);
  ImGui::StyleColorsDark();
  ImGui::GetStyle().ScaleAllSizes(scale);
  ImGui::GetStyle().WindowRounding = 4;
  // ImGui calls the callbacks that are installed already.
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  // The callbacks of the keyboard are ours alone, and pass on to ImGui what is its.
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    of(w).take_key({key, scancode, action, mods});
  });
  glfwSetCharCallback(
      window, [](GLFWwindow* w, unsigned character) { of(w).take_key({.character = character}); });
  if (!ImGui_ImplOpenGL3_Init("#version 330 core")) {
    fail("Dear ImGui does not start on this OpenGL", "draw without a window: scadray -o FILE.png");
  }
}

GlfwWindow::Impl::~Impl() {
  if (ImGui::GetCurrentContext()) {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
  if (window) glfwDestroyWindow(window);
}

/// Returns whether the mouse is over a panel, or a panel holds it. ImGui itself knows of the
/// cursor's place from the last frame only, and the cursor may have jumped since.
bool GlfwWindow::Impl::is_over_panel() const {
  const ImGuiContext& imgui = *ImGui::GetCurrentContext();
  if (imgui.OpenPopupStack.Size > 0 || (imgui.ActiveId != 0 && ImGui::IsAnyMouseDown()))
    return true;
  const ImVec2 place(static_cast<float>(cursor_x), static_cast<float>(cursor_y));
  return std::any_of(imgui.Windows.begin(), imgui.Windows.end(), [&](const ImGuiWindow* panel) {
    const bool takes_mouse = (panel->Flags & ImGuiWindowFlags_NoMouseInputs) == 0;
    return panel->Active && !panel->Hidden && takes_mouse &&
           panel->OuterRectClipped.Contains(place);
  });
}

double GlfwWindow::Impl::pixels_per_unit() const {
  int width = 0, height = 0, pixels_x = 0, pixels_y = 0;
  glfwGetWindowSize(window, &width, &height);
  glfwGetFramebufferSize(window, &pixels_x, &pixels_y);
  return width > 0 ? static_cast<double>(pixels_x) / width : 1;
}

void GlfwWindow::Impl::on_button(int button, int action, int glfw_modifiers) {
  is_active = true;
  if (action == GLFW_PRESS) {
    if (pressed >= 0 || button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    if (is_over_panel()) {
      panel_press = ImVec2(static_cast<float>(cursor_x), static_cast<float>(cursor_y));
      return;
    }
    pressed = button;
    modifiers = modifiers_of(glfw_modifiers);
    has_moved = false;
    // The place is taken from the events: the cursor's present place is further on if events come
    // late.
    press_x = last_x = cursor_x;
    press_y = last_y = cursor_y;
    events.press(kButtons[pressed], press_x * pixels_per_unit(), press_y * pixels_per_unit());
    return;
  }
  if (button != pressed) return;
  pressed = -1;
  if (has_moved) return;
  if (button == GLFW_MOUSE_BUTTON_RIGHT) events.right_click();
  if (button != GLFW_MOUSE_BUTTON_LEFT) return;
  const double now = glfwGetTime();
  const double scale = pixels_per_unit();
  const bool is_second = now - last_click_s < kDoubleClick_s;
  last_click_s = is_second ? -1e9 : now;
  if (is_second) {
    events.double_click(press_x * scale, press_y * scale);
  } else {
    events.click(modifiers, press_x * scale, press_y * scale);
  }
}

/// Gives a key that goes down, or repeats, to the picture if it is the picture's. Returns whether
/// ImGui must not see it.
bool GlfwWindow::Impl::give_to_picture(const KeyEvent& event) {
  const uint8_t held = modifiers_of(event.modifiers);
  const bool is_press = event.action == GLFW_PRESS;
  if (event.key == GLFW_KEY_F10) {
    if (is_press) toggle_menus();
    return true;
  }
  if (dialogue_has_keys()) return false;
  const bool has_panel = panels_have_keys();
  if (event.key == GLFW_KEY_TAB) {
    enter_panel((held & kShift) != 0 ? -1 : 1);
    has_key_for_frame = true;
    return true;
  }
  if (event.key == GLFW_KEY_ESCAPE && ImGui::IsAnyItemActive()) return false;
  if (event.key == GLFW_KEY_ESCAPE && has_panel) {
    leave_panels();
    return true;
  }
  if (walks_panels(event.key) && has_panel) return false;
  if (is_press || repeats(event.key, held)) events.key(event.key, held);
  return walks_panels(event.key);
}

/// Alt alone opens the menu when it goes up: it also belongs to other keys, and to window managers.
void GlfwWindow::Impl::on_alt(int action) {
  if (action == GLFW_PRESS) is_alt_alone = true;
  if (action == GLFW_RELEASE && std::exchange(is_alt_alone, false)) toggle_menus();
}

void GlfwWindow::Impl::toggle_menus() {
  if (!close_menus()) events.open_menu();
  has_key_for_frame = true;
}

void GlfwWindow::Impl::on_key(const KeyEvent& event) {
  if (is_alt(event.key)) return on_alt(event.action);
  is_alt_alone = false;
  if (event.action != GLFW_RELEASE) {
    if (give_to_picture(event)) return;
    if (event.action == GLFW_REPEAT) return;  // ImGui repeats keys by itself
  }
  has_key_for_frame = !types_text(event.key, event.modifiers);
  ImGui_ImplGlfw_KeyCallback(window, event.key, event.scancode, event.action, event.modifiers);
}

void GlfwWindow::Impl::on_character(unsigned character) {
  if (!dialogue_has_keys()) events.character(character);
  ImGui_ImplGlfw_CharCallback(window, character);
}

/// This ImGui sees the keys that are down in a frame, and takes some frames to move the focus. So
/// what comes after a key that may do so, its own release too, waits until the focus rests.
void GlfwWindow::Impl::take_key(const KeyEvent& event) {
  is_active = true;
  if (has_key_for_frame) {
    const bool repeats = event.character == 0 && event.action == GLFW_REPEAT;
    if (!repeats) waiting_keys.push_back(event);
  } else if (event.character != 0) {
    on_character(event.character);
  } else {
    on_key(event);
  }
}

/// To be called after each frame.
void GlfwWindow::Impl::take_waiting_keys() {
  if (is_focus_moving()) {
    is_active = true;  // which asks for further frames
    return;
  }
  has_key_for_frame = false;
  for (const KeyEvent& event : std::exchange(waiting_keys, {})) take_key(event);
}

void GlfwWindow::Impl::on_cursor(double x, double y) {
  is_active = true;
  is_alt_alone = false;
  has_cursor = true;
  cursor_x = x;
  cursor_y = y;
  const double scale = pixels_per_unit();
  if (pressed < 0) return events.move(x * scale, y * scale);
  if (!has_moved && std::hypot(x - press_x, y - press_y) < kClickReach) return;
  has_moved = true;
  const double dx = x - std::exchange(last_x, x), dy = y - std::exchange(last_y, y);
  events.drag(kButtons[pressed], modifiers, dx * scale, dy * scale);
}

void GlfwWindow::Impl::note_placement() {
  is_active = true;
  has_new_placement = true;
}

/// ImGui's backend asks where the cursor is now, which may have left what its button still holds:
/// the button's release is an event that has not come yet. A frame that sees a panel pressed for
/// the first time has the cursor where that was.
void GlfwWindow::Impl::place_cursor() {
  ImVec2& place = ImGui::GetIO().MousePos;
  if (has_cursor && ImGui::IsMousePosValid(&place)) {
    place = {static_cast<float>(cursor_x), static_cast<float>(cursor_y)};
  }
  if (const auto press = std::exchange(panel_press, std::nullopt)) {
    place = *press;
    is_active = true;  // the next frame has the cursor where it is
  }
}

GlfwWindow::GlfwWindow(const std::string& title, const Placement& placement, WindowEvents& events)
    : impl_(std::make_unique<Impl>(title, placement, events)) {}
GlfwWindow::~GlfwWindow() = default;

bool GlfwWindow::is_closing() const { return glfwWindowShouldClose(impl_->window); }
void GlfwWindow::close() { glfwSetWindowShouldClose(impl_->window, GLFW_TRUE); }

Size GlfwWindow::size() const {
  if (glfwGetWindowAttrib(impl_->window, GLFW_ICONIFIED)) return {};
  int width = 0, height = 0;
  glfwGetFramebufferSize(impl_->window, &width, &height);
  return {static_cast<uint32_t>(std::max(width, 0)), static_cast<uint32_t>(std::max(height, 0))};
}

double GlfwWindow::pixels_per_unit() const { return impl_->pixels_per_unit(); }

double GlfwWindow::frames_per_second() const {
  GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* const mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  return mode && mode->refreshRate > 0 ? mode->refreshRate : kUnknownRate;
}

void GlfwWindow::set_title(const std::string& title) {
  glfwSetWindowTitle(impl_->window, frontend::visible(title).c_str());
}

Placement GlfwWindow::placement() const {
  Placement placement;
  int width = 0, height = 0, x = 0, y = 0;
  glfwGetWindowSize(impl_->window, &width, &height);
  glfwGetWindowPos(impl_->window, &x, &y);
  placement.size = {static_cast<uint32_t>(std::max(width, 0)),
                    static_cast<uint32_t>(std::max(height, 0))};
  placement.position = {x, y};
  placement.is_maximized = glfwGetWindowAttrib(impl_->window, GLFW_MAXIMIZED) != 0;
  return placement;
}

bool GlfwWindow::take_placement_change() { return std::exchange(impl_->has_new_placement, false); }

void GlfwWindow::wait() { glfwWaitEvents(); }
void GlfwWindow::wait(double timeout_s) { glfwWaitEventsTimeout(timeout_s); }
void GlfwWindow::poll() { glfwPollEvents(); }
void GlfwWindow::wake() { glfwPostEmptyEvent(); }
bool GlfwWindow::take_activity() { return std::exchange(impl_->is_active, false); }

bool GlfwWindow::is_over_panel() const { return impl_->is_over_panel(); }

void GlfwWindow::need_letters(std::string_view text) { impl_->letters->need(text); }

void GlfwWindow::begin_frame() {
  if (impl_->letters->load()) {
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
  }
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  impl_->place_cursor();
  // ImGui's Enter types into items, and only its space chooses them.
  const ImGuiIO& io = ImGui::GetIO();
  const bool is_enter_down = io.KeysDown[GLFW_KEY_ENTER] || io.KeysDown[GLFW_KEY_KP_ENTER];
  if (is_enter_down && !io.WantTextInput) ImGui::GetIO().NavInputs[ImGuiNavInput_Activate] = 1;
  ImGui::NewFrame();
  choose_first_item();
}

void GlfwWindow::drop_frame() {
  ImGui::EndFrame();
  impl_->take_waiting_keys();
}

void GlfwWindow::end_frame() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  impl_->take_waiting_keys();
  glfwSwapBuffers(impl_->window);
}

}  // namespace window
