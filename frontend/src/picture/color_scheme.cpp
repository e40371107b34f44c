#include <array>

#include "frontend/render_settings.hpp"

namespace frontend {
namespace {

constexpr Rgb rgb(uint32_t hex) {
  return {static_cast<uint8_t>(hex >> 16), static_cast<uint8_t>(hex >> 8),
          static_cast<uint8_t>(hex)};
}

constexpr ColorScheme scheme(const char* name, uint32_t background, uint32_t front, uint32_t back,
                             uint32_t axes, uint32_t crosshair, uint32_t flat_face,
                             uint32_t flat_edge, std::optional<Rgb> background_below = {}) {
  return {name,           rgb(background), rgb(front),     rgb(back),       rgb(axes),
          rgb(crosshair), rgb(flat_face),  rgb(flat_edge), background_below};
}

// ClearSky is Cornfield before a gradient (OpenSCAD's pull request 4167), whose colours the preview
// of the IntelliJ plugin com.javampire.openscad has. So has it the Gems' backgrounds; their faces
// and axes are among the themes of the editor BelfrySCAD. What is cut, crosshairs and flat figures
// have the colours of Cornfield and Starnight there: those of the Gems are published nowhere but in
// OpenSCAD itself.
constexpr std::array kSchemes = {
    scheme("Cornfield", 0xffffe5, 0xf9d72c, 0x9dcb51, 0x000000, 0x800000, 0x00bf99, 0xff0000),
    scheme("Metallic", 0xaaaaff, 0xddddff, 0xdd22dd, 0x222233, 0x800000, 0x00bf99, 0xff0000),
    scheme("Sunset", 0xaa4444, 0xffaaaa, 0x882233, 0x220d0d, 0x800000, 0x00bf99, 0xff0000),
    scheme("Starnight", 0x000000, 0xffffe0, 0x00ffff, 0xe5e5e5, 0xf0f0f0, 0x9370db, 0xff00ff),
    scheme("BeforeDawn", 0x333333, 0xcccccc, 0x5563dd, 0xc1c1c1, 0xf0f0f0, 0x00bf99, 0xff0000),
    scheme("Nature", 0xfafafa, 0x16a085, 0xdbf4da, 0x323232, 0x111111, 0x00bf99, 0xff0000),
    scheme("Daylight Gem", 0xf0f0f0, 0x02daf7, 0x9dcb51, 0x373947, 0x800000, 0x00bf99, 0xff0000),
    scheme("Nocturnal Gem", 0x0c0c0c, 0x02daf7, 0x9dcb51, 0xa7a9b7, 0xf0f0f0, 0x9370db, 0xff00ff),
    scheme("DeepOcean", 0x333333, 0xeeeeee, 0x0babc8, 0xc1c1c1, 0xf0f0f0, 0x9370db, 0xff00ff),
    scheme("Solarized", 0xfdf6e3, 0xb58800, 0x882233, 0x191816, 0x800000, 0x6c71c4, 0xb58800),
    scheme("Tomorrow", 0xf8f8f8, 0x4271ae, 0xf5871f, 0x181818, 0x8959a8, 0x718c00, 0xc82829),
    scheme("Tomorrow Night", 0x1d1f21, 0x81a2be, 0xde935f, 0xe8e8e8, 0xb294bb, 0xb5bd68, 0xcc6666),
    scheme("ClearSky", 0x87ceeb, 0xf9d72c, 0x9dcb51, 0x000000, 0x800000, 0x00bf99, 0xff0000,
           rgb(0xc9e9f6)),
    scheme("Monotone", 0xffffe5, 0xf9d72c, 0xf9d72c, 0x191916, 0x800000, 0x00bf99, 0xff0000),
};

}  // namespace

std::span<const ColorScheme> color_schemes() { return kSchemes; }

const ColorScheme* find_color_scheme(std::string_view name) {
  for (const ColorScheme& candidate : kSchemes) {
    if (candidate.name == name) return &candidate;
  }
  return nullptr;
}

}  // namespace frontend
