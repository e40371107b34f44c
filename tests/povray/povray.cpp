#include "povray.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "kinds/povray_text.hpp"
#include "kinds/test_kind.hpp"

namespace povray {
namespace {

using csgcore::Affine;
using csgcore::CsgToken;
using csgcore::Op;
using csgcore::Primitive;
using csgcore::ReferenceColors;
using csgcore::Scene;
using csgcore::Vec3;
using csgcore::View;
using test_support::povray::number;
using test_support::povray::vector;

/// Two steps of 8 bits, which a surface's ambient part must exceed to be told from a miss.
constexpr double kBrighterThanBlack = 2.0 / 255;

std::string matrix(const Affine& map) {
  std::string text = "matrix <";
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) text += number(map.linear[column][row]) + ",";
  }
  return text + number(map.translation.x) + "," + number(map.translation.y) + "," +
         number(map.translation.z) + ">";
}

Vec3 base_color(const Primitive& p, bool subtracted, const ReferenceColors& colors) {
  if (p.color) return {p.color->r, p.color->g, p.color->b};
  return subtracted ? colors.back : colors.front;
}

std::string primitive_text(const Primitive& p, const Vec3& color) {
  return test_support::test_kind_of(p.shape()).as_povray(p) + " texture { pigment { rgb " +
         vector(color) + " } finish { Lit } } " + matrix(p.local_to_world) + " }\n";
}

const char* keyword(Op op) {
  switch (op) {
    case Op::kUnion:
      return "union";
    case Op::kIntersection:
      return "intersection";
    case Op::kDifference:
      return "difference";
  }
  return "";
}

/// Returns a colour for each primitive.
std::vector<Vec3> base_colors(const Scene& scene, const ReferenceColors& colors) {
  const std::vector<bool> subtracted = csgcore::subtracted_primitives(scene);
  std::vector<Vec3> result;
  for (size_t i = 0; i < scene.primitives.size(); ++i) {
    result.push_back(base_color(scene.primitives[i], subtracted[i], colors));
  }
  return result;
}

/// The postfix tree in POV-Ray's nested form. Operands are collected on a stack, each as its text.
std::string tree_text(const Scene& scene, const std::vector<Vec3>& colors) {
  std::vector<std::string> stack;
  for (const CsgToken& token : scene.model.tokens()) {
    if (token.is_primitive) {
      stack.push_back(primitive_text(scene.primitives[token.value], colors[token.value]));
      continue;
    }
    std::string text = std::string(keyword(token.op)) + " {\n";
    const size_t first = stack.size() - token.value;
    for (size_t i = first; i < stack.size(); ++i) text += stack[i];
    stack.resize(first);
    stack.push_back(text + "}\n");
  }
  return stack.empty() ? "" : stack.front();
}

/// POV-Ray's camera takes its handedness from right, up and direction.
std::string camera_text(const Scene& scene, const View& view) {
  const double width = 2 * view.half_height * view.width_px / view.height_px;
  const bool orthographic = view.projection == csgcore::Projection::kOrthographic;
  Vec3 location = view.eye;
  if (orthographic) {
    // POV-Ray sees only what is in front of the camera, so that the camera steps back until the
    // whole model is.
    const csgcore::Box box = csgcore::reference_box(scene);
    if (!box.empty()) {
      const double depth = glm::dot(box.center() - view.eye, view.forward);
      location += (depth - 2 * box.diagonal()) * view.forward;
    }
  }
  return std::string("camera { ") + (orthographic ? "orthographic" : "perspective") + " location " +
         vector(location) + " right " + vector(width * view.right) + " up " +
         vector(2 * view.half_height * view.up) + " direction " + vector(view.forward) + " }\n";
}

/// `finish` is that of all surfaces.
std::string header_text(const Vec3& background, const std::string& finish) {
  return std::string(
             "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\nbackground { color rgb ") +
         vector(background) + " }\n#declare Lit = finish { " + finish + " }\n";
}

/// A folder that is removed with its contents.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = std::filesystem::temp_directory_path() / "scadray-povray-XXXXXX";
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder " + name);
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Runs a program with its messages going to `log`; returns whether it exits with 0.
bool run(std::vector<std::string> arguments, const std::filesystem::path& log) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return failed == 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) &&
         WEXITSTATUS(status) == 0;
}

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Reads the next number of a PPM's header, and skips comments.
uint32_t header_number(std::istream& in) {
  while ((in >> std::ws).peek() == '#') {
    in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  uint32_t number = 0;
  in >> number;
  return number;
}

/// Reads a binary PPM of 8 bits.
Pixels read_ppm(const std::string& bytes, uint32_t width_px, uint32_t height_px) {
  std::istringstream in(bytes);
  std::string magic;
  in >> magic;
  const uint32_t width = header_number(in), height = header_number(in), most = header_number(in);
  in.get();  // the one white space before the pixels
  Pixels pixels(size_t(width_px) * height_px);
  in.read(reinterpret_cast<char*>(pixels.data()), std::streamsize(pixels.size() * 3));
  if (!in || magic != "P6" || width != width_px || height != height_px || most != 255) {
    throw std::runtime_error("POV-Ray's picture is not the PPM that was asked for");
  }
  return pixels;
}

}  // namespace

bool may_be_told_from_black(const Scene& scene, const ReferenceColors& colors) {
  const std::vector<bool> subtracted = csgcore::subtracted_primitives(scene);
  for (size_t i = 0; i < scene.primitives.size(); ++i) {
    const Vec3 color = base_color(scene.primitives[i], subtracted[i], colors);
    const double brightest = std::max({color.x, color.y, color.z});
    if (csgcore::kPhongAmbient * brightest < kBrighterThanBlack) return false;
  }
  return true;
}

std::string scene_text(const Scene& scene, const View& view, const csgcore::PhongLight& light,
                       const ReferenceColors& colors) {
  const std::string finish = std::string("ambient ") + number(csgcore::kPhongAmbient) +
                             " diffuse " + number(csgcore::kPhongDiffuse) + " phong " +
                             number(csgcore::kPhongSpecular) + " phong_size " +
                             number(csgcore::kPhongExponent);
  return header_text(Vec3(0.0), finish) + camera_text(scene, view) + "light_source { " +
         vector(light.position_world) + " color rgb <1,1,1> }\n" +
         tree_text(scene, base_colors(scene, colors));
}

std::string openscad_scene_text(const Scene& scene, const View& view,
                                const ReferenceColors& colors) {
  // Two lights give |n·l|, from either side.
  const Vec3 to_light = view.up - view.right - view.forward;
  std::string lights;
  for (const double side : {1.0, -1.0}) {
    lights += std::string("light_source { ") + vector(side * to_light) +
              " color rgb <1,1,1> parallel point_at <0,0,0> }\n";
  }
  return header_text(colors.background, "ambient 0.2 diffuse 1") + camera_text(scene, view) +
         lights + tree_text(scene, base_colors(scene, colors));
}

std::string id_scene_text(const Scene& scene, const View& view) {
  std::vector<Vec3> colors;
  for (uint32_t i = 1; i <= scene.primitives.size(); ++i) {
    colors.push_back(Vec3(i >> 16 & 0xff, i >> 8 & 0xff, i & 0xff) / 255.0);
  }
  return header_text(Vec3(0.0), "ambient 1 diffuse 0") + camera_text(scene, view) +
         tree_text(scene, colors);
}

uint32_t primitive_of(const std::array<uint8_t, 3>& pixel) {
  const uint32_t value = uint32_t{pixel[0]} << 16 | uint32_t{pixel[1]} << 8 | pixel[2];
  return value == 0 ? csgcore::kNoPrimitive : value - 1;
}

Pixels render(const std::string& scene_text, uint32_t width_px, uint32_t height_px) {
  const TemporaryFolder folder;
  const std::filesystem::path scene = folder.path() / "scene.pov";
  const std::filesystem::path picture = folder.path() / "picture.ppm";
  const std::filesystem::path log = folder.path() / "log";
  std::ofstream(scene, std::ios::binary) << scene_text;
  // +FP8: PPM of 8 bits. -D: no window. -A: no antialiasing.
  const bool done = run(
      {"povray", "+I" + scene.string(), "+O" + picture.string(), "+FP8", "-D", "-A", "-V", "+Q3",
       "File_Gamma=1.0", "+W" + std::to_string(width_px), "+H" + std::to_string(height_px)},
      log);
  if (!done) throw std::runtime_error("povray failed:\n" + contents(log));
  return read_ppm(contents(picture), width_px, height_px);
}

bool installed() {
  const TemporaryFolder folder;
  return run({"povray", "--version"}, folder.path() / "log");
}

}  // namespace povray
