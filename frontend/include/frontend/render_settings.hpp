// The settings of a picture and its renderer, without the scene and the camera.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string_view>

#include "csgcore/frame_settings.hpp"
#include "csgcore/studio.hpp"

namespace frontend {

using csgcore::Shading;
/// The subject of a picture (`--show`): the shaded surface, the leaf cells (paper, figure 5b), or a
/// measured channel as grey values or colours.
enum class Show : uint8_t { kSurface, kCells, kDepth, kNormals, kId };

/// The renderer (`--renderer`). kAuto: OpenGL if there is a GPU, else the CPU.
enum class RendererKind : uint8_t { kAuto, kGl, kCpu };
/// Selects where a ray's candidate primitives come from (`--technique`): the leaf cells of a
/// kd-tree, or lists for tiles of the screen. kAuto: tiles, which both renderers draw faster.
enum class Technique : uint8_t { kAuto, kCells, kTiles };

/// The most --samples: an edge then has 65 steps between its two colours, and no eye tells more.
constexpr uint32_t kMaxSamples = 64;

/// The --samples of the studio's light if none are asked for: its lines would be jagged with one.
constexpr uint32_t kStudioSamples = 4;

/// An 8-bit colour of a scheme (frontend/OPENSCAD.md, "Light and colours").
struct Rgb {
  uint8_t r, g, b;
  bool operator==(const Rgb&) const = default;
};
struct ColorScheme {
  const char* name;
  Rgb background, front, back, axes, crosshair;
  Rgb flat_face{}, flat_edge{};  // of a final render of a plane figure
  /// At the picture's lower edge; from `background` at the upper one it changes evenly. None: the
  /// background is one colour.
  std::optional<Rgb> background_below{};
};

/// The order in which translucent parts are blended.
enum class Translucency : uint8_t {
  kFile,   // OpenSCAD's: that of the file, in which a part hides later ones behind it
  kDepth,  // from the furthest surface to the nearest
};

/// Every setting of a picture but the camera's. The defaults are the command's.
struct RenderSettings {
  ColorScheme scheme{"Cornfield",        {0xff, 0xff, 0xe5}, {0xf9, 0xd7, 0x2c},
                     {0x9d, 0xcb, 0x51}, {0x00, 0x00, 0x00}, {0x80, 0x00, 0x00},
                     {0x00, 0xbf, 0x99}, {0xff, 0x00, 0x00}};
  /// The colour of faces that are seen from within the solid; none: they have that of the outside.
  std::optional<Rgb> from_within;
  Shading shading = Shading::kOpenScad;
  csgcore::StudioSettings studio;  // of Shading::kStudio
  double phong_shadows = 0;        // how dark those of Shading::kPhong are, from 0 to 1
  Translucency translucency = Translucency::kFile;
  Show show = Show::kSurface;
  RendererKind renderer = RendererKind::kAuto;
  Technique technique = Technique::kAuto;
  uint32_t samples = 1;            // --samples: rays per pixel at edges, 1…kMaxSamples
  uint32_t leaf_primitives = 8;    // --leaf-primitives: K ≥ 1
  double threshold_px = 0;         // --threshold ≥ 0; 0: no cell is dropped
  unsigned threads = 0;            // 0: as many as the machine has
  bool measured_channels = false;  // also fill Image's z, normal, position and id
  bool depth_and_id = false;       // at least z and id
  /// Of the surfaces with ids from this one on, and of the background, fill Image::shares where
  /// anything translucent is drawn. None: do not.
  std::optional<uint32_t> shares_from;
  /// Also fill those RenderStats that take extra work: T_S, T_R and S_R, for which OpenGL draws
  /// again.
  bool all_stats = false;
  /// Whether the picture may wait for OpenGL to start, and to compile shaders: seconds, on some
  /// drivers. If not, that goes on by itself, and the CPU draws until then (SceneRenderer).
  bool waits_for_shaders = true;
  /// Once requested, the CPU's pictures end early, unfinished.
  std::stop_token stop;
  /// Called during long work with a stage and the fraction of it that is done, in [0, 1]; may be
  /// empty.
  std::function<void(const char* stage, double fraction)> progress;
};

/// Returns whether both settings give the same picture.
bool draw_the_same(const RenderSettings& a, const RenderSettings& b);

/// Returns whether the studio's shadows, occlusion or edges are drawn.
bool draws_studio(const RenderSettings& settings);

/// Returns whether the light that a surface is drawn in is taken away where the solid hides it: the
/// studio's or kPhong's.
bool draws_shadows(const RenderSettings& settings);

/// Returns OpenSCAD's colour schemes in its order; the first is the default.
std::span<const ColorScheme> color_schemes();

/// Finds a scheme by its exact name, upper and lower case distinguished, as OpenSCAD does. Null if
/// there is none.
const ColorScheme* find_color_scheme(std::string_view name);

}  // namespace frontend
