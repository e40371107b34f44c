// Judges a renderer's picture by the exact ray oracle, pixel by pixel.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "csgcore/scene.hpp"
#include "csgcore/tracer.hpp"
#include "csgcore/view.hpp"
#include "error_histogram.hpp"
#include "oracle/exact_rays.hpp"

namespace stress {

/// The errors that a pixel may have and still be right.
struct Tolerance {
  double position;    // as a share of the model's size
  double normal;      // length of the difference of the unit normals
  double coordinate;  // relative rounding of the picture's coordinates
};

/// For the tracer: positions tell surfaces apart that are a tolerance (thickness_tolerance) apart;
/// normals tell a wrong side or a wrong face.
constexpr Tolerance kDoubleTolerance{oracle::kExactPositionError, oracle::kExactNormalError,
                                     0x1p-52};
/// For GL, as in tests/glrender (half a degree).
constexpr Tolerance kFloatTolerance{1e-4, 8.7e-3, 0x1p-22};

enum class Verdict : uint8_t {
  kRight,
  kWrongHit,        // a hit for a miss, or a miss for a hit
  kWrongPrimitive,  // another primitive, whatever the position
  kWrongPosition,
  kWrongNormal,
};
constexpr size_t kVerdicts = 5;

/// Compares a pixel with what the exact ray sees of the scene.
Verdict verdict_of(const oracle::ExactHit& expected, const csgcore::Hits& picture, size_t pixel,
                   const Tolerance& tolerance, const oracle::ExactScene& scene);

const char* name_of(oracle::Doubt doubt);

/// Sums over pixels. A pixel that is not right is undecided if there is a doubt (ExactRays::doubt),
/// and wrong otherwise.
struct Tally {
  uint64_t pixels = 0;
  uint64_t hits = 0;  // hits of the oracle
  uint64_t wrong[kVerdicts] = {};
  uint64_t undecided = 0;
  /// Wrong pixels with at least three of their four direct neighbours right and showing the
  /// primitive (or the miss) that this pixel ought to show.
  uint64_t speckle = 0;
  /// The errors of right hits, as shares of the model's size, and as lengths of differences of unit
  /// normals.
  ErrorHistogram position_errors, normal_errors;
  /// The largest error of positions that the rounding of the picture's coordinates alone explains,
  /// as a share of the model's size.
  double position_rounding = 0;
  std::string first_wrong;
  std::vector<std::string> undecided_pixels;  // the first ones of each picture

  uint64_t wrong_pixels() const;
  void add(const Tally& other);
};

/// The exact picture, and questions about single pixels. Scene and view must outlive this object.
class Oracle {
 public:
  Oracle(const csgcore::Scene& scene, const csgcore::View& view);

  const oracle::ExactHit& hit(size_t pixel) const { return hits_[pixel]; }
  const csgcore::View& view() const { return *view_; }
  double model_size() const { return scene_.size(); }
  const oracle::ExactScene& scene() const { return scene_; }
  uint64_t hits() const;
  /// Caches its answers.
  oracle::Doubt doubt(size_t pixel);

 private:
  const csgcore::View* view_;
  oracle::ExactScene scene_;
  oracle::ExactRays rays_;
  std::vector<oracle::ExactHit> hits_;
  std::unordered_map<size_t, oracle::Doubt> doubts_;
};

/// `picture` must be of the oracle's scene and view.
Tally judge(Oracle& oracle, const csgcore::Hits& picture, const Tolerance& tolerance);

}  // namespace stress
