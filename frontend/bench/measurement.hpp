// Measures how long a scene takes to draw: first and steady frames of every renderer, and the times
// that the paper measures (§4.1). Pictures are compared with each other before any time is taken.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "csgcore/image.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"
#include "frontend/render.hpp"

namespace bench {

/// Counts the pixels of `image` that show another face than `exact`, or a face where the other
/// shows none. Precondition: both have the same size, and measured channels.
uint64_t wrong_pixels(const csgcore::Image& image, const csgcore::Image& exact);

/// Returns whether every channel is the same, bit for bit.
bool is_same(const csgcore::Image& a, const csgcore::Image& b);

/// Returns whether the rounding of float explains so many wrong pixels in an OpenGL picture of
/// `hits` hits.
bool float_explains(uint64_t wrong_pixels, uint64_t hits);

using Json = nlohmann::ordered_json;

/// The rule that makes a cell a leaf: it has at most K primitives, or is smaller than the
/// threshold. The default is scadray's own.
struct Rule {
  uint32_t leaf_primitives = 8;
  double threshold_px = 0;
};
/// The paper's rule (§2.2), with the threshold of §4.1.
constexpr Rule kPaperRule{2, 1};

/// How often work is repeated: at least `least` times, and then until it has taken `long_enough_ms`
/// in all or was done `most` times.
struct Repetitions {
  size_t least = 5;
  size_t most = 50;
  double long_enough_ms = 2'000;
  bool enough(size_t count, double total_ms) const {
    return count >= least && (count >= most || total_ms >= long_enough_ms);
  }
};

struct Settings {
  std::vector<Rule> rules{Rule{}, kPaperRule};  // at least one; frames by cells use the first
  /// kAuto: the CPU, and OpenGL if there is any, in software too. kGl: measure() throws without
  /// OpenGL.
  frontend::RendererKind renderer = frontend::RendererKind::kAuto;
  unsigned threads = 0;  // 0: as many as the machine has
  Repetitions repetitions;
};

using ScenePointer = std::shared_ptr<const csgcore::Scene>;
using Progress = std::function<void(const std::string& stage)>;

/// Returns the JSON of a file, without its name (README.md lists the keys). `views`, at least one,
/// are those of a turning camera. An empty model is not measured. Throws frontend::Error.
Json measure(const ScenePointer& scene, std::span<const csgcore::View> views,
             const Settings& settings, const Progress& progress);

/// Returns what measure() returns of a file as a table for people. It ends with a line break.
std::string table_of(const std::string& file, const Json& result);

}  // namespace bench
